// Scenes of mechanisms, against laws that their answers do not use: energies, momenta, and each other.
#include <gtest/gtest.h>

#include <cmath>

#include "checks.hpp"
#include "scene_runs.hpp"

namespace spook::mechanism_scenes_test {
namespace {

const double pi = std::acos(-1);

TEST(Door, MovesAlikeOnAnyNumberOfHinges) {
  const double h = 0.01, time = 3;
  const SceneRun one = run_of("door", {{"hinges", "1"}}, h, time);
  for (const std::string hinges : {"2", "3", "10"}) {
    const SceneRun more = run_of("door", {{"hinges", hinges}}, h, time);
    // A hinge lags by h² times its load, and several of them share it in another way.
    EXPECT_NEAR(more.last("angle [degrees]"), one.last("angle [degrees]"), 1e-3) << hinges << " hinges";
    EXPECT_NEAR(more.last("along the post [N]"), 20 * 9.81 * std::cos(10 * pi / 180), 1e-3);
  }
}

TEST(Door, SwingsThroughTheLowestPointAsFastAsEnergySays) {
  // θ'² = 2 ω² (1 - cos θ0), ω² = (3/2) g sin(lean)/w for a thin door; from angles, half a step each side.
  const double h = 0.001, w2 = 1.5 * 9.81 * std::sin(10 * pi / 180) / (1 + 0.04 * 0.04 / 4);
  const SceneRun run = run_of("door", {}, h, 2);
  const std::vector<double>& angle = run.all("angle [degrees]");
  double fastest = 0;
  for (std::size_t n = 1; n < angle.size(); ++n)
    fastest = std::max(fastest, std::abs(angle[n] - angle[n - 1]) / h * pi / 180);
  EXPECT_NEAR(fastest, std::sqrt(2 * w2), 1e-3 * fastest);
}

TEST(PhysicalPendulum, IsOfSecondOrder) {
  testing::expect_order(
      "a rod on a hinge", "", [](double h) { return error_of("physical_pendulum", {}, h, 2); }, 0.01, 3, 2,
      0.1);
}

TEST(PhysicalPendulum, GivesItsMomentumToTheStop) {
  // m g (L/2)(cos θ1 - cos θ0) of energy, I = m L²/3 of a thin rod: I ω² = 2 E.
  const double m = 1, L = 1, I = m * (L * L / 3 + 0.04 * 0.04 / 12);
  for (const double stop : {-20.0, 0.0, 30.0, 60.0}) {
    const SceneRun run = run_of("physical_pendulum", {{"stop", std::to_string(stop)}}, 0.001, 1);
    const double E = m * 9.81 * L / 2 * std::cos(stop * pi / 180);
    // The impulse of gravity in the two or three steps of the stop is included.
    EXPECT_NEAR(run.last("its impulse [N m s]"), std::sqrt(2 * I * E), 0.003 * 9.81 * L / 2 + 1e-3) << stop;
    EXPECT_LE(run.error, 5e-3) << "stop at " << stop
                               << " degrees: ω h at the stop, 5e-3 rad, is the fraction of one step";
    for (const double angle : run.all("angle [degrees]")) ASSERT_LE(angle, stop + 1e-3);
  }
}

TEST(Flywheel, HasTurnedByTheAreaUnderItsSpeed) {
  // w t - I w²/(2T), and half a step of w more: the speed at a step's end holds through it.
  const double I = 10 * 0.25 / 2, T = 5, w = 20, h = 0.01, time = 10;
  const SceneRun run = run_of("flywheel", {}, h, time);
  EXPECT_NEAR(run.last("turned [rad]"), w * time - I * w * w / (2 * T) + h / 2 * w, 1e-6);
  EXPECT_NEAR(run.last("motor [N m]"), 0, 1e-6);
}

TEST(Flywheel, OfAMotorThatEasesOffIsOfFirstOrder) {
  testing::expect_order(
      "c = 2", "",
      [](double h) {
        return error_of("flywheel", {{"c", "2"}}, h, 10);
      },
      0.04, 3, 1, 0.1);
}

TEST(Gyroscope, KeepsItsSpinAndDoesNotNod) {
  const SceneRun run = run_of("gyroscope", {}, 0.001, 5);
  for (const double spin : run.all("spin [rad/s]")) ASSERT_NEAR(spin, 100, 1e-3);
  for (const double nod : run.all("nod [degrees]")) ASSERT_NEAR(nod, 0, 1e-2);
  testing::expect_order(
      "precession", "", [](double h) { return error_of("gyroscope", {}, h, 1); }, 0.004, 2, 2, 0.1);
}

TEST(Bead, KeepsItsAngularMomentum) {
  // The frame pulls at the rod's centre, F/k beside the axis, F up to 7 N: a torque of F²/k = 5e-8 N m at most, for 0.6
  // s.
  const SceneRun run = run_of("bead", {}, 0.001, 0.6);
  const std::vector<double>& L = run.all("L [kg m²/s]");
  const double out = run.last("out [m]"), slow = run.last("spin [rad/s]");
  for (std::size_t n = 1; n < L.size(); ++n) ASSERT_NEAR(L[n], L[1], 3e-8) << "step " << n;
  EXPECT_NEAR(slow, L[1] / (1 + 0.001 + 0.0004 + out * out), 2e-3 * slow)
      << "ω = L/(I + m r²); and ω is half a step older, by h r r'/(I + m r²) of it";
  EXPECT_GT(out, 0.5) << "it should slide out";
}

TEST(Mechanisms, AreTheSameByAnySolver) {
  for (const std::string scene : {"door", "physical_pendulum", "flywheel", "gyroscope", "bead"}) {
    const double h = 0.002, direct = error_of(scene, {}, h, 0.2);
    EXPECT_NEAR(error_of(scene, {}, h, 0.2, {}, "auto"), direct, 1e-6 + 1e-2 * direct) << scene;
    EXPECT_NEAR(error_of(scene, {}, h, 0.2, {.max_sweeps = 3000, .tolerance = 1e-12}, "gauss_seidel"), direct,
                1e-6 + 1e-2 * direct)
        << scene;
  }
}

}  // namespace
}  // namespace spook::mechanism_scenes_test
