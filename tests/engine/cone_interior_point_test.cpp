// The interior point on cones: near a solution it takes few factorisations, and it finds the same answer for any bounds.
#include "engine/solvers/cone_interior_point.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "engine/world/world.hpp"
#include "raw_system.hpp"

namespace spook::cone_interior_point_test {
namespace {

/// Calls `look` with the rows of the last of some steps, in which a wall of bricks stands.
void with_wall(const std::function<void(const SolverInput<6>&)>& look) {
  const Solver<6> inner = automatic<6>(FrictionModel::cone);
  int steps = 0;
  Solver<6> solver{.solve = [&](const SolverInput<6>& s) -> SolverResult {
                     if (++steps == 40) look(s);
                     return inner.solve(s);
                   },
                   .friction = FrictionModel::cone,
                   .wants_last = true};
  World<6> world({.friction = 0.6, .solver = solver});
  world.add_plane(Vec3::UnitZ(), 0);
  for (int course = 0; course < 5; ++course)
    for (int n = 0; n < 4; ++n)
      world.add({.x = Vec3(2.002 * n - 0.98 * (course % 2), 0, course + 0.5), .half_sides = Vec3(1, 0.5, 0.5)});
  while (steps < 40) world.step(1.0 / 60);
}

TEST(ConeInteriorPoint, TakesFewFactorisationsNearASolution) {
  int walls = 0;
  with_wall([&](const SolverInput<6>& s) {
    ++walls;
    std::vector<Row<6>> rows = s.rows();
    std::vector<Twist<6>> V = s.V;
    ContactVelocitySystem<6> system;
    ConeProblem<6> problem(rows, V, s.constraints.friction, s.bodies.motion.inverse_mass, system);
    const double B = problem.rhs_norm(), close = 1e-9 * B;
    std::vector<double> inside;
    problem.set_impulses(std::vector<double>(rows.size(), 0));
    ASSERT_TRUE(cone_interior_point(problem, close, close, {.factorisations = 60}, inside));
    EXPECT_GE(inside.size(), 10U);

    std::vector<double> lambda = problem.impulses();
    for (std::size_t k = 0; k < lambda.size(); ++k)
      lambda[k] *= 1 + 1e-5 * std::sin(3.0 * static_cast<double>(k));
    problem.project(lambda);
    problem.set_impulses(lambda);
    const double off = problem.residual();
    ASSERT_GT(off, 1e-6 * B) << "the wall is stiff";
    std::vector<double> near;
    ASSERT_TRUE(
        cone_interior_point(problem, off / 100, off / 100, {.width = 3 * off, .factorisations = 60}, near));
    EXPECT_LE(near.size(), 4U);
    EXPECT_LE(problem.residual(), off / 100);
    EXPECT_NEAR(near.back(), problem.residual(), 1e-14 * B) << "the last entry belongs to the final impulses";
  });
  EXPECT_EQ(walls, 1);
}

/// Rows with bounds of all kinds between random bodies.
struct Bounded : RandomSystem<6> {
  explicit Bounded(unsigned seed) : RandomSystem<6>(seed) {
    for (int b = 0; b < 6; ++b) {
      InverseMass<6> inverse{};
      inverse.linear = std::exp(uniform());
      inverse.angular = inverse.linear * Mat3::Identity();
      add_body(inverse);
    }
    V.assign(6, Twist<6>::Zero());
    for (int r = 0; r < 24; ++r) {
      const int i = index(6), j = (i + 1 + index(5)) % 6;
      const double lo = r % 4 == 1 || r % 4 == 3 ? -infinity : r % 4 == 0 ? 0 : -0.05;
      const double hi = r % 4 == 0 || r % 4 == 3 ? infinity : 0.05;
      add_row(i, j, spook_parameters(h, 1e5, 3), lo, hi);
    }
  }
};

TEST(ConeInteriorPoint, HasTheAnswersOfChapter11ForAnyBounds) {
  int at_bounds = 0, free = 0;
  for (unsigned seed = 1; seed <= 40; ++seed)
    for (const double width : {0.0, 1e-4, 0.1}) {
      Bounded some(seed), others = some;
      Factors factors;
      ASSERT_TRUE(direct_solve(others.rows, others.V, {}, factors).converged) << "seed " << seed;
      ContactVelocitySystem<6> system;
      const std::vector<FrictionContact> none;
      ConeProblem<6> problem(some.rows, some.V, none, some.motion.inverse_mass, system);
      std::vector<double> start;
      const double off = width > 0 ? 0.03 * width : 0.1;
      for (const Row<6>& row : others.rows) start.push_back(row.lambda + off * (0.01 - row.lambda));
      problem.project(start);
      problem.set_impulses(start);
      std::vector<double> history;
      const double close = 1e-10 * problem.rhs_norm();
      ASSERT_TRUE(cone_interior_point(problem, close, close,
                                      {.width = width * problem.rhs_norm(), .factorisations = 60}, history))
          << "seed " << seed << ", width " << width;
      if (width > 0 && width < 1e-3) {
        EXPECT_LE(history.size(), 4U) << "seed " << seed;
      }
      // Σ is at least a thousandth of S_kk here, so that a residual is multiplied by at most as much.
      EXPECT_LE(difference(some.rows, others.rows), 1e-6) << "seed " << seed << ", width " << width;
      for (const Row<6>& row : others.rows) ++(row.lo < row.lambda && row.lambda < row.hi ? free : at_bounds);
    }
  EXPECT_GE(at_bounds, 300);
  EXPECT_GE(free, 300);
}

}  // namespace
}  // namespace spook::cone_interior_point_test
