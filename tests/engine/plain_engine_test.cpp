// The plain engine, made of the steps that chapters end with: where both run a scene, it and the fast engine agree.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/bodies/conserved_quantities.hpp"
#include "refusals.hpp"
#include "scene_runs.hpp"

namespace spook::plain_engine_test {
namespace {

struct Case {
  std::string scene;
  SceneSettings settings;
  std::string step;  ///< the exercise that runs it
  std::int64_t steps = 100;
};

/// Scenes of each chapter; none is chaotic within its steps.
const std::vector<Case> cases = {{"free_fall", {}, "1.4 leapfrog_step"},
                                 {"oscillator", {}, "1.4 leapfrog_step"},
                                 {"orbit", {}, "1.4 leapfrog_step"},
                                 {"top", {}, "2.7 step_free"},
                                 {"resting_sphere", {}, "3.5 step_touching"},
                                 {"stack", {{"bodies", "5"}}, "4.7 step_contacts"},
                                 {"incline", {}, "5.7 step_friction"},
                                 {"slide_to_roll", {}, "5.7 step_friction"},
                                 {"pendulum", {}, "6.5 step_joints"},
                                 {"double_pendulum", {}, "6.5 step_joints"},
                                 {"rope", {}, "6.5 step_joints"},
                                 {"cloth", {}, "6.5 step_joints"},
                                 {"tower", {}, "8.12 step_pairs"}};

/// The fast engine by the methods of the plain one: sweeps, the friction box, one part, no contact with a gap above 0.
Method method_of(const SceneDescription& scene, Engine engine) {
  return {.h = scene.h,
          .friction_model = FrictionModel::box,
          .max_parts = 1,
          .contact_margin = 0,
          .engine = engine};
}

std::vector<double> numbers(const Frame& frame) {
  std::vector<double> all;
  const auto add = [&](const std::vector<Vec3>& vectors) {
    for (const Vec3& v : vectors) all.insert(all.end(), {v.x(), v.y(), v.z()});
  };
  add(frame.x);
  add(frame.v);
  add(frame.omega);
  for (const Quat& q : frame.q) all.insert(all.end(), {q.w(), q.x(), q.y(), q.z()});
  return all;
}

/// Expects the same motion by both engines, and the exercise whose step runs it.
void expect_agreement(const Case& one, Method method) {
  const auto& [name, settings, step, steps] = one;
  const SceneDescription& description = find_scene(name);
  const Parameters parameters = with(description, settings);
  const auto fast = (method.engine = Engine::fast, description.build(parameters, method));
  const auto plain = (method.engine = Engine::plain, description.build(parameters, method));
  const std::vector<double> start = numbers(fast->frame());
  EXPECT_EQ(plain_step_of(*plain, method), step) << name;
  plain->advance(steps);
  fast->advance(steps);
  const std::vector<double> a = numbers(plain->frame()), b = numbers(fast->frame());
  double apart = 0, moved = 0, size = 0;
  for (std::size_t k = 0; k < b.size(); ++k) {
    apart = larger(apart, std::abs(a[k] - b[k]));
    moved = larger(moved, std::abs(start[k] - b[k]));
    size = larger(size, std::abs(b[k]));
  }
  // Sums in another order are roundings apart in each step. The rows of a step take a part 4/(h(1 + 4d)) of a gap as
  // velocity, some 100/s, so that roundings of x are 100 times as large in v; 100 steps add up as many of them.
  EXPECT_LE(apart, 1e-9 * size) << name << " by " << method.solver;
  EXPECT_GT(moved, 1e-6 * size) << name << " by " << method.solver;
}

TEST(PlainEngine, AgreesWithTheFastEngine) {
  for (const Case& one : cases) expect_agreement(one, method_of(find_scene(one.scene), Engine::plain));
}

/// Chapters 09 to 12 and 14: any solver after step_rows.
TEST(PlainEngine, AgreesWithTheFastEngineByAnySolver) {
  const auto by = [](const std::string& scene, const SceneSettings& settings, Method method) {
    method.h = find_scene(scene).h;
    method.contact_margin = 0;
    method.max_parts = 1;
    method.plain_solver = true;
    expect_agreement({scene, settings, "9.9 step_rows"}, method);
  };
  const SceneSettings slide = {{"heading", "30"}}, wire = {{"links", "10"}, {"ratio", "10"}};
  by("sliding_block", slide, {.h = 0, .friction_model = FrictionModel::box});
  by("sliding_block", slide, {.h = 0, .friction_model = FrictionModel::two_pass});
  by("sliding_block", slide, {.h = 0, .friction_model = FrictionModel::cone});
  by("stack", {}, {.h = 0, .friction_model = FrictionModel::box, .row_order = RowOrder::random});
  by("stack", {}, {.h = 0, .solver_limits = {.max_sweeps = 10}, .warm_start = true});
  by("stack", {}, {.h = 0, .solver = "conjugate_gradients"});
  by("stack", {}, {.h = 0, .solver = "colours"});
  by("slide_to_roll", {}, {.h = 0, .solver = "blocks"});
  by("stack", {}, {.h = 0, .solver = "direct"});
  by("wire", wire, {.h = 0, .solver = "direct"});
  by("stiff_wire", {}, {.h = 0, .solver = "geometric_stiffness"});
}

/// Friction takes energy, a motor brings it in, and nothing pushes balls in free flight: none of these is a fault of the
/// step, whose contacts and rows are its own.
TEST(PlainEngine, HasASoundVerdictWhereItIsRight) {
  for (const auto& [scene, settings] :
       std::vector<std::pair<std::string, SceneSettings>>{{"slide_to_roll", {}},
                                                          {"incline", {{"angle", "30"}}},
                                                          {"sliding_block", {}},
                                                          {"cradle", {}},
                                                          {"flywheel", {}}}) {
    const SceneDescription& description = find_scene(scene);
    const auto plain = description.build(with(description, settings), method_of(description, Engine::plain));
    for (std::int64_t n = step_count(description.h, description.time); n > 0; --n) {
      plain->advance(1);
      plain->judge();
    }
    EXPECT_EQ(name_of(plain->verdict().state), "sound") << scene << ": " << plain->verdict().reason;
  }
}

TEST(PlainEngine, MayBringInTheEnergyOfASpring) {
  const Method method{.h = 0.01, .solver = "direct", .engine = Engine::plain, .plain_solver = true};
  World<6> world({.k = 1e6, .stepper = plain_stepper<6>(method)});
  const int frame = world.add_fixed(Vec3::Zero()), body = world.add({.principal = Vec3::Ones()});
  world.add_joint({.i = frame,
                   .j = body,
                   .kind = JointKind::slider,
                   .axis = Vec3::UnitX(),
                   .spring = Spring{.stiffness = 20, .rest = 1}});
  RunCheck<6> check;
  for (int n = 0; n < 100; ++n) {
    world.step(method.h);
    check.look(world, method.h);
  }
  EXPECT_GT(world.x(body).x(), 0.5);
  EXPECT_EQ(check.verdict().state, State::sound) << check.verdict().reason;
  EXPECT_EQ(check.verdict().note, "");
}

TEST(PlainEngine, LeavesTheErrorOfImpulsesUnknown) {
  const SceneDescription& description = find_scene("flat_box_100_contacts");
  const auto error_after = [&](int steps, Engine engine) {
    const auto scene = description.build(with(description, {}),
                                         {.h = description.h, .solver = description.solver, .engine = engine});
    scene->observe();
    for (int n = 0; n < steps; ++n) {
      scene->advance(1);
      scene->observe();
    }
    return scene->error();
  };
  EXPECT_TRUE(std::isnan(error_after(100, Engine::plain)));
  EXPECT_TRUE(std::isnan(error_after(0, Engine::fast))) << "no step has computed impulses";
  EXPECT_LT(error_after(300, Engine::fast), 1e-8);
}

/// Chapter 13: hinges, sliders, limits and motors.
TEST(PlainEngine, AgreesWithTheFastEngineOnMechanisms) {
  for (const auto& [scene, settings] : std::vector<std::pair<std::string, SceneSettings>>{
           {"physical_pendulum", {{"stop", "30"}}}, {"flywheel", {}}, {"bead", {}}, {"four_bar", {}}}) {
    Method method = method_of(find_scene(scene), Engine::plain);
    method.solver = "direct";
    expect_agreement({scene, settings, "9.9 step_rows"}, method);
  }
}

/// The step of every scene: it is refused with its reason, or its first steps are those of the fast engine. Enough
/// sweeps solve the rows of the wall. After 50 of them roundings decide which of its contacts are open.
TEST(PlainEngine, RunsEverySceneOrSaysWhyNot) {
  std::vector<std::string> refused;
  for (const SceneDescription& description : scenes()) {
    Method method = method_of(description, Engine::plain);
    method.solver_limits = {.max_sweeps = 5000};
    const Parameters parameters = with(description, {});
    const auto plain = description.build(parameters, method);
    try {
      plain_step_of(*plain, method);
    } catch (const std::invalid_argument& error) {
      EXPECT_TRUE(std::string(error.what())
                      .starts_with("the plain engine (--engine plain or mine) cannot run a scene with "))
          << error.what();
      refused.push_back(description.name);
      continue;
    }
    method.engine = Engine::fast;
    const auto fast = description.build(parameters, method);
    plain->advance(5);
    fast->advance(5);
    const std::vector<double> a = numbers(plain->frame()), b = numbers(fast->frame());
    double apart = 0, size = 0;
    for (std::size_t k = 0; k < b.size(); ++k) {
      apart = larger(apart, std::abs(a[k] - b[k]));
      size = larger(size, std::abs(b[k]));
    }
    EXPECT_LE(apart, 1e-9 * size) << description.name << " by " << plain_step_of(*plain, method);
  }
  EXPECT_EQ(refused, (std::vector<std::string>{"pile", "andrews"}));
}

/// At rest the impulses of the last step solve the next one.
TEST(PlainEngine, KeepsTheImpulsesOfAWarmStart) {
  const SceneDescription& description = find_scene("stack");
  const auto sweeps_at_rest = [&](bool warm) {
    const auto scene =
        description.build(with(description, {}), {.h = description.h,
                                                  .solver_limits = {.max_sweeps = 1000, .tolerance = 1e-7},
                                                  .warm_start = warm,
                                                  .engine = Engine::plain,
                                                  .plain_solver = true});
    scene->advance(300);
    return scene->report().iterations;
  };
  // From nothing three balls need ln(1e-7/(g h))/ln ρ sweeps, with ρ = cos²(π/6): 50.
  EXPECT_GT(sweeps_at_rest(false), 40);
  EXPECT_LT(sweeps_at_rest(true), 5);
}

TEST(PlainEngine, ReportsWhatItsSolverLeft) {
  const SceneDescription& description = find_scene("stack");
  const auto scene =
      description.build(with(description, {{"bodies", "10"}}), method_of(description, Engine::plain));
  for (int n = 0; n < 10; ++n) {
    scene->advance(1);
    scene->judge();
  }
  EXPECT_EQ(scene->report().iterations, 50);
  EXPECT_GT(scene->report().residual, 0);
  EXPECT_EQ(scene->verdict().state, State::unsolved) << "50 sweeps carry no weight through ten balls";
}

TEST(PlainEngine, ChoosesTheSimplestSufficientStep) {
  const auto step_of = [](Settings<6> settings, auto... radii) {
    World<6> world(std::move(settings));
    world.add_plane(Vec3::UnitZ(), 0);
    double x = 0;
    (world.add({.x = Vec3(x += 5, 0, 1), .radius = radii}), ...);
    return plain_step_of(world, {.h = 0.01});
  };
  EXPECT_EQ(step_of({}), "2.7 step_free");
  EXPECT_EQ(step_of({}, 0.5), "3.5 step_touching");
  EXPECT_EQ(step_of({}, 0.5, 0.5), "4.7 step_contacts");
  EXPECT_EQ(step_of({.friction = 0.5}, 0.5), "5.7 step_friction");
  EXPECT_EQ(step_of({.impacts = ImpactLaw{.restitution = 0.5}}, 0.5), "7.9 step_impacts");
}

TEST(PlainEngine, RefusesWhatNoStepHas) {
  for (const auto& [scene, what] :
       std::vector<std::pair<std::string, std::string>>{{"pile", "materials"}, {"andrews", "wrench"}}) {
    const SceneDescription& description = find_scene(scene);
    const Method method{.h = description.h, .engine = Engine::plain};
    const auto built = description.build(with(description, {}), method);
    expect_refusal({"engine", what}, [&] { built->advance(1); });
    expect_refusal({"engine", what}, [&] { plain_step_of(*built, method); });
  }
}

TEST(PlainEngine, ABallBouncesNearlyAsHighAsTheFastEnginesBall) {
  const SceneDescription& description = find_scene("bouncing_ball");
  const Parameters parameters = with(description, {});
  const double h = 0.01;
  const auto second_peak = [&](Engine engine) {
    const auto scene = description.build(parameters, {.h = h, .engine = engine});
    double highest = 0;
    bool fell = false, bounced = false;
    for (int n = 0; n < 120; ++n) {
      scene->advance(1);
      const Frame frame = scene->frame();
      const double z = frame.x[1].z(), v = frame.v[1].z();
      fell = fell || v < 0;
      bounced = bounced || (fell && v > 0);
      if (bounced) highest = std::max(highest, z);
    }
    return highest;
  };
  // The contact is found up to a step late, when gravity has added up to g h to a speed of √(2 g h0): the height goes with
  // the square of that.
  const double v = std::sqrt(2 * 9.81 * parameters.number("h0")), late = 2 * 9.81 * h / v;
  const double exact = second_peak(Engine::fast);
  EXPECT_NEAR(second_peak(Engine::plain), exact, (late + v * h / exact) * exact);
}

}  // namespace
}  // namespace spook::plain_engine_test
