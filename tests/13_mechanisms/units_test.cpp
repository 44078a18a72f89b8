// The units of arguments and results of this chapter's functions, and tests in any units.
#include "contract.hpp"
#include "exercise_test.hpp"
#include "frames.hpp"
#include "quantities.hpp"

using namespace spook;
using namespace spook::testing;

namespace spook::testing {

/// The units of a coordinate's quantities: an angle is a pure number, a shift is in metres.
struct OfCoordinate {
  Unit value;

  Unit rate() const { return value / units::s; }
  Unit impulse() const { return units::J * units::s / value; }  // N m s, or N s
  Unit softness() const { return rate() / impulse(); }          // Σ λ is a rate
  TwistUnits jacobian() const { return {value / units::m, value}; }
  TwistUnits responses() const {
    return {value / (units::kg * units::m), value / (units::kg * units::m * units::m)};
  }
};

static void each_number(Visitor& visitor, JointFrame& frame, ByField) {
  visitor.count(frame.at.body);
  each_number(visitor, frame.at.x, units::m), each_number(visitor, frame.at.r, units::m);
  each_number(visitor, frame.axes, units::pure);
}

static void each_number(Visitor& visitor, Coordinate& c, const OfCoordinate& of) {
  visitor.count(c.i), visitor.count(c.j);
  each_number(visitor, c.Gi, of.jacobian()), each_number(visitor, c.Gj, of.jacobian());
  visitor.number(c.value, of.value);
}

static void each_number(Visitor& visitor, JointLimits& range, const OfCoordinate& of) {
  visitor.bound(range.lower, of.value), visitor.bound(range.upper, of.value);
}

static void each_number(Visitor& visitor, SpookParameters& spook, const OfCoordinate& of) {
  visitor.number(spook.a, 1 / units::s), visitor.number(spook.b, units::pure);
  visitor.number(spook.Sigma, of.softness());
}

static void each_number(Visitor& visitor, Constraint<6>& row, const OfCoordinate& of) {
  visitor.count(row.i), visitor.count(row.j);
  each_number(visitor, row.Gi, of.jacobian()), each_number(visitor, row.Gj, of.jacobian());
  visitor.number(row.gap, of.value);
  each_number(visitor, row.spook, of);
  visitor.bound(row.lo, of.impulse()), visitor.bound(row.hi, of.impulse());
}

static void each_number(Visitor& visitor, Motor& motor, const OfCoordinate& of) {
  visitor.number(motor.speed, of.rate());
  visitor.number(motor.strength, of.impulse() / units::s);
  visitor.number(motor.viscosity, of.impulse() / units::s / of.rate());
}

static void each_number(Visitor& visitor, Row<6>& row, const OfCoordinate& of) {
  visitor.count(row.i), visitor.count(row.j);
  each_number(visitor, row.Gi, of.jacobian()), each_number(visitor, row.Gj, of.jacobian());
  each_number(visitor, row.MinvGi, of.responses()), each_number(visitor, row.MinvGj, of.responses());
  visitor.number(row.B, of.rate());
  visitor.number(row.Sigma, of.softness()), visitor.number(row.diagonal, of.softness());
  visitor.bound(row.lo, of.impulse()), visitor.bound(row.hi, of.impulse());
  visitor.number(row.lambda, of.impulse());
}

}  // namespace spook::testing

namespace {

EXERCISE(TurnedApart, "13.1 turned_apart");
EXERCISE(ShiftAlong, "13.2 shift_along");
EXERCISE(HingeAngle, "13.3 hinge_angle");
EXERCISE(LimitConstraint, "13.4 limit_constraint");
EXERCISE(MotorRow, "13.5 motor_row");

const OfCoordinate an_angle{units::pure}, a_shift{units::m};

template <class Value>
Quantity<Value, OfCoordinate> with(const Value& value, const OfCoordinate& of) {
  return {value, of};
}

/// Both kinds of coordinate, of the same two bodies 0 and 1.
std::vector<Quantity<Coordinate, OfCoordinate>> coordinates() {
  RandomFrames t;
  t.i.at.body = 0, t.j.at.body = 1;
  return {with(turned_apart(t.i, t.j)[1], an_angle), with(shift_along(t.i, t.j, 1), a_shift)};
}

EXERCISE_TEST(TurnedApart, IsTheSameInAnyUnits) {
  const RandomFrames t;
  expect_same_in_any_units("Eq. (13.1)-(13.4)", turned_apart, an_angle, t.i, t.j);
}

EXERCISE_TEST(ShiftAlong, IsTheSameInAnyUnits) {
  const RandomFrames t;
  for (const int axis : {0, 1, 2})
    if (!expect_same_in_any_units("Eq. (13.5), (13.6)", shift_along, a_shift, t.i, t.j, axis)) return;
}

EXERCISE_TEST(HingeAngle, IsTheSameInAnyUnits) {
  RandomFrames t;
  t.close_hinge(2.5);
  for (const double last : {-2.5, 2.0, 30.0})
    if (!expect_same_in_any_units("Eq. (13.8), (13.9)", hinge_angle, an_angle, t.i, t.j, last)) return;
}

EXERCISE_TEST(LimitConstraint, IsTheSameInAnyUnits) {
  for (const auto& [free, of] : coordinates())
    for (const double before : {0.3, 1e-9, -0.2}) {  // far from the limit, close to it, and beyond
      const JointLimits range{.lower = free.value - 1, .upper = free.value + before};
      const SpookParameters spook{.a = 3, .b = 0.8, .Sigma = 0.1};
      if (!expect_same_in_any_units_nans_aside("Eq. (13.10), (13.11)", limit_constraint, of, with(free, of),
                                               with(range, of), with(spook, of), 0.01 * units::s))
        return;
    }
}

EXERCISE_TEST(MotorRow, IsTheSameInAnyUnits) {
  Random random;
  Motion<6> motion;
  for (int body = 0; body < 2; ++body) {
    motion.inverse_mass.push_back({.linear = 0.3 + body, .angular = Vec3(1, 2, 3 + body).asDiagonal()});
    motion.W.push_back(random.twist());
    motion.Wf.push_back(random.twist());
  }
  for (const auto& [free, of] : coordinates()) {
    const Motor motor{.speed = -1.5, .strength = 4, .viscosity = 30};
    if (!expect_same_in_any_units("Eq. (13.12), (13.13)", motor_row, of, with(free, of), with(motor, of),
                                  0.01 * units::s, motion))
      return;
  }
}

}  // namespace
