// Units of this chapter's arguments and results. The answers must be the same in any system of units.
#include "collisions.hpp"
#include "contract.hpp"
#include "exercise_test.hpp"
#include "quantities.hpp"
#include "regions.hpp"

using namespace spook;
using namespace spook::testing;

namespace spook::testing {

static void each_number(Visitor& visitor, ImpactLaw& law, ByField) {
  visitor.bound(law.restitution, units::pure), visitor.bound(law.friction, units::pure);
  visitor.bound(law.threshold, units::m / units::s);
  visitor.count(law.max_passes);
}

static void each_number(Visitor& visitor, ImpactReport& report, ByField) {
  visitor.count(report.impacts), visitor.count(report.passes);
  visitor.number(report.energy, units::J);
}

}  // namespace spook::testing

namespace {

EXERCISE(StickImpulse, "7.1 stick_impulse");
EXERCISE(InsideCone, "7.2 inside_cone");
EXERCISE(SlidingImpulse, "7.3 sliding_impulse");
EXERCISE(ImpactWork, "7.4 impact_work");
EXERCISE(SafeImpulse, "7.5 safe_impulse");
EXERCISE(ImpactImpulse, "7.6 impact_impulse");
EXERCISE(ApplyImpact, "7.7 apply_impact");
EXERCISE(ResolveImpacts, "7.8 resolve_impacts");

/// Number of random impacts for each function. Some of them stick, some slide, and some are eased.
constexpr int impacts = 20;

EXERCISE_TEST(StickImpulse, IsTheSameInAnyUnits) {
  using namespace units;
  Random random;
  const Impact impact = random_impact(random);
  expect_same_in_any_units("Eq. (7.2), (7.3)", stick_impulse, N * s, impact.K * (1 / kg), impact.u * (m / s),
                           impact.n, impact.e);
}

EXERCISE_TEST(InsideCone, IsTheSameInAnyUnits) {
  using namespace units;
  Random random;
  for (int k = 0; k < impacts; ++k) {
    const Impact impact = random_impact(random);
    if (!expect_same_in_any_units("Eq. (7.4)", inside_cone, pure, impact.stick() * (N * s), impact.n,
                                  impact.mu))
      return;
  }
}

EXERCISE_TEST(SlidingImpulse, IsTheSameInAnyUnits) {
  using namespace units;
  Random random;
  for (int k = 0; k < impacts; ++k) {
    const Impact impact = random_impact(random);
    if (!expect_same_in_any_units("Eq. (7.5)", sliding_impulse, N * s, impact.K * (1 / kg), impact.u * (m / s),
                                  impact.n, impact.e, impact.mu))
      return;
  }
}

EXERCISE_TEST(ImpactWork, IsTheSameInAnyUnits) {
  using namespace units;
  Random random;
  const Impact impact = random_impact(random);
  const Vec3 impulse = random.vector();
  expect_same_in_any_units("Eq. (7.6)", impact_work, J, impact.K * (1 / kg), impact.u * (m / s),
                           impulse * (N * s));
}

EXERCISE_TEST(SafeImpulse, IsTheSameInAnyUnits) {
  using namespace units;
  Random random;
  for (int k = 0; k < impacts; ++k) {
    const Impact impact = impact_of_any_K(random);
    if (!expect_same_in_any_units_nans_aside("Eq. (7.7), (7.8)", safe_impulse, N * s, impact.K * (1 / kg),
                                             impact.u * (m / s), impact.n, impact.e, impact.mu))
      return;
  }
}

EXERCISE_TEST(ImpactImpulse, IsTheSameInAnyUnits) {
  using namespace units;
  Random random;
  Regions regions({"sticks", "slides", "would add energy"});
  while (regions.lack_draws()) {
    const Impact impact = impact_of_any_K(random);
    const bool sticks = impact.inside(impact.stick());
    const Vec3 J = sticks ? impact.stick() : impact.slide();
    const bool adds = impact.eased() > 0 && impact.work(J) > 0;
    regions.draw({{"sticks", sticks && !adds}, {"slides", !sticks && !adds}, {"would add energy", adds}});
    if (!expect_same_in_any_units_nans_aside("Eq. (7.3), (7.5), (7.7)", impact_impulse, N * s,
                                             impact.K * (1 / kg), impact.u * (m / s), impact.n, impact.e,
                                             impact.mu))
      return;
  }
}

EXERCISE_TEST(ApplyImpact, IsTheSameInAnyUnits) {
  using namespace units;
  Random random;
  const Boxes boxes(random, 3);
  const Contact contact = boxes.contact(random, 2, 0);
  const Vec3 impulse = random.vector();
  expect_same_in_any_units("Eq. (7.9)", apply_impact<6>, nothing, contact, impulse * (N * s), boxes.motion);
}

EXERCISE_TEST(ResolveImpacts, IsTheSameInAnyUnits) {
  using namespace units;
  Random random;
  const Boxes boxes(random, 4);
  std::vector<Contact> contacts;
  for (const auto& [i, j] : {std::pair(0, 1), {2, 1}, {3, 2}}) contacts.push_back(boxes.contact(random, i, j));
  const ImpactLaw law{.restitution = 0.5, .friction = 0.4, .threshold = 1e-6, .max_passes = 20};
  expect_same_in_any_units_nans_aside("Eq. (7.1), (7.10)", resolve_impacts<6>, by_field, contacts, law,
                                      boxes.motion);
}

}  // namespace
