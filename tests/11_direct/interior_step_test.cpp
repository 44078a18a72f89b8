// The interior-point step: against dense algebra, away from the bounds, and with λ and its rooms consistent.
#include "algebra.hpp"
#include "exercise_test.hpp"
#include "interior.hpp"
#include "random_input.hpp"
#include "relative_scales.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(InteriorStep, "11.9 interior_step");

struct Bounds {
  VectorXd lo, hi;
};

Bounds bounds_of(const Interior& now) {
  return {now.lambda - now.room_lo, now.lambda + now.room_hi};
}

Interior moved(const Interior& now, const Interior& step, double share) {
  Interior next = now;
  next.lambda += share * step.lambda;
  for (const Part& part : parts) next.*part.vector += share * (step.*part.vector);
  return next;
}

/// Eq. (11.8), (11.9).
Interior dense_newton_step(const Inside& p, const Target& target) {
  const Interior& now = p.now;
  const VectorXd right =
      p.B - p.S * now.lambda + target.lo.cwiseQuotient(now.room_lo) - target.hi.cwiseQuotient(now.room_hi);
  const VectorXd none = VectorXd::Zero(p.B.size());
  Interior step{.lambda = solution_of(dense_barrier(p), right),
                .room_lo = none,
                .room_hi = none,
                .push_lo = none,
                .push_hi = none};
  for (Eigen::Index k = 0; k < none.size(); ++k) {
    if (has_lo(now, k)) {
      step.room_lo[k] = step.lambda[k];
      step.push_lo[k] = (target.lo[k] - now.push_lo[k] * step.lambda[k]) / now.room_lo[k] - now.push_lo[k];
    }
    if (has_hi(now, k)) {
      step.room_hi[k] = -step.lambda[k];
      step.push_hi[k] = (target.hi[k] + now.push_hi[k] * step.lambda[k]) / now.room_hi[k] - now.push_hi[k];
    }
  }
  return step;
}

/// Eq. (11.10).
double longest_part(const Interior& now, const Interior& step) {
  double longest = 1;
  for (const Part& part : parts)
    for (Eigen::Index k = 0; k < now.lambda.size(); ++k) {
      const double change = (step.*part.vector)[k];
      if (change < 0) longest = std::min(longest, (now.*part.vector)[k] / -change);
    }
  return longest;
}

/// Eq. (11.11), and likely mistakes in it.
struct Way {
  double power = 3, second_order = -1;
  double least_share = 0.9, more_share = 0.0999;  // of the second step; the latter times α
  bool look = true, counts_rows = false, share_of_itself = false;
  double look_share = 1;  // of the longest first step
  bool whole_mean = false, part_of_product = false, above_by_lambda = false;
  bool sums = false, below_only = false, counts_two_a_row = false;  // in place of the mean over all bounds
  bool without_unit = false, centred = true, with_push = false, product_below = false;
  bool both_steps = false, as_far_as_trial = false;
};

/// The point before λ and its rooms are made consistent.
Interior dense_interior_step(const Inside& p, const Way& way = {}) {
  const Eigen::Index n = p.B.size();
  const auto mean = [&](const Interior& now) {
    double sum = 0, bounds = 0;
    for (Eigen::Index k = 0; k < n; ++k) {
      if (has_lo(now, k)) sum += now.room_lo[k] * now.push_lo[k], bounds += 1;
      if (has_hi(now, k) && !way.below_only) sum += now.room_hi[k] * now.push_hi[k], bounds += 1;
    }
    if (way.sums) return sum;
    if (way.counts_two_a_row) return sum / (2 * static_cast<double>(n));
    return sum / (way.counts_rows ? static_cast<double>(n) : std::max(bounds, 1.0));
  };
  Target target{.lo = VectorXd::Zero(n), .hi = VectorXd::Zero(n)};
  const Interior straight = dense_newton_step(p, target);
  const double part = way.look_share * longest_part(p.now, straight);
  if (way.look) {
    const double before = mean(p.now), after = mean(moved(p.now, straight, way.whole_mean ? 1 : part));
    const double centre =
        before > 0 && way.centred ? std::pow(after / before, way.power) * (way.without_unit ? 1 : before) : 0;
    const double product = way.second_order * (way.part_of_product ? part : 1);
    const double above = way.above_by_lambda ? -product : product;
    for (Eigen::Index k = 0; k < n; ++k) {
      const double below_product = straight.room_lo[k] * (way.with_push ? p.now.push_lo : straight.push_lo)[k];
      const double above_product = straight.room_hi[k] * (way.with_push ? p.now.push_hi : straight.push_hi)[k];
      target.lo[k] = centre + product * below_product;
      target.hi[k] = centre + above * (way.product_below ? below_product : above_product);
    }
  }
  const Interior step = dense_newton_step(p, target);
  const double longest = longest_part(p.now, step), far = way.as_far_as_trial ? part : longest;
  return moved(way.both_steps ? moved(p.now, straight, part) : p.now, step,
               far < 1 ? (way.least_share + way.more_share * (way.share_of_itself ? longest : part)) * far : 1);
}

/// λ, s⁻ and s⁺ of one row.
struct Place {
  double lambda, below, above;
};

/// The smallest of the three determines the other two.
Place reconciled(const Place& drifted, double lo, double hi) {
  const double smallest = std::min({std::abs(drifted.lambda), drifted.below, drifted.above});
  const double lambda = smallest == drifted.below   ? lo + drifted.below
                        : smallest == drifted.above ? hi - drifted.above
                                                    : drifted.lambda;
  return {lambda, smallest == drifted.below ? drifted.below : lambda - lo,
          smallest == drifted.above ? drifted.above : hi - lambda};
}

Interior step_of(const Inside& p, const Bounds& bounds) {
  Factors factors;
  if (!factorise(lower_triangle(dense_barrier(p)), factors))
    ADD_FAILURE() << "the test's own S̃ could not be factorised";
  return interior_step(lower_triangle(p.S), p.B, bounds.lo, bounds.hi, p.now, factors);
}

/// Replaces infinities by 0, which leaves the rooms of existing bounds.
VectorXd finite(const VectorXd& v) {
  return v.unaryExpr([](double x) { return std::isinf(x) ? 0 : x; });
}

const Tolerance conditioned{1e-10, "round-off times a condition of 1e3, and some more"};

EXERCISE_TEST(InteriorStep, ChoosesTauByATrialStep) {
  Random random;
  for (int repeat = 0; repeat < 10; ++repeat) {
    const int rows = repeat == 9 ? many : 14;  // with 100 or 13 bounds
    const Inside p = random_inside(random, rows);
    const Interior got = step_of(p, bounds_of(p.now));
    if (!has_size(got, rows, "Eq. (11.11)")) return;
    const Interior right = dense_interior_step(p);
    const auto otherwise = [&](const Way& way) { return dense_interior_step(p, way).lambda; };
    expect_near_vector(
        "λ of the next point, of " + std::to_string(rows) + " rows [N s]", "Eq. (11.11)", got.lambda,
        right.lambda, conditioned,
        {{otherwise({.look = false}), "This is the trial step, τ = 0, which only serves to choose τ."},
         {otherwise({.second_order = 0}), "The product of the two changes is left out of τ."},
         {otherwise({.second_order = 1}),
          "The product of the two changes is added to τ: it has to be taken away."},
         {otherwise({.power = 2}), "(μ'/μ)³ μ: this has the square."},
         {otherwise({.power = 4}), "(μ'/μ)³ μ: this has the fourth power."},
         {otherwise({.power = 0}), "This aims at μ itself: (μ'/μ)³ is left out."},
         {otherwise({.power = 1}), "(μ'/μ)³ μ: this is μ' itself, with the first power."},
         {otherwise({.power = -3}), "(μ'/μ)³ μ: here μ is divided by μ'."},
         {otherwise({.without_unit = true}), "(μ'/μ)³ is a number without a unit: multiply it by μ."},
         {otherwise({.centred = false}), "The first term of τ, (μ'/μ)³ μ, is missing."},
         {otherwise({.sums = true}), "μ is the mean over bounds: this is the sum."},
         {otherwise({.below_only = true}), "μ is the mean over all bounds: those above are left out."},
         {otherwise({.with_push = true}), "The second term is -Δs Δz: here Δs is multiplied by z."},
         {otherwise({.product_below = true}),
          "At the bound above the second term is -Δs⁺ Δz⁺, and not -Δs⁻ Δz⁻."},
         {otherwise({.both_steps = true}), "Both steps are taken: the trial step only serves to choose τ."},
         {otherwise({.as_far_as_trial = true}),
          "The longest part of the trial step limits this one: it has a longest part of its own, α₂."},
         {otherwise({.least_share = 0.0999, .more_share = 0.9}),
          "Take 0.9 + 0.0999 α of the longest part: here the two numbers are swapped."},
         {otherwise({.least_share = 0.9999, .more_share = 0}),
          "Take 0.9 + 0.0999 α of the longest part: this is 0.9999 of it, however far the trial step went."},
         {otherwise({.look_share = 0.999}),
          "α is the longest part of the first step: the second step alone stays short of it."},
         {otherwise({.whole_mean = true}),
          "μ' is the mean after the part α of the first step, not after all of it."},
         {otherwise({.part_of_product = true}), "The term is -Δs Δz, all of it: this is α of it."},
         {otherwise({.above_by_lambda = true}), "Δs⁺ is -Δλ: here the product above has the other sign."},
         {otherwise({.counts_two_a_row = true}),
          "μ is the mean over the bounds that there are: this divides by two for each row."},
         {otherwise({.counts_rows = true}), "μ is the mean over bounds: a row has none, one or two."},
         {otherwise({.least_share = 1, .more_share = 0}),
          "Take 0.9 + 0.0999 α of the longest part: here a room, or a push, is exactly 0."},
         {otherwise({.least_share = 0.5, .more_share = 0}),
          "Take 0.9 + 0.0999 α of the longest part: this is half of it."},
         {otherwise({.least_share = 0.9, .more_share = 0}),
          "Take 0.9 + 0.0999 α of the longest part: this is 0.9 of it, however far the trial step went."},
         {otherwise({.least_share = 0.999, .more_share = 0}),
          "Take 0.9 + 0.0999 α of the longest part: this is 0.999 of it, however far the trial step went."},
         {otherwise({.share_of_itself = true}),
          "Take 0.9 + 0.0999 α of the longest part, by α of the trial step, not by its own."}},
        "First compute the step with τ = 0 and its longest part. Then compute τ from its result, and the step "
        "to take. " +
            (rows == many ? ends_early : ""));
    expect_near_vector("z⁻ of the next point [m/s]", "Eq. (11.9)", got.push_lo, right.push_lo, conditioned);
    expect_near_vector("z⁺ of the next point [m/s]", "Eq. (11.9)", got.push_hi, right.push_hi, conditioned);
    expect_near_vector("s⁻ of the next point [N s]", "Eq. (11.5)", finite(got.room_lo), finite(right.room_lo),
                       conditioned);
    expect_near_vector("s⁺ of the next point [N s]", "Eq. (11.5)", finite(got.room_hi), finite(right.room_hi),
                       conditioned);
    for (Eigen::Index k = 0; k < rows; ++k)
      expect_true("row " + std::to_string(k) + " has the same bounds as before", "Eq. (11.5)",
                  has_lo(got, k) == has_lo(p.now, k) && has_hi(got, k) == has_hi(p.now, k),
                  "Where there is no bound, the room stays infinite.");
  }
}

EXERCISE_TEST(InteriorStep, TakesTheSmallestStep) {
  // λ = 0 of 1 kg that has to lose 1 m/s, just above its bound: it goes as far as the bound allows. The push is so
  // small that its change, times that of the room, does not reverse the second step.
  const VectorXd one = VectorXd::Ones(1), none = VectorXd::Zero(1), unbounded = infinity * one;
  for (const double part : relative_scales) {
    const std::string small = part > 0.01 ? "" : small_is_dropped;
    const Inside p{.S = MatrixXd::Identity(1, 1),
                   .B = -one,
                   .now = {.lambda = none,
                           .room_lo = part * one,
                           .room_hi = unbounded,
                           .push_lo = std::pow(part, 4) * one,
                           .push_hi = none},
                   .target = {.lo = none, .hi = none}};
    const Interior got = step_of(p, {-part * one, unbounded});
    const double share = 0.9 + 0.0999 * longest_part(p.now, dense_newton_step(p, p.target));
    if (!has_size(got, 1, "Eq. (11.11)")) return;
    expect_near("room below, of " + show(part) + " N s with a target of 1 N s, over its value before",
                "Eq. (11.10)", got.room_lo[0] / part, 1 - share, roundings(8),
                {{1, "It has not moved. " + small},
                 {0.001, "This is 0.999 of the longest part, however far the trial step went."}},
                "Take 0.9 + 0.0999 α of the longest part. " + small);
    expect_near("λ, over the room before", "Eq. (11.10)", got.lambda[0] / part, -share, roundings(8), {},
                small);
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(InteriorStep, IsWholeOnlyWhereNothingLimitsIt) {
  // λ = 0 of 1 kg that has to lose 1 m/s, with a room a little smaller or larger than that.
  const VectorXd one = VectorXd::Ones(1), none = VectorXd::Zero(1), unbounded = infinity * one;
  for (const double room : {0.99, 0.9985, 0.9995, 0.9999, 1 - 1e-5, 1 - 1e-7, 1 + 1e-7, 1.0005}) {
    const Inside p{.S = MatrixXd::Identity(1, 1),
                   .B = -one,
                   .now = {.lambda = none,
                           .room_lo = room * one,
                           .room_hi = unbounded,
                           .push_lo = 1e-12 * one,
                           .push_hi = none},
                   .target = {.lo = none, .hi = none}};
    const Interior got = step_of(p, {-room * one, unbounded});
    if (!has_size(got, 1, "Eq. (11.11)")) return;
    const double right = dense_interior_step(p).lambda[0], longest = std::min(room, 1.0);
    expect_near("λ after a step towards -1 N s, with a room of " + show(room) + " N s below [N s]",
                "Eq. (11.11)", got.lambda[0], right, {1e-11, "the push of 1e-12 m/s, and round-off"},
                {{-1,
                  "The whole step was taken, though a bound limits it, by a tiny amount. The step is whole "
                  "only where α₂ is 1."},
                 {-longest, "All of the longest part was taken, so the room is 0. Take 0.9 + 0.0999 α of it."},
                 {-(0.9 + 0.0999 * longest) * longest,
                  "This step was shortened. Nothing limits it, so take it whole."}},
                "Take the part (0.9 + 0.0999 α) α₂ of the step, or the whole step if nothing limits it.");
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(InteriorStep, KeepsATenThousandthOfEveryRoomAndPush) {
  Random random;
  for (int repeat = 0; repeat < 10; ++repeat) {
    const Inside p = random_inside(random, 12);
    const Interior got = step_of(p, bounds_of(p.now));
    if (!has_size(got, 12, "Eq. (11.11)")) return;
    double least = infinity;
    for (const Part& part : parts)
      for (Eigen::Index k = 0; k < 12; ++k) {
        const double before = (p.now.*part.vector)[k], left = (got.*part.vector)[k] / before;
        if (before > 0 && std::isfinite(before) && !(left >= least)) least = left;
      }
    expect_at_least(
        "the least of rooms and pushes, over what it was", "Eq. (11.11)", least, 1e-4 - 1e-10,
        "1 - 0.9999, and round-off",
        "A room or a push of 0 is a division by zero in the next S̃: take at most 0.9999 of the longest part.");
  }
}

EXERCISE_TEST(InteriorStep, DoesNotGoRoundInCircles) {
  // Three contacts, two of which disagree: the lesson's example.
  const MatrixXd G{{0.2, 0.6}, {-0.4, -0.7}, {0.6, -0.9}};
  Inside p{.S = G * G.transpose() + 0.001 * MatrixXd::Identity(3, 3),
           .B = VectorXd{{0.8, -1, -1}},
           .now = {},
           .target = {}};
  const Bounds bounds{VectorXd::Zero(3), VectorXd::Constant(3, infinity)};
  const Interior start = interior_start(lower_triangle(p.S), p.B, bounds.lo, bounds.hi, Vector::Zero(3));
  const auto lacks = [&](const Interior& now) {
    return dense_residual({.S = p.S, .B = p.B, .lo = bounds.lo, .hi = bounds.hi}, now.lambda.cwiseMax(0));
  };

  // This is a hard case: stopping a thousandth short of the bound, whatever the trial step did, repeats every third
  // step.
  p.now = start;
  std::vector<double> lacked;
  for (int step = 0; step < 60; ++step) {
    p.now = dense_interior_step(p, {.least_share = 0.999, .more_share = 0});
    lacked.push_back(lacks(p.now));
  }
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(lacked[57 + k], (std::array{0.0362229, 0.201273, 0.0165398})[k], 1e-6);

  p.now = start;
  for (int step = 0; step < 20 && lacks(p.now) > 1e-11; ++step) {
    p.now = step_of(p, bounds);
    if (!has_size(p.now, 3, "Eq. (11.11)")) return;
  }
  expect_at_most("residual of three rows after at most 20 steps [m/s]", "Eq. (11.11)", lacks(p.now), 1e-11,
                 "round-off of Eq. (11.13), a hundred times",
                 "With 0.999 of the longest part at every step they go round in circles: a row far ahead of "
                 "the others limits the next step. Take 0.9 + 0.0999 α of it.");
}

EXERCISE_TEST(InteriorStep, IsTheSolutionWithoutBounds) {
  Random random;
  Inside p = random_inside(random, 10);
  p.now.room_lo.setConstant(infinity), p.now.room_hi.setConstant(infinity);
  p.now.push_lo.setZero(), p.now.push_hi.setZero();
  const Interior got = step_of(p, bounds_of(p.now));
  if (!has_size(got, 10, "Eq. (11.11)")) return;
  expect_near_vector("λ after one step without bounds [N s]", "Eq. (11.5)", got.lambda, solution_of(p.S, p.B),
                     conditioned, {},
                     "Nothing limits the step, so it is taken whole. Without bounds there is no mean of "
                     "products: μ'/μ must not be 0/0.");
  expect_true("rooms stay infinite, pushes 0", "Eq. (11.5)",
              (got.room_lo.array() == infinity).all() && (got.room_hi.array() == infinity).all() &&
                  got.push_lo.isZero(0) && got.push_hi.isZero(0));
}

EXERCISE_TEST(InteriorStep, ReconcilesLambdaAndItsRooms) {
  Random random;
  for (int repeat = 0; repeat < 10; ++repeat) {
    const int rows = repeat == 9 ? many : 12;
    Inside p = random_inside(random, rows);
    p.now.room_lo[0] = p.now.room_hi[0] = 0.5, p.now.push_lo[0] = p.now.push_hi[0] = 1;
    const Bounds bounds = bounds_of(p.now);
    for (Vector* each : {&p.now.lambda, &p.now.room_lo, &p.now.room_hi})
      for (double& value : *each) value += random.uniform(-1e-3, 1e-3);
    const Interior got = step_of(p, bounds), drifted = dense_interior_step(p);
    if (!has_size(got, rows, "Eq. (11.11)")) return;
    for (Eigen::Index k = 0; k < rows && !::testing::Test::HasFailure(); ++k) {
      const Place before{drifted.lambda[k], drifted.room_lo[k], drifted.room_hi[k]};
      const Place right = reconciled(before, bounds.lo[k], bounds.hi[k]);
      const std::string what = " of row " + std::to_string(k) + " of " + std::to_string(rows) +
                               ", from λ = " + show(before.lambda) + ", s⁻ = " + show(before.below) +
                               ", s⁺ = " + show(before.above) + " [N s]";
      const std::string clue =
          "Before the step λ, s⁻ and s⁺ did not agree, by round-off. Keep the smallest of |λ|, s⁻, s⁺. "
          "The other two follow by s⁻ = λ - lo, s⁺ = hi - λ. " +
          (rows == many ? ends_early : "");
      expect_near("λ" + what, "Eq. (11.5)", got.lambda[k], right.lambda, conditioned,
                  {{before.lambda, clue + " This λ was not changed."},
                   {bounds.lo[k] - before.below, "The sign of the room below: λ = lo + s⁻."},
                   {bounds.hi[k] + before.above, "The sign of the room above: λ = hi - s⁺."}},
                  clue);
      if (has_lo(p.now, k))
        expect_near(
            "s⁻" + what, "Eq. (11.5)", got.room_lo[k], right.below, conditioned,
            {{before.below, clue + " This room did not change."}, {-right.below, "The sign: s⁻ = λ - lo."}},
            clue);
      if (has_hi(p.now, k))
        expect_near(
            "s⁺" + what, "Eq. (11.5)", got.room_hi[k], right.above, conditioned,
            {{before.above, clue + " This room did not change."}, {-right.above, "The sign: s⁺ = hi - λ."}},
            clue);
    }
  }
}

EXERCISE_TEST(InteriorStep, KeepsTheDigitsOfASmallRoom) {
  const VectorXd one = VectorXd::Ones(1);
  for (const bool above : {false, true}) {
    const double room = 1e-9, push = 0.8, side = above ? -1 : 1;
    Inside p{.S = MatrixXd::Ones(1, 1),
             .B = (1 - side * 0.6) * one,  // a push of 0.6 would suffice: the room shrinks to a quarter
             .now = {.lambda = (1 + side * room) * one,
                     .room_lo = (above ? infinity : room) * one,
                     .room_hi = (above ? room : infinity) * one,
                     .push_lo = (above ? 0 : push) * one,
                     .push_hi = (above ? push : 0) * one},
             .target = {}};
    const Bounds bounds{(above ? -infinity : 1) * one, (above ? 1 : infinity) * one};
    const Interior got = step_of(p, bounds), right = dense_interior_step(p);
    if (!has_size(got, 1, "Eq. (11.11)")) return;
    const auto part = above ? &Interior::room_hi : &Interior::room_lo;
    expect_near("room " + std::string(above ? "above" : "below") +
                    " a bound of 1, 1e-9 before the step, over the exact room",
                "Eq. (11.5)", (got.*part)[0] / (right.*part)[0], 1,
                {1e-11, "round-off of the room itself; that of λ would be 1e-7 of it"}, {},
                "The room is the smallest of the three, so keep it: λ - lo has seven digits of it only.");
  }
}

}  // namespace
