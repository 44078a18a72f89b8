// States of runs as bytes: a run that continues from its state has the same bits as one that was never interrupted.
#include <gtest/gtest.h>

#include <cstring>
#include <memory>

#include "engine/support/state_stream.hpp"
#include "refusals.hpp"
#include "scene_runs.hpp"

namespace spook::state_test {
namespace {

/// The numbers that a run shows, in a form in which NaN equals NaN.
std::string bits(const Scene& scene) {
  std::vector<double> values = scene.sample();
  values.push_back(scene.error());
  values.push_back(scene.report().residual);
  values.push_back(static_cast<double>(scene.row_updates()));
  const Frame frame = scene.frame();
  for (const Vec3& x : frame.x) values.insert(values.end(), x.begin(), x.end());
  for (const Vec3& v : frame.v) values.insert(values.end(), v.begin(), v.end());
  std::string text(values.size() * sizeof(double), 0);
  std::memcpy(text.data(), values.data(), text.size());
  const Verdict& verdict = scene.verdict();
  return text + name_of(verdict.state) + std::to_string(verdict.step) + verdict.reason + verdict.note;
}

void take_steps(Scene& scene, std::int64_t steps) {
  for (std::int64_t n = 0; n < steps; ++n) {
    scene.advance(1);
    scene.observe();
    scene.judge();
  }
}

/// Continues a run in another scene after each of these numbers of steps, and compares both at the end.
void expect_same_bits(const SceneDescription& description, const SceneSettings& settings, const Method& method,
                      const std::vector<std::int64_t>& parts) {
  const auto build = [&] { return description.build(with(description, settings), method); };
  const std::unique_ptr<Scene> whole = build();
  std::unique_ptr<Scene> continued = build();
  for (Scene* scene : {whole.get(), continued.get()}) {
    scene->observe();
    scene->judge();
  }
  for (const std::int64_t steps : parts) {
    take_steps(*whole, steps);
    take_steps(*continued, steps);
    const std::string state = bytes_of_state(*continued);
    continued = build();
    read_state(state, *continued);
    EXPECT_EQ(bits(*whole), bits(*continued)) << description.name << " differs at once";
    EXPECT_EQ(state, bytes_of_state(*continued)) << description.name;
  }
  take_steps(*whole, 40);
  take_steps(*continued, 40);
  EXPECT_EQ(bits(*whole), bits(*continued)) << description.name << " differs after further steps";
}

TEST(State, EverySceneContinuesWithTheSameBits) {
  for (const SceneDescription& scene : scenes()) {
    const std::int64_t half = std::min<std::int64_t>(step_count(scene.h, scene.time) / 2, 150);
    expect_same_bits(scene, {}, {.h = scene.h, .solver = scene.solver}, {7, half});
  }
}

TEST(State, EveryMethodContinuesWithTheSameBits) {
  const SceneDescription &tower = find_scene("tower"), &pile = find_scene("pile"), &wire = find_scene("wire");
  const SceneSettings heap = {{"bodies", "12"}, {"shape", "box"}};
  for (const NamedSolver<6>& solver : solvers<6>())
    if (solver.name != "geometric_stiffness")
      expect_same_bits(pile, heap, {.h = 0.01, .solver = solver.name}, {60});
  for (const FrictionModel model : {FrictionModel::box, FrictionModel::two_pass})
    expect_same_bits(pile, heap, {.h = 0.01, .solver = "auto", .friction_model = model}, {60});
  expect_same_bits(tower, {}, {.h = 0.01, .row_order = RowOrder::random, .seed = 5}, {3, 20});
  expect_same_bits(tower, {}, {.h = 0.01, .warm_start = true}, {30});
  expect_same_bits(pile, heap, {.h = 0.01, .warm_start = true, .soft_steps = 4}, {60});
  expect_same_bits(pile, heap, {.h = 0.01, .solver = "spatial_decomposition", .threads = 2}, {60});
  expect_same_bits(wire, {{"model", "point"}}, {.h = 0.01, .solver = "geometric_stiffness"}, {20});
  expect_same_bits(find_scene("four_bar"), {{"d", "0"}}, {.h = 0.005, .integrator_order = 4}, {30});
  expect_same_bits(find_scene("cloth"), {}, {.h = 0.01, .substeps = 3, .warm_start = true}, {30});
}

TEST(State, AWorldKeepsItsTurnsAndTheTimeOfItsVelocities) {
  // A hinge that has turned more than once, an arm on a platform with keyframes, and steps of several parts.
  const auto build = [] {
    auto world = std::make_unique<World<6>>(Settings<6>{.max_parts = 8});
    const int post = world->add_fixed(Vec3(0, 0, 2));
    const int platform = world->add_fixed_box(Vec3(3, 0, 0), Vec3(1, 1, 0.1));
    const int arm = world->add({.x = Vec3(0.5, 0, 2), .half_sides = Vec3(0.5, 0.05, 0.05)});
    world->add({.x = Vec3(3, 0, 0.3), .half_sides = Vec3(0.2, 0.2, 0.2)});
    world->set_keyframes(platform,
                         Keyframes({{.time = 0, .x = Vec3(3, 0, 0)}, {.time = 1, .x = Vec3(4, 0, 0.2)}}));
    world->add_joint({.i = post,
                      .j = arm,
                      .p_j = Vec3(-0.5, 0, 0),
                      .kind = JointKind::hinge,
                      .axis = Vec3::UnitY(),
                      .motor = Motor{.speed = 20, .strength = 1000}});
    return world;
  };
  const auto run = [](World<6>& world, int from, int to) {
    for (int n = from; n < to; ++n) world.step(n % 3 == 0 ? 0.02 : 0.01);
  };
  auto whole = build(), continued = build();
  run(*whole, 0, 100);
  run(*continued, 0, 61);
  EXPECT_GT(std::abs(continued->joint_position(0)), 7);
  const std::string state = bytes_of_state(*continued);
  continued = build();
  read_state(state, *continued);
  run(*continued, 61, 100);
  EXPECT_EQ(whole->time(), continued->time());
  EXPECT_EQ(whole->joint_position(0), continued->joint_position(0));
  for (int body = 0; body < 4; ++body) EXPECT_EQ(whole->x(body), continued->x(body)) << body;
  EXPECT_EQ(whole->row_updates(), continued->row_updates());
}

TEST(State, IsRefusedInAnotherWorld) {
  World<3> two({});
  two.add({});
  two.add({.x = Vec3(1, 0, 0)});
  const std::string state = bytes_of_state(two);
  World<3> one({});
  one.add({});
  expect_refusal({"number of bodies", "must be 2", "is 1"}, [&] { read_state(state, one); });
  World<3> joined = two;
  joined.add_joint({.i = 0, .j = 1, .length = 1});
  expect_refusal({"number of joints", "must be 0", "is 1"}, [&] { read_state(state, joined); });
  for (std::size_t size = 0; size < state.size(); ++size)
    EXPECT_THROW(read_state(state.substr(0, size), two), std::runtime_error) << size;
  EXPECT_THROW(read_state(state + "x", two), std::runtime_error);
  World<6> rigid({});
  for (int n = 0; n < 2; ++n) rigid.add({.radius = 1});
  expect_refusal({"degrees of freedom", "must be 3", "is 6"}, [&] { read_state(state, rigid); });
  const auto ball = [](const Settings<6>& settings, double mass, double radius) {
    World<6> world(settings);
    world.add({.mass = mass, .radius = radius});
    return world;
  };
  World<6> written = ball({}, 1, 1), same = written;
  const std::string of_ball = bytes_of_state(written);
  read_state(of_ball, same);
  for (World<6> other : {ball({}, 2, 1), ball({}, 1, 2), ball({.friction = 0.5}, 1, 1), ball({.k = 1e6}, 1, 1)})
    expect_refusal({"masses, shapes, joints and settings", "must be"}, [&] { read_state(of_ball, other); });
  World<3> stepped({.stepper = [](const World<3>&, double, Bodies<3>&) { return SolveReport{}; }});
  expect_refusal({"stepper"}, [&] { bytes_of_state(stepped); });
}

TEST(State, IsRefusedOnAnotherSlope) {
  const auto on = [](const Vec3& n) {
    World<6> world({});
    world.add_plane(n, 0);
    world.add({.x = Vec3(0, 0, 1), .radius = 0.1});
    return world;
  };
  World<6> level = on(Vec3::UnitZ()), slope = on(Vec3(0.6, 0, 0.8));
  const std::string state = bytes_of_state(level);
  expect_refusal({"masses, shapes, joints and settings"}, [&] { read_state(state, slope); });
  const auto hinged = [](const Quat& rest) {
    World<6> world({});
    world.add_fixed(Vec3::Zero());
    world.add({.radius = 0.1});
    world.add_joint({.i = 0, .j = 1, .kind = JointKind::hinge, .axis = Vec3::UnitZ(), .rest = rest});
    return world;
  };
  World<6> straight = hinged(Quat::Identity()), bent = hinged(Quat(Eigen::AngleAxisd(0.5, Vec3::UnitZ())));
  const std::string of_hinge = bytes_of_state(straight);
  expect_refusal({"masses, shapes, joints and settings"}, [&] { read_state(of_hinge, bent); });
}

}  // namespace
}  // namespace spook::state_test
