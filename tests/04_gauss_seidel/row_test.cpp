// A row before the sweeps, and the effect of an impulse along it.
#include "exercise_test.hpp"
#include "problems.hpp"
#include "regions.hpp"
#include "relative_scales.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(MakeRow, "4.1 make_row");
EXERCISE(ApplyImpulse, "4.2 apply_impulse");

struct TwoBodies {
  Random random;
  Motion<6> motion = random_motion(random, 2);
  Constraint<6> c = random_constraint(random, 2);
  Twist<6> MinvGi = at(motion.inverse_mass, c.i).times(c.Gi);
  Twist<6> MinvGj = at(motion.inverse_mass, c.j).times(c.Gj);

  template <class T>
  static const T& at(const std::vector<T>& values, int index) {
    return values[static_cast<std::size_t>(index)];
  }
  double along(const std::vector<Twist<6>>& W) const { return c.Gi.dot(at(W, c.i)) + c.Gj.dot(at(W, c.j)); }
};

EXERCISE_TEST(MakeRow, CountsBothBodiesAndSigmaInTheDiagonal) {
  const TwoBodies t;
  const double share_i = t.c.Gi.dot(t.MinvGi), share_j = t.c.Gj.dot(t.MinvGj), Sigma = t.c.spook.Sigma;
  const double linear = t.c.Gi.head<3>().dot(t.MinvGi.head<3>()) + t.c.Gj.head<3>().dot(t.MinvGj.head<3>());
  expect_near(
      "S_kk of a contact between two rigid bodies [1/kg]", "Eq. (4.3)", make_row(t.c, t.motion).diagonal,
      share_i + share_j + Sigma, roundings(32, 20),
      {{share_i + Sigma, "This is body i's share alone. The impulse moves body j, too."},
       {share_j + Sigma, "This is body j's share alone. The impulse moves body i, too."},
       {share_i + share_j, "Σ is missing: S = G M⁻¹ Gᵀ + Σ."},
       {t.c.Gi.dot(t.c.Gi) + t.c.Gj.dot(t.c.Gj) + Sigma, "The masses are missing: this is G·G + Σ."},
       {share_i + share_j - Sigma, "The sign of Σ: it is added."},
       {share_i + share_j + 2 * Sigma, "Σ is there twice: once for the row, not once for each body."},
       {share_j - share_i + Sigma, "Gi has its sign twice in Gi·M⁻¹Gi: both shares are positive."},
       {t.MinvGi.dot(t.MinvGi) + t.MinvGj.dot(t.MinvGj) + Sigma, "M⁻¹ is there twice: this is M⁻¹G·M⁻¹G + Σ."},
       {linear + Sigma, "The angular parts are missing: all six numbers of a block count."},
       {1 / (share_i + share_j + Sigma), "This is 1/S_kk: the diagonal is an inverse mass, [1/kg]."}},
      "S_kk = Gi·M⁻¹Giᵀ + Gj·M⁻¹Gjᵀ + Σ, each block with its own body's M⁻¹.");
}

double difference(const TwoBodies& t, const std::vector<Twist<6>>& W) {
  return t.c.Gi.dot(t.at(W, t.c.i)) - t.c.Gj.dot(t.at(W, t.c.j));
}

EXERCISE_TEST(MakeRow, FillsTheRightSide) {
  TwoBodies t;
  Regions regions(
      {"open", "overlaps", "i is at rest, and no force acts on it", "j is at rest, and no force acts on it"});
  while (regions.lack_draws()) {
    t.motion = random_motion(t.random, 2);
    t.c = random_constraint(t.random, 2);
    const int rests = t.random.integer(-4, 1);
    const auto at_rest = [&](int body) { return body == rests; };
    if (rests >= 0) t.motion.W[static_cast<std::size_t>(rests)].setZero();
    if (rests >= 0) t.motion.Wf[static_cast<std::size_t>(rests)].setZero();
    regions.draw({{"open", t.c.gap > 0},
                  {"overlaps", t.c.gap < 0},
                  {"i is at rest, and no force acts on it", at_rest(t.c.i)},
                  {"j is at rest, and no force acts on it", at_rest(t.c.j)}});
    const double ag = t.c.spook.a * t.c.gap, GW = t.along(t.motion.W), GWf = t.along(t.motion.Wf);
    const double b = t.c.spook.b;
    const Row<6> row = make_row(t.c, t.motion);
    expect_near(
        "B of a contact between two rigid bodies [m/s]", "Eq. (4.4)", row.B, -ag - b * GW - GWf,
        roundings(32, 10),
        {{ag - b * GW - GWf, "The sign of the gap: with +a g a penetrating contact pulls the bodies together."},
         {-ag - GW - GWf, "b is missing in front of G W."},
         {-ag - b * GW, "What the forces add in this step, G W_f, is missing."},
         {-ag - b * (GW + GWf), "b belongs to the old velocity alone; G W_f counts in full."},
         {-ag + b * GW + GWf, "The sign of the velocities: an approaching contact has G W < 0 and must push."},
         {-b * GW - GWf,
          "The gap is missing: it counts above 0, where a contact may close within the step, and below."},
         {-ag - b * difference(t, t.motion.W) - difference(t, t.motion.Wf),
          "Gi has its sign already: add both bodies' shares."}},
        "B = -a g - b G W - G W_f, with the blocks Gi and Gj each on its own body.");
    const double shares = t.c.Gi.dot(t.at(t.motion.inverse_mass, t.c.i).times(t.c.Gi)) +
                          t.c.Gj.dot(t.at(t.motion.inverse_mass, t.c.j).times(t.c.Gj));
    expect_near("its diagonal [1/kg]", "Eq. (4.3)", row.diagonal, shares + t.c.spook.Sigma, roundings(32, 20),
                {}, "S_kk depends on the masses only: an impulse moves a body at rest, too.");
  }
}

EXERCISE_TEST(MakeRow, DividesTheJacobianByTheMasses) {
  const TwoBodies t;
  const Row<6> row = make_row(t.c, t.motion);
  const std::string copy =
      "This is G itself: multiply it by the body's inverse mass, motion.inverse_mass[i].times(Gi).";
  expect_near_vector("M⁻¹ Giᵀ", "Eq. (4.5)", row.MinvGi, t.MinvGi, roundings(16, 10), {{t.c.Gi, copy}});
  expect_near_vector("M⁻¹ Gjᵀ", "Eq. (4.5)", row.MinvGj, t.MinvGj, roundings(16, 10), {{t.c.Gj, copy}});
}

EXERCISE_TEST(MakeRow, IncludesTheVelocityOfAKinematicBody) {
  TwoBodies t;  // a conveyor: its velocity is not changed by impulses
  for (const int belt : {t.c.i, t.c.j}) {
    Motion<6> motion = t.motion;
    motion.inverse_mass[static_cast<std::size_t>(belt)] = {};
    const Row<6> row = make_row(t.c, motion);
    const Twist<6>& G = belt == t.c.i ? t.c.Gi : t.c.Gj;
    const double b = t.c.spook.b, GW = t.along(motion.W), GWf = t.along(motion.Wf), ag = t.c.spook.a * t.c.gap;
    const double without = G.dot(t.at(motion.W, belt)), without_f = G.dot(t.at(motion.Wf, belt));
    expect_near("B of a contact with a body that moves, but has an infinite mass [m/s]", "Eq. (4.4)", row.B,
                -ag - b * GW - GWf, roundings(32, 10),
                {{-ag - b * (GW - without) - (GWf - without_f),
                  "The velocity of the body with inverse mass 0 has been left out. It counts, although no "
                  "impulse changes it."}},
                "B = -a g - b G W - G W_f, with both bodies' velocities.");
    const double share = belt == t.c.i ? t.c.Gj.dot(t.MinvGj) : t.c.Gi.dot(t.MinvGi);
    expect_near("its diagonal: the other body's share, and Σ [1/kg]", "Eq. (4.3)", row.diagonal,
                share + t.c.spook.Sigma, roundings(32, 20));
  }
}

EXERCISE_TEST(MakeRow, CarriesTheRestOver) {
  TwoBodies t;
  t.motion = random_motion(t.random, 3);
  t.c.i = 2;  // and none is 0, which could be a number that was never set
  t.c.j = 1;
  // λ begins at 0, as V does, for any bounds. The first update projects it.
  for (const auto& [lo, hi] : {std::pair(0.25, 0.75), std::pair(-0.75, -0.25), std::pair(0.0, 0.5),
                               std::pair(-0.5, 0.0), std::pair(0.0, 0.0)}) {
    t.c.lo = lo;
    t.c.hi = hi;
    const Row<6> row = make_row(t.c, t.motion);
    expect_true("the row has the constraint's bodies", "Eq. (4.3)", row.i == t.c.i && row.j == t.c.j,
                "Copy i and j, in that order.");
    expect_near_vector("Gi", "Eq. (4.3)", row.Gi, t.c.Gi, {0, "a copy"});
    expect_near_vector("Gj", "Eq. (4.3)", row.Gj, t.c.Gj, {0, "a copy"});
    expect_near("Σ [1/kg]", "Eq. (4.3)", row.Sigma, t.c.spook.Sigma, {0, "a copy"}, {},
                "The row has the Σ of its constraint, whatever its bounds, as a field and in the diagonal.");
    expect_near(
        "lower bound of λ [N s]", "Eq. (4.1)", row.lo, t.c.lo, {0, "a copy"}, {},
        "A contact has the bounds 0 and infinity, but other rows have others: copy them. A field that is never "
        "set can hold any value.");
    expect_near("upper bound of λ [N s]", "Eq. (4.1)", row.hi, t.c.hi, {0, "a copy"}, {},
                "A contact has the bounds 0 and infinity, but other rows have others: copy them.");
    expect_near("λ before the first sweep, of bounds " + show(t.c.lo) + " and " + show(t.c.hi) + " [N s]",
                "Eq. (4.1)", row.lambda, 0, {0, "exact"},
                {{lo > 0 ? t.c.lo : t.c.hi,
                  "This is a bound. λ begins at 0, as V does, for any bounds. The sweeps project it."}});
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(MakeRow, TakesPointMasses) {
  const Problem<3> p = stack({2, 4}, 0.1, 0.125, 10);
  expect_near("S_kk of a contact between 2 kg and 4 kg, Σ = 1/8 [1/kg]", "Eq. (4.3)", p.rows[1].diagonal,
              0.5 + 0.25 + 0.125, roundings(8));
  expect_near("B of the contact of 2 kg with the floor, h g = 1 m/s [m/s]", "Eq. (4.4)", p.rows[0].B, 1,
              roundings(8), {}, "Gravity moves the body into the floor at h g, and B is the opposite of that.");
}

EXERCISE_TEST(ApplyImpulse, MovesBothBodies) {
  const TwoBodies t;
  Row<6> row = make_row(t.c, t.motion);
  for (const double delta : {0.7, -0.7, 1e-20, -1e-20}) {
    // Any λ and any bounds.
    row.lambda = delta > 0 ? 0.3 : -0.3;
    row.lo = row.lambda - 0.1, row.hi = row.lambda + 0.1;
    // V from other rows. It is 0 beside the smallest impulses, which would otherwise be lost in round-off.
    const Twist<6> so_far = Twist<6>::Constant(std::abs(delta) < 0.1 ? 0 : 0.5);
    const double size = std::abs(delta) < 0.1 ? std::abs(delta) * 10 : 10;
    std::vector<Twist<6>> V(2, so_far);
    apply_impulse(row, delta, V);
    const Twist<6> change_i = V[static_cast<std::size_t>(row.i)] - so_far;
    const Twist<6> change_j = V[static_cast<std::size_t>(row.j)] - so_far;
    const std::string masses = "The masses are missing: use MinvGi and MinvGj.";
    const std::string sign = "The sign is in Gi and Gj already: both are added.";
    const std::string idle =
        "This body has not moved, for Δλ = " + show(delta) +
        " N s. An impulse acts on both, Newton's third law, and Δλ may have either sign and any size.";
    const std::string unscaled = "Δλ is missing: this is M⁻¹G alone.";
    const std::string whole = "This is the row's own λ, times M⁻¹G. The impulse to scatter is `delta`.";
    const std::string lost = "Keep what V held before: add, do not assign.";
    expect_near_vector("velocity change of body i", "Eq. (4.5)", change_i, delta * row.MinvGi,
                       roundings(16, size),
                       {{delta * row.Gi, masses},
                        {-delta * row.MinvGi, sign},
                        {Twist<6>::Zero(), idle},
                        {row.MinvGi, unscaled},
                        {row.lambda * row.MinvGi, whole},
                        {(row.lambda + delta) * row.MinvGi, whole},
                        {delta * row.MinvGi - so_far, lost}});
    expect_near_vector("velocity change of body j", "Eq. (4.5)", change_j, delta * row.MinvGj,
                       roundings(16, size),
                       {{delta * row.Gj, masses},
                        {-delta * row.MinvGj, sign},
                        {Twist<6>::Zero(), idle},
                        {row.MinvGj, unscaled},
                        {row.lambda * row.MinvGj, whole},
                        {(row.lambda + delta) * row.MinvGj, whole},
                        {delta * row.MinvGj - so_far, lost}});
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(ApplyImpulse, ConservesMomentum) {
  Random random;
  const Problem<6> p = random_problem(random, 4, 12);
  std::vector<Twist<6>> V = p.V;
  for (const Row<6>& row : p.rows) apply_impulse(row, random.uniform(-1, 1), V);
  Vec3 momentum = Vec3::Zero();
  for (std::size_t k = 0; k < V.size(); ++k) momentum += V[k].head<3>() / p.motion.inverse_mass[k].linear;
  expect_near_vector(
      "momentum that 12 impulses between 4 free bodies give them in all [kg m/s]", "Eq. (4.5)", momentum,
      Vec3::Zero(), roundings(100, 5), {},
      "What one body gains the other must lose: +Δλ n on j and -Δλ n on i, each over its own mass.");
}

EXERCISE_TEST(ApplyImpulse, KeepsANaN) {
  const Problem<3> p = stack({1, 2}, 0.1);
  std::vector<Twist<3>> V = p.V;
  apply_impulse(p.rows[1], std::nan(""), V);
  expect_true(
      "an impulse that is NaN makes the velocities of both its bodies NaN", "Eq. (4.5)",
      std::isnan(V[1].z()) && std::isnan(V[2].z()),
      "The NaN was lost: every comparison with a NaN is false, so an `if` that looks for an impulse skips it.");
}

EXERCISE_TEST(ApplyImpulse, LeavesTheOtherBodiesAndTheFloorAlone) {
  const Problem<3> p = stack({1, 2, 3}, 0.1);
  std::vector<Twist<3>> V = p.V;
  apply_impulse(p.rows[0], 0.0, V);
  expect_near("speed of 1 kg after an impulse of 0 N s from the floor [m/s]", "Eq. (4.5)", V[1].norm(), 0,
              {0, "exact"}, {}, "An impulse of 0 changes nothing. Do not replace it by another one.");
  apply_impulse(p.rows[0], 5.0, V);
  expect_near("speed of 1 kg after an impulse of 5 N s from the floor [m/s]", "Eq. (4.5)", V[1].z(), 5,
              roundings(8));
  expect_near("speed of the floor, whose inverse mass is 0 [m/s]", "Eq. (4.5)", V[0].z(), 0, {0, "exact"});
  expect_near("speed of a body that the row does not touch [m/s]", "Eq. (4.5)", V[2].norm() + V[3].norm(), 0,
              {0, "exact"});
}

EXERCISE_TEST(MakeRow, DropsNothingSmall) {
  const Twist<3> up(0, 0, 1);
  for (const double part : relative_scales)
    for (const bool light_i : {true, false}) {
      const Motion<3> motion{.inverse_mass = {{.linear = light_i ? 1 : part}, {.linear = light_i ? part : 1}},
                             .W = {Vec3::Zero(), Vec3::Zero()},
                             .Wf = {Vec3::Zero(), Vec3::Zero()}};
      const Row<3> row = make_row<3>({.i = 0,
                                      .j = 1,
                                      .Gi = -up,
                                      .Gj = up,
                                      .gap = 0,
                                      .spook = {.a = 1, .b = 1, .Sigma = 0},
                                      .lo = 0,
                                      .hi = infinity},
                                     motion);
      const Twist<3> heavy = light_i ? row.MinvGj : row.MinvGi;
      expect_near("M⁻¹Gᵀ of a body whose 1/m is " + show(part) + " of the other's [1/kg]", "Eq. (4.5)",
                  std::abs(heavy.z()), part, {0, "a product with 1"},
                  {{0, "This treats the body as static, and momentum is lost. " + small_is_dropped}},
                  small_is_dropped);
    }
  const std::string names[] = {"gap", "velocity of i", "velocity of j", "forces on i", "forces on j"};
  for (const double part : relative_scales)  // of the five terms of B one is large, and another small
    for (int large = 0; large < 5; ++large)
      for (int more = 1; more < 5; ++more) {
        const int small = (large + more) % 5;
        double want[5] = {0, 0, 0, 0, 0};
        want[large] = 1, want[small] = part;
        const Motion<3> motion{.inverse_mass = {{.linear = 1}, {.linear = 1}},
                               .W = {want[1] * up, -want[2] * up},
                               .Wf = {want[3] * up, -want[4] * up}};
        const Row<3> row = make_row<3>({.i = 0,
                                        .j = 1,
                                        .Gi = -up,
                                        .Gj = up,
                                        .gap = -want[0],
                                        .spook = {.a = 1, .b = 1, .Sigma = 0},
                                        .lo = 0,
                                        .hi = infinity},
                                       motion);
        expect_near("B, where the " + names[large] + " asks for 1 m/s and the " + names[small] + " for " +
                        show(part) + " m/s [m/s]",
                    "Eq. (4.4)", row.B, 1 + part, roundings(4),
                    {{1, "The small one is missing. " + small_is_dropped}}, small_is_dropped);
        if (::testing::Test::HasFailure()) return;
      }
}

}  // namespace
