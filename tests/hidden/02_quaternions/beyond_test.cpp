// Beyond chapter 02's own tests: what rotations do to each function.
#include "02_quaternions/quaternions.hpp"
#include "exercise_test.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(QuaternionRate, "2.1 quaternion_rate");
EXERCISE(UpdateExponential, "2.3 update_exponential");
EXERCISE(WorldInertia, "2.4 world_inertia");
EXERCISE(GyroscopicTorque, "2.5 gyroscopic_torque");
EXERCISE(FreeRotation, "2.6 free_rotation");

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

}  // namespace
