// One sweep over all rows, each contact with its cone, and the residual.
#include "cancellation.hpp"
#include "exercise_test.hpp"
#include "friction_systems.hpp"
#include "random_input.hpp"
#include "regions.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(SweepOnCones, "9.6 sweep_on_cones");
EXERCISE(ResidualOnCones, "9.7 residual_on_cones");

/// The λ after a sweep that takes the rows in this order; -1 - c stands for the friction of contact c.
Eigen::VectorXd swept(System<6> s, const std::vector<int>& order) {
  for (const int k : order)
    if (k >= 0)
      update_row(s.rows[static_cast<std::size_t>(k)], s.V);
    else
      update_friction(s.contacts[static_cast<std::size_t>(-1 - k)], s.rows, s.V);
  return all_lambda(s.rows);
}

EXERCISE_TEST(SweepOnCones, TakesEveryRowInOrderAndTheFrictionOfAContactTogether) {
  Random random;
  for (int trial = 0; trial < 10 && !::testing::Test::HasFailure(); ++trial) {
    // joint 0, contact 1 2 3, joint 4, contact 5 6 7, joint 8
    System<6> s = random_system(random, 3, 2, 1);
    for (std::size_t k = 0; k < s.rows.size(); ++k) s.begin_with(k, random.uniform(0.1, 0.3));
    const System<6> before = s;
    sweep_on_cones(s.contacts, s.rows, s.V);
    expect_near_vector(
        "λ [N s] after one sweep of joint, contact, joint, contact, joint", "Eq. (4.7), (9.6)",
        all_lambda(s.rows), swept(before, {0, 1, -1, 4, 5, -2, 8}), roundings(1000, 5),
        {{all_lambda(before.rows), "No row has changed."},
         {swept(before, {1, -1, 5, -2}), "The rows of joints have been left out. Sweep them, too."},
         {swept(before, {0, 1, 4, 5, 8, -1, -2}),
          "Friction came after all other rows. It comes right after its own normal row."},
         {swept(before, {0, 4, 8, 1, -1, 5, -2}), "The joints came first. Rows come in their order."},
         {swept(before, {0, -1, 1, 4, -2, 5, 8}),
          "Friction came before its normal row, so it used the normal impulse of the last sweep."},
         {swept(before, {0, 1, 2, 3, 4, 5, 6, 7, 8}),
          "This is chapter 04's sweep, which updates each friction row by itself, with its own bounds."},
         {swept(before, {0, 1, -1, 2, 3, 4, 5, -2, 6, 7, 8}),
          "The friction rows have been updated twice, together and then separately. Continue behind them."},
         {swept(before, {0, 1, -1, 4, 5, 6, 7, 8}), "Only the first contact has had its cone."},
         {swept(before, {0, 1, 2, 3, -1, 4, 5, 6, 7, -2, 8}),
          "The friction rows have also been updated separately. Update them only together, on the cone."},
         {swept(before, {0, 1, 4, 5, 8}), "The friction rows have not been swept."},
         {swept(before, {8, 5, -2, 4, 1, -1, 0}), "The rows were swept from the last to the first."}},
        "Row by row; at a contact's normal row, the row, then its two friction rows by update_friction, "
        "then on behind them, to the very last row.");
    expect_near_vector("V after it", "Eq. (4.5)", all_V(s.V), V_of_lambda(s.rows, s.V.size()),
                       roundings(1000, 10));
    for (std::size_t k = 0; k < s.rows.size(); ++k)
      expect_true("after it row " + std::to_string(k) + " has the bounds that it had", "Eq. (9.6)",
                  s.rows[k].lo == before.rows[k].lo && s.rows[k].hi == before.rows[k].hi,
                  "update_friction takes its radius from λ_n and μ. Nobody has to set bounds for it.");
  }
}

EXERCISE_TEST(SweepOnCones, WithoutMuIsASweepWithoutFriction) {
  Random random;
  System<6> s = random_system(random, 4, 3, 0), plain = s;
  for (const FrictionContact& contact : plain.contacts)
    for (const std::size_t k : {contact.normal + 1, contact.normal + 2})
      plain.rows[k].lo = plain.rows[k].hi = 0;
  for (int n = 0; n < 5; ++n) {
    const double got = sweep_on_cones(s.contacts, s.rows, s.V), expected = sweep(plain.rows, plain.V);
    expect_near("what sweep " + std::to_string(n + 1) + " of 3 contacts with μ = 0 returns [m/s]",
                "Eq. (9.3), (4.9)", got, expected, roundings(1e4, 5), {},
                "On ice it is chapter 04's sweep, with friction rows that have bounds of 0. update_friction "
                "does this by itself: for μ = 0 its disc has the radius 0.");
  }
  expect_near_vector("λ after 5 sweeps of 3 contacts with μ = 0 [N s]", "Eq. (9.3), (4.7)", all_lambda(s.rows),
                     all_lambda(plain.rows), roundings(1e4, 5), {},
                     "On ice it is chapter 04's sweep, with friction rows that have bounds of 0. "
                     "update_friction does this by itself: for μ = 0 its disc has the radius 0.");
}

// Friction of an earlier step, in λ and in V, at a contact with μ = 0, or at one that has separated since.
EXERCISE_TEST(SweepOnCones, TakesOldFrictionOff) {
  Random random;
  for (const bool on_ice : {true, false}) {
    System<6> s = random_system(random, 4, 3, 1);
    for (std::size_t k = 0; k < s.rows.size(); ++k) s.begin_with(k, random.uniform(0.2, 0.4));
    const FrictionContact& contact = s.contacts[1];
    if (on_ice) s.contacts[1].mu = 0;
    Row<6>& normal = s.rows[contact.normal];
    if (!on_ice) normal.B -= 1000;  // larger than all other terms, so that the contact separates
    const Vec2 old = s.tangential(contact);
    System<6> by_hand = s;
    double largest = 0;
    for (std::size_t k = 0, c = 0; k < s.rows.size(); ++k) {
      Row<6>& row = by_hand.rows[k];
      const double change = std::abs(update_row(row, by_hand.V));
      largest = std::max(largest, row.diagonal * change);
      if (c == s.contacts.size() || s.contacts[c].normal != k) continue;
      largest = std::max(largest, update_friction(s.contacts[c++], by_hand.rows, by_hand.V));
      k += 2;
    }
    const double got = sweep_on_cones(s.contacts, s.rows, s.V);
    const std::string where = on_ice ? "with μ = 0" : "that has come apart";
    const std::string stays = "The old friction stays at a contact " + where +
                              ": call update_friction, which removes it, for every contact.";
    expect_near_vector("λ_t of a contact " + where + ", a sweep after it was " + show(old) + " [N s]",
                       "Eq. (9.3), (9.6)", s.tangential(contact), Vec2::Zero(), {0, "exact"}, {{old, stays}},
                       "A cone of radius 0 is a point.");
    expect_near_vector("V after it", "Eq. (4.5)", all_V(s.V), V_of_lambda(s.rows, s.V.size()),
                       roundings(1e4, 10 + normal.lambda), {}, "Remove the old λ_t from V, too.");
    expect_near("what the sweep returned [m/s]", "Eq. (9.6), (4.9)", got, largest, roundings(1e4, largest), {},
                "The change of friction counts, too.");
  }
}

EXERCISE_TEST(SweepOnCones, WithoutContactsEqualsSweep) {
  Random random;
  System<6> s = random_bodies(random, 3);
  for (int k = 0; k < 6; ++k) add_random_joint(s, random);
  System<6> plain = s;
  const double got = sweep_on_cones(s.contacts, s.rows, s.V), expected = sweep(plain.rows, plain.V);
  expect_near("what a sweep of six joints' rows returns [m/s]", "Eq. (4.9)", got, expected, roundings(1000, 5));
  expect_near_vector("λ of six joints' rows after it [N s]", "Eq. (4.7)", all_lambda(s.rows),
                     all_lambda(plain.rows), roundings(1000, 5), {},
                     "Without contacts, every row by update_row.");
}

EXERCISE_TEST(SweepOnCones, LeavesEveryContactInItsCone) {
  Random random;
  System<6> s = random_system(random, 5, 8, 1);
  for (int n = 0; n < 5; ++n) {
    sweep_on_cones(s.contacts, s.rows, s.V);
    for (const FrictionContact& contact : s.contacts) {
      const double limit = contact.mu * s.rows[contact.normal].lambda;
      expect_at_most("|λ_t| of a contact after sweep " + std::to_string(n + 1) + " [N s]", "Eq. (9.3)",
                     s.tangential(contact).norm(), limit + roundings(8, 1 + limit).value, "μ λ_n",
                     "Friction right after its normal row: then no later row of this sweep changes either.");
    }
  }
}

EXERCISE_TEST(SweepOnCones, ReturnsTheLargestChange) {
  Random random;
  for (int trial = 0; trial < 20 && !::testing::Test::HasFailure(); ++trial) {
    System<6> s = random_system(random, 3, 2, 1);
    for (const FrictionContact& contact : s.contacts) s.begin_with(contact.normal, 1);
    // One of three has the largest residual: a normal row, a pair of friction rows, or the last joint.
    const std::size_t most = std::vector<std::size_t>{1, 6, 8}[static_cast<std::size_t>(trial % 3)];
    s.rows[most].B += 20;
    const System<6> before = s;
    const double got = sweep_on_cones(s.contacts, s.rows, s.V);
    const Eigen::VectorXd change = all_lambda(s.rows) - all_lambda(before.rows);
    double rows = 0, pairs = 0, joints = 0, impulse = 0, last = 0;
    for (const Eigen::Index k : {0, 1, 4, 5, 8}) {
      last = s.rows[static_cast<std::size_t>(k)].diagonal * std::abs(change[k]);
      rows = std::max(rows, last);
      if (k != 1 && k != 5) joints = std::max(joints, last);
      impulse = std::max(impulse, std::abs(change[k]));
    }
    for (const FrictionContact& contact : s.contacts) {
      const double length = change.segment<2>(static_cast<Eigen::Index>(contact.normal + 1)).norm();
      pairs = std::max(pairs, larger_eigenvalue(tangential_S(s, contact)) * length);
      impulse = std::max(impulse, length);
    }
    expect_near("what a sweep of two contacts and three joints' rows returns, row " + std::to_string(most) +
                    " lacking most [m/s]",
                "Eq. (9.6), (4.9)", got, std::max(rows, pairs), roundings(1000, 20),
                {{rows, "Friction is missing: what update_friction returns counts, too."},
                 {pairs, "Only the friction rows have been counted."},
                 {std::max(joints, pairs), "The normal rows of contacts are missing: they count, too."},
                 {impulse, "This is the largest |Δλ|, an impulse. Times S_kk, or s, it is a velocity."},
                 {last, "This is the last row's, not the largest."}},
                "The largest S_kk |Δλ_k| of the rows, and s |Δλ_t| of the pairs.");
  }
}

/// Contacts among joints' rows that have bounds of any kind; their λ is anywhere, or at one of the bounds.
System<6> system_with_bounds(Random& random, int contacts) {
  System<6> s = random_system(random, 4, contacts, 1);
  std::size_t contact = 0;
  for (std::size_t k = 0; k < s.rows.size(); ++k) {
    if (contact < s.contacts.size() && s.contacts[contact].normal == k) {
      for (const std::size_t each : {k, k + 1, k + 2}) s.begin_with(each, random.uniform(0, 0.3));
      ++contact;
      k += 2;
      continue;
    }
    give_any_bounds(random, s.rows[k]);
    const double bound = random.integer(0, 1) ? s.rows[k].lo : s.rows[k].hi;
    s.begin_with(k, random.integer(0, 1) && std::abs(bound) < infinity ? bound : random.uniform(-0.5, 0.5));
  }
  return s;
}

const std::string any_row =
    "Update every joint's row by Eq. (4.7), with its own bounds, also if it begins at a bound and leaves it.";

EXERCISE_TEST(SweepOnCones, TakesAnyBoundsOfTheOtherRows) {
  Random random;
  for (int trial = 0; trial < 30 && !::testing::Test::HasFailure(); ++trial) {
    const int contacts = trial == 0 ? many : 3;
    System<6> s = system_with_bounds(random, contacts), expected = s;
    double largest = 0;
    std::size_t contact = 0;
    for (std::size_t k = 0; k < s.rows.size(); ++k) {
      Row<6>& row = expected.rows[k];
      largest = std::max(largest, row.diagonal * std::abs(update_row(row, expected.V)));
      if (contact == s.contacts.size() || s.contacts[contact].normal != k) continue;
      largest = std::max(largest, update_friction(s.contacts[contact++], expected.rows, expected.V));
      k += 2;
    }
    const double got = sweep_on_cones(s.contacts, s.rows, s.V);
    expect_near_vector("λ after a sweep over " + std::to_string(contacts) +
                           " contacts and rows with bounds of all kinds between them [N s]",
                       "Eq. (4.7), (9.6)", all_lambda(s.rows), all_lambda(expected.rows), roundings(1000, 5),
                       {}, any_row + " " + ends_early);
    expect_near("what it returned [m/s]", "Eq. (4.9)", got, largest, roundings(1000, 30), {}, any_row);
  }
}

EXERCISE_TEST(SweepOnCones, OfNothingIsZeroAndOfNaNIsNaN) {
  System<3> none;
  expect_near("what a sweep of no rows returns [m/s]", "Eq. (4.9)",
              sweep_on_cones(none.contacts, none.rows, none.V), 0, {0, "exact"});
  for (const std::size_t broken : {0u, 1u, 3u, 5u}) {
    System<3> s;  // points on a floor each, as 0 times NaN is a NaN in a floor's V, too: it is no neighbour's
    for (int k = 0; k < 3; ++k) add_body<3>(s, {.linear = 1}, Vec3(1, 1, -1));
    const Vec3 up = Vec3::UnitZ(), zero = Vec3::Zero();
    for (int k = 0; k < 3; ++k) add_body<3>(s, {});
    for (int j = 0; j < 3; ++j)
      add_contact(s, {.i = 3 + j, .j = j, .n = up, .gap = 0, .r_i = zero, .r_j = zero}, tangents(up), 0.5);
    s.rows[broken].B = std::nan("");
    expect_true(
        "a sweep with a NaN in row " + std::to_string(broken) + " of 9 returns NaN", "Eq. (4.9)",
        std::isnan(sweep_on_cones(s.contacts, s.rows, s.V)),
        "The NaN was lost. std::max(a, NaN) is a. Once the maximum is NaN, no later row may replace it.");
  }
}

// Where a rod slides for sure, λ_t = -μ λ_n t, and a sweep is λ_n <- (fall + μ n·Kt λ_n)/n·Kn: Eq. (9.8).
EXERCISE_TEST(SweepOnCones, ContractsASlidingRodAtItsRate) {
  for (const double slip : {3.0, -3.0})
    for (const double mu : {0.2, 0.5, 1.0}) {
      System<6> s = leaning_rod(mu, slip, 0.16);
      const double rho = std::copysign(mu, slip) * rod_Knx / rod_Knn;
      const double exact = 0.16 / (rod_Knn * (1 - rho));
      for (int n = 1; n <= 8; ++n) {
        sweep_on_cones(s.contacts, s.rows, s.V);
        expect_near("error of λ_n after sweep " + std::to_string(n) + ", over λ_n; μ = " + show(mu) +
                        ", a rod that slides " + (slip > 0 ? "end behind" : "end ahead"),
                    "Eq. (9.8)", s.rows[0].lambda / exact - 1, -std::pow(rho, n), roundings(200, 4), {},
                    "ρ = μ n·Kt/n·Kn a sweep: friction of the last sweep presses, or lifts, in this one.");
      }
    }
}

/// A system with a known solution: λ is chosen first, sticking, sliding, or 0, and B is computed from it.
System<6> solved_system(Random& random) {
  System<6> s = random_system(random, 4, 4, 1);
  std::vector<double> lacking(s.rows.size(), 0);
  for (std::size_t k = 0; k < s.rows.size(); k += 4) s.begin_with(k, random.uniform(-1, 1));  // joints
  for (std::size_t c = 0; c < s.contacts.size(); ++c) {
    const FrictionContact& contact = s.contacts[c];
    const double angle = random.uniform(0, 6.3), press = c == 0 ? 0 : random.uniform(0.5, 2);
    const double share = c == 1 ? random.uniform(0.1, 0.9) : 1;  // contact 1 sticks, 2 and 3 slide
    const double slip = c == 1 ? 0 : random.uniform(0.1, 2);
    s.begin_with(contact.normal, press);
    for (const std::size_t k : {contact.normal + 1, contact.normal + 2}) {  // for answers that use them
      s.rows[k].lo = -0.01;
      s.rows[k].hi = 0.01;
    }
    if (c == 0) lacking[contact.normal] = -random.uniform(0.1, 2);  // it comes apart
    for (const std::size_t t : {0u, 1u}) {
      const double direction = t == 0 ? std::cos(angle) : std::sin(angle);
      s.begin_with(contact.normal + 1 + t, share * contact.mu * press * direction);
      lacking[contact.normal + 1 + t] = slip * direction;
    }
  }
  for (std::size_t k = 0; k < s.rows.size(); ++k) s.rows[k].B += lacking[k] - s.lacks(k);
  return s;
}

EXERCISE_TEST(ResidualOnCones, IsZeroWhereCoulombsLawHolds) {
  Random random;
  for (int trial = 0; trial < 50 && !::testing::Test::HasFailure(); ++trial) {
    const System<6> s = solved_system(random);
    double unprojected = 0;
    for (std::size_t k = 0; k < s.rows.size(); ++k) unprojected = std::max(unprojected, std::abs(s.lacks(k)));
    expect_near(
        "residual of joints and contacts of which one is off, one sticks and two slide [m/s]", "Eq. (9.7)",
        residual_on_cones(s.contacts, s.rows, s.V), 0, roundings(3000, 5),
        {{unprojected,
          "This is the largest |r|. At a solution a sliding contact has r_t along λ_t, and a separating one r "
          "< "
          "0."},
         {residual(s.rows, s.V),
          "This is Eq. (4.8) for all rows, with the friction rows' own bounds. On the cone it is Eq. (9.7)."}},
        "Nothing would change: zero.");
  }
}

// Old friction at a contact with λ_n = 0, or with μ = 0: λ_t will go to 0.
EXERCISE_TEST(ResidualOnCones, CountsOldFriction) {
  for (const auto& [press, mu] : {std::pair(0.0, 0.5), std::pair(2.0, 0.0)}) {
    System<3> s = points_on_a_slope(2, 0.3, 0.5, 0, 0.1);
    const FrictionContact& contact = s.contacts[1];
    s.contacts[1].mu = mu;
    s.begin_with(contact.normal, press);
    s.begin_with(contact.normal + 1, 30), s.begin_with(contact.normal + 2, -40);
    double others = 0;
    for (std::size_t k = 0; k < s.rows.size(); ++k) {
      if (k > contact.normal) continue;  // rows 0 to 3
      System<3> next = s;
      if (k == s.contacts[0].normal + 1)
        others = std::max(others, update_friction(s.contacts[0], next.rows, next.V));
      if (k == s.contacts[0].normal || k == contact.normal)
        others = std::max(others, next.rows[k].diagonal * std::abs(update_row(next.rows[k], next.V)));
    }
    const double s_of_pair = larger_eigenvalue(tangential_S(s, contact));
    expect_near(
        "residual of two contacts, of which one has λ_t of 50 N s, λ_n = " + show(press) +
            " N s and μ = " + show(mu) + " [m/s]",
        "Eq. (9.7)", residual_on_cones(s.contacts, s.rows, s.V), 50 * s_of_pair, roundings(1000, 100),
        {{others, press == 0
                      ? "The friction of a contact with λ_n = 0 has been left out. Its next update "
                        "removes all of λ_t, so this counts."
                      : "The friction of a contact with μ = 0 has been left out. Its next update removes "
                        "all of λ_t, so this counts."}},
        "s |Δλ_t|, with a cone of radius 0: all of λ_t.");
  }
}

EXERCISE_TEST(ResidualOnCones, IsWhatEachUpdateByItselfWouldChange) {
  Random random;
  for (int trial = 0; trial < 20 && !::testing::Test::HasFailure(); ++trial) {
    System<6> s = random_system(random, 4, 3, 1);
    for (std::size_t k = 0; k < s.rows.size(); ++k) s.begin_with(k, random.uniform(0.2, 0.6));
    // One of these has the largest residual.
    s.rows[std::vector<std::size_t>{5, 10, 12}[static_cast<std::size_t>(trial % 3)]].B += 20;
    double rows = 0, pairs = 0, components = 0, impulse = 0, pairs_of_next = 0;
    std::size_t contact = 0;
    for (std::size_t k = 0; k < s.rows.size(); ++k) {
      System<6> next = s;
      const double change = std::abs(update_row(next.rows[k], next.V));
      rows = std::max(rows, s.rows[k].diagonal * change);
      impulse = std::max(impulse, change);
      if (contact == s.contacts.size() || s.contacts[contact].normal != k) continue;
      next.V = s.V;
      pairs_of_next = std::max(pairs_of_next, update_friction(s.contacts[contact], next.rows, next.V));
      next = s;
      pairs = std::max(pairs, update_friction(s.contacts[contact], next.rows, next.V));
      const Vec2 moved = next.tangential(s.contacts[contact]) - s.tangential(s.contacts[contact]);
      impulse = std::max(impulse, moved.norm());
      components = std::max(
          components, larger_eigenvalue(tangential_S(s, s.contacts[contact])) * moved.cwiseAbs().maxCoeff());
      ++contact;
      k += 2;
    }
    System<6> on = s;
    const double next_sweep = sweep_on_cones(on.contacts, on.rows, on.V);
    expect_near(
        "residual of three contacts and four joints' rows [m/s]", "Eq. (9.7)",
        residual_on_cones(s.contacts, s.rows, s.V), std::max(rows, pairs), roundings(1000, 30),
        {{std::max(rows, components),
          "Friction is missing, or only one component of a pair is used. The length counts, s |Δλ_t|."},
         {rows, "Friction is missing: s |Δλ_t| of each pair counts, too."},
         {std::max(rows, pairs_of_next),
          "This uses the λ_n after an update of the normal row. A pair's limit is μ times the present λ_n."},
         {pairs, "The rows that are no friction rows are missing: Eq. (4.8)."},
         {impulse, "This is the largest |Δλ|, an impulse. Times S_kk, or s, it is a velocity."},
         {next_sweep,
          "This is the value that the next sweep returns, where each row uses the updates before it. For the "
          "residual compare all rows with the same λ and V."}},
        "Compare each row, or pair, with the same λ and V. Do not scatter, and return the largest.");
  }
}

EXERCISE_TEST(ResidualOnCones, TakesAnyBoundsOfTheOtherRows) {
  Random random;
  // The row with the largest residual is of each kind in turn, so an answer that leaves out a kind is noticed.
  Regions regions({"the row with the largest residual is between its bounds",
                   "the row with the largest residual is at its "
                   "lower bound",
                   "the row with the largest residual is at its upper bound",
                   "the row with the largest residual is out of "
                   "its bounds",
                   "the row with the largest residual goes to a lower bound above 0", "friction lacks most",
                   "of a hundred rows one of the last has the largest residual"});
  while (regions.lack_draws()) {
    const System<6> s = system_with_bounds(random, random.integer(0, 3) ? 3 : many / 4);
    double of_first = 0;
    double rows = 0, pairs = 0;
    Row<6> most{};
    double next_of_most = 0;
    for (std::size_t k = 0, contact = 0; k < s.rows.size(); ++k) {
      if (k < 2 * many / 3) of_first = std::max(rows, pairs);
      System<6> next = s;
      const double lacks = s.rows[k].diagonal * std::abs(update_row(next.rows[k], next.V));
      if (lacks > rows) most = s.rows[k], next_of_most = next.rows[k].lambda;
      rows = std::max(rows, lacks);
      if (contact == s.contacts.size() || s.contacts[contact].normal != k) continue;
      next = s;
      pairs = std::max(pairs, update_friction(s.contacts[contact++], next.rows, next.V));
      k += 2;
    }
    const bool is_row = rows > pairs;
    const double at = most.lambda;
    regions.draw(
        {{"the row with the largest residual is between its bounds", is_row && most.lo < at && at < most.hi},
         {"the row with the largest residual is at its lower bound", is_row && at == most.lo},
         {"the row with the largest residual is at its upper bound", is_row && at == most.hi},
         {"the row with the largest residual is out of its bounds", is_row && (at < most.lo || at > most.hi)},
         {"the row with the largest residual goes to a lower bound above 0",
          is_row && most.lo > 0 && next_of_most == most.lo},
         {"friction lacks most", !is_row},
         {"of a hundred rows one of the last has the largest residual",
          s.rows.size() > many && of_first < std::max(rows, pairs)}});
    expect_near("residual of " + std::to_string(s.contacts.size()) +
                    " contacts and rows with bounds of all kinds between them [m/s]",
                "Eq. (4.8), (9.7)", residual_on_cones(s.contacts, s.rows, s.V), std::max(rows, pairs),
                roundings(1000, 30), {},
                any_row + " Of " + std::to_string(s.rows.size()) + " rows the last counts like the first.");
  }
}

EXERCISE_TEST(ResidualOnCones, WithoutContactsEqualsResidual) {
  Random random;
  System<6> s = random_bodies(random, 3);
  for (int k = 0; k < 6; ++k) add_random_joint(s, random);
  expect_near("residual of six joints' rows [m/s]", "Eq. (4.8), (9.7)",
              residual_on_cones(s.contacts, s.rows, s.V), residual(s.rows, s.V), roundings(1000, 5), {},
              "Without contacts, every row by Eq. (4.8).");
}

EXERCISE_TEST(ResidualOnCones, DropsNothingSmall) {
  for (const double part : relative_scales)
    for (const CancellationCase& of : cancellation_cases(part)) {
      expect_near("residual of a row with " + of.text + " [m/s]", "Eq. (9.7)",
                  residual_on_cones<3>({}, {of.row}, of.V), std::abs(of.lacks), roundings(8), {},
                  small_is_dropped);
      if (::testing::Test::HasFailure()) return;
    }
}

EXERCISE_TEST(ResidualOnCones, SeesFrictionThatHasTheWrongDirection) {
  System<3> s = points_on_a_slope(1, 0, 0.5, 0, 0.1);
  s.begin_with(0, s.rows[0].B);
  const double limit = 0.5 * s.rows[0].lambda;
  s.rows[1].B = -10;  // it slides along t1
  for (const Vec2& direction : {Vec2(-1, 0), Vec2(1, 0), Vec2(0, 1)}) {
    s.begin_with(1, limit * direction.x());
    s.begin_with(2, limit * direction.y());
    expect_near("residual of a point that slides along t1, friction of full strength along (" +
                    show(direction.x()) + ", " + show(direction.y()) + ") [m/s]",
                "Eq. (9.7)", residual_on_cones(s.contacts, s.rows, s.V),
                limit * (direction - Vec2(-1, 0)).norm(), roundings(32, 10),
                {{0,
                  "The length μ λ_n is not enough: take the difference of the two vectors, not of their "
                  "lengths."}},
                "s = 1/kg times the distance to μ λ_n against the slip.");
  }
}

EXERCISE_TEST(ResidualOnCones, OfNothingIsZeroAndOfNaNIsNaN) {
  System<3> none;
  expect_near("residual of no rows [m/s]", "Eq. (9.7)", residual_on_cones(none.contacts, none.rows, none.V), 0,
              {0, "exact"});
  for (const std::size_t broken : {0u, 2u, 3u, 4u}) {
    System<3> s = points_on_a_slope(3, 0.3, 0.5, 0, 0.1);
    s.rows[broken].B = std::nan("");
    expect_true(
        "a NaN in row " + std::to_string(broken) + " of 9 makes the residual NaN", "Eq. (9.7)",
        std::isnan(residual_on_cones(s.contacts, s.rows, s.V)),
        "The NaN was lost. std::max(a, NaN) is a. Once the maximum is NaN, no later row may replace it.");
  }
}

}  // namespace
