// A run reports when it no longer solves the given problem, and only then.
#include "engine/diagnostics/run_check.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scene_runs.hpp"

namespace spook::run_check_test {
namespace {

constexpr double h = 1.0 / 60, g = 9.81;

template <int Dof>
Verdict judged(World<Dof>& world, int steps, double step = h) {
  RunCheck<Dof> check;
  check.look(world, step);
  for (int n = 0; n < steps; ++n) {
    world.step(step);
    check.look(world, step);
  }
  return check.verdict();
}

Verdict judged(const std::string& name, const SceneSettings& settings, double time, Method method) {
  const SceneDescription& description = find_scene(name);
  const auto scene = description.build(with(description, settings), method);
  scene->judge();
  for (std::int64_t n = step_count(method.h, time); n > 0; --n) {
    scene->advance(1);
    scene->judge();
  }
  return scene->verdict();
}

/// A heavy ball on a light one on the floor. Each sweep leaves m/M of its fall, Eq. (4.10).
World<3> heavy_on_light(double ratio, int sweeps, double unit = 1, double gravity = g) {
  World<3> world({.gravity = Vec3(0, 0, -gravity) * unit,
                  .k = 1e9 * unit,
                  .solver = gauss_seidel<3>(),
                  .solver_limits = {.max_sweeps = sweeps}});
  world.add_plane(Vec3::UnitZ(), 0);
  world.add({.x = unit * Vec3(0, 0, 0.5), .mass = unit, .radius = 0.5 * unit});
  world.add({.x = unit * Vec3(0, 0, 1.5), .mass = ratio * unit, .radius = 0.5 * unit});
  return world;
}

/// Cubes of 1 m, one above the other with gaps, in soft steps.
World<6> soft_tower(int cubes, double gap, int substeps) {
  World<6> world({.friction = 0.6, .soft_steps = SoftSteps{.substeps = substeps}});
  world.add_plane(Vec3::UnitZ(), 0);
  for (int n = 0; n < cubes; ++n)
    world.add({.x = Vec3(0, 0, 0.5 + n + (n + 1) * gap), .half_sides = Vec3::Constant(0.5)});
  return world;
}

// A sweep leaves some speed in a tower that settles: 0.06 m/s here, a millimetre in a step.
TEST(RunCheck, SoftStepsAreJudgedByTheWayOfWhatTheyLeave) {
  World<6> settling = soft_tower(20, 0, 4);
  EXPECT_EQ(judged(settling, 120).state, State::sound) << judged(settling, 1).reason;
  World<6> falling = soft_tower(10, 1, 1);
  const Verdict verdict = judged(falling, 120);
  EXPECT_EQ(verdict.state, State::unsolved);
  EXPECT_NE(verdict.reason.find("more than a hundredth of the size 0.5 m: more substeps"), std::string::npos)
      << verdict.reason;
}

// Velocities are half a part behind positions, so the work of forces is along where bodies were then.
TEST(RunCheck, WhatFallsAndWhatSwingsIsSoundInStepsOfParts) {
  for (const int substeps : {1, 2, 4, 16}) {
    World<3> falling({.soft_steps = SoftSteps{.substeps = substeps}});
    World<3> swinging({.gravity = Vec3::Zero(),
                       .force = [](std::size_t i, const std::vector<Vec3>& x) -> Vec3 { return -x[i]; },
                       .soft_steps = SoftSteps{.substeps = substeps}});
    for (World<3>* world : {&falling, &swinging}) {
      world->add({.x = Vec3(1, 0, 0), .mass = 1});
      world->start_half_step_back(0.01);
      const Verdict verdict = judged(*world, 1000, 0.01);
      EXPECT_EQ(verdict.state, State::sound) << substeps << ": " << verdict.reason;
    }
  }
}

// Gravity adds 0.16 m/s in a step, so a solver that ends at 0.1 m/s has converged to nothing.
TEST(RunCheck, ALooseToleranceIsUnsolved) {
  for (const double tolerance : {0.1, 1e-4}) {
    World<3> world(
        {.k = 1e9, .solver = gauss_seidel<3>(), .solver_limits = {.max_sweeps = 1000, .tolerance = tolerance}});
    world.add_plane(Vec3::UnitZ(), 0);
    for (const double z : {0.5, 1.5}) world.add({.x = Vec3(0, 0, z), .radius = 0.5});
    EXPECT_EQ(judged(world, 3).state, tolerance == 0.1 ? State::unsolved : State::sound) << tolerance;
    EXPECT_TRUE(world.solved().converged);
  }
}

TEST(RunCheck, SweepsThatStopEarlyAreUnsolved) {
  World<3> world = heavy_on_light(1000, 50);
  const Verdict verdict = judged(world, 3);
  EXPECT_EQ(verdict.state, State::unsolved);
  EXPECT_EQ(verdict.step, 1);
  EXPECT_DOUBLE_EQ(verdict.time, h);
  EXPECT_EQ(verdict.unsolved, 3);
  World<3> patient = heavy_on_light(1000, 20000);
  EXPECT_EQ(judged(patient, 2).state, State::sound);
  World<3> equal = heavy_on_light(1, 50);
  EXPECT_EQ(judged(equal, 2).state, State::sound);
}

TEST(RunCheck, WhatIsBelowTheRoundingsOfItsVelocitiesIsSolved) {
  const auto flying = [](double speed) {
    World<3> world = heavy_on_light(1000, 2, 1, 0);
    for (const int i : {1, 2})
      world.apply_central_impulse(i, (i == 1 ? 1 : 1000) * Vec3(speed, 0, i == 1 ? 0 : -1e-20));
    return world;
  };
  World<3> fast = flying(1), slow = flying(1e-20);
  EXPECT_EQ(judged(fast, 3).state, State::sound);
  EXPECT_EQ(judged(slow, 3).state, State::unsolved);
}

TEST(RunCheck, ASmallResidualOfSweepsThatCreepIsNoSolution) {
  // A wire of a hundred equal links: ρ = cos²(π/200). An error of a hundredth of the residual's size would be 1/(1 - ρ)
  // = 4,000 times the residual.
  const auto hundred = [](Solver<3> solver) {
    World<3> world({.k = 1e12, .solver = std::move(solver), .solver_limits = {.max_sweeps = 3000}});
    world.add_fixed(Vec3::Zero());
    for (int i = 1; i <= 100; ++i) world.add({.x = Vec3(0, 0, -i)});
    for (int i = 1; i <= 100; ++i) world.add_joint({.i = i - 1, .j = i, .length = 1});
    return world;
  };
  World<3> swept = hundred(gauss_seidel<3>()), factorised = hundred(direct<3>());
  EXPECT_EQ(judged(swept, 1).state, State::unsolved);
  EXPECT_LT(swept.report().residual, 1e-2 * g * h) << "which is too optimistic";
  EXPECT_EQ(judged(factorised, 1).state, State::sound);
}

TEST(RunCheck, IsTheSameInOtherUnits) {
  // Masses and lengths scale by 2^-20, g as lengths, and λ and velocities with them, to the last bit.
  for (const int sweeps : {40, 50, 3000, 20000}) {
    World<3> one = heavy_on_light(1000, sweeps), other = heavy_on_light(1000, sweeps, std::ldexp(1, -20));
    EXPECT_EQ(judged(one, 5).state, judged(other, 5).state) << sweeps;
  }
}

TEST(RunCheck, AWireThatRunsAwayIsLost) {
  const SceneSettings wire = {{"links", "100"}, {"ratio", "1000"}};
  const Verdict verdict = judged("wire", wire, 1, {.h = h, .solver = "gauss_seidel", .warm_start = true});
  EXPECT_EQ(verdict.state, State::lost) << "Eq. (10.12)";
  EXPECT_EQ(judged("wire", wire, 1, {.h = h, .solver = "direct"}).state, State::sound);
}

TEST(RunCheck, WhatGivesUnderItsLoadIsSound) {
  // A weight on a spring of a thousandth of its weight a metre: it stretches by a thousand lengths, as it should.
  World<3> soft({.solver = direct<3>()});
  soft.add_fixed(Vec3::Zero());
  soft.add({.x = Vec3(0, 0, -1), .mass = 1});
  soft.add_joint({.i = 0, .j = 1, .length = 1, .k = g / 1000, .d = 1e4});
  EXPECT_EQ(judged(soft, 3000).state, State::sound);
}

TEST(RunCheck, BodiesThatPassThroughEachOtherAreLost) {
  // With so small a k the floor holds the ball a hundred radii down: that solves the given problem. A ball that starts
  // there on a hard floor does not.
  World<3> soft({.k = g / 10, .solver = direct<3>()});
  soft.add_plane(Vec3::UnitZ(), 0);
  soft.add({.x = Vec3(0, 0, 0.1 - 10), .mass = 1, .radius = 0.1});
  EXPECT_EQ(judged(soft, 10).state, State::sound);
  World<3> hard({.k = 1e9, .solver = direct<3>()});
  hard.add_plane(Vec3::UnitZ(), 0);
  const int ball = hard.add({.x = Vec3(0, 0, 0.1 - 10), .mass = 1, .radius = 0.1});
  RunCheck<3> check;
  for (int n = 0; n < 12; ++n) {
    hard.step(h);
    check.look(hard, h);
    const bool lost = check.verdict().state == State::lost;
    EXPECT_EQ(lost, n >= 10) << "a thin and fast body may be so for a moment, step " << n;
    hard.place(ball, Vec3(0, 0, 0.1 - 10), Vec3::Zero());
  }
  EXPECT_EQ(check.verdict().state, State::lost);
}

TEST(RunCheck, NotesASpringThatIsTooSoftForItsLoad) {
  // m g/k is two hundredths of the radius, and half a hundredth.
  for (const double part : {0.02, 0.005}) {
    World<3> world({.k = g / (part * 0.1), .solver = direct<3>()});
    world.add_plane(Vec3::UnitZ(), 0);
    world.add({.x = Vec3(0, 0, 0.1 - part * 0.1), .mass = 1, .radius = 0.1});
    const Verdict verdict = judged(world, 20);
    EXPECT_EQ(verdict.state, State::sound);
    EXPECT_EQ(verdict.note.empty(), part < 0.01) << verdict.note;
    const bool named = verdict.note.find("bodies 0 and 1") != std::string::npos;
    EXPECT_EQ(named, part > 0.01) << verdict.note;
  }
}

TEST(RunCheck, AnImpactIsNotALoad) {
  // Dropped from 10 m it sinks in by more than a hundredth of its radius, and only while it is stopped.
  World<3> world({.solver = direct<3>()});
  world.add_plane(Vec3::UnitZ(), 0);
  world.add({.x = Vec3(0, 0, 10), .mass = 1, .radius = 0.5});
  EXPECT_EQ(judged(world, 400).note, "");
}

TEST(RunCheck, NotesAContactThatIsFoundTooLate) {
  // A ball of 0.1 m comes at 40 m/s, 2/3 m in a step of 1/60 s, and is half of that deep when it is found. In a step of
  // 1/1000 s it comes no deeper than 0.04 m.
  const auto note = [](double z, double v, double step) {
    World<6> world({});
    world.add_plane(Vec3::UnitZ(), 0);
    world.add({.x = Vec3(0, 0, z), .v = Vec3(0, 0, v), .radius = 0.1});
    return judged(world, 60, step).note;
  };
  const std::string late = note(0.1 + 2.5 * 40 / 60, -40, 1.0 / 60);
  EXPECT_EQ(late.find("bodies 0 and 1 overlap by"), 0u) << late;
  EXPECT_NE(late.find("a shorter step would find it earlier"), std::string::npos) << late;
  EXPECT_EQ(note(0.1 + 2.5 * 40 / 60, -40, 1.0 / 1000), "");
  EXPECT_EQ(note(0.02, 0, 1.0 / 60), "");  // an overlap from the start
  EXPECT_EQ(note(0.6, 0, 1.0 / 60), "");   // a fall of half a metre
}

TEST(RunCheck, KeepsItsVerdictWhenBodiesAreMoved) {
  World<6> top({.gravity = Vec3::Zero(),
                .rotation = {.update = RotationUpdate::first_order, .gyroscopic_torque = true}});
  const int body = top.add({.omega = Vec3(0.1, 3, 0.1), .principal = Vec3(1, 2, 3)});
  RunCheck<6> check;
  for (int n = 0; n < 250; ++n) top.step(0.1), check.look(top, 0.1);
  ASSERT_EQ(check.verdict().state, State::lost);
  check.bodies_were_moved();
  top.turn(body, Quat::Identity(), Vec3::Zero());
  top.step(0.1), check.look(top, 0.1);
  EXPECT_EQ(check.verdict().state, State::lost);
  check.begin_again();
  EXPECT_EQ(check.verdict().state, State::sound);
  // Energy that a caller adds between two checks is not an error.
  for (int n = 1; n < 100; ++n) {
    check.bodies_were_moved();
    top.turn(body, Quat::Identity(), Vec3(n, 0, 0));
    top.step(0.1), check.look(top, 0.1);
  }
  EXPECT_EQ(check.verdict().state, State::sound);
}

TEST(RunCheck, EnergyFromNothingIsLost) {
  // By the notes' update without its gyroscopic torque a fast top keeps ω, and so its energy changes as it turns.
  World<6> top({.gravity = Vec3::Zero(),
                .rotation = {.update = RotationUpdate::first_order, .gyroscopic_torque = true}});
  top.add({.omega = Vec3(0.1, 3, 0.1), .principal = Vec3(1, 2, 3)});
  EXPECT_EQ(judged(top, 250, 0.1).state, State::lost) << "explicit gyroscopic torques spin it up";
  World<6> split({.gravity = Vec3::Zero()});
  split.add({.omega = Vec3(0.1, 3, 0.1), .principal = Vec3(1, 2, 3)});
  EXPECT_EQ(judged(split, 5000, 0.1).state, State::sound);
}

TEST(RunCheck, WhatForcesGiveIsNotFromNothing) {
  World<3> falling({.solver = direct<3>()});
  falling.add({.v = Vec3(1, 0, 5)});
  EXPECT_EQ(judged(falling, 10000).state, State::sound);
  EXPECT_EQ(judged("orbit", {{"eccentricity", "0.7"}}, 50, {.h = 0.01}).state, State::sound);
  EXPECT_EQ(judged("bouncing_ball", {{"restitution", "1"}}, 20, {.h = 0.01}).state, State::sound);
  EXPECT_EQ(judged("double_pendulum", {}, 10, {.h = 1.0 / 240}).state, State::sound);
}

TEST(RunCheck, APushIsNotFromNothing) {
  World<3> world({.gravity = Vec3::Zero()});
  const int body = world.add({.mass = 1});
  RunCheck<3> check;
  check.look(world, h);
  world.apply_central_impulse(body, Vec3(3, 0, 0));
  check.begin_again();
  check.look(world, h);
  world.step(h);
  check.look(world, h);
  EXPECT_EQ(check.verdict().state, State::sound);
}

TEST(RunCheck, NotesTunnellingInAStepThatItWasToldOf) {
  for (const bool is_told : {true, false}) {
    World<6> world({.gravity = Vec3::Zero()});
    world.add_fixed_box(Vec3(1, 0, 0), Vec3(0.05, 1, 1));
    const int ball = world.add({.v = Vec3(100, 0, 0), .radius = 0.1});
    RunCheck<6> check;
    const auto step = [&] {
      if (is_told) check.begin_step(world);
      world.step(h);
      check.look(world, h);
    };
    step();  // the first
    EXPECT_EQ(check.verdict().note.find("body 1 moves by 1.67 m in a step") == 0, is_told);
    check.begin_again();
    world.place(ball, Vec3::Zero(), Vec3::Zero());
    step();
    world.place(ball, Vec3::Zero(), Vec3(100, 0, 0));
    check.bodies_were_moved();
    step();
    EXPECT_EQ(check.verdict().note.find("body 1 moves by 1.67 m in a step") == 0, is_told);
  }
}

TEST(RunCheck, FindsEveryDefaultSceneSound) {
  for (const SceneDescription& scene : scenes()) {
    const Verdict verdict =
        judged(scene.name, {}, std::min(scene.time, 5.0), {.h = scene.h, .solver = scene.solver});
    EXPECT_EQ(verdict.state, State::sound) << scene.name << ", step " << verdict.step << ": " << verdict.reason;
  }
}

}  // namespace
}  // namespace spook::run_check_test
