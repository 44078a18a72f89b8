// Units of this chapter's arguments and results. The answers must be the same in any system of units.
#include "contract.hpp"
#include "exercise_test.hpp"
#include "problems.hpp"
#include "quantities.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(MakeRow, "4.1 make_row");
EXERCISE(ApplyImpulse, "4.2 apply_impulse");
EXERCISE(UpdateRow, "4.3 update_row");
EXERCISE(Sweep, "4.4 sweep");
EXERCISE(Residual, "4.5 residual");
EXERCISE(Solve, "4.6 solve");

/// Rows of contacts after a few sweeps, so that some push and some do not.
Problem<6> some_rows(int sweeps) {
  Random random;
  Problem<6> p = random_problem(random, 4, 8);
  for (int k = 0; k < sweeps; ++k) sweep(p.rows, p.V);
  return p;
}

EXERCISE_TEST(MakeRow, IsTheSameInAnyUnits) {
  Random random;
  const Motion<6> motion = random_motion(random, 3);
  const Constraint<6> constraint = random_constraint(random, 3);
  expect_same_in_any_units("Eq. (4.3), (4.4)", make_row<6>, units::by_field, constraint, motion);
}

EXERCISE_TEST(ApplyImpulse, IsTheSameInAnyUnits) {
  using namespace units;
  const Problem<6> p = some_rows(1);
  expect_same_in_any_units("Eq. (4.5)", apply_impulse<6>, nothing, p.rows[0], 0.3 * (N * s), p.V * velocity);
}

EXERCISE_TEST(UpdateRow, IsTheSameInAnyUnits) {
  using namespace units;
  const Problem<6> p = some_rows(1);
  for (const Row<6>& row : p.rows)
    if (!expect_same_in_any_units("Eq. (4.6), (4.7)", update_row<6>, N * s, row, p.V * velocity)) return;
}

EXERCISE_TEST(Sweep, IsTheSameInAnyUnits) {
  using namespace units;
  const Problem<6> p = some_rows(1);
  expect_same_in_any_units("Eq. (4.2), (4.9)", sweep<6>, m / s, p.rows, p.V * velocity);
}

EXERCISE_TEST(Residual, IsTheSameInAnyUnits) {
  using namespace units;
  Problem<6> p = some_rows(1);
  // An answer that projects on S_kk (lo - λ) reports a NaN of the diagonal as one of a bound.
  const auto of_sound_diagonals = [&](std::vector<Row<6>> rows, const std::vector<Twist<6>>& V) {
    for (std::size_t k = 0; k < rows.size(); ++k) rows[k].diagonal = p.rows[k].diagonal;
    return residual(rows, V);
  };
  for (const double lambda : {0.0, 0.01, 1.0}) {  // too little, and too much
    set_lambda(p, Eigen::VectorXd::Constant(std::ssize(p.rows), lambda));
    if (!expect_same_in_any_units_nans_aside("Eq. (4.8)", residual<6>, m / s, p.rows, p.V * velocity)) return;
    if (!nans_are_kept("Eq. (4.8)", [&](Replacing& replacing) {
          return outcome_of({}, replacing, of_sound_diagonals, m / s, p.rows, p.V * velocity);
        }))
      return;
  }
}

EXERCISE_TEST(Solve, IsTheSameInAnyUnits) {
  using namespace units;
  const Problem<6> p = some_rows(0);
  for (const StopRule& stop :
       {StopRule{.max_sweeps = 3, .tolerance = 0}, {.max_sweeps = 500, .tolerance = 1e-5}})
    expect_same_in_any_units("Eq. (4.9)", solve<6>, by_field, p.rows, p.V * velocity, stop);
}

}  // namespace
