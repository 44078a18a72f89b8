// The answers of the mechanisms' scenes, against published numbers and another integrator: nothing here runs the engine.
//
//   pendulum     x, y at 10 s and the period, from horizontal       A01 of the library of benchmark problems for multibody
//                                                                   dynamics, Universidad de La Coruña
//   governor     cos θ = (1 + m/(2M)) g/(l ω²), and its swings      closed form; scenes/governor_motion.hpp in two ways
//   squeezer     seven angles at 0.03 s                             Mazzia and Magherini, Test Set for IVP Solvers, andrews
#include <gtest/gtest.h>

#include "dormand_prince.hpp"
#include "scenes/andrews_squeezer.hpp"
#include "scenes/governor_motion.hpp"
#include "scenes/mechanism.hpp"
#include "scenes/plane_pendulum.hpp"

namespace spook {
namespace {

const Vec3 down(0, 0, -9.81);

/// One point at 1 m from the origin, level with it.
NaturalCoordinates pendulum() {
  NaturalCoordinates point;
  const auto origin = NaturalCoordinates::fixed(Vec3::Zero());
  const auto bob = point.add(Vec3::UnitX());
  point.hold(bob, origin, bob, origin);
  point.add_rod(bob, bob, 1, down);
  return point;
}

Numbers by_dormand_prince(const NaturalCoordinates& mechanism, double time, double tolerance) {
  return dormand_prince([&](const Numbers& y) { return mechanism.rate(y); }, mechanism.start(), time, tolerance,
                        [&](const Numbers& y) { return mechanism.projected(y); });
}

TEST(PublishedNumbers, PendulumFromHorizontal) {
  const double x = -0.27508746, y = -0.96141921, period = 2.367841947576;
  // Starts at +x: the published pendulum starts at -x.
  const Numbers end = by_dormand_prince(pendulum(), 10, 1e-12);
  EXPECT_NEAR(std::abs(end[0]), std::abs(x), 1e-8) << "eight digits are published";
  EXPECT_NEAR(end[2], y, 1e-8);
  const PlanePendulum closed(std::acos(-1) / 2, std::sqrt(9.81));
  EXPECT_NEAR(closed.period(), period, 1e-12);
  EXPECT_NEAR(closed.direction(10).sin, end[0], 1e-10);
  EXPECT_NEAR(-closed.direction(10).cos, end[2], 1e-10);
}

TEST(PublishedNumbers, AndrewsSqueezer) {
  using namespace squeezer;
  Angles published;
  published << 15.81077119629904, -15.75637105984298, 0.04082224013073101, -0.5347301163226948,
      0.5244099658805304, 0.5347301163226948, 1.048080741042263;
  EXPECT_LE(closure(start()).norm(), 1e-16);
  State rest;
  rest << start(), Angles::Zero();
  const Numbers end = dormand_prince([](const Numbers& y) -> Numbers { return rate(y); }, rest, 0.03, 1e-11,
                                     [](const Numbers& y) -> Numbers { return projected(y); });
  ReferenceMotion<14> extrapolated([](const State& y) { return rate(y); }, rest, 1e-14,
                                   [](const State& y) { return projected(y); });
  for (int n = 0; n < 7; ++n) {
    EXPECT_NEAR(extrapolated.at(0.03)[n], end[n], 2e-11) << "two methods, angle " << n;
    // The crank turns at 1140 rad/s then. The published angles are late by 1e-12 s, more than the two methods differ.
    EXPECT_NEAR(end[n], published[n], 1140 * 1.5e-12) << "angle " << n;
  }
}

TEST(NaturalCoordinates, KeepEnergyAndWhatIsHeld) {
  NaturalCoordinates rods;  // a double pendulum of rods, not in its plane of rest
  const auto origin = NaturalCoordinates::fixed(Vec3::Zero());
  const auto first = rods.add(Vec3::UnitX()), second = rods.add(Vec3(1, 1, 0), Vec3(0.5, 0, 1));
  rods.hold(first, origin, first, origin);
  rods.hold(second, first, second, first);
  rods.add_rod(origin, first, 1, down);
  rods.add_rod(first, second, 2, down);
  // The given velocities need not satisfy the constraints: only the admissible part counts.
  const Numbers start = rods.projected(rods.start());
  const Numbers end = dormand_prince([&](const Numbers& y) { return rods.rate(y); }, start, 3, 1e-11,
                                     [&](const Numbers& y) { return rods.projected(y); });
  EXPECT_NEAR(rods.energy(end), rods.energy(start), 1e-8);
  EXPECT_NEAR(rods.at(first, end).norm(), 1, 1e-14);
  EXPECT_NEAR((rods.at(second, end) - rods.at(first, end)).norm(), 1, 1e-14);
}

TEST(NaturalCoordinates, ARodSwingsAsItsInertiaSays) {
  // m l²/3 about its end, as a point at 2 l/3.
  NaturalCoordinates one;
  const auto origin = NaturalCoordinates::fixed(Vec3::Zero());
  const auto end = one.add(Vec3::UnitX());
  one.hold(end, origin, end, origin);
  one.add_rod(origin, end, 3, down);
  const PlanePendulum closed(std::acos(-1) / 2, std::sqrt(9.81 * 1.5));
  const Numbers y = by_dormand_prince(one, 2, 1e-12);
  EXPECT_NEAR(y[0], closed.direction(2).sin, 1e-10);
}

TEST(NaturalCoordinates, ExtrapolationAndDormandPrinceAgree) {
  const NaturalCoordinates point = pendulum();
  NaturalMotion motion = motion_of(point);
  EXPECT_LE((motion.at(3) - by_dormand_prince(point, 3, 1e-12)).cwiseAbs().maxCoeff(), 1e-10);
}

// A governor with a known steady speed, and one with any other.

const Governor watts{.l = 0.3, .M = 0.5, .J = 3.2e-4, .m = 1, .I0 = 0.011, .g = 9.81};

TEST(FlyballGovernor, ExtrapolationAndDormandPrinceAgree) {
  const Governor::State start(0.5, 0, 0);
  const double L = watts.moment(start[0]) * 11;
  const auto rate = [&](const Governor::State& y) { return watts.rate(y, L); };
  ReferenceMotion<3> extrapolated(rate, start);
  const Numbers end = dormand_prince([&](const Numbers& y) -> Numbers { return rate(y); }, start, 2, 1e-13);
  EXPECT_GT(std::abs(end[0] - start[0]), 0.01) << "the governor should swing";
  EXPECT_LE((extrapolated.at(2) - end).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_NEAR(watts.energy(end, L), watts.energy(start, L), 1e-11);
}

TEST(FlyballGovernor, StaysWhereItTurnsSteadily) {
  for (const double theta : {0.2, 0.7, 1.4}) {
    const double spin = watts.steady(theta);
    EXPECT_NEAR(std::cos(theta), (1 + watts.m / (2 * watts.M)) * watts.g / (watts.l * spin * spin), 1e-14);
    const Governor::State rate = watts.rate({theta, 0, 0}, watts.moment(theta) * spin);
    EXPECT_NEAR(rate[1], 0, 1e-12 * spin * spin) << theta;
    EXPECT_NEAR(rate[2], spin, 1e-14 * spin) << theta;
  }
}

}  // namespace
}  // namespace spook
