// Beyond chapter 09's own tests: any size, any heading, many contacts between other rows.
#include <numbers>

#include "09_better_friction/better_friction.hpp"
#include "dense_rows.hpp"
#include "exercise_test.hpp"
#include "stages.hpp"
#include "stop_rule.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(SlidingTangents, "9.1 sliding_tangents");
EXERCISE(LimitFriction, "9.2 limit_friction");
EXERCISE(OntoDisc, "9.4 onto_disc");
EXERCISE(TwoPassSolve, "9.3 two_pass_solve");
EXERCISE(UpdateFriction, "9.5 update_friction");
EXERCISE(SweepOnCones, "9.6 sweep_on_cones");
EXERCISE(ResidualOnCones, "9.7 residual_on_cones");
EXERCISE(ConeSolve, "9.8 cone_solve");
EXERCISE(StepRows, "9.9 step_rows");

EXERCISE_TEST(SlidingTangents, FollowTheSlip) {
  Random random;
  const Vec3 n = random.unit_vector(), u = random.vector_of_length(1, 5);
  const Vec3 along = u - u.dot(n) * n;
  if (along.norm() < 0.1) return;
  const Tangents t = sliding_tangents(n, u, 1e-6);
  expect_near_vector("t1", "Eq. (9.2)", t.t1, Vec3(along.normalized()), roundings(64 / along.norm(), 5));
  expect_near_vector("t2", "Eq. (9.2)", t.t2, Vec3(n.cross(along.normalized())),
                     roundings(64 / along.norm(), 5));
}

EXERCISE_TEST(OntoDisc, DoesNotAskHowLargeAnImpulseIs) {
  Random random;
  const double along = random.uniform(1, 3);
  const Vec2 lambda(along, random.uniform(-3, -1));
  const double radius = random.uniform(0.2, 1);
  for (const double size : {1e-100, 1e-8, 1e8, 1e100}) {
    const Vec2 got = onto_disc(size * lambda, size * radius) / size;
    expect_near_vector("λ_t over its size", "Eq. (9.4)", got, Vec2(radius * lambda.normalized()),
                       roundings(32, 1));
  }
}

struct Thrown {
  Motion<3> motion;
  std::vector<Row<3>> rows;
  std::vector<FrictionContact> contacts;
  std::vector<Twist<3>> V{Twist<3>::Zero(), Twist<3>::Zero()};
  double m, mu, h = 0.01, heading;

  /// A point mass on the floor, thrown along it.
  Thrown(Random& random, double speed) {
    m = random.uniform(0.5, 5);
    mu = random.uniform(0.1, 0.8);
    heading = random.uniform(0, 2 * std::numbers::pi);
    motion.inverse_mass = {{.linear = 0}, {.linear = 1 / m}};
    motion.W = {Vec3::Zero(), speed * Vec3(std::cos(heading), std::sin(heading), 0)};
    motion.Wf = {Vec3::Zero(), Vec3(0, 0, -h * 9.81)};
    for (const Vec3& axis : {Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, 1, 0)}) {
      const bool normal = axis.z() > 0;
      rows.push_back(make_row<3>({.i = 0,
                                  .j = 1,
                                  .Gi = -axis,
                                  .Gj = axis,
                                  .gap = 0,
                                  .spook = {.a = 0, .b = 1, .Sigma = 0},
                                  .lo = normal ? 0 : -infinity,
                                  .hi = infinity},
                                 motion));
    }
    contacts = {{.normal = 0, .mu = mu}};
  }

  void expect_coulomb(double speed) const {
    const double held = std::min(m * speed, mu * m * 9.81 * h);
    expect_near("λ_n [N s]", "Eq. (9.3)", rows[0].lambda, m * 9.81 * h, roundings(64, m));
    expect_near("λ_t along x [N s]", "Eq. (9.3)", rows[1].lambda, -held * std::cos(heading),
                roundings(200, m * (speed + 1)));
    expect_near("λ_t along y [N s]", "Eq. (9.3)", rows[2].lambda, -held * std::sin(heading),
                roundings(200, m * (speed + 1)));
  }
};

EXERCISE_TEST(ConeSolve, BrakesEveryHeadingAlike) {
  Random random;
  for (int k = 0; k < 20; ++k)
    for (const double speed : {0.001, 3.0}) {  // it stops, and it slides on
      Thrown t(random, speed);
      cone_solve(t.contacts, t.rows, t.V, {.max_sweeps = 50, .tolerance = 1e-15});
      t.expect_coulomb(speed);
    }
}

EXERCISE_TEST(TwoPassSolve, StopsWhatIsSlow) {
  Random random;
  for (int k = 0; k < 20; ++k) {
    Thrown t(random, 0.001);
    two_pass_solve(t.contacts, t.rows, t.V, {.max_sweeps = 50, .tolerance = 1e-15});
    t.expect_coulomb(0.001);
  }
}

/// Contacts of many bodies, with rows of any λ, between rows of joints.
struct RoughSystem {
  Random random;
  Motion<6> motion;
  std::vector<Row<6>> rows;
  std::vector<FrictionContact> contacts;
  std::vector<Twist<6>> V;

  explicit RoughSystem(int count) {
    for (int b = 0; b < 10; ++b) {
      motion.inverse_mass.push_back(random_body(random));
      motion.W.push_back(random.twist());
      motion.Wf.push_back(random.twist(0.2));
      V.push_back(random.twist(0.2));
    }
    const SpookParameters soft{.a = 4, .b = 0.8, .Sigma = 0.3}, rub{.a = 0, .b = 1, .Sigma = 0.01};
    for (int k = 0; k < count; ++k) {
      const int i = random.integer(0, 9), step = random.integer(1, 9);
      Contact c{.i = i,
                .j = (i + step) % 10,
                .n = random.unit_vector(),
                .gap = -0.05,
                .r_i = random.vector(),
                .r_j = random.vector()};
      if (k % 4 != 3)
        contacts.push_back({.normal = rows.size(), .mu = k % 5 == 4 ? 0 : random.uniform(0.1, 1)});
      const Tangents t = tangents(c.n);
      for (const Vec3& along : {c.n, t.t1, t.t2}) {
        const bool normal = along == c.n;
        const ContactJacobian G = contact_jacobian({c.i, c.j, along, c.gap, c.r_i, c.r_j});
        rows.push_back(make_row<6>({.i = c.i,
                                    .j = c.j,
                                    .Gi = G.Gi,
                                    .Gj = G.Gj,
                                    .gap = normal ? c.gap : 0,
                                    .spook = normal ? soft : rub,
                                    .lo = normal ? 0 : -infinity,
                                    .hi = infinity},
                                   motion));
        rows.back().lambda = random.uniform(normal ? 0 : -0.5, 0.5);
        if (k % 4 == 3) break;  // one row of something else
      }
    }
  }

  double lacks(const Row<6>& row) const {
    return row.B - row.Gi.dot(V[static_cast<std::size_t>(row.i)]) -
           row.Gj.dot(V[static_cast<std::size_t>(row.j)]) - row.Sigma * row.lambda;
  }
  double stiffest(std::size_t k) const {
    const Row<6>&a = rows[k + 1], &b = rows[k + 2];
    const double S12 = a.Gi.dot(b.MinvGi) + a.Gj.dot(b.MinvGj);
    return (a.diagonal + b.diagonal) / 2 + std::hypot((a.diagonal - b.diagonal) / 2, S12);
  }
  /// Both tangential impulses after the next update: Eq. (9.6).
  Vec2 next(const FrictionContact& c) const {
    const double s = stiffest(c.normal), radius = c.mu * rows[c.normal].lambda;
    Vec2 wanted;
    for (int a = 0; a < 2; ++a) {
      const Row<6>& row = rows[c.normal + 1 + static_cast<std::size_t>(a)];
      wanted[a] = row.lambda + lacks(row) / s;
    }
    return wanted.norm() <= radius ? wanted : Vec2(wanted.normalized() * radius);
  }
  Vec2 friction(const FrictionContact& c) const {
    return {rows[c.normal + 1].lambda, rows[c.normal + 2].lambda};
  }
  /// Makes the update by hand; returns what it lacked.
  double rub(const FrictionContact& c) {
    const Vec2 to = next(c), change = to - friction(c);
    for (int a = 0; a < 2; ++a) {
      Row<6>& row = rows[c.normal + 1 + static_cast<std::size_t>(a)];
      V[static_cast<std::size_t>(row.i)] += change[a] * row.MinvGi;
      V[static_cast<std::size_t>(row.j)] += change[a] * row.MinvGj;
      row.lambda = to[a];
    }
    return stiffest(c.normal) * change.norm();
  }
  const FrictionContact* of(std::size_t row) const {
    for (const FrictionContact& c : contacts)
      if (c.normal == row) return &c;
    return nullptr;
  }
  double sweep_by_hand() {
    double most = 0;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const Row<6>& row = rows[k];
      most = std::max(most, row.diagonal * std::abs(update_row(rows[k], V)));
      if (const FrictionContact* c = of(k)) most = std::max(most, rub(*c)), k += 2;
    }
    return most;
  }
  void expect_same(const std::string& equation, const RoughSystem& expected, double tolerance) const {
    for (std::size_t k = 0; k < rows.size(); ++k)
      expect_near("λ of row " + std::to_string(k) + " [N s]", equation, rows[k].lambda, expected.rows[k].lambda,
                  {tolerance, "roundings of the rows before"});
    for (std::size_t b = 0; b < V.size(); ++b)
      expect_near_vector("V of body " + std::to_string(b), equation, V[b], expected.V[b],
                         {10 * tolerance, "roundings of the rows before"});
  }
};

EXERCISE_TEST(SlidingTangents, FallBackWhereNothingSlides) {
  Random random;
  for (const double speed : {0.0, 1e-9, 1e-3, 1.0}) {
    const Vec3 n = random.unit_vector(), way = random.unit_vector();
    const Vec3 u = speed * n.cross(way).normalized() - 2 * n;
    const Tangents t = sliding_tangents(n, u, 1e-4);
    expect_near_vector("t1 × t2", "Eq. (5.1)", Vec3(t.t1.cross(t.t2)), n, roundings(64));
    expect_near("|t1|", "Eq. (5.1)", t.t1.norm(), 1, roundings(16));
    const Vec3 expected = speed > 1e-4 ? Vec3(n.cross(way).normalized()) : tangents(n).t1;
    expect_near_vector("t1", "Eq. (9.2)", t.t1, expected, {1e-11, "roundings of 2 m/s beside the slip"});
  }
}

EXERCISE_TEST(LimitFriction, GivesEachContactItsOwnBounds) {
  RoughSystem t(40);
  const RoughSystem before = t;
  limit_friction(t.contacts, t.rows);
  for (std::size_t k = 0; k < t.rows.size(); ++k) {
    double lo = before.rows[k].lo, hi = before.rows[k].hi;
    for (const FrictionContact& c : t.contacts)
      if (k == c.normal + 1 || k == c.normal + 2) hi = c.mu * before.rows[c.normal].lambda, lo = -hi;
    expect_true("bounds of row " + std::to_string(k) + " are ∓ μ λ_n for friction, and others stay",
                "Eq. (9.1)", t.rows[k].lo == lo && t.rows[k].hi == hi);
    expect_true("λ of row " + std::to_string(k) + " stays", "Eq. (9.1)",
                t.rows[k].lambda == before.rows[k].lambda);
  }
}

EXERCISE_TEST(OntoDisc, ChangesNothingInside) {
  Random random;
  for (const double part : {0.0, 1e-9, 0.5, 1.0}) {
    const double angle = random.uniform(0, 6);
    const Vec2 lambda(part * std::cos(angle), part * std::sin(angle));
    expect_near_vector("λ_t inside", "Eq. (9.4)", onto_disc(lambda, 1 + 1e-12), lambda, {0, "it stays"});
    expect_near_vector("λ_t on a disc of no size", "Eq. (9.4)", onto_disc(lambda, 0), Vec2(0, 0),
                       {0, "only 0 is in it"});
  }
  expect_true("a NaN stays one", "Eq. (9.4)", onto_disc(Vec2(std::nan(""), 0), 1).hasNaN());
}

EXERCISE_TEST(UpdateFriction, MovesBothRowsTogether) {
  RoughSystem t(40);
  RoughSystem expected = t;
  for (const FrictionContact& c : t.contacts)
    expect_near("s |Δλ_t|, which is returned [m/s]", "Eq. (9.6)", update_friction(c, t.rows, t.V),
                expected.rub(c), {1e-11, "roundings of the contacts before"});
  t.expect_same("Eq. (9.5), (9.6)", expected, 1e-11);
}

EXERCISE_TEST(SweepOnCones, IsItsUpdatesInTheirOrder) {
  RoughSystem t(40);
  RoughSystem expected = t;
  expect_near("the largest change, which is returned [m/s]", "Eq. (9.6)",
              sweep_on_cones(t.contacts, t.rows, t.V), expected.sweep_by_hand(),
              {1e-11, "roundings of a sweep"});
  t.expect_same("Eq. (4.7), (9.6)", expected, 1e-11);
  t.rows[4].B = std::nan("");
  expect_true("a NaN stays one", "Eq. (9.7)", std::isnan(sweep_on_cones(t.contacts, t.rows, t.V)));
}

EXERCISE_TEST(ResidualOnCones, IsWhatTheNextUpdateWouldChange) {
  for (int count = 1; count < 40; count += 3) {
    RoughSystem t(count);
    for (int sweeps = 0; sweeps < 3; ++sweeps) {
      double most = 0;
      for (std::size_t k = 0; k < t.rows.size(); ++k) {
        const Row<6>& row = t.rows[k];
        const double to = std::max(row.lo, std::min(row.hi, row.lambda + t.lacks(row) / row.diagonal));
        most = std::max(most, row.diagonal * std::abs(to - row.lambda));
        if (const FrictionContact* c = t.of(k))
          most = std::max(most, t.stiffest(k) * (t.next(*c) - t.friction(*c)).norm()), k += 2;
      }
      expect_near("residual [m/s]", "Eq. (9.7)", residual_on_cones(t.contacts, t.rows, t.V), most,
                  {1e-11, "roundings"});
      t.sweep_by_hand();
    }
  }
}

EXERCISE_TEST(ConeSolve, StopsByTheRuleAndGoesOn) {
  RoughSystem t(20);
  RoughSystem expected = t;
  std::vector<double> history;
  for (int k = 0; k < 5; ++k) history.push_back(expected.sweep_by_hand());
  const SolveReport report = cone_solve(t.contacts, t.rows, t.V, {.max_sweeps = 5});
  t.expect_same("Eq. (9.6)", expected, 1e-10);
  expect_true("it makes 5 sweeps, and has not converged", "Eq. (4.9)",
              std::ssize(report.history) == 5 && !report.converged);
  expect_stops_by_the_rule("Eq. (4.9)", 20, [](const StopRule& stop) {
    RoughSystem fresh(20);
    return cone_solve(fresh.contacts, fresh.rows, fresh.V, stop);
  });
  expect_rejects(
      "max_sweeps = 0", "max_sweeps", [&] { cone_solve(t.contacts, t.rows, t.V, {.max_sweeps = 0}); }, "",
      state_of(t.rows, t.V));
  expect_rejects(
      "tolerance = -1", "tolerance", [&] { cone_solve(t.contacts, t.rows, t.V, {.tolerance = -1}); }, "",
      state_of(t.rows, t.V));
}

EXERCISE_TEST(TwoPassSolve, IsTwoSolvesWithLimitsBetween) {
  RoughSystem t(20);
  RoughSystem expected = t;
  const StopRule stop{.max_sweeps = 6, .tolerance = 0};
  for (const FrictionContact& c : expected.contacts)
    for (const std::size_t k : {c.normal + 1, c.normal + 2}) {
      Row<6>& row = expected.rows[k];
      apply_impulse(row, -row.lambda, expected.V);
      row.lambda = row.lo = row.hi = 0;
    }
  solve(expected.rows, expected.V, stop);
  for (const FrictionContact& c : expected.contacts)
    for (const std::size_t k : {c.normal + 1, c.normal + 2})
      expected.rows[k].hi = c.mu * expected.rows[c.normal].lambda, expected.rows[k].lo = -expected.rows[k].hi;
  solve(expected.rows, expected.V, stop);
  const SolveReport report = two_pass_solve(t.contacts, t.rows, t.V, stop);
  t.expect_same("Eq. (9.1), (9.3)", expected, 1e-10);
  expect_true("the history has the sweeps of both passes", "Eq. (4.9)", std::ssize(report.history) == 12);
  expect_rejects(
      "max_sweeps = 0", "max_sweeps", [&] { two_pass_solve(t.contacts, t.rows, t.V, {.max_sweeps = 0}); }, "",
      state_of(t.rows, t.V));
}

// With the sweeps of chapter 04 between its halves, the step is chapter 07's, with and without friction and impacts.
EXERCISE_TEST(StepRows, AreThoseOfAnyCrowd) {
  Random random;
  const double h = 0.01;
  for (int n = 0; n < 8; ++n) {
    auto [all, contacts] = crowd(random, 9, 15);
    open_every_third(contacts);
    all.mu = n % 2 == 0 ? 0.7 : 0;
    all.viscosity = 400;
    all.restitution = n % 4 < 2 ? 0.8 : 0;
    for (int k = 0; k < 3; ++k) {
      all.joints.push_back({k, k + 5, random.vector(0.2), random.vector(0.2)});
      all.joints.back().length = k == 1 ? 0.7 : 0;
      all.joints.back().d = random.uniform(2, 4);
    }
    Simulation half = all, expected = all;
    StepRows step = step_rows(half, contacts, h);
    const std::size_t of_joints = 3 + 1 + 3, each = all.mu > 0 ? 3 : 1;
    expect_true("a row for each held direction, and one or three for each contact", "Eq. (6.6)",
                step.rows.size() == of_joints + each * contacts.size());
    expect_true("each contact with friction has its place", "Eq. (9.1)",
                step.friction.size() == (all.mu > 0 ? contacts.size() : 0));
    for (std::size_t c = 0; c < step.friction.size(); ++c)
      expect_true("contact " + std::to_string(c) + " has its rows where friction says", "Eq. (9.1)",
                  step.friction[c].normal == of_joints + 3 * c && step.friction[c].mu == all.mu);
    for (std::size_t b = 0; b < all.bodies.size(); ++b)
      expect_true("no body moves before the solver", "Eq. (5.8)", half.bodies[b].x == all.bodies[b].x);
    std::vector<Twist<6>> V(all.bodies.size(), Twist<6>::Zero());
    solve(step.rows, V, {.max_sweeps = all.max_sweeps, .tolerance = all.tolerance});
    finish_step(half, V, h);
    step_impacts(expected, contacts, h);
    expect_same_bodies("after the step", "Eq. (7.9)", half, expected,
                       {1e-9, "roundings of some passes and 5 sweeps, of impulses up to 100"});
  }
}

}  // namespace
