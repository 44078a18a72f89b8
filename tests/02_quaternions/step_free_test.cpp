// The step of bodies without contacts: each moves by itself, and exactly where only gravity acts.
#include "contract.hpp"
#include "simulations.hpp"
#include "top.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(StepFree, "2.7 step_free");

/// Returns so many bodies: tops, balls, point masses, and static bodies among them. Some tops are nearly balls, and
/// some have two equal moments.
Simulation bodies_of_all_kinds(Random& random, int count) {
  Simulation all;
  all.gravity = random.vector(5, 10);
  for (int b = 0; b < count; ++b) {
    RigidBody body = b % 4 == 3 ? random_static_body(random) : random_rigid_body(random);
    if (b % 4 == 1) body.principal = Vec3::Constant(body.principal[0]);
    if (b % 4 == 2) body.principal = body.omega = Vec3::Zero();
    if (b % 12 == 0) body.principal = body.principal[0] * Vec3(1, 1.0005, 0.9998);
    if (b % 12 == 4) body.principal[(b / 12) % 3] = body.principal[(b / 12 + 1) % 3];
    all.bodies.push_back(body);
  }
  return all;
}

/// The step, made of the functions of chapters 01 and 02, with switches for known mistakes.
struct Way {
  bool drifts_first = false, splits_balls = false, splits_tops = true, splits_near_balls = true;
  bool splits_symmetric_tops = true;
  int compared = -1;      ///< this moment with the next one, and no others
  int not_compared = -1;  ///< one of the two other pairs of moments is enough
  double drifts_by = 1, turns_by = 1;
};

void turn(RigidBody& body, const Way& way, double h) {
  if (body.principal == Vec3::Zero()) return;
  const Vec3& I = body.principal;
  const bool is_near = I.maxCoeff() < 1.001 * I.minCoeff(),
             is_symmetric = I[0] == I[1] || I[1] == I[2] || I[2] == I[0],
             are_equal = way.compared >= 0 && I[way.compared] == I[(way.compared + 1) % 3];
  const auto are_equal_from = [&](int k) { return k != way.not_compared && I[k] == I[(k + 1) % 3]; };
  const bool one_is_enough =
      way.not_compared >= 0 && (are_equal_from(0) || are_equal_from(1) || are_equal_from(2));
  const bool is_round = I == Vec3::Constant(I[0]) || (is_near && !way.splits_near_balls) ||
                        (is_symmetric && !way.splits_symmetric_tops) || are_equal || one_is_enough;
  if (is_round ? way.splits_balls : way.splits_tops)
    free_rotation(body.q, body.omega, body.principal, h);
  else
    body.q = update_exponential(body.q, body.omega, h);
}

Simulation moved(Simulation all, double h, const Way& way = {}) {
  for (RigidBody& body : all.bodies) {
    if (body.mass == 0) continue;
    const Vec3 before = body.v;
    body.v += h * all.gravity;
    body.x += way.drifts_by * h * (way.drifts_first ? before : body.v);
    turn(body, way, way.turns_by * h);
  }
  return all;
}

const Tolerance of_a_step = roundings(64, 20);

EXERCISE_TEST(StepFree, MovesEachBodyByItself) {
  Random random;
  const Simulation before = bodies_of_all_kinds(random, many);
  const double h = 0.1;
  Simulation got = before;
  step_free(got, h);

  const std::string two_of_three =
      "This turns a body by Eq. (2.6) of which two moments are equal: only three equal ones make it a ball.";
  Simulation heavy = moved(before, h), fixed_fall = heavy;
  for (std::size_t b = 0; b < before.bodies.size(); ++b) {
    RigidBody& body = heavy.bodies[b];
    if (body.mass == 0) {
      fixed_fall.bodies[b].v += h * before.gravity;
      fixed_fall.bodies[b].x += h * fixed_fall.bodies[b].v;
      continue;
    }
    body.v = before.bodies[b].v + h * body.mass * before.gravity;
    body.x = before.bodies[b].x + h * body.v;
  }
  expect_same_bodies(
      "of 100 after a step of 0.1 s", "Eq. (1.3), (1.4), (2.6), (2.11)", got, moved(before, h), of_a_step,
      {{before,
        "Nothing has changed. Does the step move a copy of the body (auto body, where auto& body is meant)?"},
       {moved(before, h, {.drifts_first = true}), "This drifts with the velocity before the kick: kick first."},
       {moved(before, h, {.splits_tops = false}),
        "This turns a top as if its ω were constant, by Eq. (2.6): three different moments need Eq. (2.11)."},
       {moved(before, h, {.splits_near_balls = false}),
        "This turns a body by Eq. (2.6) whose moments differ by less than a thousandth: they are not equal, "
        "and its ω changes."},
       {moved(before, h, {.splits_symmetric_tops = false}), two_of_three},
       {moved(before, h, {.not_compared = 0}), two_of_three},
       {moved(before, h, {.not_compared = 1}), two_of_three},
       {moved(before, h, {.not_compared = 2}), two_of_three},
       {moved(before, h, {.compared = 0}), "This compares I1 and I2 only: a ball has I3 equal to these, too."},
       {moved(before, h, {.compared = 1}), "This compares I2 and I3 only: a ball has I1 equal to these, too."},
       {moved(before, h, {.compared = 2}), "This compares I1 and I3 only: a ball has I2 equal to these, too."},
       {moved(before, h, {.splits_balls = true}),
        "This turns a ball by Eq. (2.11), which is of second order where Eq. (2.6) is exact."},
       {moved(before, h, {.turns_by = 0}), "It has not turned."},
       {moved(before, h, {.turns_by = 2}), "It has turned twice."},
       {moved(before, h, {.drifts_by = 0}), "It has not drifted."},
       {moved(before, h, {.drifts_by = 2}), "It has drifted twice."},
       {heavy, "The inverse mass has not been used: Eq. (1.3) multiplies the force m g by 1/m."},
       {fixed_fall, "A body with mass 0 is static: it does not fall."}},
      ends_early);
}

EXERCISE_TEST(StepFree, LeavesAStaticBodyAlone) {
  Random random;
  Simulation all;
  all.bodies = {random_static_body(random)};
  const Simulation before = all;
  step_free(all, 0.1);
  expect_same_bodies("after a step, static", "Eq. (1.3)", all, before, {0, "nothing is computed"}, {},
                     "A static body has mass 0. Skip it, so that no division by 0 reaches it.");
  all.bodies[0].v = random.vector(1, 2);
  all.bodies[0].omega = random.vector(1, 2);
  const Simulation belt = all;
  step_free(all, 0.1);
  expect_same_bodies("after a step, static, though it has a velocity and an angular velocity", "Eq. (1.3)", all,
                     belt, {0, "nothing is computed"}, {},
                     "A static body does not move, nor turn. Its velocity only drives what touches it.");
}

// A point mass has no moments: nothing divides by them.
EXERCISE_TEST(StepFree, TurnsNoPointMass) {
  Random random;
  Simulation all;
  all.bodies = {random_rigid_body(random)};
  all.bodies[0].principal = Vec3::Zero();
  for (const Vec3& omega : {Vec3::Zero().eval(), random.vector(1, 5)}) {
    all.bodies[0].omega = omega;
    const Quat before = all.bodies[0].q;
    step_free(all, 0.1);
    expect_true("q and ω of a point mass stay as they were", "Eq. (2.11)",
                all.bodies[0].q.coeffs() == before.coeffs() && all.bodies[0].omega == omega,
                "A point mass has moments of zero, so I⁻¹ would be infinite. Leave out its rotation.");
  }
}

// From rest, n steps fall by g h² n(n+1)/2, Eq. (1.7). A falling top conserves L.
EXERCISE_TEST(StepFree, FallsExactlyAndKeepsAngularMomentum) {
  const double h = 0.02;
  const int n = 1000;
  const Top start = tumbling_top();
  Simulation all;
  all.bodies = {{.q = start.q, .omega = start.omega, .mass = 2, .principal = start.principal}};
  for (int k = 0; k < n; ++k) step_free(all, h);
  const RigidBody& body = all.bodies[0];
  const double fall = 9.81 * h * h * n * (n + 1) / 2;
  expect_near("height of a tumbling body after 1000 steps from rest [m]", "Eq. (1.7)", body.x.z(), -fall,
              roundings(4 * n, fall),
              {{-fall * (n - 1) / (n + 1), "It drifts with the velocity before the kick."}},
              "The fall does not depend on the rotation.");
  expect_near_vector<Vec3>(
      "L of a tumbling body after 1000 steps [kg m²/s]", "Eq. (2.11)",
      Top{start.principal, body.q, body.omega}.L(), start.L(), roundings(16.0 * n, 2), {},
      "No torque acts, and free_rotation conserves L = I ω. Does something else change ω?");
  expect_at_least("distance from the start in q and ω", "Eq. (2.11)",
                  distance({start.principal, body.q, body.omega}, start), 0.01, "half of its period of 39 s",
                  "It does not turn.");
}

// The motion of a top that also falls, against Runge-Kutta steps of its quaternion.
EXERCISE_TEST(StepFree, IsOfSecondOrderOnATop) {
  const Top start{Vec3(2, 3, 4), Quat(0.5, 0.5, -0.5, 0.5), Vec3(0.5, 1, 0.7)};
  const double time = 5;
  const Top end = true_motion(start, time, 4000);  // whose own error is (h ω)⁴, some 1e-11
  const auto error = [&](double h) {
    Simulation all;
    all.bodies = {{.q = start.q, .omega = start.omega, .mass = 2, .principal = start.principal}};
    for (int k = 0; k < std::lround(time / h); ++k) step_free(all, h);
    return distance({start.principal, all.bodies[0].q, all.bodies[0].omega}, end);
  };
  expect_second_order(
      "a top that falls, error of q and ω at t = 5 s", "Eq. (2.11)", error, 0.05, 1e-10,
      "Order 1: a body with three moments turns by free_rotation. Order 0: it does not turn with h.");
}

EXERCISE_TEST(StepFree, RejectsAStepThatIsNotPositive) {
  Random random;
  Simulation all = bodies_of_all_kinds(random, 4);
  for (const double h : {0.0, -0.1, std::nan(""), HUGE_VAL})
    expect_rejects(
        "h = " + show(h), "h", [&] { step_free(all, h); }, "See require_positive in common/require.hpp.",
        [&] { return state_of(all); });
  Simulation nobody;
  expect_rejects(
      "h = 0, with no bodies", "h", [&] { step_free(nobody, 0); },
      "Check h first: a step that makes no sense is refused even if there is nothing to move.");
}

EXERCISE_TEST(StepFree, IsTheSameInAnyUnits) {
  Random random;
  const Simulation all = bodies_of_all_kinds(random, 4);
  expect_same_in_any_units("Eq. (1.3), (1.4), (2.6), (2.11)", step_free, units::nothing, all, 0.1 * units::s);
}

}  // namespace
