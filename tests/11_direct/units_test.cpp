// The units of arguments and results of this chapter's functions, and tests in any units.
#include "contract.hpp"
#include "exercise_test.hpp"
#include "interior.hpp"
#include "matrices.hpp"
#include "quantities.hpp"
#include "systems.hpp"

using namespace spook;
using namespace spook::testing;

namespace spook::testing {

static void each_number(Visitor& visitor, Interior& now, ByField) {
  using namespace units;
  for (Vector* impulses : {&now.lambda, &now.room_lo, &now.room_hi}) each_number(visitor, *impulses, N * s);
  for (Vector* pushes : {&now.push_lo, &now.push_hi}) each_number(visitor, *pushes, m / s);
}

static void each_number(Visitor& visitor, Target& target, ByField) {
  each_number(visitor, target.lo, units::J), each_number(visitor, target.hi, units::J);
}

}  // namespace spook::testing

namespace {

EXERCISE(SchurComplement, "11.1 schur_complement");
EXERCISE(SaddleMatrix, "11.2 saddle_matrix");
EXERCISE(Factorise, "11.3 factorise");
EXERCISE(SaddleSolve, "11.4 saddle_solve");
EXERCISE(BarrierMatrix, "11.5 barrier_matrix");
EXERCISE(NewtonStep, "11.6 newton_step");
EXERCISE(LongestStep, "11.7 longest_step");
EXERCISE(InteriorStart, "11.8 interior_start");
EXERCISE(InteriorStep, "11.9 interior_step");
EXERCISE(InteriorSolve, "11.10 interior_solve");
EXERCISE(DirectSolve, "11.11 direct_solve");

/// Rigid bodies, of which the first is static, and rows without bounds or with bounds of every kind.
System<6> some_system(bool bounds) {
  Random random;
  System<6> system = random_system(random, 4, 9);
  if (bounds) add_random_bounds(random, system.rows);
  return system;
}

/// A symmetric system with bounds, as interior_solve takes it.
struct Sparse {
  SparseMatrix S;
  VectorXd B, lo, hi;
};

Sparse sparse_system() {
  const System<6> system = some_system(true);
  const Bounded p = bounded(system.rows);
  return {.S = lower_triangle(p.S), .B = p.B, .lo = p.lo, .hi = p.hi};
}

/// The arguments of the steps.
struct FactorsOf : Factors {
  explicit FactorsOf(const SparseMatrix& A) { factorise(A, *this); }
};

EXERCISE_TEST(SchurComplement, IsTheSameInAnyUnits) {
  expect_same_in_any_units("Eq. (11.1)", schur_complement<6>, 1 / units::kg, some_system(false).rows);
}

EXERCISE_TEST(SaddleMatrix, IsTheSameInAnyUnits) {
  const System<6> system = some_system(false);
  const SaddleUnits entries{.bodies = 4, .dof = 6, .fixed = 1};
  expect_same_in_any_units("Eq. (11.2)", saddle_matrix<6>, entries, system.rows, system.motion.inverse_mass);
}

EXERCISE_TEST(Factorise, IsTheSameInAnyUnits) {
  using namespace units;
  const auto solution = [](const SparseMatrix& A, const Vector& b) {
    Factors factors;
    const bool sound = factorise(A, factors);
    return std::pair(sound, sound ? Vector(factors.ldlt.solve(b)) : b);
  };
  const Sparse p = sparse_system();
  expect_same_in_any_units("Eq. (11.3), (11.4)", solution, N * s, p.S * (1 / kg), p.B * (m / s));
}

EXERCISE_TEST(SaddleSolve, IsTheSameInAnyUnits) {
  using namespace units;
  const auto solve = [](std::vector<Row<6>>& rows, const std::vector<InverseMass<6>>& inverse_mass,
                        std::vector<Twist<6>>& V) {
    Factors factors;
    return saddle_solve(rows, inverse_mass, V, factors);
  };
  const System<6> system = some_system(false);
  expect_same_in_any_units("Eq. (11.2)", solve, pure, system.rows, system.motion.inverse_mass,
                           system.V * velocity);
}

EXERCISE_TEST(BarrierMatrix, IsTheSameInAnyUnits) {
  using namespace units;
  Random random;
  const Inside p = random_inside(random, 8);
  expect_same_in_any_units("Eq. (11.7)", barrier_matrix, 1 / kg, lower_triangle(p.S) * (1 / kg), p.now);
}

EXERCISE_TEST(NewtonStep, IsTheSameInAnyUnits) {
  using namespace units;
  const auto step = [](const SparseMatrix& S, const Vector& B, const Interior& now, const Target& target) {
    return newton_step(S, B, now, target, FactorsOf(barrier_matrix(S, now)));
  };
  Random random;
  const Inside p = random_inside(random, 8);
  expect_same_in_any_units("Eq. (11.8), (11.9)", step, by_field, lower_triangle(p.S) * (1 / kg), p.B * (m / s),
                           p.now, p.target);
}

EXERCISE_TEST(LongestStep, IsTheSameInAnyUnits) {
  Random random;
  const Interior now = random_inside(random, 8).now;
  Interior step = random_inside(random, 8).now;
  for (const Part& part : parts)
    for (double& change : step.*part.vector) change = std::isfinite(change) ? random.uniform(-2, 2) : 0;
  // A NaN among the rooms and pushes stays in the step that is taken, whatever its length.
  expect_same_in_any_units_nans_aside("Eq. (11.10)", longest_step, units::pure, now, step);
}

EXERCISE_TEST(InteriorStart, IsTheSameInAnyUnits) {
  using namespace units;
  const Sparse p = sparse_system();
  const Vector guess = Vector::LinSpaced(p.B.size(), -1, 1);
  expect_same_in_any_units_nans_aside("Eq. (11.12)", interior_start, by_field, p.S * (1 / kg), p.B * (m / s),
                                      p.lo * impulse_bounds, p.hi * impulse_bounds, guess * (N * s));
}

EXERCISE_TEST(InteriorStep, IsTheSameInAnyUnits) {
  using namespace units;
  const auto step = [](const SparseMatrix& S, const Vector& B, const Vector& lo, const Vector& hi,
                       const Interior& now) {
    return interior_step(S, B, lo, hi, now, FactorsOf(barrier_matrix(S, now)));
  };
  Random random;
  const Inside p = random_inside(random, 8);
  expect_same_in_any_units("Eq. (11.11)", step, by_field, lower_triangle(p.S) * (1 / kg), p.B * (m / s),
                           (p.now.lambda - p.now.room_lo) * impulse_bounds,
                           (p.now.lambda + p.now.room_hi) * impulse_bounds, p.now);
}

EXERCISE_TEST(InteriorSolve, IsTheSameInAnyUnits) {
  using namespace units;
  const auto solve = [](const SparseMatrix& S, const Vector& B, const Vector& lo, const Vector& hi,
                        const StopRule& stop, Vector& lambda) {
    Factors factors;
    return interior_solve(S, B, lo, hi, stop, lambda, factors);
  };
  const Sparse p = sparse_system();
  const Vector guess = Vector::Zero(p.B.size());
  for (const StopRule& stop :
       {StopRule{.max_sweeps = 3, .tolerance = 0}, {.max_sweeps = 50, .tolerance = 1e-7}})
    expect_same_in_any_units_nans_aside("Eq. (11.5), (11.13)", solve, by_field, p.S * (1 / kg), p.B * (m / s),
                                        p.lo * impulse_bounds, p.hi * impulse_bounds, stop, guess * (N * s));
}

EXERCISE_TEST(DirectSolve, IsTheSameInAnyUnits) {
  using namespace units;
  const auto solve = [](std::vector<Row<6>>& rows, std::vector<Twist<6>>& V, const StopRule& stop) {
    Factors factors;
    return direct_solve(rows, V, stop, factors);
  };
  for (const bool bounds : {false, true}) {
    const System<6> system = some_system(bounds);
    expect_same_in_any_units("Eq. (11.5), (11.14)", solve, by_field, system.rows, system.V * velocity,
                             StopRule{.max_sweeps = 50, .tolerance = 1e-7});
  }
}

}  // namespace
