// The start of the interior-point method: one energy for every bound, and the room that goes with it.
#include "exercise_test.hpp"
#include "interior.hpp"
#include "random_input.hpp"
#include "regions.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(InteriorStart, "11.8 interior_start");

Interior start_of(const Bounded& p, const VectorXd& guess) {
  return interior_start(lower_triangle(p.S), p.B, p.lo, p.hi, guess);
}

/// The terms of E in Eq. (11.12), each the largest of all rows.
struct Energies {
  double all = 0, of_B = 0, without_guess = 0, without_least = 0, outside = 0, sum = 0;
};

Energies energies(const Bounded& p, const VectorXd& guess) {
  Energies e;
  for (Eigen::Index k = 0; k < p.B.size(); ++k) {
    const double S = p.S(k, k), of_B = p.B[k] * p.B[k] / S;
    const auto of = [&](double lambda) { return S * lambda * lambda; };
    const double least = of(std::clamp(0.0, p.lo[k], p.hi[k]));
    const double likely = of(std::clamp(guess[k], p.lo[k], p.hi[k]));
    e.all = std::max(e.all, of_B + least + likely);
    e.of_B = std::max(e.of_B, of_B);
    e.without_guess = std::max(e.without_guess, of_B + least);
    e.without_least = std::max(e.without_least, of_B + likely);
    e.outside = std::max(e.outside, of_B + least + of(guess[k]));
    e.sum += of_B + least + likely;
  }
  return e;
}

/// One row, with S = 2.
Bounded one_row(double B, double lo, double hi) {
  return {.S = MatrixXd::Constant(1, 1, 2),
          .B = VectorXd::Constant(1, B),
          .lo = VectorXd::Constant(1, lo),
          .hi = VectorXd::Constant(1, hi)};
}

const Tolerance close{1e-12, "round-off of bounds up to 0.5, over rooms of 0.005 and more"};

/// Checks every number of a start, from Eq. (11.12) and the energy.
void expect_start(const Bounded& p, const VectorXd& guess) {
  const Interior start = start_of(p, guess);
  if (!has_size(start, p.B.size(), "Eq. (11.12)")) return;
  const Energies e = energies(p, guess);
  for (Eigen::Index k = 0; k < p.B.size(); ++k) {
    const std::string what =
        " of row " + std::to_string(k) + ", lo = " + show(p.lo[k]) + ", hi = " + show(p.hi[k]);
    const double least = std::clamp(0.0, p.lo[k], p.hi[k]), guessed = std::clamp(guess[k], p.lo[k], p.hi[k]);
    const double own = p.B[k] * p.B[k] / p.S(k, k) + p.S(k, k) * (least * least + guessed * guessed);
    const auto expect_energy = [&](const std::string& side, double room, double push) {
      expect_near(
          "s z " + side + what + ", over E", "Eq. (11.12)", room * push / e.all, 1, close,
          {{own / e.all,
            "This is the row's own energy, or that of B alone. E is the largest of all rows, one for all, and "
            "includes the guess and the bounds."},
           {e.of_B / e.all, "This is from B only: the guess and the bounds may need more."},
           {e.without_guess / e.all, e.without_guess == e.without_least
                                         ? "λ₀ and λ_g are the same here, and both count: S λ² is in E twice."
                                         : "The guess is forgotten."},
           {e.without_least / e.all, "The bounds may keep λ from 0: then S λ² is needed in any case."},
           {e.outside / e.all, "The guess is outside the bounds: use the nearest λ within them."},
           {e.sum / e.all, "Take the largest of all rows, and not their sum."},
           {1 / e.all, "This is 1 J, which is for an E of 0. Here B, the guess or the bounds tell a size."}},
          room > 0
              ? "Every bound begins with the same s z, the largest B²/S + S (λ₀² + λ_g²) of all rows."
              : "There is no room: use at most half of the distance between two bounds, so that z is finite.");
    };
    const bool below = std::isfinite(p.lo[k]), above = std::isfinite(p.hi[k]);
    if (below) expect_energy("below", start.room_lo[k], start.push_lo[k]);
    if (above) expect_energy("above", start.room_hi[k], start.push_hi[k]);

    const double half = (p.hi[k] - p.lo[k]) / 2, room = std::min(std::sqrt(e.all / p.S(k, k)), half);
    const auto nearest = [&](double from, double space) {
      return std::max(p.lo[k] + space, std::min(from, p.hi[k] - space));
    };
    const double lambda = nearest(0, room);
    const std::string beside = "This is beside a bound, which may be far away. λ begins near 0.";
    expect_near(
        "λ" + what + " [N s]", "Eq. (11.12)", start.lambda[k], lambda,
        {1e-12 * (1 + std::abs(lambda)), "a rounding of a bound and a room"},
        {{nearest(guess[k], room), "λ begins near 0, whatever the guess, which tells a size."},
         {p.lo[k] + room, beside},
         {p.hi[k] - room, beside},
         {nearest(0, half), "Half the way between the bounds may be far too much: √(E/S) depends on the row."}},
        "λ begins at 0, or as near as leaves a room of min(√(E/S), (hi - lo)/2) to both bounds.");
    const auto expect_room = [&](const std::string& name, double got, double right) {
      expect_near(name + what + " [N s]", "Eq. (11.5)", got, right,
                  {1e-12 * (1 + right), "round-off of a bound and of λ"}, {}, "s⁻ = λ - lo, s⁺ = hi - λ.");
    };
    if (below) expect_room("s⁻", start.room_lo[k], lambda - p.lo[k]);
    if (above) expect_room("s⁺", start.room_hi[k], p.hi[k] - lambda);
    const std::string clue = "Where there is no bound its room is infinite, and its push 0.";
    if (!below)
      expect_true("no bound below" + what, "Eq. (11.5)", start.room_lo[k] == infinity && start.push_lo[k] == 0,
                  clue);
    if (!above)
      expect_true("no bound above" + what, "Eq. (11.5)", start.room_hi[k] == infinity && start.push_hi[k] == 0,
                  clue);
  }
}

EXERCISE_TEST(InteriorStart, GivesEveryBoundTheSameEnergy) {
  Random random;
  Regions regions(
      {"no bound", "a bound below", "a bound above", "two bounds", "a bound below, of 0", "a bound above, of 0",
       "two bounds, one of them 0", "0 is not allowed", "the guess is not allowed", "the guess is allowed",
       "B tells the size", "the guess tells the size", "half the way to the other bound",
       "the root of E/S between two bounds"},
      10);
  while (regions.lack_draws()) {
    System<6> s = random_system(random, 4, 12);
    add_random_bounds(random, s.rows);
    if (random.integer(0, 1))  // two bounds far from each other
      for (Row<6>& row : s.rows)
        if (std::isfinite(row.lo) && std::isfinite(row.hi)) row.hi = row.lo + 100;
    const double size = random.integer(0, 1) ? 10 : 1e-3;
    const Bounded p = bounded(s.rows);
    const VectorXd guess = VectorXd::NullaryExpr(12, [&] { return size * random.uniform(-1, 1); });
    const Energies e = energies(p, guess);
    bool none = false, below = false, above = false, both = false, no_zero = false, out = false, in = false,
         half_way = false, by_root = false, zero_below = false, zero_above = false, zero_of_two = false;
    for (Eigen::Index k = 0; k < 12; ++k) {
      const bool lo = std::isfinite(p.lo[k]), hi = std::isfinite(p.hi[k]);
      const double half = (p.hi[k] - p.lo[k]) / 2, root = std::sqrt(e.all / p.S(k, k));
      const bool allowed = p.lo[k] <= guess[k] && guess[k] <= p.hi[k];
      none |= !lo && !hi, below |= lo && !hi, above |= !lo && hi, both |= lo && hi;
      no_zero |= p.lo[k] > 0 || p.hi[k] < 0, out |= !allowed, in |= allowed;
      zero_below |= p.lo[k] == 0 && !hi, zero_above |= p.hi[k] == 0 && !lo;
      zero_of_two |= lo && hi && (p.lo[k] == 0 || p.hi[k] == 0);
      half_way |= lo && hi && half < root, by_root |= lo && hi && root < half;
    }
    regions.draw({{"no bound", none},
                  {"a bound below", below},
                  {"a bound above", above},
                  {"two bounds", both},
                  {"a bound below, of 0", zero_below},
                  {"a bound above, of 0", zero_above},
                  {"two bounds, one of them 0", zero_of_two},
                  {"0 is not allowed", no_zero},
                  {"the guess is not allowed", out},
                  {"the guess is allowed", in},
                  {"B tells the size", e.of_B > e.all / 2},
                  {"the guess tells the size", e.without_guess < e.all / 2},
                  {"half the way to the other bound", half_way},
                  {"the root of E/S between two bounds", by_root}});
    expect_start(p, guess);
    Bounded quiet = p;
    quiet.B *= 1e-3;
    expect_start(quiet, guess);
  }
}

EXERCISE_TEST(InteriorStart, TakesTheLargestOfTheRows) {
  // Each row in turn determines the size.
  for (const auto& [rows, k] : {std::pair(3, 0), {3, 1}, {3, 2}, {many, many - 1}}) {
    Bounded p{.S = VectorXd::Constant(rows, 2).asDiagonal(),
              .B = VectorXd::Constant(rows, 0.1),
              .lo = VectorXd::Zero(rows),
              .hi = VectorXd::Constant(rows, infinity)};
    expect_start(p, VectorXd::Unit(rows, k));
    p.B[k] = -1;
    expect_start(p, VectorXd::Zero(rows));
    p.lo[k] = 3;
    expect_start(p, 5 * VectorXd::Unit(rows, k));
    p.lo[k] = -infinity, p.hi[k] = -4;
    expect_start(p, -5 * VectorXd::Unit(rows, k));
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(InteriorStart, IsInTheMiddleOfANarrowWay) {
  for (const double width : {1e-9, 1e-3, 0.4}) {
    const Interior start = start_of(one_row(3, 1, 1 + width), VectorXd::Zero(1));
    if (!has_size(start, 1, "Eq. (11.12)")) return;
    const double half = ((1 + width) - 1) / 2;
    expect_near("s⁻ between bounds that are " + show(width) + " apart, over the half", "Eq. (11.12)",
                start.room_lo[0] / half, 1, {1e-15 / half, "round-off of a bound of 1, over the room"});
    expect_near("s⁺ between bounds that are " + show(width) + " apart, over the half", "Eq. (11.12)",
                start.room_hi[0] / half, 1, {1e-15 / half, "round-off of a bound of 1, over the room"});
  }
}

EXERCISE_TEST(InteriorStart, IsNearZeroHoweverFarTheBounds) {
  for (const double far : {2.0, 1e3, 1e9, 1e17}) {
    expect_start(one_row(3, -far, far), VectorXd::Zero(1));
    expect_start(one_row(3, -far, infinity), VectorXd::Zero(1));
    expect_start(one_row(3, -infinity, far), VectorXd::Zero(1));
    expect_start(one_row(3, -far, 0.25), VectorXd::Zero(1));
    expect_start(one_row(3, -0.25, far), VectorXd::Zero(1));
  }
}

EXERCISE_TEST(InteriorStart, IsPositiveWhereBIsZero) {
  // B = 0, and another source of a size: the guess alone, or a bound alone.
  expect_start(one_row(0, 0, infinity), VectorXd::Constant(1, 3));
  expect_start(one_row(0, 3, infinity), VectorXd::Zero(1));
  expect_start(one_row(0, -infinity, -3), VectorXd::Zero(1));
  for (const double hi : {infinity, 0.25}) {
    const Interior start = start_of(one_row(0, 0, hi), VectorXd::Zero(1));
    if (!has_size(start, 1, "Eq. (11.12)")) return;
    const double room = std::min(std::sqrt(0.5), hi / 2);
    const std::string clue =
        "B and the guess are 0, and the bounds allow λ = 0: take 1 J, since rooms must be positive.";
    expect_near("s⁻ where nothing tells a size, S = 2, hi = " + show(hi) + " [N s]", "Eq. (11.12)",
                start.room_lo[0], room, roundings(4), {}, clue);
    expect_near("s⁻ z⁻ where nothing tells a size [J]", "Eq. (11.12)", start.room_lo[0] * start.push_lo[0], 1,
                roundings(4), {}, clue);
  }
  for (const double B : {1e-9, 1e-150}) {  // B² is far above underflow
    const Interior little = start_of(one_row(B, 0, infinity), VectorXd::Zero(1));
    if (!has_size(little, 1, "Eq. (11.12)")) return;
    expect_near("s⁻ of a row with S = 2, B = " + show(B) + " m/s, over B/2", "Eq. (11.12)",
                little.room_lo[0] / (B / 2), 1, roundings(8), {},
                "A small B tells a size, too: 1 J is for an E of 0.");
  }
}

EXERCISE_TEST(InteriorStart, IsIndependentOfRowScaling) {
  Random random;
  System<6> s = random_system(random, 4, 8);
  add_random_bounds(random, s.rows);
  const Bounded p = bounded(s.rows);
  const VectorXd guess = VectorXd::NullaryExpr(8, [&] { return random.uniform(-1, 1); });
  const VectorXd c = VectorXd::NullaryExpr(8, [&] { return random.log_uniform(1e-3, 1e3); });
  const Bounded scaled{.S = c.asDiagonal() * p.S * c.asDiagonal(),
                       .B = c.cwiseProduct(p.B),
                       .lo = p.lo.cwiseQuotient(c),
                       .hi = p.hi.cwiseQuotient(c)};
  const Interior one = start_of(p, guess), other = start_of(scaled, guess.cwiseQuotient(c));
  if (!has_size(one, 8, "Eq. (11.12)") || !has_size(other, 8, "Eq. (11.12)")) return;
  for (Eigen::Index k = 0; k < 8; ++k)
    expect_near("λ of row " + std::to_string(k) + " in other units, taken back [N s]", "Eq. (11.12)",
                c[k] * other.lambda[k], one.lambda[k], {1e-12, "round-off of λ about 1"}, {},
                "S_kk scales by the square, B by the scale, λ by its inverse: energies do not change.");
}

}  // namespace
