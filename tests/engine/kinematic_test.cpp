// Kinematic bodies and conveyor belts: static bodies whose velocity acts in contacts, friction and joints.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/diagnostics/run_check.hpp"
#include "engine/world/world.hpp"
#include "refusals.hpp"

namespace spook::kinematic_test {
namespace {

constexpr double g = 9.81;
constexpr double steps_to_try[] = {1.0 / 60, 1.0 / 240, 1.0 / 1000};

template <int Dof>
Verdict run(World<Dof>& world, double h, double time) {
  RunCheck<Dof> check;
  check.look(world, h);
  while (world.time() < time) {
    world.step(h);
    check.look(world, h);
  }
  return check.verdict();
}

TEST(Kinematic, PlatformCarriesWhatLiesOnIt) {
  for (const double h : steps_to_try) {
    World<6> world({.friction = 0.5});
    const int platform = world.add_fixed_box(Vec3(0, 0, -0.1), Vec3(1, 1, 0.1));
    world.set_velocity(platform, Vec3(1, 0, 0));
    const int box = world.add({.x = Vec3(0, 0, 0.2), .mass = 1, .half_sides = Vec3::Constant(0.2)});
    const Verdict verdict = run(world, h, 2);
    EXPECT_EQ(verdict.state, State::sound) << verdict.reason;
    EXPECT_NEAR(world.x(platform).x(), world.time(), 1e-9);
    EXPECT_NEAR(world.v(box).x(), 1, 1e-6) << "h = " << h;
    // It slips until μ g t = 1 m/s, and loses half of that way, within a step's drift.
    EXPECT_NEAR(world.x(box).x(), world.time() - 1 / (2 * 0.5 * g), h) << "h = " << h;
  }
}

TEST(Kinematic, LiftRaisesAndLowers) {
  for (const double speed : {1.0, -1.0}) {
    World<6> world({.friction = 0.5});
    const int lift = world.add_fixed_box(Vec3(0, 0, -0.1), Vec3(1, 1, 0.1));
    world.set_velocity(lift, Vec3(0, 0, speed));
    const int ball = world.add({.x = Vec3(0, 0, 0.2), .v = Vec3(0, 0, speed), .mass = 1, .radius = 0.2});
    const Verdict verdict = run(world, 1.0 / 60, 2);
    EXPECT_EQ(verdict.state, State::sound) << verdict.reason;
    EXPECT_NEAR(world.x(ball).z(), 0.2 + speed * world.time(), 1e-3);
    EXPECT_NEAR(world.contact_force(0).z(), g, 1e-3 * g);
  }
}

TEST(Kinematic, WallPushesWithoutSinkingIn) {
  for (const double h : steps_to_try) {
    World<6> world({.friction = 0.2});
    world.add_plane(Vec3::UnitZ(), 0);
    const int wall = world.add_fixed_box(Vec3(-1, 0, 0.5), Vec3(0.1, 1, 0.5));
    world.set_velocity(wall, Vec3(2, 0, 0));
    const int box = world.add({.x = Vec3(0, 0, 0.2), .mass = 10, .half_sides = Vec3::Constant(0.2)});
    const Verdict verdict = run(world, h, 2);
    EXPECT_EQ(verdict.state, State::sound) << verdict.reason << ", h = " << h;
    EXPECT_NEAR(world.x(box).x(), world.x(wall).x() + 0.3, 1e-3 * 0.2) << "h = " << h;
    EXPECT_NEAR(world.v(box).x(), 2, 2e-2) << "h = " << h;
  }
}

TEST(Kinematic, TurntableTurnsWhatItHolds) {
  // A hinge welded to a rotating body: the arm rotates with it.
  const double rate = 3;
  World<6> world({.gravity = Vec3::Zero()});
  const int table = world.add_fixed(Vec3::Zero());
  world.set_velocity(table, Vec3::Zero(), Vec3(0, 0, rate));
  const int arm = world.add({.x = Vec3(0.5, 0, 0),
                             .v = Vec3(0, 0.5 * rate, 0),
                             .mass = 1,
                             .omega = Vec3(0, 0, rate),
                             .principal = Vec3::Constant(0.1)});
  world.add_joint({.i = table, .j = arm, .p_j = Vec3(-0.5, 0, 0), .kind = JointKind::weld});
  const Verdict verdict = run(world, 1.0 / 240, 2);
  EXPECT_EQ(verdict.state, State::sound) << verdict.reason;
  const double angle = rate * world.time();
  EXPECT_NEAR((world.x(arm) - 0.5 * Vec3(std::cos(angle), std::sin(angle), 0)).norm(), 0, 2e-2 * 0.5);
  EXPECT_NEAR(orientation(world, table).angularDistance(Quat(Eigen::AngleAxisd(angle, Vec3::UnitZ()))), 0,
              1e-9);
}

TEST(Kinematic, BeltCarriesAndStaysWhereItIs) {
  for (const bool plane : {false, true}) {
    World<6> world({.friction = 0.5});
    const int belt =
        plane ? world.add_plane(Vec3::UnitZ(), 0) : world.add_fixed_box(Vec3(0, 0, -0.1), Vec3(5, 1, 0.1));
    const Vec3 before = world.x(belt);
    world.set_surface_velocity(belt, Vec3(1, 0, 0));
    const int box = world.add({.x = Vec3(0, 0, 0.2), .mass = 1, .half_sides = Vec3::Constant(0.2)});
    const Verdict verdict = run(world, 1.0 / 60, 2);
    EXPECT_EQ(verdict.state, State::sound) << verdict.reason;
    EXPECT_NEAR(world.v(box).x(), 1, 1e-6);
    EXPECT_EQ(world.x(belt), before);
    world.set_surface_velocity(belt, Vec3::Zero());
    run(world, 1.0 / 60, 4);
    EXPECT_NEAR(world.v(box).norm(), 0, 1e-6);
  }
}

TEST(Kinematic, MeetsWhatWasFarAway) {
  World<3> world({.gravity = Vec3::Zero()});
  const int pusher = world.add_fixed(Vec3(-5, 0, 0), 0.5);
  world.set_velocity(pusher, Vec3(2, 0, 0));
  const int ball = world.add({.x = Vec3::Zero(), .mass = 1, .radius = 0.5});
  const Verdict verdict = run(world, 1.0 / 60, 4);
  EXPECT_EQ(verdict.state, State::sound) << verdict.reason;
  EXPECT_NEAR(world.v(ball).x(), 2, 2e-2);
  EXPECT_GE(world.x(ball).x() - world.x(pusher).x(), 1 - 1e-3);
}

TEST(Kinematic, GoesOnAfterAnotherBodyIsTakenOut) {
  World<6> world({});
  const int first = world.add_fixed(Vec3(9, 0, 0), 0.1);
  const int second = world.add_fixed(Vec3::Zero(), 0.1);
  world.set_velocity(second, Vec3(1, 0, 0));
  world.remove_body(first);
  world.step(0.5);
  EXPECT_NEAR(world.x(0).x(), 0.5, 1e-15);
  world.set_velocity(0, Vec3::Zero());
  EXPECT_FALSE(world.has_kinematic_bodies());
}

TEST(Kinematic, LiftFollowsKeyframesAndCarriesABox) {
  // Up by 1.5 m in 3 s, a rest of a second, and down by 1 m in 2.
  const std::vector<Keyframe> frames = {{.time = 1, .x = Vec3(0, 0, 0)},
                                        {.time = 4, .x = Vec3(0, 0, 1.5)},
                                        {.time = 5, .x = Vec3(0, 0, 1.5)},
                                        {.time = 7, .x = Vec3(0, 0, 0.5)}};
  for (const double h : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
    World<6> world({.friction = 0.5});
    const int lift = world.add_fixed_box(Vec3(9, 9, 9), Vec3(1, 1, 0.1));
    world.set_keyframes(lift, Keyframes(frames));
    EXPECT_EQ(world.x(lift), Vec3::Zero());
    const int box = world.add({.x = Vec3(0, 0, 0.3), .mass = 4, .half_sides = Vec3::Constant(0.2)});
    for (const auto& [time, height] : {std::pair{2.0, 0.5}, {4.5, 1.5}, {6.5, 0.75}, {8.0, 0.5}}) {
      const Verdict verdict = run(world, h, time - h / 2);
      EXPECT_EQ(verdict.state, State::sound) << verdict.reason << ", h = " << h;
      EXPECT_NEAR(world.x(lift).z(), height, 1e-12) << "at " << time << " s, h = " << h;
      EXPECT_NEAR(world.x(box).z(), height + 0.3, 1e-3 * 0.2) << "at " << time << " s, h = " << h;
    }
    EXPECT_NEAR(world.x(box).head<2>().norm(), 0, 1e-6);
    EXPECT_EQ(world.v(lift), Vec3::Zero());
  }
}

TEST(Kinematic, TurntableFollowsKeyframesTheShorterWay) {
  // A quarter turn in a second, given by -q, which is the same orientation; a box on its axis turns along.
  const double quarter = std::acos(0.0), h = 1.0 / 60;
  const Quat turned(Eigen::AngleAxisd(quarter, Vec3::UnitZ()));
  World<6> world({.friction = 0.5});
  const int table = world.add_fixed_box(Vec3::Zero(), Vec3(1, 1, 0.1));
  world.set_keyframes(table, Keyframes({{.time = 0, .x = Vec3::Zero()},
                                        {.time = 1, .x = Vec3::Zero(), .q = Quat(-turned.coeffs())}}));
  const int box = world.add({.x = Vec3(0, 0, 0.3), .mass = 1, .half_sides = Vec3::Constant(0.2)});
  run(world, h, 0.5 - h / 2);
  EXPECT_NEAR(angular_velocity(world, table).z(), quarter, 1e-9);
  EXPECT_NEAR(orientation(world, table).angularDistance(Quat::Identity()), quarter / 2, 1e-9);
  run(world, h, 1.5);
  EXPECT_NEAR(orientation(world, table).angularDistance(turned), 0, 1e-7);
  EXPECT_NEAR(orientation(world, box).angularDistance(turned), 0, 2 * quarter * h);  // it slips at the start
}

TEST(Kinematic, VelocityFunctionMovesToSecondOrder) {
  const double height = 0.3, omega = 2;
  std::vector<double> errors;
  for (const double h : {1.0 / 50, 1.0 / 100, 1.0 / 200}) {
    World<6> world({});
    const int lift = world.add_fixed_box(Vec3(0, 0, -0.1), Vec3(1, 1, 0.1));
    world.set_velocity_function(lift, [&](double t) {
      return (Twist<6>() << 0, 0, height * omega * std::cos(omega * t), 0, 0, 0).finished();
    });
    const int box = world.add({.x = Vec3(0, 0, 0.2), .mass = 1, .half_sides = Vec3::Constant(0.2)});
    const Verdict verdict = run(world, h, 1 - h / 2);
    EXPECT_EQ(verdict.state, State::sound) << verdict.reason;
    errors.push_back(std::abs(world.x(lift).z() + 0.1 - height * std::sin(omega * world.time())));
    EXPECT_NEAR(world.x(box).z(), world.x(lift).z() + 0.3, 1e-3 * 0.2);  // ω² height < g: it stays on the lift
  }
  for (std::size_t n = 1; n < errors.size(); ++n) EXPECT_NEAR(std::log2(errors[n - 1] / errors[n]), 2, 0.05);
}

TEST(Kinematic, CopyAndSuccessorFollowTheSameKeyframes) {
  const Keyframes frames({{.time = 0, .x = Vec3::Zero()}, {.time = 1, .x = Vec3(0, 1, 0)}});
  World<3> world({});
  world.set_keyframes(world.add_fixed(Vec3::Zero(), 0.1), frames);
  run(world, 0.25, 2);
  World<3> copy = world, next({});
  next.set_keyframes(next.add_fixed(Vec3::Zero(), 0.1), frames);
  next.take_state_from(world);
  for (World<3>* other : {&copy, &next}) {
    other->step(0.25);
    EXPECT_EQ(other->x(0), Vec3(0, 1, 0));
    EXPECT_EQ(other->v(0), Vec3::Zero());
  }
}

TEST(Kinematic, RefusesKeyframesAndFunctionsThatMakeNoSense) {
  expect_refusal({"keyframes"}, [] { Keyframes({}); });
  expect_refusal({"time", "nan"}, [] { Keyframes({{.time = NAN, .x = Vec3::Zero()}}); });
  expect_refusal({"time", "later"}, [] {
    Keyframes({{.time = 1, .x = Vec3::Zero()}, {.time = 1, .x = Vec3::Zero()}});
  });
  expect_refusal({"x", "inf"}, [] { Keyframes({{.time = 0, .x = Vec3(infinity, 0, 0)}}); });
  expect_refusal({"q"}, [] { Keyframes({{.time = 0, .x = Vec3::Zero(), .q = Quat(2, 0, 0, 0)}}); });
  World<6> world({});
  const int plane = world.add_plane(Vec3::UnitZ(), 0);
  const int wall = world.add_fixed_box(Vec3(0, 0, 3), Vec3::Ones());
  expect_refusal({"body", "plane"},
                 [&] { world.set_keyframes(plane, Keyframes({{.time = 0, .x = Vec3::Zero()}})); });
  expect_refusal({"velocity", "null"}, [&] { world.set_velocity_function(wall, nullptr); });
  world.set_velocity_function(wall, [](double t) { return Twist<6>(Twist<6>::Constant(t > 0.1 ? NAN : 0)); });
  world.step(1.0 / 60);
  expect_refusal({"velocity of body 1", "nan"}, [&] { world.step(1); });
  EXPECT_EQ(world.steps(), 1) << "a step that was refused does not count";
}

TEST(Kinematic, RefusesWhatIsNotStatic) {
  World<6> world({});
  const int plane = world.add_plane(Vec3::UnitZ(), 0);
  const int ball = world.add({.x = Vec3(0, 0, 1), .mass = 1, .radius = 0.5});
  const int wall = world.add_fixed_box(Vec3(3, 0, 0), Vec3::Ones());
  expect_refusal({"body", "static"}, [&] { world.set_velocity(ball, Vec3::UnitX()); });
  expect_refusal({"body", "plane"}, [&] { world.set_velocity(plane, Vec3::UnitX()); });
  expect_refusal({"v"}, [&] { world.set_velocity(wall, Vec3(NAN, 0, 0)); });
  expect_refusal({"omega"}, [&] { world.set_velocity(wall, Vec3::Zero(), Vec3(INFINITY, 0, 0)); });
  expect_refusal({"v"}, [&] { world.set_surface_velocity(wall, Vec3(NAN, 0, 0)); });
  expect_refusal({"along the plane's normal", "0.5"},
                 [&] { world.set_surface_velocity(plane, Vec3(1, 0, 0.5)); });
  world.set_surface_velocity(plane, Vec3(1, 2, 0));
  expect_refusal({"body", "7"}, [&] { world.set_velocity(7, Vec3::Zero()); });
}

}  // namespace
}  // namespace spook::kinematic_test
