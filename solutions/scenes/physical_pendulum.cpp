// A rod on a hinge, released from rest, with an optional stop on the other side.
//
//   θ'' = -(m g s/I) sin θ,   I = I_y + m s²                                  from -θ0, θ = 0 hangs down
//   the stop at θ1 removes the angular momentum I θ'                          Eq. (13.11)
//   afterwards it is a pendulum of amplitude θ1; or it rests on the stop, if θ1 <= 0
#include "scenes/degrees.hpp"
#include "scenes/number.hpp"
#include "scenes/plane_pendulum.hpp"
#include "scenes/registry.hpp"

namespace spook {

namespace {

constexpr double rod_thickness = 0.02;  // half the thickness [m]

double rod_inertia(const Parameters& p) {
  const double s = p.number("length") / 2, m = p.number("m");
  return solid_box_moments(m, Vec3(rod_thickness, rod_thickness, s)).y() + m * s * s;
}
double rod_squared_rate(const Parameters& p) {
  return p.number("m") * p.number("g") * p.number("length") / 2 / rod_inertia(p);
}

double pendulum_angle(const PlanePendulum& pendulum, double t) {
  const PlanePendulum::Direction theta = pendulum.direction(t);
  return std::atan2(theta.sin, theta.cos);
}

/// Returns the first time at which a pendulum from rest at -θ0 is at `angle`; infinite if it does not reach that angle.
double arrival(const PlanePendulum& down, double angle0, double angle) {
  if (!(angle < angle0)) return infinity;
  double before = 0, after = down.period() / 2;
  for (int n = 0; n < 200; ++n) {
    const double middle = (before + after) / 2;
    (pendulum_angle(down, middle) < angle ? before : after) = middle;
  }
  return after;
}

class PhysicalPendulum : public WorldScene<6> {
 public:
  PhysicalPendulum(const Parameters& p, const Method& method)
      : WorldScene({.gravity = Vec3(0, 0, -p.number("g")), .k = p.number("k"), .d = p.number("d")}, method),
        s_(p.number("length") / 2),
        stop_(radians(p.number("stop"))),
        down_(-radians(p.number("angle")), std::sqrt(rod_squared_rate(p))),
        back_(std::max(stop_, 0.0), std::sqrt(rod_squared_rate(p))),
        arrival_(arrival(down_, radians(p.number("angle")), stop_)),
        inertia_(rod_inertia(p)) {
    const double angle0 = radians(p.number("angle")), m = p.number("m");
    if (!(stop_ > -angle0))
      throw std::invalid_argument("stop must be more than -angle = " + short_text(-p.number("angle")) +
                                  " degrees, where the rod is released, but is " +
                                  short_text(p.number("stop")));
    const int frame = world_.add_fixed(Vec3::Zero());
    const Vec3 half(rod_thickness, rod_thickness, s_);
    rod_ = world_.add({.x = turned(-angle0) * Vec3(0, 0, -s_),
                       .mass = m,
                       .q = turned(-angle0),
                       .principal = solid_box_moments(m, half),
                       .corners = box_corners(half)});
    Joint hinge{.i = frame,
                .j = rod_,
                .p_j = Vec3(0, 0, s_),
                .kind = JointKind::hinge,
                .axis = -Vec3::UnitY(),
                .rest = Quat::Identity()};
    if (std::isfinite(arrival_)) hinge.limits = JointLimits{.upper = stop_};
    world_.add_joint(hinge);
    world_.start_consistently(h_);
    // Gravity makes θ'² = 2 ω² (cos θ - cos θ0).
    stopped_ = std::isfinite(arrival_)
                   ? inertia_ * std::sqrt(2 * rod_squared_rate(p) * (std::cos(stop_) - std::cos(angle0)))
                   : 0;
  }

  void observe() override {
    largest_error_ = larger(largest_error_, std::abs(world_.joint_position(0) - answer()));
    // Counts impulses from the arrival; a later load by the weight is not counted.
    if (std::abs(time() - arrival_) < 2.5 * h_) given_ -= h_ * world_.limit_force(0);
  }
  double error() const override { return largest_error_; }
  std::vector<Ghost> ghosts() const override {
    const Quat q = turned(answer());
    return {{.body = rod_, .x = q * Vec3(0, 0, -s_), .q = q}};
  }

  void results(StateStream& s) override { s(given_, largest_error_); }

  std::vector<std::string> columns() const override {
    return {"time [s]",   "angle [degrees]",     "answer [degrees]",
            "stop [N m]", "its impulse [N m s]", "I ω [kg m²/s]"};
  }
  std::vector<double> sample() const override {
    return {time(), world_.joint_position(0) / radians(1), answer() / radians(1), world_.limit_force(0),
            given_, time() < arrival_ ? 0 : stopped_};
  }

 private:
  /// The orientation of the rod at an angle, which grows towards x.
  static Quat turned(double angle) { return Quat(Eigen::AngleAxisd(-angle, Vec3::UnitY())); }

  double answer() const {
    if (time() < arrival_) return pendulum_angle(down_, time());
    return stop_ > 0 ? pendulum_angle(back_, time() - arrival_) : stop_;
  }

  double s_, stop_;
  PlanePendulum down_, back_;
  double arrival_;  // time of arrival at the stop [s]
  double inertia_;
  double stopped_ = 0, given_ = 0;  // [N m s]
  int rod_ = 0;
  double largest_error_ = 0;
};

}  // namespace

SceneDescription physical_pendulum() {
  const Limits positive = {.low = 0, .low_included = false};
  Parameter k = parameter::stiffness(), d = parameter::relaxation();
  k.value = 1e12;  // a softer hinge would return part of the impulse
  d.value = 0.25;
  return {
      .name = "physical_pendulum",
      .summary = "A rod swings on a hinge, to a stop if there is one.",
      .answer =
          "sin(θ/2) = sin(θ0/2) cd(ωt), ω² = m g s/I. The stop removes I θ' at once; afterwards it is a "
          "pendulum released there.",
      .error_name = "largest error of the angle",
      .error_unit = "rad",
      .parameters = {{.name = "length", .meaning = "of the rod", .unit = "m", .value = 1, .limits = positive},
                     {.name = "angle",
                      .meaning = "initial angle, from hanging down",
                      .unit = "degrees",
                      .value = 90,
                      .limits = {.low = 0, .high = 180, .low_included = false, .high_included = false}},
                     {.name = "stop",
                      .meaning = "the angle of a stop beyond the lowest point; 180: none",
                      .unit = "degrees",
                      .value = 180,
                      .limits = {.low = -180, .high = 180}},
                     parameter::mass(),
                     parameter::gravity(),
                     k,
                     d},
      .h = 0.001,
      .time = 5,
      .solves = true,
      .build = build_as<PhysicalPendulum>,
      .solver = "direct"};
}

}  // namespace spook
