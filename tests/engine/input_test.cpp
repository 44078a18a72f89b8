// Input that the engine refuses, with the parameter and its value in the message.
#include <gtest/gtest.h>

#include <limits>

#include "engine/support/did_you_mean.hpp"
#include "engine/world/world.hpp"
#include "refusals.hpp"
#include "scenes/number.hpp"
#include "scenes/run.hpp"

namespace spook::input_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(Input, Settings) {
  expect_refusal({"gravity", "nan"}, [] { World<3>({.gravity = Vec3(0, nan, 0)}); });
  expect_refusal({"k", "0"}, [] { World<3>({.k = 0}); });
  expect_refusal({"k", "inf"}, [] { World<6>({.k = infinity}); });
  expect_refusal({"d", "-1"}, [] { World<6>({.d = -1}); });
  expect_refusal({"solver"}, [] { World<3>({.solver = {.solve = nullptr}}); });
  expect_refusal({"max_sweeps", "0"}, [] { World<3>({.solver_limits = {.max_sweeps = 0}}); });
  expect_refusal({"tolerance", "nan"}, [] { World<3>({.solver_limits = {.tolerance = nan}}); });
}

TEST(Input, Bodies) {
  World<3> points({});
  World<6> rigid({});
  expect_refusal({"x", "nan"}, [&] { points.add({.x = Vec3(nan, 0, 0)}); });
  expect_refusal({"v", "inf"}, [&] { points.add({.v = Vec3(0, infinity, 0)}); });
  expect_refusal({"mass", "0"}, [&] { points.add({.mass = 0}); });
  expect_refusal({"mass", "-2"}, [&] { rigid.add({.mass = -2}); });
  expect_refusal({"mass", "inf"}, [&] { rigid.add({.mass = infinity}); });
  expect_refusal({"radius", "-1"}, [&] { points.add({.radius = -1}); });
  expect_refusal({"radius", "0.5", "corners"}, [&] { rigid.add({.radius = 0.5, .corners = {Vec3::UnitX()}}); });
  expect_refusal({"q", "2"}, [&] { rigid.add({.q = Quat(2, 0, 0, 0)}); });
  expect_refusal({"q", "nan"}, [&] { rigid.add({.q = Quat(nan, 0, 0, 0)}); });
  expect_refusal({"omega", "nan"}, [&] { rigid.add({.omega = Vec3(0, 0, nan)}); });
  expect_refusal({"principal moment", "0"}, [&] { rigid.add({.principal = Vec3(1, 0, 1)}); });
  expect_refusal({"x", "nan"}, [&] { points.add_fixed(Vec3(0, 0, nan)); });
  expect_refusal({"radius", "nan"}, [&] { points.add_fixed(Vec3::Zero(), nan); });
  expect_refusal({"n", "2"}, [&] { points.add_plane(Vec3(0, 0, 2), 0); });
  expect_refusal({"n", "nan"}, [&] { points.add_plane(Vec3(0, 0, nan), 0); });
  expect_refusal({"offset", "inf"}, [&] { points.add_plane(Vec3::UnitZ(), infinity); });
  EXPECT_EQ(points.bodies().size(), 0U) << "a refused body must leave no trace";
  EXPECT_EQ(rigid.bodies().size(), 0U);
}

TEST(Input, NumbersWithoutAnInverse) {
  const auto refuses = [](const std::string& name, const Body<6>& body) {
    World<6> world({});
    expect_refusal({name}, [&] { world.add(body); });
    EXPECT_EQ(world.bodies().size(), 0u);
  };
  refuses("mass", {.mass = 1e-310, .radius = 1});
  refuses("principal moment", {.half_sides = Vec3(1e160, 1, 1)});
  refuses("principal moment", {.radius = 1e160});
  refuses("principal moment", {.radius = 1e-170});
  refuses("principal moment", {.principal = Vec3::Constant(1e-310)});
}

TEST(Input, StepsAndIndices) {
  World<3> world({});
  world.add({});
  for (const double h : {0.0, -0.1, infinity, nan}) {
    expect_refusal({"h"}, [&] { world.step(h); });
    expect_refusal({"h"}, [&] { world.start_half_step_back(h); });
  }
  EXPECT_EQ(world.steps(), 0);
  expect_refusal({"body", "1"}, [&] { world.x(1); });
  expect_refusal({"body", "-1"}, [&] { world.v(-1); });
  expect_refusal({"contact", "0"}, [&] { world.lambda(0); });
  expect_refusal({"solver", "gaus_seidel", "gauss_seidel"}, [] { find_solver<6>("gaus_seidel"); });
}

TEST(Input, NumbersAsTyped) {
  EXPECT_EQ(parse_number("h", "1/60"), 1.0 / 60);
  EXPECT_EQ(parse_number("h", "-2.5e-3"), -2.5e-3);
  EXPECT_EQ(parse_whole("iterations", "50", 1, 100), 50);
  for (const std::string text : {"", " ", "abc", "1e", "1/0", "0/0", "1/", "/2", "1/2/3", "1 ", " 1", "nan",
                                 "inf", "-inf", "1e400", "1,5", "0x10", "+1", "--1"})
    expect_refusal({"h", "\"" + text + "\""}, [&] { parse_number("h", text); });
  for (const std::string text : {"0", "101", "1.5", "-1", "x"})
    expect_refusal({"iterations", text}, [&] { parse_whole("iterations", text, 1, 100); });
  EXPECT_EQ(parse_number("k", exact_text(0.1 + 0.2)), 0.1 + 0.2);
}

TEST(Input, StepCounts) {
  EXPECT_EQ(step_count(1.0 / 60, 5), 300);
  EXPECT_EQ(step_count(0.3, 1), 3);
  EXPECT_EQ(step_count(0.1, 0), 0);
  expect_refusal({"h", "0"}, [] { step_count(0, 1); });
  expect_refusal({"time", "-1"}, [] { step_count(1, -1); });
  expect_refusal({"time/h", "10000000000"}, [] { step_count(1e-10, 1); });
  expect_refusal({"time/h", "inf"}, [] { step_count(1e-300, 1e300); });
}

TEST(Input, NearMisses) {
  const std::vector<std::string> known = {"orbit", "top", "stack"};
  EXPECT_EQ(did_you_mean("obrit", known), "; did you mean \"orbit\"?");
  EXPECT_EQ(did_you_mean("stakc", known), "; did you mean \"stack\"?");
  EXPECT_EQ(did_you_mean("nope", known), "; there are: orbit, top, stack");
  EXPECT_EQ(did_you_mean("", {"only"}), "; there is only only");
}

}  // namespace
}  // namespace spook::input_test
