// Sweeps over blocks of three rows: the same numbers as chapter 09's sweeps over rows, to round-off.
#include "engine/solvers/cone_sweeps.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "engine/world/world.hpp"

namespace spook::cone_sweeps_test {
namespace {

/// Calls `look` with the rows of a step: a chain on a wall, whose last link leans on sliding boxes of unequal masses.
void with_rows(const std::function<void(const SolverInput<6>&)>& look) {
  Solver<6> solver{.solve = [&](const SolverInput<6>& s) -> SolverResult {
                     look(s);
                     return SolveReport{.history = {0}, .converged = true};
                   },
                   .friction = FrictionModel::cone};
  World<6> world({.k = 1e5, .friction = 0.4, .solver = solver});
  world.add_plane(Vec3::UnitZ(), 0);
  const int wall = world.add_fixed(Vec3(-1, 0, 1));
  const auto box = [&](const Vec3& x, double mass) {
    return world.add({.x = x,
                      .v = Vec3(0.3, -0.2, -0.5),
                      .mass = mass,
                      .omega = Vec3(0.2, -0.4, 0.6),
                      .half_sides = Vec3(0.2, 0.15, 0.1)});
  };
  const int lower = box(Vec3(0, 0, 0.0999), 1), upper = box(Vec3(0.05, 0.02, 0.2997), 7),
            top = box(Vec3(0, 0, 0.4995), 0.3);
  world.add_joint({.i = wall,
                   .j = upper,
                   .p_i = world.x(upper) - world.x(wall),
                   .kind = JointKind::hinge,
                   .axis = Vec3::UnitY()});
  world.set_material(lower, top, {.friction = 0.0});
  world.step(0.01);
}

TEST(ConeSweeps, EqualTheSweepsOfChapter09) {
  int systems = 0;
  with_rows([&](const SolverInput<6>& s) {
    ++systems;
    ASSERT_GE(s.constraints.friction.size(), 12U);
    ASSERT_GE(s.constraints.first_contact_row, 5U) << "rows of a hinge come first";
    std::vector<Row<6>> rows = s.rows(), blocks = s.rows();
    std::vector<Twist<6>> V = s.V, V_blocks = s.V;
    ConeSweeps<6> sweeps(s.constraints.friction, blocks, V_blocks, s.bodies.motion.inverse_mass);
    double size = 0, speed = 0;
    for (int n = 0; n < 20; ++n) {
      const double expected = sweep_on_cones(s.constraints.friction, rows, V);
      EXPECT_NEAR(sweeps.sweep(), expected, 1e-12 * expected) << "sweep " << n;
    }
    sweeps.write_back();
    for (const Row<6>& row : rows) size = std::max(size, std::abs(row.lambda));
    for (const Twist<6>& v : V) speed = std::max(speed, v.norm());
    // A sweep is a chain of some 50 roundings for each of 50 rows. Errors do not grow from sweep to sweep.
    for (std::size_t k = 0; k < rows.size(); ++k)
      EXPECT_NEAR(blocks[k].lambda, rows[k].lambda, 1e-12 * size) << "row " << k;
    for (std::size_t b = 0; b < V.size(); ++b)
      EXPECT_LE((V_blocks[b] - V[b]).norm(), 1e-12 * speed) << "body " << b;
  });
  EXPECT_EQ(systems, 1);
}

TEST(ConeSweeps, StartFromAnyImpulsesWithinTheirBounds) {
  with_rows([](const SolverInput<6>& s) {
    std::vector<Row<6>> rows = s.rows();
    std::vector<Twist<6>> V = s.V;
    ConeSweeps<6> sweeps(s.constraints.friction, rows, V, s.bodies.motion.inverse_mass);
    for (int n = 0; n < 5; ++n) sweeps.sweep();
    const Eigen::VectorXd before = sweeps.scaled_impulses();
    sweeps.start_from(before);
    EXPECT_LE((sweeps.scaled_impulses() - before).norm(), 1e-14 * before.norm())
        << "λ of a sweep is within its bounds";

    sweeps.start_from(Eigen::VectorXd::Constant(before.size(), -3) + 20 * before);
    sweeps.write_back();
    std::vector<Twist<6>> sum(V.size(), Twist<6>::Zero());
    for (const Row<6>& row : rows) apply_impulse(row, row.lambda, sum);
    double speed = 0;
    for (const Twist<6>& v : sum) speed = std::max(speed, v.norm());
    for (std::size_t b = 0; b < V.size(); ++b)
      EXPECT_LE((V[b] - sum[b]).norm(), 1e-13 * speed) << "V is not M⁻¹ Gᵀ λ of body " << b;
    for (const auto& [normal, mu] : s.constraints.friction) {
      EXPECT_GE(rows[normal].lambda, 0);
      EXPECT_LE(Vec2(rows[normal + 1].lambda, rows[normal + 2].lambda).norm(),
                mu * rows[normal].lambda * (1 + 1e-15) + 1e-300);
    }
  });
}

}  // namespace
}  // namespace spook::cone_sweeps_test
