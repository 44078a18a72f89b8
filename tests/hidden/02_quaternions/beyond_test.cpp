// Beyond chapter 02's own tests: what rotations do to each function, any angle, bodies of every kind.
#include "02_quaternions/quaternions.hpp"
#include "exercise_test.hpp"
#include "simulations.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(QuaternionRate, "2.1 quaternion_rate");
EXERCISE(UpdateFirstOrder, "2.2 update_first_order");
EXERCISE(UpdateExponential, "2.3 update_exponential");
EXERCISE(WorldInertia, "2.4 world_inertia");
EXERCISE(GyroscopicTorque, "2.5 gyroscopic_torque");
EXERCISE(FreeRotation, "2.6 free_rotation");
EXERCISE(StepFree, "2.7 step_free");

EXERCISE_TEST(QuaternionRate, GivesOmegaBack) {
  Random random;
  const Quat q = random.rotation();
  const Vec3 omega = random.vector(10);
  const Quat twice = quaternion_rate(q, omega) * q.conjugate();
  expect_near_vector("2 dq/dt q* [rad/s]", "Eq. (2.3)", Vec3(2 * twice.vec()), omega, roundings(32, 20), {},
                     "ω is in world coordinates, so it stands to the left of q.");
  expect_near("its real part [rad/s]", "Eq. (2.3)", 2 * twice.w(), 0, roundings(32, 20));
}

EXERCISE_TEST(UpdateExponential, TwoHalvesAreAWhole) {
  Random random;
  const Quat q = random.rotation();
  const Vec3 omega = random.vector_of_length(1, 20);
  const Quat once = update_exponential(q, omega, 0.1);
  const Quat twice = update_exponential(update_exponential(q, omega, 0.05), omega, 0.05);
  expect_near_vector("q, as (x, y, z, w)", "Eq. (2.6)", Eigen::Vector4d(twice.coeffs()),
                     Eigen::Vector4d(once.coeffs()), roundings(32));
}

EXERCISE_TEST(WorldInertia, TurnsWithTheBody) {
  Random random;
  const Quat q = random.rotation(), p = random.rotation();
  const Vec3 principal = random.vector(1, 5);
  const Mat3 R = p.toRotationMatrix();
  const Mat3 turned = R * world_inertia(q, principal) * R.transpose();
  expect_near("largest difference of the inertia of a body that is turned once more [kg m²]", "Eq. (2.7)",
              (world_inertia(p * q, principal) - turned).cwiseAbs().maxCoeff(), 0, roundings(100, 5));
}

EXERCISE_TEST(GyroscopicTorque, DoesNoWorkAndGrowsWithTheSquare) {
  Random random;
  const Mat3 R = random.rotation().toRotationMatrix();
  const Mat3 inertia = R * random.vector(1, 5).asDiagonal() * R.transpose();
  const Vec3 omega = random.vector(5);
  const Vec3 torque = gyroscopic_torque(inertia, omega);
  expect_near("its power [W]", "Eq. (2.9)", torque.dot(omega), 0, roundings(64, 5 * 500));
  expect_near_vector("torque at -2 ω [N m]", "Eq. (2.9)", gyroscopic_torque(inertia, -2 * omega), 4 * torque,
                     roundings(64, 4 * 400));
}

EXERCISE_TEST(FreeRotation, IsExactAboutAPrincipalAxis) {
  Random random;
  const Quat start = random.rotation();
  const Vec3 principal = random.vector(1, 5);
  const double speed = random.uniform(1, 10), h = 0.05;
  for (int axis = 0; axis < 3; ++axis) {
    Quat q = start;
    const Vec3 spin = speed * (start * Vec3::Unit(axis));
    Vec3 omega = spin;
    free_rotation(q, omega, principal, h);
    const Quat expected = start * Quat(Eigen::AngleAxisd(h * speed, Vec3::Unit(axis)));
    expect_near("q · what is expected, up to its sign", "Eq. (2.10)", std::abs(q.dot(expected)), 1,
                roundings(64));
    expect_near_vector("ω [rad/s]", "Eq. (2.11)", omega, spin, roundings(200, 10));
  }
}

EXERCISE_TEST(UpdateFirstOrder, AddsHalfOfOmegaTimesQ) {
  Random random;
  for (const double speed : {20.0, 1.0, 1e-3, 1e-7, 0.0})
    for (const double h : {0.1, -0.1, 0.0})
      for (const double length : {1.0, 1 + 5e-13}) {
        const Quat unit = random.rotation();
        const Vec3 omega = speed * random.unit_vector();
        const Quat q(Eigen::Vector4d(length * unit.coeffs()));
        const Eigen::Vector4d sum =
            q.coeffs() + h / 2 * (Quat(0, omega.x(), omega.y(), omega.z()) * q).coeffs();
        expect_near_vector("q, as (x, y, z, w)", "Eq. (2.4)",
                           Eigen::Vector4d(update_first_order(q, omega, h).coeffs()),
                           Eigen::Vector4d(sum / sum.norm()), roundings(16));
      }
}

EXERCISE_TEST(UpdateExponential, TurnsByAnyAngle) {
  Random random;
  for (const double angle : {5.0, 0.5, 0.05, 1e-3, 1e-6, 1e-10, 0.0})
    for (const double h : {0.01, -0.01, 100.0}) {
      const Quat q = random.rotation();
      const Vec3 any = random.unit_vector(), near_x = Vec3(1, 1e-7, -1e-8).normalized();
      const Vec3 axis = angle > 0.1 ? any : near_x;
      const Quat turn(Eigen::AngleAxisd(h > 0 ? angle : -angle, axis));
      expect_near_vector("q, as (x, y, z, w)", "Eq. (2.6)",
                         Eigen::Vector4d(update_exponential(q, Vec3(angle / std::abs(h) * axis), h).coeffs()),
                         Eigen::Vector4d((turn * q).coeffs()), roundings(32));
    }
}

EXERCISE_TEST(GyroscopicTorque, IsEulersForAnySpin) {
  Random random;
  for (const double small : {1.0, 1e-4, 1e-8})
    for (const double size : {1.0, 1e-12}) {
      const Vec3 moments = Vec3(1, 3, 5) + random.vector(0, 1);
      const Vec3 omega = size * Vec3(random.uniform(1, 2), small, -small);
      const Mat3 inertia = moments.asDiagonal();
      const Vec3 expected((moments.y() - moments.z()) * omega.y() * omega.z(),
                          (moments.z() - moments.x()) * omega.z() * omega.x(),
                          (moments.x() - moments.y()) * omega.x() * omega.y());
      const Vec3 got = gyroscopic_torque(inertia, omega);
      for (int c = 0; c < 3;
           ++c)  // each a difference of two products, of moments that differ by a sixth and more
        expect_near("torque along axis " + std::to_string(c) + " [N m]", "Eq. (2.9)", got[c], expected[c],
                    roundings(40, expected[c]));
    }
}

EXERCISE_TEST(FreeRotation, KeepsLAndRunsBack) {
  Random random;
  for (const double speed : {5.0, 1e-6}) {
    const Quat start = random.rotation();
    const Vec3 spin = speed * random.unit_vector(), principal(2, 5, 3.5);
    const Vec3 L = world_inertia(start, principal) * spin;
    const double h = 0.02;
    Quat q = start;
    Vec3 omega = spin;
    free_rotation(q, omega, principal, h);
    expect_near_vector("L after a step [kg m²/s]", "Eq. (2.10)", Vec3(world_inertia(q, principal) * omega), L,
                       roundings(200, L.norm()));
    const Vec3 turned = 2 * (q * start.conjugate()).vec() / h;  // the sine of a small angle for it: (h ω)²/24
    expect_near_vector("turn over h [rad/s]", "Eq. (2.10)", turned, spin,
                       {speed * (3 * h * speed + 1e-9), "the change of ω in a step, at most (5/2 - 1) |ω|² h"});
    free_rotation(q, omega, principal, -h);
    expect_near("q · its start, after a step and one back", "Eq. (2.11)", std::abs(q.dot(start)), 1,
                roundings(64));
    expect_near_vector("ω after a step and one back [rad/s]", "Eq. (2.11)", omega, spin, roundings(400, speed));
  }
}

EXERCISE_TEST(StepFree, MovesEveryKindOfBody) {
  Random random;
  Simulation all;
  all.gravity = random.vector(9);
  for (int k = 0; k < many; ++k) {
    all.bodies.push_back(k % 5 == 0 ? random_static_body(random) : random_rigid_body(random));
    if (k % 5 == 1) all.bodies.back().principal = Vec3::Zero();
    if (k % 5 == 2) all.bodies.back().principal = Vec3::Constant(0.3);
  }
  const double h = random.uniform(0.05, 0.1);
  Simulation expected = all, got = all;
  for (RigidBody& body : expected.bodies) {
    if (body.mass == 0) continue;
    body.v += h * all.gravity;
    body.x += h * body.v;
    if (body.principal == Vec3::Constant(0.3))
      body.q = update_exponential(body.q, body.omega, h);
    else if (body.principal.norm() > 0)
      free_rotation(body.q, body.omega, body.principal, h);
  }
  step_free(got, h);
  expect_same_bodies("after a step", "Eq. (1.3), (1.4), (2.11)", got, expected, roundings(400, 10));
  for (const double none : {0.0, -0.1, std::nan("")})
    expect_rejects(
        "h = " + std::to_string(none), "h", [&] { step_free(got, none); }, "", [&] { return state_of(got); });
}

}  // namespace
