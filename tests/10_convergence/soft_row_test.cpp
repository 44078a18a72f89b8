// One update of a soft row: by numbers, by chapter 04's update, and what an open gap and the bounds ask for.
#include "exercise_test.hpp"
#include "random_input.hpp"
#include "systems.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(UpdateSoftRow, "10.11 update_soft_row");

/// A contact of a ball of 2 kg with the floor. B, Σ and diagonal are of another solve.
Row<3> row_of_a_ball() {
  const Twist<3> up(0, 0, 1);
  const Motion<3> motion{.inverse_mass = {{.linear = 0}, {.linear = 0.5}},
                         .W = {Twist<3>::Zero(), Twist<3>::Zero()},
                         .Wf = {Twist<3>::Zero(), Twist<3>::Zero()}};
  return make_row<3>(
      {.i = 0, .j = 1, .Gi = -up, .Gj = up, .gap = -1, .spook = {.a = 20, .b = 0.9, .Sigma = 0.25}}, motion);
}

EXERCISE_TEST(UpdateSoftRow, SolvesOneSoftRowByHand) {
  // w = 10 · 0.02 = 0.2 m/s, u = -0.3 m/s, S = 0.5/kg: Δλ = 0.6 · 0.5/0.5 - 0.4 · 0.8 = 0.28 N s.
  Row<3> row = row_of_a_ball();
  row.lambda = 0.8;
  std::vector<Twist<3>> W = {Twist<3>::Zero(), Twist<3>(0, 0, -0.3)};
  const SoftParameters soft{.bias_rate = 10, .mass_scale = 0.6, .impulse_scale = 0.4};
  const double change = update_soft_row(0.01, soft, -0.02, row, W);
  expect_near("λ [N s] of a ball that falls in the floor, 0.8 N s before", "Eq. (10.21)", row.lambda, 1.08,
              roundings(16),
              {{0.6, "The gap has the wrong sign: a closed gap is negative, and w = -a g."},
               {0.78, "S is missing: the mass of the row is 1/S."},
               {0.72, "The velocity u of the row is missing."},
               {0.84, "w, the target of u, is missing: w = -a g."},
               {1.40, "The part -(1 - σ) λ is missing: a soft row gives way as it pushes."},
               {1.48, "The mass scale is missing in the first term."},
               {0.88, "This divides by the row's diagonal, S + Σ. Divide by S alone."},
               {0.28, "This is Δλ. It is added to λ."}});
  expect_near("Δλ, which it returns [N s]", "Eq. (10.21)", change, 0.28, roundings(16),
              {{1.08, "This is λ: return its change."}});
  expect_near("u afterwards [m/s]", "Eq. (4.5)", W[1].z(), -0.16, roundings(16),
              {{-0.3, "W has not been changed: Δλ acts on both bodies."}});
  expect_true("B, Σ and diagonal of the row stay", "Eq. (10.21)",
              row.B == row_of_a_ball().B && row.Sigma == 0.25 && row.diagonal == row_of_a_ball().diagonal);
  // w = 0: Δλ = 0.6 · 0.3/0.5 - 0.4 · 0.8 = 0.04 N s.
  row.lambda = 0.8;
  W[1].z() = -0.3;
  update_soft_row(0.01, soft, 0, row, W);
  expect_near(
      "λ [N s] of a ball that just touches the floor, g = 0", "Eq. (10.21)", row.lambda, 0.84, roundings(16),
      {{1.4, "This is the row of an open gap. Open is above 0: a gap of 0 is closed, so the row is soft."}});
}

EXERCISE_TEST(UpdateSoftRow, LetsAnOpenGapCloseInASubstep) {
  const SoftParameters soft{.bias_rate = 10, .mass_scale = 0.6, .impulse_scale = 0.4};
  const double h = 0.125, gap = 0.0625;  // w = -1/2 m/s
  const auto speed_after = [&](double speed, double lambda) {
    Row<3> row = row_of_a_ball();
    row.lambda = lambda;
    std::vector<Twist<3>> W = {Twist<3>::Zero(), Twist<3>(0, 0, speed)};
    update_soft_row(h, soft, gap, row, W);
    return W[1].z();
  };
  expect_near("u [m/s] of a ball that would fall through an open gap", "Eq. (10.21)", speed_after(-3, 0), -0.5,
              roundings(8),
              {{-0.625, "An open gap has w = -g/h, not -a g."},
               {-3 + 0.6 * 2.375, "An open gap has w = -g/h, not -a g, and its row is rigid."},
               {-3 + 0.6 * 2.5, "The row of an open gap is rigid: its scales are 1 and 0."},
               {0, "It may close the gap in this substep: w = -g/h."}});
  expect_near("u [m/s] of a ball that does not reach the floor", "Eq. (10.21), (4.7)", speed_after(-0.25, 0),
              -0.25, roundings(8), {}, "It does not close the gap within the substep: nothing pushes.");
  expect_near(
      "u [m/s] of a ball with an impulse of the last substep", "Eq. (10.21)", speed_after(-1, 0.25), -0.5,
      roundings(8),
      {{-1 + 0.5 * 0.9, "The row of an open gap is rigid: its impulse scale is 0."},
       {-1 + 0.6 * 0.375 - 0.5 * 0.1,
        "The row of an open gap is rigid, and w = -g/h, also if it has an impulse of the last substep."}});
}

EXERCISE_TEST(UpdateSoftRow, PullsAJointBackSoftly) {
  // A joint has no bounds, and an open gap of it is a gap as any other.
  Row<3> row = row_of_a_ball();
  row.lo = -infinity;
  std::vector<Twist<3>> W(2, Twist<3>::Zero());
  const SoftParameters soft{.bias_rate = 10, .mass_scale = 0.6, .impulse_scale = 0.4};
  update_soft_row(0.01, soft, 0.02, row, W);
  expect_near("λ [N s] of a joint, 2 cm too long", "Eq. (10.21)", row.lambda, -0.24, roundings(16),
              {{-4, "Only a row with lo = 0 has an open gap. This row holds, so w = -a g."},
               {0, "A row without bounds pulls, too."}});
}

EXERCISE_TEST(UpdateSoftRow, KeepsTheImpulseWithinItsBounds) {
  const SoftParameters soft{.bias_rate = 10, .mass_scale = 0.5, .impulse_scale = 0.5};
  // u = 1 m/s: wanted is 0.3 - 0.5 · 2 - 0.5 · 0.3 = -0.85 N s.
  Row<3> row = row_of_a_ball();
  row.lambda = 0.3;
  std::vector<Twist<3>> W = {Twist<3>::Zero(), Twist<3>(0, 0, 1)};
  const double change = update_soft_row(0.01, soft, 0, row, W);
  expect_near("λ [N s] of a ball that rises", "Eq. (4.7)", row.lambda, 0, roundings(4),
              {{-0.85, "A contact does not pull: project λ."},
               {0.3, "Project λ, not Δλ: an impulse may shrink again."}});
  expect_near("Δλ [N s]", "Eq. (4.7)", change, -0.3, roundings(4),
              {{-1.15, "It is the change after projection."}});
  expect_near("u afterwards [m/s]", "Eq. (4.5)", W[1].z(), 0.85, roundings(4),
              {{1 - 0.575, "W changes by the projected Δλ."}});
  row.hi = 0.25;
  W[1].z() = -1;
  update_soft_row(0.01, soft, 0, row, W);
  expect_near("λ [N s] at an upper bound of 0.25 N s", "Eq. (4.7)", row.lambda, 0.25, roundings(4), {},
              "Rows have two bounds.");
}

EXERCISE_TEST(UpdateSoftRow, IsTheUpdateOfChapterFour) {
  Random random;
  for (int trial = 0; trial < 200 && !::testing::Test::HasFailure(); ++trial) {
    Problem<6> p = random_problem(random, 3, 1);
    if (trial % 2) give_bounds(random, p);
    Row<6>& row = p.rows[0];
    row.lambda = std::clamp(random.uniform(-0.3, 0.5), row.lo, row.hi);
    const double S = row.Gi.dot(row.MinvGi) + row.Gj.dot(row.MinvGj);
    const double a = random.uniform(1, 10), Sigma = S * random.log_uniform(0.01, 100);
    const double gap = (trial % 3 ? -1 : 1) * random.uniform(0, 0.1), h = random.log_uniform(1e-3, 0.1);
    const SoftParameters soft{
        .bias_rate = a, .mass_scale = S / (S + Sigma), .impulse_scale = Sigma / (S + Sigma)};

    // Chapter 04's row has the same target in B, and V instead of W.
    const bool open = row.lo == 0 && gap > 0;
    Row<6> other = row;
    other.B = open ? -gap / h : -a * gap;
    other.Sigma = open ? 0 : Sigma;
    other.diagonal = S + other.Sigma;
    std::vector<Twist<6>> W = p.motion.W, V = W;
    const double wanted = update_row(other, V), got = update_soft_row(h, soft, gap, row, W);
    const double size = 1 + (std::abs(other.B) + 10) / S;
    expect_near("Δλ [N s]", "Eq. (10.21), (4.6)", got, wanted, roundings(100, size), {},
                "It is (w - u - Σ λ)/(S + Σ), divided by S above and below, then projected.");
    expect_near_vector("W of all bodies [m/s, rad/s]", "Eq. (4.5)", flat(W), flat(V), roundings(1000, size), {},
                       "W changes by M⁻¹ Gᵀ Δλ, on both bodies.");
  }
}

}  // namespace
