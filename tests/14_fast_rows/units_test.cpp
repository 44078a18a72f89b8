// The units of arguments and results of this chapter's functions, and tests in any units.
#include "../09_better_friction/friction_systems.hpp"
#include "contract.hpp"
#include "exercise_test.hpp"
#include "packs.hpp"
#include "quantities.hpp"

namespace spook::testing {

inline void each_number(Visitor& visitor, Lanes& lanes, const Unit& unit) {
  for (double& value : lanes) visitor.number(value, unit);
}

inline void each_number(Visitor& visitor, Lanes& lanes, const BoundUnits& units) {
  for (double& value : lanes) visitor.bound(value, units.unit);
}

inline void each_number(Visitor& visitor, LanePairs& pairs, const Unit& unit) {
  for (double& value : pairs.reshaped()) visitor.number(value, unit);
}

inline void each_number(Visitor& visitor, LaneTwists<6>& twists, const TwistUnits& units) {
  for (int k = 0; k < 6; ++k)
    for (int lane = 0; lane < lane_count; ++lane)
      visitor.number(twists(lane, k), k < 3 ? units.linear : units.angular);
}

inline void each_number(Visitor& visitor, LaneRows<6>& row, ByField) {
  using namespace units;
  visitor.fixed(true);
  each_number(visitor, row.Gi, jacobian), each_number(visitor, row.Gj, jacobian);
  each_number(visitor, row.MinvGi, responses), each_number(visitor, row.MinvGj, responses);
  each_number(visitor, row.B, m / s);
  each_number(visitor, row.Sigma, 1 / kg), each_number(visitor, row.diagonal, 1 / kg);
  each_number(visitor, row.lo, impulse_bounds), each_number(visitor, row.hi, impulse_bounds);
  visitor.fixed(false);
  each_number(visitor, row.lambda, N * s);
}

inline void each_number(Visitor& visitor, Pack<6>& pack, ByField) {
  visitor.fixed(true);
  for (const auto& indices : {pack.i, pack.j, pack.first})
    for (const int index : indices) visitor.count(index);
  visitor.fixed(false);
  for (LaneRows<6>& row : pack.rows) each_number(visitor, row, units::by_field);
}

}  // namespace spook::testing

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(SolveOnCone, "14.1 solve_on_cone");
EXERCISE(UpdateContact, "14.2 update_contact");
EXERCISE(UpdatePack, "14.4 update_pack");
EXERCISE(SolveInColours, "14.5 solve_in_colours");
EXERCISE(OntoDiscs, "14.6 onto_discs");

EXERCISE_TEST(SolveOnCone, IsTheSameInAnyUnits) {
  using namespace units;
  const Mat3 S = (Mat3() << 1.6, -1.2, 0.3, -1.2, 3.4, 0, 0.3, 0, 4).finished();
  for (const Vec3& q : {Vec3(1, 0.1, 0.2), Vec3(1, -3, 2), Vec3(-1, 0, 2)})
    expect_same_in_any_units_nans_aside("Eq. (14.5)", solve_on_cone, N * s, S * (1 / kg), q * (m / s), 0.5);
}

EXERCISE_TEST(UpdateContact, IsTheSameInAnyUnits) {
  using namespace units;
  Random random;
  const System<6> system = random_system(random, 4, 4, 0.8);
  for (const FrictionContact& contact : system.contacts)
    if (!expect_same_in_any_units("Eq. (14.2)", update_contact<6>, m / s, contact, system.rows,
                                  system.V * velocity))
      return;
}

EXERCISE_TEST(UpdatePack, IsTheSameInAnyUnits) {
  using namespace units;
  Random random;
  const Heap heap(random, 8, 10);
  for (const Colour<6>& colour : packed(heap.rows, heap.V.size()))
    for (const Pack<6>& pack : colour)
      if (!expect_same_in_any_units("Eq. (14.9)", update_pack<6>, m / s, pack, heap.V * velocity)) return;
}

EXERCISE_TEST(SolveInColours, IsTheSameInAnyUnits) {
  using namespace units;
  Random random;
  const Heap heap(random, 5, 6);
  const std::vector<Colour<6>> colours = packed(heap.rows, heap.V.size());
  // On one thread only: with a data race the result of several threads differs from call to call.
  for (const int sweeps : {100, 5})
    expect_same_in_any_units("Eq. (14.10)", solve_in_colours<6>, by_field, colours, heap.V * velocity,
                             StopRule{.max_sweeps = sweeps, .tolerance = 1e-4}, 1);
}

EXERCISE_TEST(OntoDiscs, IsTheSameInAnyUnits) {
  using namespace units;
  LanePairs lambda;
  lambda << Lanes(3, -1, 0.2, 5), Lanes(-4, 2, 0.1, 0.3);
  expect_same_in_any_units("Eq. (14.14)", onto_discs, N * s, lambda * (N * s), Lanes(5, 1, 2, 0) * (N * s));
}

}  // namespace
