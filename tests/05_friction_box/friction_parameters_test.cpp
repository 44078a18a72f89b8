// The three numbers of a friction row: closed forms, and the creep of a body that sticks.
#include "05_friction_box/friction_box.hpp"
#include "exercise_test.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(FrictionParameters, "5.2 friction_parameters");

struct Input {
  Random random;
  double h = random.log_uniform(0.001, 0.03);
  double m = random.log_uniform(0.1, 10);
  double F = random.uniform(1, 20);
  double softness = random.log_uniform(1e-6, 1e-4);  // m Γ
  double c = m / (h * softness);
  std::string text =
      "h = " + show(h) + " s, c = " + show(c) + " N s/m, m = " + show(m) + " kg, F = " + show(F) + " N";
};

// One step of a body of mass m at speed u, to which a force adds u_f: a row with these numbers, and gap 0.
double step(const SpookParameters& spook, double m, double u, double u_f) {
  const double lambda = (-spook.b * u - u_f) / (1 / m + spook.Sigma);
  return u + u_f + lambda / m;
}

const std::string contacts_b =
    "Friction has no gap that decays over several steps. It removes the whole velocity at once: b = 1.";

EXERCISE_TEST(FrictionParameters, WeighNoGap) {
  const Input in;
  expect_near("a [1/s] for " + in.text, "Eq. (5.3)", friction_parameters(in.h, in.c).a, 0, {0, "exact"}, {},
              "A friction row has no gap, since it must not pull a body back to an earlier place: a = 0.");
}

EXERCISE_TEST(FrictionParameters, WeighTheVelocityInFull) {
  const Input in;
  expect_near("b for " + in.text, "Eq. (5.3)", friction_parameters(in.h, in.c).b, 1, {0, "exact"},
              {{0, "With b = 0 the row opposes forces only, and never slows a sliding body."}}, contacts_b);
}

EXERCISE_TEST(FrictionParameters, SoftenByViscosityAndStep) {
  const Input in;
  const double h = in.h, c = in.c;
  const SpookParameters spook = friction_parameters(h, c);
  const std::string contacts = "This is a contact's Σ with c for k. But c is no stiffness: it is in kg/s.";
  const double upsilon = 1 - spook.b;  // a contact's 1/(1 + 4d)
  expect_near(
      "Γ [1/kg] for " + in.text, "Eq. (5.4)", spook.Sigma, 1 / (h * c), roundings(8, 1 / (h * c)),
      {{1 / c, "h is missing. Γ stands beside an inverse mass: c is in kg/s, and c times a time is a mass."},
       {1 / (h * h * c), "This has h², as for a stiffness. c is in kg/s, so h c is a mass."},
       {h / c, "h belongs in the denominator: Γ is in 1/kg."},
       {c / h, "c belongs in the denominator: with more viscosity the creep and Γ are smaller. Γ is in 1/kg."},
       {h * c, "This is a mass. Γ stands beside an inverse mass, so it is 1/(h c)."},
       {c, "This is c itself: Γ is 1/(h c)."},
       {0, "Γ is 0: that is c = ∞, no creep at all."},
       {4 / (h * h * c), contacts},
       {4 * upsilon / (h * h * c), contacts}},
      "Eq. (5.4): Γ = 1/(h c).");
}

EXERCISE_TEST(FrictionParameters, LetAStuckBodyCreepAtFOverC) {
  const Input in;
  const double h = in.h, c = in.c, m = in.m, F = in.F;
  const SpookParameters spook = friction_parameters(h, c);
  double u = 0;
  for (int n = 0; n < 60; ++n) u = step(spook, m, u, h * F / m);
  // In each step the difference from steady creep shrinks by mΓ/(1 + mΓ) < 1e-4. The roundings of u + u_f do
  // not add up.
  const double own = spook.b == 1 ? std::nan("") : spook.Sigma * h * F / spook.b;
  expect_near(
      "speed of a stuck body after 60 steps, " + in.text + " [m/s]", "Eq. (5.5)", u, F / c,
      roundings(16, h * F / m),
      {{own,
        "This is Σ h F/b with a b that is not 1. With a contact's b and Σ that is F/(k d h): the smaller "
        "the step, the faster it creeps. Friction has numbers of its own."},
       {h * F / c, "This creeps h times as fast: h is missing in Γ."},
       {F / (h * c), "This creeps at F/(h c), faster with smaller steps: Γ has one h too many."},
       {h * F / m * 60, "Nothing holds it."},
       {0, "It does not creep at all: Γ is missing."}},
      "It sticks except for a creep at F/c, for any h and m.");
}

EXERCISE_TEST(FrictionParameters, BrakeWhatSlides) {
  const Input in;
  const double Gamma = 1 / (in.h * in.c), u0 = in.F;
  const double left = step(friction_parameters(in.h, in.c), in.m, u0, 0) / u0;
  expect_near("fraction of a velocity that remains after a step without a force, " + in.text, "Eq. (5.3)", left,
              in.m * Gamma / (1 + in.m * Gamma), roundings(16), {{1, "Its velocity does not change: b is 0."}},
              "(1/m + Γ) λ = -u leaves mΓ/(1 + mΓ) of u. More is left when b is less than 1.");
}

EXERCISE_TEST(FrictionParameters, MayBeRigid) {
  const Input in;
  const double h = in.h, m = in.m, F = in.F;
  const SpookParameters spook = friction_parameters(h, infinity);
  expect_near("Γ for c = ∞ [1/kg]", "Eq. (5.4)", spook.Sigma, 0, {0, "exact"}, {},
              "Γ is 1/(h c), which is 0 for c = ∞.");
  double u = 0, x = 0;
  for (int n = 0; n < 10000; ++n) {
    u = step(spook, m, u, h * F / m);
    x += h * u;
  }
  expect_near("creep in 10,000 steps with c = ∞, " + in.text + " [m]", "Eq. (5.5)", x, 0,
              roundings(10000 * 8, h * h * F / m), {}, "F/c is 0 for c = ∞: a body that sticks does not move.");
}

EXERCISE_TEST(FrictionParameters, TakeAnyPositiveViscosity) {
  for (const double c : {1e-9, 0.01, 1.0, 1e12})
    expect_near("Γ for h = 0.01 s and c = " + show(c) + " N s/m [1/kg]", "Eq. (5.4)",
                friction_parameters(0.01, c).Sigma, 100 / c, roundings(8, 100 / c), {},
                "Any positive c is a viscosity. A number in N s/m is neither large nor small by itself.");
}

EXERCISE_TEST(FrictionParameters, FollowTheUnitsOfTheStep) {
  const Input in;
  const double whole = friction_parameters(in.h, in.c).Sigma;
  expect_near("Γ at h/2 over Γ at h", "Eq. (5.4)", friction_parameters(in.h / 2, in.c).Sigma / whole, 2,
              roundings(16, 2),
              {{4, "One h too many."}, {1, "h is missing."}, {0.5, "h belongs in the denominator."}},
              "1/(h c) is in 1/kg, so half the step gives twice the number.");
  expect_near("Γ at 2c over Γ at c", "Eq. (5.4)", friction_parameters(in.h, 2 * in.c).Sigma / whole, 0.5,
              roundings(16), {{2, "c belongs in the denominator."}},
              "Twice the viscosity gives half the creep.");
}

EXERCISE_TEST(FrictionParameters, RejectAStepThatIsNotPositive) {
  friction_parameters(0.01, 1e4);
  for (const double h : {0.0, -0.01, std::nan(""), HUGE_VAL})
    expect_rejects(
        "h = " + show(h), "h", [&] { friction_parameters(h, 1e4); }, "See require_positive in require.hpp.");
  expect_rejects(
      "h = NaN where c = ∞", "h", [&] { friction_parameters(std::nan(""), HUGE_VAL); },
      "Check h before you return, also where Γ is 0 for any h.");
}

EXERCISE_TEST(FrictionParameters, RejectAViscosityThatIsNotPositive) {
  friction_parameters(0.01, 1e4);
  for (const double c : {0.0, -1e4, std::nan(""), -HUGE_VAL})
    expect_rejects(
        "c = " + show(c), "c", [&] { friction_parameters(0.01, c); },
        "See reject in require.hpp. With c = 0 there would be no friction. Positive numbers and +∞ are "
        "allowed.");
}

}  // namespace
