// The engine on mechanisms: published angles, and energy over ten seconds. plots/mechanisms/published.cpp claims the
// order of its steps.
#include <gtest/gtest.h>

#include <cmath>
#include <iomanip>
#include <sstream>

#include "engine/scene_runs.hpp"
#include "scenes/andrews_squeezer.hpp"

namespace spook {
namespace {

/// A scene with steps of order four, whose remaining error is not of second order.
class RattleRun {
 public:
  RattleRun(const std::string& name, SceneSettings settings, double h) : h_(h) {
    settings.emplace_back("d", "0");
    const SceneDescription& description = find_scene(name);
    scene_ = description.build(with(description, settings),
                               {.h = h, .solver = description.solver, .integrator_order = 4});
    scene_->observe();
  }

  /// The largest error and the largest change of energy until `time`.
  double error_after(double time) {
    const auto energy = [&] {
      const Energy now = scene_->frame().energy;
      return now.motion + now.turning + now.weight;
    };
    const double first = energy();
    for (std::int64_t n = step_count(h_, time); n > 0; --n) {
      scene_->advance(1);
      scene_->observe();
      scene_->judge();
      energy_change_ = larger(energy_change_, std::abs(energy() - first));
    }
    return scene_->error();
  }
  double energy_change() const { return energy_change_; }
  const Verdict& verdict() const { return scene_->verdict(); }
  const World<6>& world() const { return *scene_->rigid_bodies(); }
  const World<3>& points() const { return *scene_->points(); }

 private:
  double h_;
  std::unique_ptr<Scene> scene_;
  double energy_change_ = 0;
};

TEST(Mechanisms, APendulumFromHorizontalIsWherePublishedAfterTenSeconds) {
  RattleRun run("pendulum", {{"model", "point"}, {"angle", "90"}, {"l", "1"}, {"g", "9.81"}}, 0.002);
  run.error_after(10);
  // Eight digits are published. By published.cpp, steps of 2 ms have an error of 2e-10 m in 4 s, and below 2e-9 m in
  // ten.
  EXPECT_NEAR(std::abs(run.points().x(1).x()), 0.27508746, 1e-8);
  EXPECT_NEAR(run.points().x(1).z(), -0.96141921, 1e-8);
}

TEST(Mechanisms, AndrewsSqueezerReachesThePublishedAngles) {
  using namespace squeezer;
  Angles published;
  published << 15.81077119629904, -15.75637105984298, 0.04082224013073101, -0.5347301163226948,
      0.5244099658805304, 0.5347301163226948, 1.048080741042263;
  RattleRun run("andrews", {}, 2e-5);
  run.error_after(0.03);
  EXPECT_EQ(run.verdict().state, spook::State::sound) << run.verdict().reason;
  const Angles wanted = of_bodies(published);
  for (int body = 1; body <= 7; ++body) {
    const Quat right(Eigen::AngleAxisd(wanted[body - 1], Vec3::UnitZ()));
    // The published numbers are right to 1.2e-9, by answers_test.cpp; steps of 2e-5 s have an error of 1e-9.
    EXPECT_LE(orientation(run.world(), body).angularDistance(right), 3e-9) << "body " << body;
  }
  EXPECT_NEAR(run.world().joints()[0].angle + start()[0], published[0], 3e-9) << "β, with whole turns";
}

TEST(Mechanisms, BricardsKeepsItsEnergyForTenSeconds) {
  RattleRun run("bricard", {}, 0.01);
  EXPECT_LE(run.error_after(10), 2e-6);
  EXPECT_EQ(run.verdict().state, spook::State::sound) << run.verdict().reason;
  EXPECT_LE(run.energy_change(), 1e-3) << "the bound of the problem [J]; the actual change is far smaller";
}

TEST(Mechanisms, FourBarsPassPlacesWithTwoWaysOn) {
  // By published.cpp, steps of 1/50 s of order four have an error of 4e-6 in two seconds, and change the energy by 1e-6
  // of it. In five times the time the path is five times as long, and a cycle may be late by five times as much.
  for (const double loops : {2, 40}) {
    RattleRun run("four_bar", {{"loops", std::to_string(static_cast<int>(loops))}}, 0.02);
    EXPECT_LE(run.error_after(10), 25 * 4e-6) << loops;
    EXPECT_EQ(run.verdict().state, spook::State::sound) << run.verdict().reason;
    const double fall =
        2 * 9.81 * ((loops + 1) / 2 + loops);  // of the weight, between upright and hanging down [J]
    EXPECT_LE(run.energy_change(), 2e-6 * fall) << loops;
  }
}

TEST(Mechanisms, AGovernorStaysWhereItTurnsSteadily) {
  // cos 40° = (1 + sleeve/(2 m)) g/(l ω²). For a swinging governor such steps have an error of 3e-11 m.
  const double angle = 40 * std::acos(-1) / 180, spin = std::sqrt(2 * 9.81 / (0.3 * std::cos(angle)));
  std::ostringstream exact;
  exact << std::setprecision(17) << spin;
  RattleRun run("governor", {{"angle", "40"}, {"spin", exact.str()}}, 0.001);
  run.error_after(2);
  EXPECT_NEAR(run.world().x(2).z(), -0.3 * std::cos(angle), 1e-10) << "the sleeve";
  EXPECT_NEAR(run.world().joint_speed(0), spin, 1e-10 * spin);
}

}  // namespace
}  // namespace spook
