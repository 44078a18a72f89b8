// Free rotation: what one step turns by, conservation of L, reversal, second order.
#include "relative_scales.hpp"
#include "top.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(FreeRotation, "2.6 free_rotation");

// Uses a step so small that all orders of the turns give the same mean ω, up to a relative error of h|ω|.
EXERCISE_TEST(FreeRotation, TurnsByOmegaTimesStep) {
  Random random;
  const Top start = random_top(random);
  Top top = start;
  const double h = 1e-6;
  top.step(h);
  const Quat turn = start.q.conjugate() * top.q;  // in body coordinates
  const Vec3 got = (turn.w() < 0 ? -2 : 2) * turn.vec() / h;

  const Vec3 right = start.omega_body(), L = start.L(), L_body = start.q.conjugate() * L;
  const double size = right.norm();
  expect_near_vector<Vec3>(
      "mean ω of a step of 1 µs, in body coordinates [rad/s]", "Eq. (2.10), (2.11)", got, right,
      {10 * h * size * size, "ω changes by some h|ω|² within the step"},
      {{Vec3::Zero(), "q has not moved."},
       {2 * right, "Twice too fast: a quaternion takes half the angle."},
       {right / 2, "Half too slow: is the angle halved twice?"},
       {-right, "This body turns backwards."},
       {L.cwiseQuotient(start.principal),
        "L was taken in world coordinates: L_c in Eq. (2.10) is along the body's axis c. Take q* L."},
       {(start.q * L).cwiseQuotient(start.principal),
        "L was turned the wrong way: q takes body to world coordinates, its conjugate takes them back."},
       {L_body, "α = h L_c: divide by the moment I_c."},
       {start.q.conjugate() * right,
        "The turns were multiplied from the left, as if e_c were an axis of the world. A turn about the body's "
        "axis stands right of q."},
       {{2 * right[0], 2 * right[1], right[2]},
        "Axes 1 and 2 have turned by two whole steps: turn each time by h/2."},
       {{right[0] / 2, right[1] / 2, right[2]},
        "Axes 1 and 2 turn by half a step only: the way back is missing."},
       {{right[0], right[1], right[2] / 2}, "Axis 3 has turned by h/2 only. It has one turn, so turn by h."},
       {{right[0], right[1], 2 * right[2]}, "Axis 3 turns by two steps: once is enough, in the middle."}},
      "Axis c turns by h L_c/I_c in total. Does every angle contain h and I_c?");
}

EXERCISE_TEST(FreeRotation, DropsNoSmallTurn) {
  // Starts from q = 1, since the turn is then in the small coefficients of q, which keep all their digits.
  Random random;
  for (const double h : {1e-9, 1e-15, 1e-30}) {
    Top top = random_top(random);
    top.q = Quat::Identity();
    const Vec3 omega = top.omega;
    top.step(h);
    expect_near_vector<Vec3>(
        "turn from q = 1 in a step of " + show(h) + " s, over the step [rad/s]", "Eq. (2.11)",
        Vec3(2 * top.q.vec() / h), omega, {10 * h * omega.squaredNorm() + 1e-13, "h|ω|², and roundings"},
        {{Vec3::Zero(), "This small turn has been dropped. Many small turns add up to a large one."}});
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(FreeRotation, DoesNothingInAZeroStep) {
  Random random;
  const Top start = random_top(random);
  Top top = start;
  top.step(0);
  expect_near("distance from the start, after a step of h = 0", "Eq. (2.11)", distance(top, start), 0,
              roundings(64), {}, "A step of 0 turns nothing. Do not replace it by another step.");
}

EXERCISE_TEST(FreeRotation, KeepsAngularMomentum) {
  Random random;
  const Top start = random_top(random);
  Top top = start;
  top.step(0.3);
  expect_moved(top, start);
  const auto L_with = [&](const Vec3& omega) { return Top{top.principal, top.q, omega}.L(); };
  const Vec3 omega_right = Top{top.principal, top.q, Vec3::Zero()}.q *
                           Vec3((top.q.conjugate() * start.L()).cwiseQuotient(top.principal));
  expect_near_vector<Vec3>(
      "L after a step of 0.3 s [kg m²/s]", "Eq. (2.11)", top.L(), start.L(), roundings(64, 5),
      {{L_with(start.omega), "This is the old ω. L is fixed and q is new, so ω = I⁻¹ L has changed."},
       {L_with(top.q * start.q.conjugate() * start.omega),
        "ω has been turned along with the body. L is fixed in the world, and ω = I⁻¹ L with the new q."},
       {L_with(top.q.conjugate() * omega_right),
        "The new ω is in body coordinates. Return it in world "
        "coordinates."},
       {L_with(world_inertia(top.q, top.principal) * start.L()),
        "This ω is I L: ω = I⁻¹ L takes the inverse moments, world_inertia(q, principal.cwiseInverse())."},
       {Vec3(start.principal.cwiseProduct(start.omega)),
        "L was formed from moments along the body's axes and ω in the world: L = I_world(q) ω."},
       {L_with(top.q.conjugate() * start.omega), "The old ω, in body coordinates, has been returned."}},
      "L in world coordinates is constant during the step. Compute it once, before q changes, and compute ω "
      "from it afterwards.");
}

EXERCISE_TEST(FreeRotation, FollowsTheTrueMotion) {
  Random random;
  const Top start = random_top(random);
  const double time = 2;
  const Top truth = true_motion(start, time, 2000);
  const auto error = [&](double h) { return distance(after(start, time, h), truth); };
  expect_second_order(
      "random top, error of q and ω after 2 s", "Eq. (2.11)", error, 0.1, 1e-10,
      "Order 1: the second half must mirror the first, and each turn needs L in the body coordinates of that "
      "moment. Order 0: this is another motion.");
}

EXERCISE_TEST(FreeRotation, RunsBackToWhereItCameFrom) {
  Random random;
  const Top start = random_top(random);
  Top top = start;
  top.step(0.1);
  expect_moved(top, start);
  for (int n = 1; n < 50; ++n) top.step(0.1);
  for (int n = 0; n < 50; ++n) top.step(-0.1);
  expect_near("distance from the start after 50 steps of 0.1 s forwards and 50 backwards", "Eq. (2.11)",
              distance(top, start), 0,
              {1e-11,
               "100 steps of 16 roundings, times e^(5 s · 0.7/s), the fastest growth of a small "
               "difference"},
              {}, "A symmetric sequence of turns is reversible.");
}

EXERCISE_TEST(FreeRotation, SpinsOnAboutAPrincipalAxis) {
  Random random;
  for (const std::string body : {"", " of a sphere", " of a needle"})
    for (int c = 0; c < 3; ++c) {
      Top top = random_top(random);
      const bool round = body == " of a sphere", thin = body == " of a needle";
      const double ratio = thin ? 1e4 : 1;  // of its moments, by which roundings of L grow
      if (round || thin) top.principal.setConstant(0.4);
      if (thin) top.principal[c] /= ratio;
      const Vec3 axis = top.q * Vec3::Unit(c);
      top.omega = 2 * axis;
      const auto turned = [&](double angle) { return turn_about(axis, angle) * top.q; };
      const Top end = after(top, 1, 0.5);
      expect_near_vector<Vec3>(
          "ω" + body + " after 1 s about the body's axis " + std::to_string(c + 1) + " [rad/s]", "Eq. (2.11)",
          end.omega, top.omega, roundings(64 * 2, 2 * ratio), {},
          "About a principal axis nothing changes: ω stays along L.");
      expect_same_rotation(
          "q" + body + " after two steps of 0.5 s at 2 rad/s about the body's axis " + std::to_string(c + 1) +
              " (w, x, y, z)",
          "Eq. (2.10)", end.q, turned(2), roundings(64 * ratio),
          {{top.q, "It has not turned. A small moment makes α = t L_c/I_c large: no axis is left out."},
           {turned(4), "Twice the angle."},
           {turned(1), "Half the angle."},
           {turned(4 * std::atan(0.5)),
            "This is Eq. (2.4): each step turns by 2 atan(h|ω|/2). The turns of Eq. (2.10) are exact, "
            "also for a sphere."}},
          "About a principal axis this is a plain turn by hω a step, exact for any h: Eq. (2.6).");
    }
}

EXERCISE_TEST(FreeRotation, OfASphereIsAPlainTurn) {
  Random random;
  Top sphere{Vec3::Constant(0.4), random.rotation(), 2 * random.unit_vector()};
  const Top end = after(sphere, 1, 0.1);
  expect_near_vector<Vec3>("ω of a sphere after 1 s [rad/s]", "Eq. (2.8)", end.omega, sphere.omega,
                           roundings(64 * 10, 2), {}, "For a sphere ω = L/I, and L is constant.");
  const auto error = [&](double h) {
    const Quat exact = update_exponential(sphere.q, sphere.omega, 1);
    return distance(after(sphere, 1, h), {sphere.principal, exact, sphere.omega});
  };
  expect_second_order(
      "sphere, distance from the turn by |ω| about ω after 1 s", "Eq. (2.6), (2.11)", error, 0.1, 1e-10,
      "A sphere turns by h|ω| about ω. Turns about three axes in a row approximate this to order 2.");
}

// ω = L/I1 + ω_3 (1 - I3/I1) e_3: the body spins about its axis e_3, and e_3 goes round L at |L|/I1.
EXERCISE_TEST(FreeRotation, OfASymmetricTopPrecesses) {
  Random random;
  Top top = random_top(random);
  top.principal[1] = top.principal[0];
  const double I1 = top.principal[0], I3 = top.principal[2], spin = top.omega_body()[2] * (1 - I3 / I1);
  const double time = 2;
  const Quat precession = turn_about(top.L().normalized(), time * top.L().norm() / I1);
  Top truth = top;
  truth.q = precession * top.q * turn_about(Vec3::UnitZ(), time * spin);
  truth.omega = top.L() / I1 + spin * (truth.q * Vec3::UnitZ());
  const auto error = [&](double h) { return distance(after(top, time, h), truth); };
  expect_second_order("symmetric top, error of q and ω after 2 s", "Eq. (2.8), (2.11)", error, 0.1, 1e-10,
                      "Its axis precesses about L at |L|/I1, at a fixed angle. Order 0 means another speed.");
}

EXERCISE_TEST(FreeRotation, DropsNothingSmall) {
  const double h = 1e-3;
  for (const double part : relative_scales)
    for (const Vec3& omega : lopsided(part)) {
      const Top start{Vec3(2, 3, 4), Quat::Identity(), omega};
      Top top = start;
      top.step(h);
      const std::string of = " of ω = " + show(Eigen::MatrixXd(omega)) + " rad/s";
      expect_near_vector<Vec3>("L after 1 ms" + of + ", less L before [kg m²/s]", "Eq. (2.8)",
                               top.L() - start.L(), Vec3::Zero(), roundings(64, start.L().norm()), {},
                               "In world coordinates each coefficient of L is constant. " + small_is_dropped);
      const Vec3 mean = 2 * top.q.vec() / h;
      for (int c = 0; c < 3; ++c)
        expect_near(
            "mean ω about axis " + std::to_string(c + 1) + " in 1 ms" + of + ", over what it was",
            "Eq. (2.10), (2.11)", mean[c] / omega[c], 1,
            {10 * h, "within the step ω changes by about h|ω|², and its small part by the same fraction"},
            {{0, "It has not turned about this axis. " + small_is_dropped}}, small_is_dropped);
      if (::testing::Test::HasFailure()) return;
    }
}

EXERCISE_TEST(FreeRotation, TakesMomentsInAnyOrder) {
  Random random;
  const double a = 2, b = 3, c = 4, time = 1;
  for (const Vec3& principal : {Vec3(a, b, c),
                                {a, c, b},
                                {b, a, c},
                                {b, c, a},
                                {c, a, b},
                                {c, b, a},
                                {a, a, c},
                                {a, c, a},
                                {c, a, a},
                                {c, c, a},
                                {c, a, c},
                                {a, c, c}}) {
    Top top = random_top(random);
    top.principal = principal;
    const Top truth = true_motion(top, time, 400);
    const auto error = [&](double h) { return distance(after(top, time, h), truth); };
    given() = "given the moments " + show(Eigen::MatrixXd(principal)) + " kg m²";
    expect_second_order("error of q and ω after 1 s", "Eq. (2.11)", error, 0.1, 1e-9,
                        "No axis is special, and two moments may be equal. Each turn takes the moment of its "
                        "own axis.");
    if (::testing::Test::HasFailure()) return;
  }
}

}  // namespace
