// The units of arguments and results of this chapter's functions, and tests in any units.
#include "contract.hpp"
#include "exercise_test.hpp"
#include "quantities.hpp"
#include "systems.hpp"

using namespace spook;
using namespace spook::testing;

namespace spook::testing {

static void each_number(Visitor& visitor, OldContact& old, ByField) {
  visitor.count(old.i), visitor.count(old.j);
  each_number(visitor, old.point, units::m);
}

static void each_number(Visitor& visitor, SoftParameters& soft, ByField) {
  visitor.number(soft.bias_rate, 1 / units::s);
  visitor.number(soft.mass_scale, units::pure), visitor.number(soft.impulse_scale, units::pure);
}

}  // namespace spook::testing

namespace {

EXERCISE(MatchContacts, "10.1 match_contacts");
EXERCISE(WarmStart, "10.2 warm_start");
EXERCISE(OrderAlong, "10.3 order_along");
EXERCISE(RandomOrder, "10.4 random_order");
EXERCISE(SweepInOrder, "10.5 sweep_in_order");
EXERCISE(ObservedRate, "10.6 observed_rate");
EXERCISE(Precondition, "10.7 precondition");
EXERCISE(ConjugateSolve, "10.8 conjugate_solve");
EXERCISE(Relax, "10.9 relax");
EXERCISE(SoftParameters, "10.10 soft_parameters");
EXERCISE(UpdateSoftRow, "10.11 update_soft_row");
EXERCISE(SoftSubstep, "10.12 soft_substep");

constexpr SoftParameters somewhat_soft{.bias_rate = 5, .mass_scale = 0.7, .impulse_scale = 0.3};

/// Rows with bounds of every kind.
Problem<6> bounded_rows() {
  Random random;
  Problem<6> p = random_problem(random, 4, 9);
  give_bounds(random, p);
  return p;
}

EXERCISE_TEST(MatchContacts, IsTheSameInAnyUnits) {
  using namespace units;
  Random random;
  std::vector<Contact> contacts;
  std::vector<OldContact> old;
  for (int k = 0; k < 12; ++k) {
    const Vec3 point = random.vector();
    contacts.push_back(
        {.i = k % 2, .j = 2, .n = Vec3::UnitZ(), .gap = 0, .r_i = random.vector(), .r_j = point});
    old.push_back({.i = k % 2, .j = 2, .point = point + random.vector(0.2)});
  }
  expect_same_in_any_units("Eq. (10.1)", match_contacts, pure, contacts, old, 0.2 * m);
}

EXERCISE_TEST(WarmStart, IsTheSameInAnyUnits) {
  using namespace units;
  Random random;
  const Problem<6> p = bounded_rows();
  std::vector<double> impulses;
  for (std::size_t k = 0; k < p.rows.size(); ++k) impulses.push_back(random.uniform(-0.4, 0.4));
  expect_same_in_any_units("Eq. (10.2)", warm_start<6>, nothing, impulses * (N * s), p.rows, p.V * velocity);
}

EXERCISE_TEST(OrderAlong, IsTheSameInAnyUnits) {
  using namespace units;
  const std::vector<double> heights = {0.3, -1, 0.30001, 2, -0.99999, 0.3, 0.29999};
  expect_same_in_any_units("Eq. (10.3)", order_along, pure, heights * m);
}

EXERCISE_TEST(RandomOrder, DependsOnTheGeneratorAlone) {
  const auto order = [](int n, int seed) {
    std::mt19937_64 generator(static_cast<std::uint64_t>(seed));
    return random_order(n, generator);
  };
  expect_same_in_any_units("Eq. (10.4)", order, units::pure, 50, 7);
}

EXERCISE_TEST(SweepInOrder, IsTheSameInAnyUnits) {
  using namespace units;
  const Problem<6> p = bounded_rows();
  const std::vector<int> order = {3, 8, 1, 0, 5, 7, 2, 6, 4};
  expect_same_in_any_units("Eq. (4.9)", sweep_in_order<6>, m / s, order, p.rows, p.V * velocity);
}

EXERCISE_TEST(ObservedRate, IsTheSameInAnyUnits) {
  using namespace units;
  const std::vector<double> history = {3, 2, 1.1, 0.5, 0.3, 0.1, 0.04};
  expect_same_in_any_units("Eq. (10.5)", observed_rate, pure, history * (m / s));
}

EXERCISE_TEST(Precondition, IsTheSameInAnyUnits) {
  using namespace units;
  Random random;
  const Problem<6> p = bounded_rows();
  std::vector<double> lacks;
  std::vector<bool> free;
  for (std::size_t k = 0; k < p.rows.size(); ++k) {
    lacks.push_back(random.uniform(-1, 1));
    free.push_back(k % 4 != 2);
  }
  expect_same_in_any_units("Eq. (10.6)", precondition<6>, N * s, p.rows, lacks * (m / s), free, p.V.size());
}

EXERCISE_TEST(ConjugateSolve, IsTheSameInAnyUnits) {
  using namespace units;
  const Problem<6> p = bounded_rows();
  for (const StopRule& stop :
       {StopRule{.max_sweeps = 5, .tolerance = 0}, {.max_sweeps = 100, .tolerance = 1e-6}})
    expect_same_in_any_units("Eq. (10.6)-(10.9)", conjugate_solve<6>, by_field, p.rows, p.V * velocity, stop);
}

EXERCISE_TEST(Relax, IsTheSameInAnyUnits) {
  using namespace units;
  const Problem<6> p = bounded_rows();
  for (const StopRule& stop :
       {StopRule{.max_sweeps = 5, .tolerance = 0}, {.max_sweeps = 100, .tolerance = 1e-6}})
    expect_same_in_any_units("Eq. (10.15)", relax<6>, by_field, p.motion, p.rows, p.V * velocity, stop);
}

EXERCISE_TEST(SoftParameters, IsTheSameInAnyUnits) {
  using namespace units;
  expect_same_in_any_units("Eq. (10.20)", soft_parameters, by_field, 0.01 * s, 48 * (1 / s), 0.7);
}

EXERCISE_TEST(UpdateSoftRow, IsTheSameInAnyUnits) {
  using namespace units;
  const Problem<6> p = bounded_rows();
  for (const double gap : {-0.03, 0.002})
    for (const Row<6>& row : p.rows)
      expect_same_in_any_units("Eq. (10.21)", update_soft_row<6>, N * s, 0.01 * s, somewhat_soft, gap * m, row,
                               p.motion.W * velocity);
}

EXERCISE_TEST(SoftSubstep, IsTheSameInAnyUnits) {
  using namespace units;
  const Problem<6> p = bounded_rows();
  const std::vector<double> gaps = {-0.03, 0.002, 0.01, -0.01, -0.02, 0.004, 0.02, -0.05, 0.001};
  expect_same_in_any_units("Eq. (10.15), (10.19)", soft_substep<6>, velocity, 0.01 * s, somewhat_soft,
                           p.motion.Wf * velocity, p.rows, gaps * m, p.motion.W * velocity);
}

}  // namespace
