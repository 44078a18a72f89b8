// One solve with M̃: against dense algebra, and for what it conserves.
#include <Eigen/LU>

#include "algebra.hpp"
#include "exercise_test.hpp"
#include "random_input.hpp"
#include "relative_scales.hpp"
#include "springs.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(StiffSolve, "12.4 stiff_solve");

struct Answer {
  Eigen::VectorXd V, lambda;  ///< all bodies', all rows'
};

Answer solved(Springs& s) {
  std::vector<Twist<3>> V(static_cast<std::size_t>(s.bodies()), Vec3(7, 7, 7));
  for (Row<3>& row : s.rows) row.lambda = 7;
  Factors factors;
  expect_true("the factorisation of sound rows succeeds", "Eq. (12.6)",
              stiff_solve(s.rows, s.motion, s.stiffness, s.h, V, factors),
              "Return the result of factorise: true when it has succeeded.");
  if (std::ssize(V) != s.bodies()) throw std::logic_error("V no longer has one velocity a body");
  Answer answer{.V = Eigen::VectorXd(3 * s.bodies()), .lambda = Eigen::VectorXd(std::ssize(s.rows))};
  for (int body = 0; body < s.bodies(); ++body)
    answer.V.segment<3>(3 * body) = V[static_cast<std::size_t>(body)];
  for (std::size_t k = 0; k < s.rows.size(); ++k) answer.lambda[static_cast<int>(k)] = s.rows[k].lambda;
  return answer;
}

/// The law of the springs: by the velocities of both ends, which is right, or with a mistake.
enum class Push {
  of_both,
  of_its_own_end,
  of_the_other_end,
  of_j_alone,
  of_i_alone,
  on_i_only,
  on_j_only,
  alike_on_both,
  static_bodies_too,
  between_dynamic_bodies,
  of_the_last_spring,
  without_brackets
};

/// The right side: a factor of the springs' part, and one of B.
struct RightSide {
  double push = 1, B = 1;
};

/// Computes V and λ by dense algebra, with so many times h²K in M̃, and K acting on these velocities.
Answer dense(const Springs& s, double times, const std::vector<Vec3>& pushed, Push how = Push::of_both,
             const RightSide& right_side = {}) {
  const Eigen::MatrixXd A = dense_matrix(s, times);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(A.rows());
  for (const Stiffness& spring : s.stiffness) {
    const auto of = [&](int body) -> Vec3 {
      if (how == Push::of_j_alone && body == spring.i) return Vec3::Zero();
      if (how == Push::of_i_alone && body == spring.j) return Vec3::Zero();
      return pushed[static_cast<std::size_t>(body)];
    };
    const bool own = how != Push::of_the_other_end, other = how != Push::of_its_own_end;
    if (how == Push::between_dynamic_bodies && !(s.moves(spring.i) && s.moves(spring.j))) continue;
    const auto push_on = [&](int body, int end) {
      if (!s.moves(body) && how != Push::static_bodies_too) return;
      if (how == Push::of_the_last_spring) right.segment<3>(3 * body).setZero();
      Vec3 pushed_by = spring.K * (other * of(end) - own * of(body));
      if (how == Push::without_brackets)
        pushed_by = (body == spring.i ? 1 : -1) * Vec3(spring.K * of(spring.j) - of(spring.i));
      const double sign = how == Push::alike_on_both && body == spring.j ? -1 : 1;
      right.segment<3>(3 * body) += right_side.push * sign * s.h * s.h * pushed_by;
    };
    if (how != Push::on_j_only) push_on(spring.i, spring.j);
    if (how != Push::on_i_only) push_on(spring.j, spring.i);
  }
  for (std::size_t k = 0; k < s.rows.size(); ++k)
    right[3 * s.bodies() + static_cast<int>(k)] = right_side.B * s.rows[k].B;
  const Eigen::VectorXd unknowns = solution_of(A, right);
  return {.V = unknowns.head(3 * s.bodies()), .lambda = -unknowns.tail(std::ssize(s.rows))};
}

/// The same problem with another h; the rows stay.
Springs stepped(Springs s, double h) {
  s.h = h;
  return s;
}

EXERCISE_TEST(StiffSolve, SolvesTheStep) {
  Random random;
  for (int repeat = 0; repeat < 10 && !::testing::Test::HasFailure(); ++repeat) {
    const int bodies = random.integer(3, 8), fixed = random.integer(0, 2);
    Springs s = random_springs(random, bodies, fixed, random.integer(0, 4), repeat % 2 == 1);
    if (repeat == 9) s.h = 0;  // then there is no K
    const std::vector<Vec3>&Wf = s.motion.Wf, none(Wf.size(), Vec3::Zero());
    std::vector<Vec3> whole, back;
    Eigen::VectorXd forces(3 * s.bodies());
    for (std::size_t k = 0; k < Wf.size(); ++k) {
      const bool moves = s.moves(static_cast<int>(k));
      whole.push_back(moves ? Vec3(s.motion.W[k] + Wf[k]) : Vec3::Zero());
      back.push_back(-Wf[k]);
      forces.segment<3>(3 * static_cast<int>(k)) = Wf[k];
    }
    const Answer got = solved(s), right = dense(s, 1, Wf), unstiff = dense(s, 0, none),
                 unpushed = dense(s, 1, none);
    const Answer tournier = dense(s, 1, whole), backwards = dense(s, 1, back);
    const std::string of = ", of " + std::to_string(s.bodies()) + " bodies with " +
                           std::to_string(s.rows.size()) + " rows, h = " + show(s.h) + " s";
    const std::string no_K = "This is the solution with M for M̃: there is no K in it.";
    const std::string no_push =
        "K must also resist the forces' part W_f. In terms of V the right side of the bodies is M W_f - M̃ W_f "
        "= -h²K W_f, not 0. The forces' own part W_f is missing.";
    const std::string damps =
        "This is Tournier's form, Eq. (12.8): K acts on the whole new velocity, and damps it. It should act on "
        "the "
        "change V + W_f.";
    const std::string sign = "The sign of what the forces add: the right side of the bodies is -h²K W_f.";
    const auto with = [&](const RightSide& right_side) { return dense(s, 1, Wf, Push::of_both, right_side).V; };
    const std::string equations = "M̃ V - Gᵀλ = -h²K W_f and G V + Σ λ = B, whatever V and λ were before.";
    const bool right_V = (got.V - right.V).norm() <= 1e-9 * right.V.norm(),
               right_lambda = (got.lambda - right.lambda).norm() <= 1e-9 * right.lambda.norm();
    expect_near_vector<Eigen::VectorXd>(
        "V of all bodies" + of + " [m/s]", "Eq. (12.6)", got.V, right.V,
        {1e-10 * right.V.norm(), "round-off times a condition of up to 1e5"},
        {{repeat == 9 ? dense(stepped(s, 1), 1, Wf).V : unstiff.V,
          repeat == 9 ? "This is a step of 1 s. The given step is 0: use it." : no_K},
         {unpushed.V, no_push},
         {tournier.V, damps},
         {backwards.V, sign},
         {dense(s, 1, Wf, Push::of_its_own_end).V,
          "The other end's W_f is missing: a spring resists W_f,j - W_f,i, the difference of its two ends."},
         {dense(s, 1, Wf, Push::of_the_other_end).V,
          "The end's own W_f is missing: a spring resists W_f,j - W_f,i, what its two ends move apart."},
         {dense(s, 1, Wf, Push::of_j_alone).V,
          "W_f of body i is missing on both ends: a spring resists the difference W_f,j - W_f,i."},
         {dense(s, 1, Wf, Push::of_i_alone).V,
          "W_f of body j is missing on both ends: a spring resists the difference W_f,j - W_f,i."},
         {dense(s, 1, Wf, Push::on_i_only).V, "K acts on body i only: what one end gets the other gives."},
         {dense(s, 1, Wf, Push::on_j_only).V, "K acts on body j only: what one end gets the other gives."},
         {dense(s, 1, Wf, Push::alike_on_both).V,
          "Both ends get the same push: what one end gets the other gives, with the other sign."},
         {dense(s, 1, Wf, Push::static_bodies_too).V,
          "Your static body moves. Its M is the identity, so its V is its right side: keep that side at 0."},
         {dense(s, 1, s.motion.W).V,
          "K acts on the velocity W of before the step. It should act on W_f, which the forces add."},
         {with({.push = 2}), "The push -h²K W_f counts twice."},
         {s.h == 0 ? unpushed.V : with({.push = 1 / s.h}), "The push is h K W_f, with one h: it needs h²."},
         {s.h == 0 ? unpushed.V : with({.push = 1 / (s.h * s.h)}), "The push is K W_f, without h²."},
         {with({.B = 0}), "B is missing: it is the right side of the rows."},
         {with({.B = -1}), "The sign of B, the right side of the rows."},
         {with({.B = 0.5}), "The right side of a row is B, all of it: this has half of B."},
         {dense(s, 1, Wf, Push::between_dynamic_bodies).V,
          "The springs with a static end are missing. They push, too: they resist the W_f of the end that "
          "moves."},
         {dense(s, 1, Wf, Push::of_the_last_spring).V,
          "Only the last spring of a body pushes here. Add up the pushes of all its springs."},
         {dense(s, 1, Wf, Push::without_brackets).V,
          "K multiplies the difference of the two: K (W_f,j - W_f,i), with brackets."},
         {right.V + forces, "This is V + W_f: V is what rows and springs add to W_f."},
         {-right.V, "The sign of V."},
         {right.V + Eigen::VectorXd::Constant(right.V.size(), 7),
          "The result is added to the V that was there: it replaces V."}},
        right_lambda ? "λ is right, so the equations are solved. V of body b is the three unknowns from 3 b on."
                     : equations);
    expect_near_vector<Eigen::VectorXd>(
        "λ of all rows" + of + " [N s]", "Eq. (12.6)", got.lambda, right.lambda,
        {1e-10 * right.lambda.norm(), "round-off times a condition of up to 1e5"},
        {{-right.lambda, "The unknowns of Eq. (11.2) are V and -λ."},
         {unstiff.lambda, no_K},
         {unpushed.lambda, no_push},
         {tournier.lambda, damps},
         {Eigen::VectorXd::Constant(right.lambda.size(), 7),
          "The rows still have the λ that they had on entry."},
         {right.lambda + Eigen::VectorXd::Constant(right.lambda.size(), 7),
          "The result is added to the λ that was there: it replaces λ."},
         {s.h * right.lambda, "This is h λ. λ is an impulse already, and is not multiplied by h."}},
        right_V
            ? "V is right, so the equations are solved. λ of row k is minus the unknown 3 n + k, of n bodies."
            : equations);
  }
}

EXERCISE_TEST(StiffSolve, TakesAnyNumberOfSpringsAndRows) {
  Random random;
  Springs s = random_springs(random, 400, 1, 300);
  const Answer got = solved(s);
  Eigen::VectorXd x(got.V.size() + got.lambda.size()), right(x.size());
  x << got.V, -got.lambda;
  // h²K multiplies V + W_f. So the right side is the matrix's own springs times -W_f, without masses and rows.
  Springs springs{.motion = s.motion, .rows = {}, .stiffness = s.stiffness, .h = s.h};
  Eigen::VectorXd Wf(3 * s.bodies()), masses(3 * s.bodies());
  for (int body = 0; body < s.bodies(); ++body) {
    Wf.segment<3>(3 * body) = s.motion.Wf[static_cast<std::size_t>(body)];
    masses.segment<3>(3 * body) = s.mass(body) * Wf.segment<3>(3 * body);
  }
  right.head(Wf.size()) = masses - times_matrix(springs, Wf);
  for (std::size_t k = 0; k < s.rows.size(); ++k) right[Wf.size() + static_cast<Eigen::Index>(k)] = s.rows[k].B;
  const Eigen::VectorXd left = times_matrix(s, x);
  Eigen::Index worst = 0;
  (left - right).cwiseAbs().maxCoeff(&worst);
  expect_near("line " + std::to_string(worst) + " of the equations of " + std::to_string(s.stiffness.size()) +
                  " springs and " + std::to_string(s.rows.size()) + " rows, with V and λ inserted",
              "Eq. (12.6)", left[worst], right[worst],
              {1e-9 * x.cwiseAbs().maxCoeff() * std::max(1.0, right.cwiseAbs().maxCoeff()),
               "round-off times the growth of the factors"},
              {}, "All springs and all rows, however many there are.");
}

EXERCISE_TEST(StiffSolve, WithoutSpringsIsTheSaddlePoint) {
  Random random;
  Springs s = random_springs(random, 6, 1, 2);
  s.stiffness.clear();
  const Answer got = solved(s);
  std::vector<Twist<3>> V(6);
  Factors factors;
  saddle_solve(s.rows, s.motion.inverse_mass, V, factors);
  for (int body = 0; body < 6; ++body)
    expect_near_vector<Vec3>("V of body " + std::to_string(body) + " without springs [m/s]", "Eq. (11.2)",
                             got.V.segment<3>(3 * body), V[static_cast<std::size_t>(body)],
                             {1e-10, "round-off times a condition of up to 1e5"},
                             {{Vec3(7, 7, 7), "V is as it was before: without springs it is set, too."}},
                             "Without springs M̃ is M, and this is chapter 11's solve.");
  Springs without_rows{.h = 0.5};
  without_rows.add(1, Vec3::Zero(), Vec3::Zero());
  without_rows.add(1, Vec3::Zero(), Vec3(3, 3, 3));
  without_rows.stiffness = {{.i = 0, .j = 1, .K = 4 * Mat3::Identity()}};  // h²K is 1 kg, and so are the masses
  const Vec3 V0 = solved(without_rows).V.head<3>();
  if (V0 == Vec3::Zero()) this_failure_explains();
  expect_near_vector(
      "V of body 0 on a spring, without rows [m/s]", "Eq. (12.6)", V0, Vec3(1, 1, 1), roundings(16),
      {{Vec3::Zero(), "Nothing was solved, since there are no rows. The springs still need a solve."}},
      "M̃ V = -h² K W_f without rows.");
}

EXERCISE_TEST(StiffSolve, KnowsNoBounds) {
  Random random;
  for (int repeat = 0; repeat < 5; ++repeat) {
    Springs s = random_springs(random, 6, 1, 2);
    const Answer free = solved(s);
    for (Row<3>& row : s.rows) row.lo = -1e-9, row.hi = 1e-9;  // less than any of them needs
    const Answer bounded = solved(s);
    expect_near_vector("λ of rows with bounds, against the same rows without [N s]", "Eq. (12.6)",
                       bounded.lambda, free.lambda, {0, "the same numbers"},
                       {{free.lambda.cwiseMax(-1e-9).cwiseMin(1e-9),
                         "It is clamped, and V, computed from the other λ, does not belong to it."}},
                       "Rows are solved as if they had no bounds.");
  }
}

EXERCISE_TEST(StiffSolve, DropsNothingSmall) {
  for (const double part : relative_scales)
    for (const Vec3& apart : lopsided(part)) {
      Springs s{.h = 0.5};
      s.add(1, Vec3::Zero(), Vec3::Zero());
      s.add(1, Vec3::Zero(), apart);
      s.stiffness = {{.i = 0, .j = 1, .K = 4 * Mat3::Identity()}};  // h²K is 1 kg, and so are the masses
      expect_each_near<Eigen::VectorXd>("V of two bodies that forces separate nearly along an axis [m/s]",
                                        "Eq. (12.6)", solved(s).V,
                                        (Eigen::VectorXd(6) << apart / 3, -apart / 3).finished(), 16);
      if (::testing::Test::HasFailure()) return;
    }
}

EXERCISE_TEST(StiffSolve, KeepsMomentum) {
  Random random;
  for (int repeat = 0; repeat < 10 && !::testing::Test::HasFailure(); ++repeat) {
    const int bodies = random.integer(3, 8);
    Springs s = random_springs(random, bodies, 0, random.integer(0, 4));
    const Answer got = solved(s);
    Vec3 sum = Vec3::Zero();
    double size = 0;
    for (int body = 0; body < s.bodies(); ++body) {
      sum += s.mass(body) * got.V.segment<3>(3 * body);
      size += s.mass(body) * got.V.segment<3>(3 * body).norm();
    }
    expect_near_vector<Vec3>("Σ m V of " + std::to_string(s.bodies()) + " free bodies [N s]", "Eq. (12.6)", sum,
                             Vec3::Zero(), {1e-10 * size, "round-off times a condition of up to 1e5"}, {},
                             "Rows and springs act between two bodies: what one gets the other gives.");
  }
}

EXERCISE_TEST(StiffSolve, DoesNotDampSteadyMotion) {
  // Bodies that move apart, each at its own velocity, and fall alike: no velocity difference changes.
  Random random;
  Springs s = random_springs(random, 6, 0, 3);
  s.rows.clear();
  for (Vec3& Wf : s.motion.Wf) Wf = Vec3(0, 0, -0.16);
  const Answer got = solved(s);
  expect_near("largest of V of six bodies on springs, without rows [m/s]", "Eq. (12.6)",
              got.V.cwiseAbs().maxCoeff(), 0, {1e-12, "round-off times a condition of up to 1e3"}, {},
              "K acts on changes of velocity, and here all changes are equal. Acting on a steady motion is "
              "damping: the Tournier form, Eq. (12.8).");
}

EXERCISE_TEST(StiffSolve, MovesNothingThatIsFixed) {
  Random random;
  for (int repeat = 0; repeat < 5 && !::testing::Test::HasFailure(); ++repeat) {
    Springs s = random_springs(random, 6, 2, 4);
    const Answer got = solved(s);
    for (int body = 0; body < 2; ++body)
      expect_near_vector<Vec3>("V of body " + std::to_string(body) + ", which is static [m/s]", "Eq. (12.6)",
                               got.V.segment<3>(3 * body), Vec3::Zero(), {0, "exact"}, {},
                               "Its M is the identity, so its V is its right side: keep that at 0.");
  }
  for (const int bodies : {2, many}) {
    Springs s{.h = 0.1};
    while (s.bodies() < bodies - 1) s.add(1, Vec3::Zero(), Vec3(0, 0, -1));
    s.add(0, Vec3::Zero(), Vec3::Zero());
    s.stiffness.push_back({0, bodies - 1, 50 * Mat3::Identity()});
    expect_near_vector<Vec3>("V of the last of " + std::to_string(bodies) + " bodies, which is static [m/s]",
                             "Eq. (12.6)", solved(s).V.tail<3>(), Vec3::Zero(), {0, "exact"}, {},
                             "Any body may be static, also the last. " + ends_early);
  }
}

EXERCISE_TEST(StiffSolve, LeavesAllAsItWasWhenItFails) {
  Springs s{.h = 0.1};
  s.add(0, Vec3::Zero(), Vec3::Zero());
  s.add(0, Vec3::Zero(), Vec3::Zero());
  s.add(1, Vec3::Zero(), Vec3(0, 0, -1));
  s.add_row(0, 1, Vec3::UnitZ(), 0,
            {.a = 1, .b = 1, .Sigma = 0});  // B ≠ 0 between two static bodies, with Σ = 0
  s.rows[0].lambda = 7;
  std::vector<Twist<3>> V(3, Vec3(1, 2, 3));
  Factors factors;
  expect_true("a row between static bodies, with Σ = 0, has no solution, and stiff_solve returns false",
              "Eq. (11.4)", !stiff_solve(s.rows, s.motion, s.stiffness, s.h, V, factors),
              "factorise returns false for a pivot that is not sound: return that.");
  expect_near("λ of that row, which was 7 N s on entry [N s]", "Eq. (12.6)", s.rows[0].lambda, 7, {0, "exact"},
              {}, "Return before you write to rows or V.");
  for (const Vec3& velocity : V)
    expect_near_vector<Vec3>("V of a body, which was (1, 2, 3) on entry [m/s]", "Eq. (12.6)", velocity,
                             Vec3(1, 2, 3), {0, "exact"},
                             {{Vec3::Zero(), "V has been cleared before the solve had succeeded."}},
                             "Return before you write to rows or V.");
}

EXERCISE_TEST(StiffSolve, LooksForThePatternOnce) {
  Random random;
  Springs s = random_springs(random, 8, 1, 0);
  std::vector<Twist<3>> V(8);
  Factors factors;
  for (int step = 0; step < 5; ++step) {
    stiff_solve(s.rows, s.motion, s.stiffness, s.h, V, factors);
    for (Stiffness& spring : s.stiffness) {
      const Vec3 n = random.unit_vector();
      spring.K = across(n, random.uniform(0, 100));
    }
  }
  expect_near("analyses in five solves of the same wire under other tensions", "Eq. (11.3)", factors.analyses,
              1, {0, "exact"}, {{0, "The factors that were given have not been used."}},
              "Use the factors in the arguments: they hold the pattern.");
}

}  // namespace
