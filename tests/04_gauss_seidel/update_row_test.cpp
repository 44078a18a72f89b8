// The update of one row: solve, project, scatter.
#include "cancellation.hpp"
#include "exercise_test.hpp"
#include "problems.hpp"
#include "regions.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(UpdateRow, "4.3 update_row");

// A floor and one body, with numbers for a calculation by hand: S_kk = 1/m + Σ = 0.5, B as given.
Row<3> by_hand(double B, double lambda) {
  const Twist<3> up(0, 0, 1);
  return {.i = 0,
          .j = 1,
          .Gi = -up,
          .Gj = up,
          .MinvGi = Twist<3>::Zero(),
          .MinvGj = 0.25 * up,
          .B = B,
          .Sigma = 0.25,
          .diagonal = 0.5,
          .lo = 0,
          .hi = infinity,
          .lambda = lambda};
}

EXERCISE_TEST(UpdateRow, SolvesOneRowInOneUpdate) {
  Row<3> row = by_hand(3, 0);
  std::vector<Twist<3>> V(2, Twist<3>::Zero());
  const double delta = update_row(row, V);
  expect_near("λ = B/S_kk = 3/0.5, from zero [N s]", "Eq. (4.7)", row.lambda, 6, roundings(8, 6),
              {{12, "This is B/(G M⁻¹ Gᵀ): Σ has been left out of the diagonal."},
               {4, "Σ has been added to the diagonal once more: S_kk contains it already."},
               {1.5, "This is B S_kk: divide by the diagonal."},
               {0, "The row's λ has not been stored."},
               {-6, "The sign: a positive residual r = B - G V - Σ λ needs a positive Δλ."}});
  expect_near("the returned change Δλ [N s]", "Eq. (4.7)", delta, 6, roundings(8, 6));
  expect_near("velocity change of the body, Δλ/m = 6/4 [m/s]", "Eq. (4.5)", V[1].z(), 1.5, roundings(8, 6),
              {{0, "Nothing was scattered, so the next row uses an old V."}});
}

EXERCISE_TEST(UpdateRow, CountsSigmaLambdaAndTheVelocitySoFar) {
  // λ = 2 so far, with its velocity 2/4 = 0.5 in V, and 0.25 m/s from another row.
  Row<3> row = by_hand(3, 2);
  std::vector<Twist<3>> V{Twist<3>::Zero(), Twist<3>(0, 0, 0.5 + 0.25)};
  update_row(row, V);
  // r = 3 - 0.75 - 0.25*2 = 1.75, Δλ = 3.5
  expect_near(
      "λ, from 2 N s and a body that moves already [N s]", "Eq. (4.6), (4.7)", row.lambda, 5.5,
      roundings(16, 6),
      {{2 + 2.25 / 0.5, "Σ λ is missing in the residual: r = B - G V - Σ λ."},
       {2 + 2.5 / 0.5, "G V is missing in the residual: r = B - G V - Σ λ."},
       {3.5, "This is Δλ alone: add it to the λ so far."},
       {2 + 3 / 0.5, "This is λ + B/S_kk: B is the residual at the start, not the present one."},
       {2 + 3.25 / 0.5, "The sign of G V: the velocity that the body already has is subtracted from B."}});
}

EXERCISE_TEST(UpdateRow, GathersFromBothBodies) {
  Random random;
  Problem<6> p = random_problem(random, 2, 1);
  Row<6>& row = p.rows[0];
  row.B = 10;
  row.lo = -infinity;
  for (auto& V : p.V) V = random.twist();
  const auto Vi = p.V[static_cast<std::size_t>(row.i)], Vj = p.V[static_cast<std::size_t>(row.j)];
  const double GiV = row.Gi.dot(Vi), GjV = row.Gj.dot(Vj);
  update_row(row, p.V);
  expect_near("λ of a row between two moving rigid bodies [N s]", "Eq. (4.6)", row.lambda,
              (10 - GiV - GjV) / row.diagonal, roundings(64, 20),
              {{(10 - GiV) / row.diagonal, "Body j's velocity has not been gathered."},
               {(10 - GjV) / row.diagonal, "Body i's velocity has not been gathered."},
               {(10 + GiV - GjV) / row.diagonal, "The sign of body i is in Gi already: Gi·V_i + Gj·V_j."},
               {(10 - row.MinvGi.dot(Vi) - row.MinvGj.dot(Vj)) / row.diagonal,
                "Gather with G, scatter with M⁻¹Gᵀ: the gather used M⁻¹G."}});
}

EXERCISE_TEST(UpdateRow, LeavesAResidualOfZero) {
  Random random;
  Problem<6> p = random_problem(random, 3, 6);
  for (Row<6>& row : p.rows) {
    row.lo = -infinity;
    update_row(row, p.V);
    const double lacks = row.B - row.Gi.dot(p.V[static_cast<std::size_t>(row.i)]) -
                         row.Gj.dot(p.V[static_cast<std::size_t>(row.j)]) - row.Sigma * row.lambda;
    expect_near(
        "residual of a row without bounds right after its update [m/s]", "Eq. (4.6)", lacks, 0,
        roundings(200, 5), {},
        "One update solves its own row exactly. If it does not, the change that was scattered is not the "
        "change that was stored, or the diagonal is not the row's own.");
  }
}

EXERCISE_TEST(UpdateRow, NeverPulls) {
  Row<3> row = by_hand(-3, 0);
  std::vector<Twist<3>> V(2, Twist<3>::Zero());
  const double delta = update_row(row, V);
  expect_near("λ of a contact that comes apart, B = -3 m/s [N s]", "Eq. (4.7)", row.lambda, 0, {0, "exact"},
              {{-6, "A negative λ pulls. Project it: a contact's λ may not leave [lo, hi]."},
               {6, "This is the absolute value: it pushes bodies that separate. Project to 0 instead."}});
  expect_near("the returned change Δλ [N s]", "Eq. (4.7)", delta, 0, {0, "exact"},
              {{-6, "Return the change after projection, not before."}});
  expect_near(
      "velocity change of the body [m/s]", "Eq. (4.7)", V[1].z(), 0, {0, "exact"},
      {{-1.5, "The unprojected change was scattered. Project first, then scatter the change that remains."}});
}

EXERCISE_TEST(UpdateRow, ImpulseMayShrinkAgain) {
  // λ = 6 so far, but another row has lifted the body by 1 m/s: r = 3 - 2.5 - 1.5 = -1, Δλ = -2.
  Row<3> row = by_hand(3, 6);
  std::vector<Twist<3>> V{Twist<3>::Zero(), Twist<3>(0, 0, 1.5 + 1)};
  const double delta = update_row(row, V);
  expect_near("λ of a contact that needs less than it has [N s]", "Eq. (4.7)", row.lambda, 4, roundings(16, 6),
              {{6, "The change was clamped instead of the impulse: Δλ may be negative, λ may not."},
               {0, "λ was set to zero because Δλ is negative: only a negative λ is projected."}});
  expect_near("the returned change Δλ [N s]", "Eq. (4.7)", delta, -2, roundings(16, 6),
              {{2, "Return the change with its sign."}, {4, "This is λ: return what changed, λ new - λ old."}});
  expect_near("velocity of the body, 2.5 - 2/4 [m/s]", "Eq. (4.5)", V[1].z(), 2, roundings(16, 6),
              {{3.5, "All of λ was scattered, not its change."}});
}

EXERCISE_TEST(UpdateRow, StopsAtZeroOnItsWayDown) {
  // λ = 2 so far; r = 3 - 10.5 - 0.5 = -8 asks for Δλ = -16, but there are only 2 to give back.
  Row<3> row = by_hand(3, 2);
  std::vector<Twist<3>> V{Twist<3>::Zero(), Twist<3>(0, 0, 10.5)};
  const double delta = update_row(row, V);
  expect_near("λ, projected on its way down [N s]", "Eq. (4.7)", row.lambda, 0, {0, "exact"});
  expect_near("the returned change Δλ [N s]", "Eq. (4.7)", delta, -2, roundings(8, 2),
              {{-16, "Return, and scatter, the change after projection: λ_new - λ_old."},
               {0, "λ fell from 2 to 0: that is a change of -2."}});
  expect_near("velocity of the body [m/s]", "Eq. (4.7)", V[1].z(), 10.5 - 0.5, roundings(16, 10),
              {{10.5 - 4, "The unprojected change was scattered: project first."}});
}

EXERCISE_TEST(UpdateRow, StaysOffABoundThatIsNear) {
  for (const double part : relative_scales)
    for (const double side : {-1.0, 1.0}) {
      Row<3> row = by_hand(3 * (1 + side * part), 0);
      row.lo = side < 0 ? 0 : 6;
      row.hi = side < 0 ? 6 : infinity;
      std::vector<Twist<3>> V(2, Twist<3>::Zero());
      update_row(row, V);
      expect_near("λ minus its bound of 6 N s; it should be " + show(side * part) + " of the bound [N s]",
                  "Eq. (4.7)", row.lambda - 6, 6 * side * part, roundings(4, 6),
                  {{0, "λ was set to the bound. If it is only close to the bound, leave it where it is."}},
                  small_is_dropped);
      if (::testing::Test::HasFailure()) return;
    }
}

EXERCISE_TEST(UpdateRow, KeepsBothBounds) {
  for (const double B : {-30.0, 0.5, 30.0}) {
    Row<3> row = by_hand(B, 0);
    row.lo = -2;
    row.hi = 5;
    std::vector<Twist<3>> V(2, Twist<3>::Zero());
    update_row(row, V);
    const double expected = B < 0 ? -2 : B > 1 ? 5 : 1;
    expect_near("λ within [-2, 5], for B = " + show(B) + " [N s]", "Eq. (4.7)", row.lambda, expected,
                roundings(8, 5),
                {{0, "The lower bound is the row's own `lo`, not always zero."},
                 {60, "The upper bound, the row's own `hi`, has been left out."}});
  }
}

EXERCISE_TEST(UpdateRow, ProjectsEvenWithAResidualOfZero) {
  Row<3> row = by_hand(2, 4);  // λ = B/S_kk: r = 0, were it not for its bound
  row.hi = 3;
  std::vector<Twist<3>> V(2, Twist<3>::Zero());
  V[1].z() = 1;  // what λ = 4 N s does
  update_row(row, V);
  expect_near("λ of a row with residual 0 at λ = 4, and the upper bound 3 [N s]", "Eq. (4.7)", row.lambda, 3,
              {0, "exact"},
              {{4, "With a warm start a row with residual 0 may still be outside its bounds: project."}});
}

EXERCISE_TEST(UpdateRow, TakesAnyBoundsAndAnyStart) {
  Random random;
  Regions regions({"free", "held at lo", "held at hi", "held at hi = 0", "lo = hi", "λ begins below lo",
                   "λ begins above hi", "λ leaves lo", "λ leaves hi", "Δλ < 0"});
  while (regions.lack_draws()) {
    Problem<6> p = random_problem(random, 2, 1);
    Row<6>& row = p.rows[0];
    give_any_bounds(random, row);
    row.lambda = random.uniform(-0.5, 0.5);
    const double bound = random.integer(0, 1) ? row.lo : row.hi;
    if (std::isfinite(bound) && random.integer(0, 1)) row.lambda = bound;
    for (auto& V : p.V) V = random.twist(0.3);
    const Row<6> old = row;
    const std::vector<Twist<6>> before = p.V;
    const auto along = [&](const std::vector<Twist<6>>& V) {
      return old.Gi.dot(V[static_cast<std::size_t>(old.i)]) + old.Gj.dot(V[static_cast<std::size_t>(old.j)]);
    };
    const double wanted = old.lambda + (old.B - along(before) - old.Sigma * old.lambda) / old.diagonal;
    const double expected = std::min(old.hi, std::max(old.lo, wanted)), change = expected - old.lambda;
    regions.draw({{"free", old.lo < wanted && wanted < old.hi},
                  {"held at lo", wanted <= old.lo},
                  {"held at hi", wanted >= old.hi},
                  {"held at hi = 0", old.hi == 0 && wanted > 0},
                  {"lo = hi", old.lo == old.hi},
                  {"λ begins below lo", old.lambda < old.lo},
                  {"λ begins above hi", old.lambda > old.hi},
                  {"λ leaves lo", old.lambda == old.lo && expected > old.lo && old.lo != 0},
                  {"λ leaves hi", old.lambda == old.hi && expected < old.hi && old.hi != 0},
                  {"Δλ < 0", change < 0}});
    const double delta = update_row(row, p.V);
    const std::string bounds = "[" + show(old.lo) + ", " + show(old.hi) + "]";
    expect_near(
        "λ within " + bounds + ", from " + show(old.lambda) + " [N s]", "Eq. (4.6), (4.7)", row.lambda,
        expected, roundings(100, 5),
        {{wanted, "This has not been projected: use both of the row's bounds."},
         {old.lambda, old.lambda == old.lo || old.lambda == old.hi
                          ? "λ has stayed at its bound. If r points away from the bound, λ must leave it."
                          : "λ has not changed. A λ outside its bounds must be projected."},
         {std::max(0.0, wanted), "This was projected on a contact's bounds. The row has bounds of its own."}},
        "λ + r/S_kk, projected on [lo, hi], from any λ.");
    expect_near("the returned change Δλ [N s]", "Eq. (4.7)", delta, change, roundings(100, 5),
                {{std::abs(change), "Return the change with its sign."},
                 {expected - std::min(old.hi, std::max(old.lo, old.lambda)),
                  old.hi == 0 || old.lo == 0
                      ? "This is λ, or the change from the projected old λ. Return the change from the old λ "
                        "itself, inside its bounds or not."
                      : "This is the change from the projected old λ. Return the change from the old λ itself, "
                        "since V contains the old λ."},
                 {expected, "This is λ: return what changed."},
                 {wanted - old.lambda, "Return the change after projection, not before."}});
    expect_near("what G V changed by [m/s]", "Eq. (4.5)", along(p.V) - along(before),
                change * (old.diagonal - old.Sigma), roundings(1000, 10),
                {{(wanted - old.lambda) * (old.diagonal - old.Sigma), "The unprojected change was scattered."},
                 {expected * (old.diagonal - old.Sigma), "All of λ was scattered, not its change."},
                 {0, "Nothing was scattered."}},
                "Scatter Δλ, which changes G V by (S_kk - Σ) Δλ.");
  }
}

EXERCISE_TEST(UpdateRow, KeepsANaN) {
  Row<3> row = by_hand(std::nan(""), 1);
  std::vector<Twist<3>> V(2, Twist<3>::Zero());
  update_row(row, V);
  expect_true(
      "a right side that is NaN gives a λ that is NaN", "Eq. (4.7)", std::isnan(row.lambda),
      "std::min and std::max return their first argument when the other is NaN, so the NaN became a number. "
      "std::clamp keeps a NaN.");
}

EXERCISE_TEST(UpdateRow, DropsNothingSmall) {
  for (const double part : relative_scales) {
    for (CancellationCase of : cancellation_cases(part)) {
      const double before = of.row.lambda, delta = update_row(of.row, of.V);
      expect_near("Δλ of a row with " + of.text + " [N s]", "Eq. (4.6)", delta, of.lacks / 3, roundings(4), {},
                  small_is_dropped);
      expect_near("λ of a row with " + of.text + " [N s]", "Eq. (4.7)", of.row.lambda, before + of.lacks / 3,
                  roundings(4), {}, small_is_dropped);
    }
    // λ = 1 N s is nearly enough.
    CancellationCase nearly = cancellation_cases(part).back();
    nearly.V = {Twist<3>::Zero(), Twist<3>::Zero()};
    nearly.row.lambda = 1;
    nearly.row.B = 1 + part;
    update_row(nearly.row, nearly.V);
    expect_near("velocity of body j, where λ = 1 N s grows by " + show(part / 3) + " of itself [m/s]",
                "Eq. (4.7)", nearly.V[1].z(), part / 3, roundings(8),
                {{0, "It has not been changed. " + small_is_dropped}}, small_is_dropped);
    // And it loses nearly all of it.
    nearly.V = {Twist<3>::Zero(), Twist<3>::Zero()};
    nearly.row.lambda = 1;
    nearly.row.B = 3 * part - 2;
    update_row(nearly.row, nearly.V);
    expect_near("velocity of body j, where " + show(part) + " of λ = 1 N s is left [m/s]", "Eq. (4.7)",
                nearly.V[1].z(), part - 1, roundings(8),
                {{-1, "It has been treated as 0. " + small_is_dropped}}, small_is_dropped);
    if (::testing::Test::HasFailure()) return;
  }
}

}  // namespace
