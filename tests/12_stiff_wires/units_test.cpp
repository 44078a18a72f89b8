// The units of arguments and results of this chapter's functions, and tests in any units.
#include "contract.hpp"
#include "exercise_test.hpp"
#include "matrices.hpp"
#include "quantities.hpp"
#include "springs.hpp"

using namespace spook;
using namespace spook::testing;

namespace spook::testing {

static void each_number(Visitor& visitor, Stiffness& spring, ByField) {
  visitor.count(spring.i), visitor.count(spring.j);
  each_number(visitor, spring.K, units::N / units::m);
}

}  // namespace spook::testing

namespace {

EXERCISE(TransverseFrequency, "12.1 transverse_frequency");
EXERCISE(GeometricStiffness, "12.2 geometric_stiffness");
EXERCISE(StiffenedMatrix, "12.3 stiffened_matrix");
EXERCISE(StiffSolve, "12.4 stiff_solve");

EXERCISE_TEST(TransverseFrequency, IsTheSameInAnyUnits) {
  using namespace units;
  expect_same_in_any_units("Eq. (12.1)", transverse_frequency, 1 / s, 30 * N, 0.2 * kg, 0.05 * m);
}

EXERCISE_TEST(GeometricStiffness, IsTheSameInAnyUnits) {
  using namespace units;
  Random random;
  for (const double tension : {-3.0, 0.0, 5.0})
    expect_same_in_any_units("Eq. (12.3), (12.4)", geometric_stiffness, N / m, random.unit_vector(), 0.1 * m,
                             tension * N);
}

EXERCISE_TEST(StiffenedMatrix, IsTheSameInAnyUnits) {
  using namespace units;
  Random random;
  const Springs springs = random_springs(random, 6, 2, 4);
  const SaddleUnits entries{.bodies = 6, .dof = 3, .fixed = 2};
  expect_same_in_any_units("Eq. (12.5)", stiffened_matrix, entries, springs.rows, springs.motion.inverse_mass,
                           springs.stiffness, springs.h * s);
}

EXERCISE_TEST(StiffSolve, IsTheSameInAnyUnits) {
  using namespace units;
  const auto solve = [](std::vector<Row<3>>& rows, const Motion<3>& motion,
                        const std::vector<Stiffness>& stiffness, double h, std::vector<Twist<3>>& V) {
    Factors factors;
    return stiff_solve(rows, motion, stiffness, h, V, factors);
  };
  Random random;
  const Springs springs = random_springs(random, 6, 2, 4);
  const std::vector<Twist<3>> V(6, Twist<3>::Zero());
  expect_same_in_any_units("Eq. (12.6)", solve, pure, springs.rows, springs.motion, springs.stiffness,
                           springs.h * s, V * velocity);
}

}  // namespace
