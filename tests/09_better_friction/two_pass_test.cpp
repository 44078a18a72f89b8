// Friction limits from normal impulses: set, and used in two passes.
#include "exercise_test.hpp"
#include "friction_systems.hpp"
#include "random_input.hpp"
#include "stop_rule.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(LimitFriction, "9.2 limit_friction");
EXERCISE(TwoPassSolve, "9.3 two_pass_solve");

EXERCISE_TEST(LimitFriction, IsMuTimesWhatPresses) {
  System<3> s = points_on_a_slope(1, 0, 0.25, 0, 0.1);
  s.rows[0].lambda = 8;
  for (const std::size_t k : {1u, 2u}) {
    s.rows[k].lo = -77;
    s.rows[k].hi = 77;
  }
  limit_friction(s.contacts, s.rows);
  for (const std::size_t k : {1u, 2u}) {
    const std::string row = " of the row along t" + std::to_string(k) + ", μ = 0.25, λ_n = 8 N s [N s]";
    const std::string untouched = "It still has the old bound. Set new bounds in both friction rows.";
    expect_near("upper bound" + row, "Eq. (9.1)", s.rows[k].hi, 2, roundings(2, 2),
                {{77, untouched},
                 {8, "μ is missing."},
                 {1, "Each row gets all of μ λ_n. Do not divide it between t1 and t2."},
                 {2 / std::numbers::sqrt2, "Each row gets all of μ λ_n. (This box would fit into the disc.)"},
                 {32, "This is λ_n/μ."}});
    expect_near("lower bound" + row, "Eq. (9.1)", s.rows[k].lo, -2, roundings(2, 2),
                {{-77, untouched},
                 {0, "Friction acts both ways along t: the lower bound is -Λ."},
                 {2, "The lower bound is -Λ."},
                 {-8, "μ is missing."}});
  }
}

EXERCISE_TEST(LimitFriction, TakesEachContactsOwnNormalAndMu) {
  Random random;
  for (const int contacts : {3, many}) {
    System<6> s = random_system(random, 4, contacts, 1);
    for (Row<6>& row : s.rows) row.lambda = random.uniform(0.5, 3), row.hi = 77, row.lo = -77;
    const auto before = s.rows;
    limit_friction(s.contacts, s.rows);
    for (const FrictionContact& contact : s.contacts)
      for (const std::size_t k : {contact.normal + 1, contact.normal + 2}) {
        const double press = before[contact.normal].lambda, expected = contact.mu * press;
        const std::string row = "row " + std::to_string(k) + ", of " + std::to_string(contacts) + " contacts";
        expect_near(
            "upper bound of " + row + " [N s]", "Eq. (9.1)", s.rows[k].hi, expected, roundings(4, 3),
            {{77, "It still has the old bound. " + ends_early},
             {s.contacts[0].mu * press, "This uses the μ of the first contact. Each contact has its own."},
             {contact.mu * before[0].lambda,
              "This uses row 0's λ. contact.normal is the index of the normal "
              "row."}},
            "μ of this contact times λ of its own normal row, rows[contact.normal]. Other rows may stand "
            "between.");
        expect_near("lower bound of " + row + " [N s]", "Eq. (9.1)", s.rows[k].lo, -expected, roundings(4, 3),
                    {{-77, "It still has the old bound. " + ends_early}}, "Minus the upper one.");
        if (::testing::Test::HasFailure()) return;
      }
  }
}

EXERCISE_TEST(LimitFriction, ReplacesOldBounds) {
  for (const double old : {0.0, 1e-3, 100.0}) {
    System<3> s = points_on_a_slope(1, 0, 0.5, 0, 0.1);
    for (const std::size_t k : {1u, 2u}) {
      s.rows[k].hi = old;
      s.rows[k].lo = -old;
    }
    s.rows[0].lambda = 4;
    limit_friction(s.contacts, s.rows);
    const std::string clue = "The old bounds do not matter: the new ones may be wider or narrower.";
    expect_near("upper bound, ±" + show(old) + " before, μ = 0.5, λ_n = 4 N s [N s]", "Eq. (9.1)", s.rows[1].hi,
                2, roundings(2, 2), {{old, clue}}, clue);
    expect_near("lower bound, ±" + show(old) + " before, μ = 0.5, λ_n = 4 N s [N s]", "Eq. (9.1)", s.rows[2].lo,
                -2, roundings(2, 2), {{-old, clue}}, clue);
  }
}

EXERCISE_TEST(LimitFriction, SetsZeroBoundsWithoutPressureOrFriction) {
  for (const auto& [mu, press] : {std::pair(0.0, 3.0), std::pair(0.7, 0.0)}) {
    System<3> s = points_on_a_slope(1, 0, mu, 0, 0.1);
    s.rows[0].lambda = press;
    limit_friction(s.contacts, s.rows);
    expect_near("upper bound for μ = " + show(mu) + ", λ_n = " + show(press) + " N s [N s]", "Eq. (9.1)",
                s.rows[2].hi, 0, {0, "exact"}, {}, "With μ = 0, or λ_n = 0, there is no friction.");
    expect_near("lower bound for μ = " + show(mu) + ", λ_n = " + show(press) + " N s [N s]", "Eq. (9.1)",
                s.rows[2].lo, 0, {0, "exact"}, {}, "With μ = 0, or λ_n = 0, there is no friction.");
  }
}

EXERCISE_TEST(LimitFriction, KeepsANaN) {
  System<3> s = points_on_a_slope(2, 0, 0.5, 0, 0.1);
  const double nan = std::nan("");
  s.rows[s.contacts[0].normal].lambda = 4;
  s.rows[s.contacts[1].normal].lambda = nan;
  limit_friction(s.contacts, s.rows);
  for (const std::size_t k : {s.contacts[1].normal + 1, s.contacts[1].normal + 2})
    expect_true("bounds of row " + std::to_string(k) + " where λ_n is NaN: here from " + show(s.rows[k].lo) +
                    " to " + show(s.rows[k].hi) + " N s, and to be NaN",
                "Eq. (9.1)", std::isnan(s.rows[k].lo) && std::isnan(s.rows[k].hi),
                "The NaN was lost: std::max(0.0, NaN) is 0, and a comparison with NaN is false. An error would "
                "silently "
                "remove the friction.");
  expect_near("upper bound beside it, μ = 0.5, λ_n = 4 N s [N s]", "Eq. (9.1)",
              s.rows[s.contacts[0].normal + 1].hi, 2, roundings(2, 2), {}, "The other contact has no NaN.");
}

EXERCISE_TEST(LimitFriction, ChangesNothingElse) {
  Random random;
  System<6> s = random_system(random, 3, 2, 1);
  for (Row<6>& row : s.rows) row.lambda = random.uniform(1, 3);
  const auto before = s.rows;
  limit_friction(s.contacts, s.rows);
  for (std::size_t k = 0; k < before.size(); ++k)
    expect_near("λ of row " + std::to_string(k) + " [N s]", "Eq. (9.1)", s.rows[k].lambda, before[k].lambda,
                {0, "untouched"}, {},
                "Do not change a λ outside its new bounds. Its next update projects it, and corrects V.");
  for (std::size_t k = 0; k < before.size(); k += 4)  // the joint, and with it the normal row after it
    for (std::size_t other = k; other < std::min(k + 2, before.size()); ++other)
      expect_true("row " + std::to_string(other) + ", no friction row, has the bounds it had", "Eq. (9.1)",
                  s.rows[other].lo == before[other].lo && s.rows[other].hi == before[other].hi,
                  "Only rows normal + 1 and normal + 2 get new bounds.");
}

/// Returns the speeds of the slowest and the fastest point after the step [m/s].
std::pair<double, double> speeds(const System<3>& s) {
  double slowest = infinity, fastest = 0;
  for (std::size_t k = 1; k < s.V.size(); ++k) {
    const double speed = s.velocity(k).norm();
    if (!(speed >= slowest)) slowest = speed;
    if (!(speed <= fastest)) fastest = speed;
  }
  return {slowest, fastest};
}

EXERCISE_TEST(TwoPassSolve, HoldsAStackFromTanThetaOn) {
  Random random;
  for (int n = 1; n <= 6; ++n) {
    const double slope = random.uniform(0.1, 1), h = 0.01;
    const std::string stack =
        std::to_string(n) + " points, one on the other, on a slope of " + show(slope) + " rad";
    for (const double times : {1.001, 0.9}) {
      const double mu = times * std::tan(slope);
      System<3> s = points_on_a_slope(n, slope, mu, 0, h);
      two_pass_solve(s.contacts, s.rows, s.V, {.max_sweeps = 20000, .tolerance = 1e-13});
      const auto [slowest, fastest] = speeds(s);
      if (times > 1)
        expect_at_most("speed of the fastest of " + stack + ", μ = 1.001 tan θ [m/s]", "Eq. (9.1)", fastest,
                       1e-10, "0: they stick; the tolerance, 1e-13, times the condition of their S",
                       "The lowest contact carries them all, and its limit is μ times that impulse. Does the "
                       "limit belong to another time, or to another contact?");
      else
        expect_near("speed of the slowest of " + stack + ", μ = 0.9 tan θ [m/s]", "Eq. (9.1)", slowest,
                    0.1 * h * g * std::sin(slope), {1e-10, "the tolerance times the condition of their S"},
                    {{0, "It sticks, although μ λ_n is too small. Is the friction bounded?"},
                     {h * g * std::sin(slope), "There is no friction. Did the second pass use the limits?"}},
                    "It slides with h (g sin θ - μ g cos θ).");
    }
  }
}

// Each of two walls presses with an impulse P in a step. Gravity has no component along the walls' normals, so with
// chapter 05's box the block would fall.
EXERCISE_TEST(TwoPassSolve, HoldsABlockBetweenTwoWalls) {
  const double h = 0.01, P = 0.3, Sigma = 0.5;
  for (const double times : {1.001, 0.8}) {
    const double mu = times * h * g / (2 * P);
    System<3> s;
    const Vec3 zero = Vec3::Zero(), up = Vec3::UnitZ();
    add_body<3>(s, {});
    add_body<3>(s, {.linear = 1}, zero, -h * g * up);
    for (const Vec3& n : {Vec3(1, 0, 0), Vec3(-1, 0, 0)}) {
      add_contact(s, {.i = 0, .j = 1, .n = n, .gap = 0, .r_i = zero, .r_j = zero}, {up, n.cross(up)}, mu,
                  Sigma);
      s.rows[s.contacts.back().normal].B = Sigma * P;  // as deep in the wall as that takes
    }
    two_pass_solve(s.contacts, s.rows, s.V, {.max_sweeps = 1000, .tolerance = 1e-14});
    expect_near(
        "velocity of a block of 1 kg between two walls, upwards, μ = " + show(times) + " h g/(2P) [m/s]",
        "Eq. (9.1)", s.velocity(1).z(), std::min(0.0, (times - 1) * h * g), {1e-12, "the tolerance"},
        {{-h * g, "It falls freely: friction ignores the wall forces."}},
        "Two contacts hold 2 μ P. The limit comes from the normal impulse, not from gravity.");
  }
}

EXERCISE_TEST(TwoPassSolve, LimitsFrictionByTheFirstPass) {
  const double mu = 0.5, fall = 0.16, slip = -3;
  System<6> s = leaning_rod(mu, slip, fall), rough = s;
  two_pass_solve(s.contacts, s.rows, s.V, {.max_sweeps = 1000, .tolerance = 1e-14});
  for (const std::size_t k : {std::size_t{1}, std::size_t{2}})
    rough.rows[k].lo = -infinity, rough.rows[k].hi = infinity;
  solve(rough.rows, rough.V, {.max_sweeps = 1000, .tolerance = 1e-14});  // sticks
  const double without = fall / rod_Knn;                                 // λ_n of the first pass
  const double cone = fall / (rod_Knn + mu * rod_Knx);                   // of both together, Eq. (7.5)
  expect_near(
      "friction of a rod that slides, its end ahead, μ = 0.5 [N s]", "Eq. (9.1)", s.rows[1].lambda,
      mu * without, roundings(64),
      {{mu * cone,
        "This is Coulomb's cone, with the normal impulse at the end. The two-pass limit is μ times "
        "the normal impulse of the first pass, without friction."},
       {mu * rough.rows[0].lambda,
        "Your first pass has friction. Before it, set bounds and λ of all friction rows to 0, loaded or not."},
       {0, "There is no friction. Its bounds come from the first pass, and then a second one uses them."},
       {-slip / (1 + 3 * 0.8), "This has no limit: it stops the slip."}},
      "Limits are set once, after the first pass, from its normal impulses.");
  expect_near("λ_n of the rod after the second pass [N s]", "Eq. (9.1)", s.rows[0].lambda,
              without * (1 - mu * rod_Knx / rod_Knn), roundings(64),
              {{without, "This is the first pass's. The second pass sweeps the normal rows, too."}});
}

/// Known mistakes of the start of two passes.
enum class Start {
  right,
  all_rows_at_0,
  friction_left_to_its_bounds,
  friction_left_in_V,
  friction_left_on_ice
};

/// Performs the two passes. Returns the number of sweeps of the first.
template <int Dof>
std::size_t by_hand(System<Dof>& s, const StopRule& stop, std::vector<double>* history = nullptr,
                    Start start = Start::right) {
  if (start == Start::all_rows_at_0)
    for (std::size_t k = 0; k < s.rows.size(); ++k) s.begin_with(k, 0);
  for (const FrictionContact& contact : s.contacts)
    for (const std::size_t k : {contact.normal + 1, contact.normal + 2}) {
      if (start == Start::friction_left_on_ice && contact.mu == 0) continue;
      if (start == Start::friction_left_in_V) s.rows[k].lambda = 0;
      if (start != Start::friction_left_to_its_bounds) s.begin_with(k, 0);
      s.rows[k].lo = s.rows[k].hi = 0;
    }
  const SolveReport first = solve(s.rows, s.V, stop);
  for (const FrictionContact& contact : s.contacts)
    for (const std::size_t k : {contact.normal + 1, contact.normal + 2}) {
      s.rows[k].hi = contact.mu * s.rows[contact.normal].lambda;
      s.rows[k].lo = -s.rows[k].hi;
    }
  const SolveReport second = solve(s.rows, s.V, stop);
  if (history) {
    *history = first.history;
    history->insert(history->end(), second.history.begin(), second.history.end());
  }
  return first.history.size();
}

EXERCISE_TEST(TwoPassSolve, IsTwoSolvesOneAfterTheOther) {
  Random random;
  for (int trial = 0; trial < 20 && !::testing::Test::HasFailure(); ++trial) {
    const int contacts = trial == 1 ? many : 3;
    System<6> s = random_system(random, 4, contacts, 1);
    const bool warm = trial % 2, stops_early = trial % 4 > 1;
    if (warm)
      for (std::size_t k = 0; k < s.rows.size(); ++k) s.begin_with(k, random.uniform(0.2, 1));
    System<6> expected = s;
    const StopRule stop = stops_early ? StopRule{.max_sweeps = 2000, .tolerance = 1e-2}
                                      : StopRule{.max_sweeps = 7, .tolerance = 1e-12};
    given() = "given " + std::to_string(contacts) + " contacts and a joint's row between any two, λ " +
              std::string(warm ? "of before in all rows, friction too" : "= 0") + "; at most " +
              std::to_string(stop.max_sweeps) + " sweeps a pass, to " + show(stop.tolerance) + " m/s";
    const auto with = [&, before = s](Start start) {
      System<6> by = before;
      by_hand(by, stop, nullptr, start);
      return all_lambda(by.rows);
    };
    const SolveReport report = two_pass_solve(s.contacts, s.rows, s.V, stop);
    std::vector<double> history;
    const std::size_t first_pass = by_hand(expected, stop, &history);
    // If all λ begin at 0, these mistakes have no effect.
    if (warm)
      expect_near_vector("λ after two passes [N s]", "Eq. (9.1)", all_lambda(s.rows), all_lambda(expected.rows),
                         roundings(1e4, 5),
                         {{with(Start::all_rows_at_0),
                           "All rows began at 0. Only the friction rows do: all other rows keep their λ on "
                           "entry."},
                          {with(Start::friction_left_to_its_bounds),
                           "The old friction was removed only by its bounds of 0, so the first rows of the "
                           "sweep still used it. Set λ to 0 before the sweep."},
                          {with(Start::friction_left_in_V),
                           "The old friction was removed from λ, but not from V. Subtract it from V, too."}},
                         contacts == many ? ends_early : "Set friction to 0; solve; set limits; solve.");
    const std::size_t entries = report.history.size();
    expect_true("two passes leave " + std::to_string(history.size()) + " entries in the history, and not " +
                    std::to_string(entries),
                "Eq. (9.1), (4.9)", entries == history.size(),
                "Each pass has the whole stop rule, and the history has both, the first pass's first.");
    if (entries != history.size()) return;
    for (std::size_t k = 0; k < history.size() && !::testing::Test::HasFailure(); ++k)
      expect_near("entry " + std::to_string(k) + " of the history [m/s]", "Eq. (9.1), (4.9)", report.history[k],
                  history[k], roundings(1e4, 1 + history[k]), {},
                  k < first_pass
                      ? "It is of the first pass, which is solve() with bounds of 0 for friction rows."
                      : "It is of the second pass, which goes on where the first ended: λ and V stay.");
    expect_near_vector(
        "λ after two passes [N s]", "Eq. (9.1)", all_lambda(s.rows), all_lambda(expected.rows),
        roundings(1e4, 5), {},
        "Set friction to 0; solve; set limits; solve. Joints and normal rows are in both passes.");
  }
}

EXERCISE_TEST(TwoPassSolve, TakesOldFrictionOutOfTheVelocitiesToo) {
  Random random;
  for (int trial = 0; trial < 10 && !::testing::Test::HasFailure(); ++trial) {
    System<6> s = random_system(random, 3, 2, 1);
    for (std::size_t k = 0; k < s.rows.size(); ++k) s.begin_with(k, random.uniform(0.2, 2));
    two_pass_solve(s.contacts, s.rows, s.V, {.max_sweeps = 5, .tolerance = 0});
    expect_near_vector("V, when friction rows brought in impulses of their own", "Eq. (4.5)", all_V(s.V),
                       V_of_lambda(s.rows, s.V.size()), roundings(1000, 20), {},
                       "V is M⁻¹ Gᵀ λ at all times. Before you set a λ to 0, remove it from V: "
                       "apply_impulse(row, -row.lambda, V).");
  }
}

// μ = 0 at one of two contacts, and old friction at both.
EXERCISE_TEST(TwoPassSolve, RemovesOldFrictionWhereMuIsZero) {
  Random random;
  for (int trial = 0; trial < 10 && !::testing::Test::HasFailure(); ++trial) {
    System<6> s = random_system(random, 3, 2, 1);
    const std::size_t ice = trial % 2;
    s.contacts[ice].mu = 0;
    for (std::size_t k = 0; k < s.rows.size(); ++k) s.begin_with(k, random.uniform(0.2, 2));
    const StopRule stop{.max_sweeps = 5, .tolerance = 0};
    System<6> expected = s, kept = s;
    const Vec2 old = s.tangential(s.contacts[ice]);
    by_hand(expected, stop);
    by_hand(kept, stop, nullptr, Start::friction_left_on_ice);
    two_pass_solve(s.contacts, s.rows, s.V, stop);
    const std::string stays = "The old friction stays where μ = 0. Remove it from λ and V at every contact.";
    expect_near_vector("λ_t of a contact with μ = 0, two passes after it was " + show(old) + " [N s]",
                       "Eq. (9.1)", s.tangential(s.contacts[ice]), Vec2::Zero(), {0, "exact"},
                       {{old, stays}, {kept.tangential(s.contacts[ice]), stays}},
                       "With μ = 0 there is no friction, for any λ on entry.");
    expect_near_vector("λ after two passes, μ = 0 at one of two contacts [N s]", "Eq. (9.1)",
                       all_lambda(s.rows), all_lambda(expected.rows), roundings(1e4, 5),
                       {{all_lambda(kept.rows), stays}},
                       "Set friction to 0, also at μ = 0; solve; set limits; solve.");
  }
}

// The first pass of a contact alone is one row: it is done in two sweeps. The second is slower, Eq. (9.8).
EXERCISE_TEST(TwoPassSolve, HasConvergedWhenTheSecondPassHas) {
  System<6> s = leaning_rod(2, -0.01, 0.5);
  const SolveReport report = two_pass_solve(s.contacts, s.rows, s.V, {.max_sweeps = 3, .tolerance = 1e-12});
  expect_true(
      "`converged` is false: the first pass converged in 2 sweeps, the second did not in 3", "Eq. (4.9)",
      !report.converged && report.history.size() == 5,
      "`converged` belongs to the second pass, whose result is the answer. Each pass has its own stop.");

  // A stack is solved at a rate; what 60 sweeps leave is above the tolerance, what 120 leave below it.
  System<3> stack = points_on_a_slope(5, 0.2, 0, 0, 0.01);
  std::vector<double> history;
  System<3> counted = stack;
  by_hand(counted, {.max_sweeps = 120, .tolerance = 0}, &history);
  const double tolerance = history[90];
  const SolveReport later =
      two_pass_solve(stack.contacts, stack.rows, stack.V, {.max_sweeps = 60, .tolerance = tolerance});
  expect_true("a first pass that did not converge and a second that did have converged", "Eq. (4.9)",
              later.converged && later.history.size() < 120,
              later.history.size() <= 60
                  ? "There is only one pass here. Make two for any μ, 0 as well: the second goes on where the "
                    "first ended."
                  : "The second pass goes on where the first ended, and only its own end decides `converged`.");
}

EXERCISE_TEST(TwoPassSolve, RefusesABadStopRule) {
  System<3> s = points_on_a_slope(1, 0.1, 0.5, 0, 0.1), none;
  for (std::size_t k = 0; k < s.rows.size(); ++k) {
    s.rows[k].lambda = 0.1 * static_cast<double>(k + 1);
    apply_impulse(s.rows[k], s.rows[k].lambda, s.V);
  }
  const auto state = state_of(s.rows, s.V);
  const std::string late =
      "Check the rule first: when solve throws, the friction rows have been changed "
      "already.";
  expect_rejects(
      "a rule of no sweeps", "max_sweeps",
      [&] { two_pass_solve(s.contacts, s.rows, s.V, {.max_sweeps = 0, .tolerance = 0}); }, late, state);
  expect_rejects(
      "a negative tolerance", "tolerance",
      [&] { two_pass_solve(s.contacts, s.rows, s.V, {.max_sweeps = 5, .tolerance = -1}); }, late, state);
  expect_rejects("a rule of no sweeps, without rows", "max_sweeps",
                 [&] { two_pass_solve(none.contacts, none.rows, none.V, {.max_sweeps = 0, .tolerance = 0}); });
  const SolveReport report =
      two_pass_solve(none.contacts, none.rows, none.V, {.max_sweeps = 5, .tolerance = 0});
  expect_true("two passes over no rows have converged without a sweep", "Eq. (4.9)",
              report.converged && report.history.empty());
}

}  // namespace
