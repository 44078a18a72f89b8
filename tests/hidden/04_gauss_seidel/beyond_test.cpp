// Beyond chapter 04's own tests: exchanged bodies, impulses that add up, elimination, bounds of every kind.
#include "algebra.hpp"
#include "dense_rows.hpp"
#include "exercise_test.hpp"
#include "stages.hpp"
#include "stop_rule.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(MakeRow, "4.1 make_row");
EXERCISE(ApplyImpulse, "4.2 apply_impulse");
EXERCISE(UpdateRow, "4.3 update_row");
EXERCISE(Sweep, "4.4 sweep");
EXERCISE(Residual, "4.5 residual");
EXERCISE(Solve, "4.6 solve");
EXERCISE(StepContacts, "4.7 step_contacts");

struct Tangle {
  Random random;
  Motion<6> motion;
  std::vector<Constraint<6>> constraints;
  std::vector<Row<6>> rows;
  std::vector<Twist<6>> V;

  Tangle(int bodies, int count) {
    for (int k = 0; k < bodies; ++k) {
      motion.inverse_mass.push_back(random_body(random));
      motion.W.push_back(random.twist());
      motion.Wf.push_back(random.twist(0.2));
    }
    for (int k = 0; k < count; ++k) {
      const int i = random.integer(0, bodies - 1);
      const int j = (i + random.integer(1, bodies - 1)) % bodies;
      const ContactJacobian G = contact_jacobian({.i = i,
                                                  .j = j,
                                                  .n = random.unit_vector(),
                                                  .gap = 0,
                                                  .r_i = random.vector(),
                                                  .r_j = random.vector()});
      constraints.push_back({.i = i,
                             .j = j,
                             .Gi = G.Gi,
                             .Gj = G.Gj,
                             .gap = random.uniform(-0.1, 0.1),
                             .spook = {.a = random.uniform(1, 10), .b = random.uniform(0.5, 1), .Sigma = 0.5},
                             .lo = -infinity,
                             .hi = infinity});
      rows.push_back(make_row(constraints.back(), motion));
    }
    V.assign(static_cast<std::size_t>(bodies), Twist<6>::Zero());
  }
};

EXERCISE_TEST(MakeRow, IsTheSameForExchangedBodies) {
  const Tangle t(2, 1);
  const Constraint<6>& c = t.constraints[0];
  Constraint<6> other = c;
  std::swap(other.i, other.j);
  std::swap(other.Gi, other.Gj);
  const Row<6> row = make_row(c, t.motion), swapped = make_row(other, t.motion);
  expect_near("B [m/s]", "Eq. (4.4)", swapped.B, row.B, roundings(64, 10));
  expect_near("S_kk [1/kg]", "Eq. (4.3)", swapped.diagonal, row.diagonal, roundings(64, 20));
}

EXERCISE_TEST(ApplyImpulse, AddsUp) {
  Tangle t(2, 1);
  std::vector<Twist<6>> once = t.V;
  apply_impulse(t.rows[0], 0.3, t.V);
  apply_impulse(t.rows[0], -1.1, t.V);
  apply_impulse(t.rows[0], -0.8, once);
  for (std::size_t k = 0; k < 2; ++k)
    expect_near_vector("V after two impulses", "Eq. (4.5)", t.V[k], once[k], roundings(32, 10));
}

EXERCISE_TEST(UpdateRow, LeavesItsOwnRowSolved) {
  Tangle t(3, 6);
  for (Row<6>& row : t.rows) {
    update_row(row, t.V);
    const Twist<6>&V_i = t.V[static_cast<std::size_t>(row.i)], &V_j = t.V[static_cast<std::size_t>(row.j)];
    expect_near("B - Gi·V_i - Gj·V_j - Σ λ after the update [m/s]", "Eq. (4.6)",
                row.B - row.Gi.dot(V_i) - row.Gj.dot(V_j) - row.Sigma * row.lambda, 0, roundings(500, 20));
  }
}

EXERCISE_TEST(Residual, VanishesWhereEliminationEnds) {
  Tangle t(4, 8);
  const Eigen::VectorXd lambda = solution_of(dense_S(t.rows), gathered(t.rows, &Row<6>::B));
  for (std::size_t k = 0; k < t.rows.size(); ++k) {
    Row<6>& row = t.rows[k];
    row.lambda = lambda[static_cast<Eigen::Index>(k)];
    t.V[static_cast<std::size_t>(row.i)] += row.lambda * row.MinvGi;
    t.V[static_cast<std::size_t>(row.j)] += row.lambda * row.MinvGj;
  }
  expect_near("residual at the solution [m/s]", "Eq. (4.8)", residual(t.rows, t.V), 0, roundings(1e4, 20));
  t.rows[3].lambda += 1;
  expect_at_least("residual away from it [m/s]", "Eq. (4.8)", residual(t.rows, t.V), 0.4,
                  "Σ = 0.5 alone makes 0.5 of it");
}

EXERCISE_TEST(Solve, AgreesWithElimination) {
  Tangle t(4, 8);
  const Eigen::MatrixXd S = dense_S(t.rows);
  const Eigen::VectorXd expected = solution_of(S, gathered(t.rows, &Row<6>::B));
  const double tolerance = 1e-12;
  const SolveReport report = solve(t.rows, t.V, {.max_sweeps = 100000, .tolerance = tolerance});
  expect_true("it converges", "Eq. (4.9)", report.converged);
  // An update after row k changes its residual by S_kl Δλ_l, with S_ll |Δλ_l| below the tolerance; S has no eigenvalue
  // below Σ = 0.5.
  const double most = 8 * S.norm() / S.diagonal().minCoeff() * tolerance / 0.5;
  expect_near_vector("λ [N s]", "Eq. (4.1)", gathered(t.rows, &Row<6>::lambda), expected,
                     {most, "the tolerance, as S carries it on"});
}

/// Rows with bounds of every kind, whose λ may begin beyond them, and bodies that move.
struct Loose : Tangle {
  Loose(int bodies, int count) : Tangle(bodies, count) {
    for (Row<6>& row : rows) {
      give_any_bounds(random, row);
      row.lambda = random.uniform(-0.5, 0.5);
    }
    for (Twist<6>& velocity : V) velocity = random.twist(0.5);
  }
};

double lacks(const Row<6>& row, const std::vector<Twist<6>>& V) {
  return row.B - row.Gi.dot(V[static_cast<std::size_t>(row.i)]) -
         row.Gj.dot(V[static_cast<std::size_t>(row.j)]) - row.Sigma * row.lambda;
}

double projected(const Row<6>& row, const std::vector<Twist<6>>& V) {
  const double wanted = row.lambda + lacks(row, V) / row.diagonal;
  return wanted < row.lo ? row.lo : wanted > row.hi ? row.hi : wanted;
}

/// Updates a row; returns S_kk |Δλ|.
double expected_update(Row<6>& row, std::vector<Twist<6>>& V) {
  const double change = projected(row, V) - row.lambda;
  V[static_cast<std::size_t>(row.i)] += change * row.MinvGi;
  V[static_cast<std::size_t>(row.j)] += change * row.MinvGj;
  row.lambda += change;
  return row.diagonal * std::abs(change);
}

void expect_same_state(const std::string& equation, const Tangle& got, const Tangle& expected, double count) {
  for (std::size_t k = 0; k < expected.rows.size(); ++k)
    expect_near("λ of row " + std::to_string(k) + " [N s]", equation, got.rows[k].lambda,
                expected.rows[k].lambda, roundings(count, 5));
  for (std::size_t b = 0; b < expected.V.size(); ++b)
    expect_near_vector("V of body " + std::to_string(b), equation, got.V[b], expected.V[b],
                       roundings(count, 20));
}

EXERCISE_TEST(MakeRow, CarriesEveryNumber) {
  Loose t(5, 40);
  t.motion.inverse_mass[2] = {};  // a static body
  for (Constraint<6>& c : t.constraints) {
    c.lo = t.random.uniform(-2, 0), c.hi = t.random.uniform(0, 2);
    c.spook.Sigma = t.random.log_uniform(1e-12, 1);
    const auto i = static_cast<std::size_t>(c.i), j = static_cast<std::size_t>(c.j);
    const Motion<6>& all = t.motion;
    const Row<6> row = make_row(c, all);
    const auto response = [&](std::size_t b, const Twist<6>& G) {
      return twist(all.inverse_mass[b].linear * G.head<3>(), all.inverse_mass[b].angular * G.tail<3>());
    };
    expect_true("i, j, lo and hi are the constraint's, and λ is 0", "Eq. (4.1)",
                row.i == c.i && row.j == c.j && row.lo == c.lo && row.hi == c.hi && row.lambda == 0);
    expect_near_vector("M⁻¹Gi", "Eq. (4.3)", row.MinvGi, response(i, c.Gi), roundings(32, 10));
    expect_near_vector("M⁻¹Gj", "Eq. (4.3)", row.MinvGj, response(j, c.Gj), roundings(32, 10));
    expect_near_vector("Gi", "Eq. (4.2)", row.Gi, c.Gi, {0, "a copy"});
    expect_near_vector("Gj", "Eq. (4.2)", row.Gj, c.Gj, {0, "a copy"});
    expect_near("Σ [1/kg]", "Eq. (3.6)", row.Sigma, c.spook.Sigma, {0, "a copy"});
    expect_near("S_kk [1/kg]", "Eq. (4.3)", row.diagonal,
                c.Gi.dot(response(i, c.Gi)) + c.Gj.dot(response(j, c.Gj)) + c.spook.Sigma, roundings(64, 20));
    const double GW = c.Gi.dot(all.W[i]) + c.Gj.dot(all.W[j]), GWf = c.Gi.dot(all.Wf[i]) + c.Gj.dot(all.Wf[j]);
    expect_near("B [m/s]", "Eq. (4.4)", row.B, -c.spook.a * c.gap - c.spook.b * GW - GWf, roundings(64, 10));
  }
}

EXERCISE_TEST(ApplyImpulse, MovesTwoBodiesAndNoOther) {
  Loose t(6, 20);
  for (const Row<6>& row : t.rows)
    for (const double delta : {0.7, -0.7, 1e-13, 0.0}) {
      std::vector<Twist<6>> expected = t.V;
      expected[static_cast<std::size_t>(row.i)] += delta * row.MinvGi;
      expected[static_cast<std::size_t>(row.j)] += delta * row.MinvGj;
      apply_impulse(row, delta, t.V);
      for (std::size_t b = 0; b < expected.size(); ++b)
        expect_near_vector("V of body " + std::to_string(b), "Eq. (4.5)", t.V[b], expected[b], roundings(2, 1));
    }
}

EXERCISE_TEST(UpdateRow, ProjectsOnAnyBounds) {
  Loose t(4, many);
  Loose expected = t;
  for (std::size_t k = 0; k < t.rows.size(); ++k) {
    const double before = t.rows[k].lambda;
    expected_update(expected.rows[k], expected.V);
    expect_near("Δλ, which is returned [N s]", "Eq. (4.7)", update_row(t.rows[k], t.V),
                expected.rows[k].lambda - before, roundings(1e4, 5));
  }
  expect_same_state("Eq. (4.7)", t, expected, 1e4);
  t.rows[0].B = std::nan("");
  expect_true("a NaN stays one", "Eq. (4.7)", std::isnan(update_row(t.rows[0], t.V)));
}

EXERCISE_TEST(Sweep, IsItsUpdatesInTheirOrder) {
  Loose t(12, many);
  Loose expected = t;
  double most = 0;
  for (Row<6>& row : expected.rows) most = std::max(most, expected_update(row, expected.V));
  expect_near("the largest S_kk |Δλ|, which is returned [m/s]", "Eq. (4.9)", sweep(t.rows, t.V), most,
              roundings(1e5, 20));
  expect_same_state("Eq. (4.2)", t, expected, 1e5);
  t.rows[5].B = std::nan("");
  expect_true("a NaN stays one", "Eq. (4.9)", std::isnan(sweep(t.rows, t.V)));
}

EXERCISE_TEST(Residual, IsTheLargestChangeOfAnyRow) {
  for (int seed = 0; seed < 10; ++seed) {
    Loose t(5, 3 * seed + 1);
    double most = 0;
    for (const Row<6>& row : t.rows)
      most = std::max(most, row.diagonal * std::abs(projected(row, t.V) - row.lambda));
    expect_near("residual [m/s]", "Eq. (4.8)", residual(t.rows, t.V), most, roundings(200, 20));
  }
}

EXERCISE_TEST(Solve, EndsByTheRuleOrNotAtAll) {
  expect_stops_by_the_rule("Eq. (4.9)", 20, [](const StopRule& stop) {
    Tangle t(4, 8);
    return solve(t.rows, t.V, stop);
  });
  Tangle t(4, 8);
  const auto state = state_of(t.rows, t.V);
  expect_rejects(
      "max_sweeps = 0", "max_sweeps", [&] { solve(t.rows, t.V, {.max_sweeps = 0}); }, "", state);
  expect_rejects(
      "tolerance = -1", "tolerance", [&] { solve(t.rows, t.V, {.tolerance = -1}); }, "", state);
  std::vector<Row<6>> none;
  const SolveReport report = solve(none, t.V, {});
  expect_true("no rows are solved by no sweep", "Eq. (4.9)", report.converged && report.history.empty());
}

EXERCISE_TEST(Solve, GoesOnFromWhereItIs) {
  Loose t(4, 30);
  Loose by_hand = t;
  std::vector<double> history;
  for (int k = 0; k < 7; ++k) history.push_back(sweep(by_hand.rows, by_hand.V));
  const SolveReport report = solve(t.rows, t.V, {.max_sweeps = 7});
  expect_same_state("Eq. (4.9)", t, by_hand, 8);
  expect_true("history has what each sweep returned", "Eq. (4.9)", report.history == history);
}

EXERCISE_TEST(StepContacts, IsAStepOfAllRows) {
  Random random;
  auto drawn = crowd(random, 20, 60);
  auto& all = drawn.all;
  auto& contacts = drawn.contacts;
  open_every_third(contacts);
  all.max_sweeps = 7;
  const double h = random.uniform(0.05, 0.1);
  Simulation got = all;
  step_contacts(got, contacts, h);
  expect_same_bodies("after a step with many contacts", "Eq. (4.4), (4.7)", got, assembled(all, contacts, h),
                     {1e-10, "roundings of 7 sweeps over some 90 rows, of impulses up to 100"});
  all.max_sweeps = 0;
  expect_rejects(
      "max_sweeps = 0", "max_sweeps", [&, some = contacts] { step_contacts(all, some, h); }, "",
      [&] { return state_of(all); });
}

}  // namespace
