// A step with the gyroscopic torque, ω += h I⁻¹ τ: it conserves L to first order in h, and adds energy.
#include "exercise_test.hpp"
#include "rotations.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(GyroscopicTorque, "2.5 gyroscopic_torque");

struct Spin {
  Vec3 principal = {1, 2, 3};
  Quat q = Quat(1, 0, 0, 0);
  Vec3 omega = {1, 1, 1};

  Mat3 inertia() const { return world_inertia(q, principal); }
  Vec3 acceleration() const {
    return world_inertia(q, principal.cwiseInverse()) * gyroscopic_torque(inertia(), omega);
  }
  void step(double h, const Vec3& alpha) {
    omega += h * alpha;
    q = update_exponential(q, omega, h);
  }
};

/// |L(t) - L(0)| / |L| after 2 s.
double change_of_L(double h, bool with_torque) {
  Spin body;
  const Vec3 before = body.inertia() * body.omega;
  const int steps = static_cast<int>(std::lround(2 / h));
  for (int n = 0; n < steps; ++n) body.step(h, with_torque ? body.acceleration() : Vec3::Zero());
  return (body.inertia() * body.omega - before).norm() / before.norm();
}

EXERCISE_TEST(GyroscopicTorque, KeepsLToFirstOrder) {
  expect_order(
      "top (1, 2, 3) at ω = (1, 1, 1), change of L after 2 s over |L|", "Eq. (2.8), (2.9)",
      [](double h) { return change_of_L(h, true); }, 0.02, 3, 1, 0.1,
      "Order 0 means that the torque is not the one that conserves L. Look at its sign and factors.");
}

EXERCISE_TEST(GyroscopicTorque, KeepsLWhereConstantOmegaDoesNot) {
  const double with_torque = change_of_L(0.002, true);
  const double without = change_of_L(0.002, false);
  expect_at_most("change of L after 2 s, over the change with ω held constant", "Eq. (2.8)",
                 with_torque / without, 0.02,
                 "a constant ω turns L by about 1 rad; with the torque the error is about h |ω| = 0.0035",
                 "No torque acts on the body, so L is constant, and ω must change.");
}

// The turn about ω leaves ½ ω · I ω as it is; the kick adds h ω · τ = 0 and ½ h² τ · I⁻¹ τ, which is never
// negative.
EXERCISE_TEST(GyroscopicTorque, AddsEnergyInAnExplicitStep) {
  Spin body;
  const double h = 0.01;
  const auto energy = [&] { return body.omega.dot(body.inertia() * body.omega) / 2; };
  const double before = energy();
  double expected = 0;
  for (int n = 0; n < 100; ++n) {
    const Vec3 alpha = body.acceleration();
    expected += h * h / 2 * alpha.dot(body.inertia() * alpha);
    body.step(h, alpha);
  }
  const double gain = energy() - before;
  expect_near("energy gained over 100 explicit steps, divided by Σ ½ h² τ·I⁻¹τ", "Eq. (2.9)", gain / expected,
              1, roundings(16 * 100, before / expected), {},
              "A torque that does no work leaves only the second-order term, which is positive at every step.");
  expect_at_least("this gain, relative to the energy", "Eq. (2.9)", gain / before, 1e-4,
                  "of the order of h² a step", "No torque?");
}

}  // namespace
