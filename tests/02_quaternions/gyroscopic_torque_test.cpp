// The gyroscopic torque alone: Euler's equations, where it is zero, and that it does no work.
#include "exercise_test.hpp"
#include "relative_scales.hpp"
#include "rotations.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(GyroscopicTorque, "2.5 gyroscopic_torque");

struct FreeTop {
  Random random;
  Quat q = random.rotation();
  Vec3 principal = {random.uniform(2, 2.4), random.uniform(3, 3.4), random.uniform(4, 4.4)};
  Mat3 R = q.toRotationMatrix();
  Mat3 inertia = R * principal.asDiagonal() * R.transpose();
  Vec3 omega = R * random.vector(1, 2);
};

EXERCISE_TEST(GyroscopicTorque, IsEulersInBodyAxes) {
  const Vec3 got = gyroscopic_torque(Vec3(1, 2, 4).asDiagonal().toDenseMatrix(), Vec3(1, 1, 1));
  expect_near_vector<Vec3>(
      "gyroscopic torque for moments 1, 2, 4 and ω = (1, 1, 1) [N m]", "Eq. (2.9)", got, {-2, 3, -1},
      roundings(8, 4),
      {{{2, -3, 1},
        "The sign: this is +ω × Iω. In Eq. (2.8) it stands with a minus on the side of the torques."},
       {Vec3::Zero(),
        "This is 0: the cross product of ω with itself, or a diagonal inertia taken for a ball's. The second "
        "factor is L = Iω, and here its direction is another."},
       {{-4, 6, -2}, "Twice too much: one of the terms of dL/dt is counted twice."},
       {{-2, 1.5, -0.25}, "This has been divided by the inertia, so it is an acceleration. Return a torque."}},
      "Euler's equations: τ1 = (I2 - I3) ω2 ω3, and cyclically.");
}

EXERCISE_TEST(GyroscopicTorque, IsMinusOmegaCrossL) {
  const FreeTop b;
  const Vec3 got = gyroscopic_torque(b.inertia, b.omega);
  // Euler's equations in body coordinates, converted to world coordinates.
  const Vec3 w = b.R.transpose() * b.omega, I = b.principal;
  const Vec3 euler((I[1] - I[2]) * w[1] * w[2], (I[2] - I[0]) * w[2] * w[0], (I[0] - I[1]) * w[0] * w[1]);
  const Vec3 expected = b.R * euler;
  const Vec3 diagonal_only = b.inertia.diagonal().cwiseProduct(b.omega);
  expect_near_vector<Vec3>(
      "gyroscopic torque on a random body [N m]", "Eq. (2.9)", got, expected, roundings(64, 40),
      {{-expected,
        "The sign: this is +ω × Iω. In Eq. (2.8) it stands with a minus on the side of the torques."},
       {Vec3::Zero(), "This is 0: the cross product of ω with itself. The second factor is L = Iω."},
       {-b.omega.cross(Mat3(b.inertia.triangularView<Eigen::Lower>()) * b.omega),
        "This reads the lower triangle of the inertia alone. All nine entries count."},
       {-b.omega.cross(Mat3(b.inertia.triangularView<Eigen::Upper>()) * b.omega),
        "This reads the upper triangle of the inertia alone. All nine entries count."},
       {2 * expected, "Twice too much: one of the terms of dL/dt is counted twice."},
       {b.inertia.inverse() * expected,
        "This has been divided by the inertia, so it is an acceleration. Return a torque."},
       {-b.omega.cross(b.inertia.inverse() * b.omega), "The inverse inertia has been used: L is Iω, not I⁻¹ω."},
       {-b.omega.cross(diagonal_only),
        "Only the diagonal of the inertia has been used. In world coordinates the other six entries matter, "
        "too."}},
      "Eq. (2.9): -ω × L, with L = Iω.");
}

EXERCISE_TEST(GyroscopicTorque, IsZeroForASphere) {
  Random random;
  expect_near_vector<Vec3>("gyroscopic torque on a sphere [N m]", "Eq. (2.9)",
                           gyroscopic_torque(0.4 * Mat3::Identity(), random.vector(5)), Vec3::Zero(),
                           roundings(16, 30), {}, "For a sphere L is along ω, and the cross product is 0.");
}

EXERCISE_TEST(GyroscopicTorque, IsZeroAboutAPrincipalAxis) {
  const FreeTop b;
  for (int c = 0; c < 3; ++c)
    expect_near_vector<Vec3>(
        "gyroscopic torque at 3 rad/s about the body's axis " + std::to_string(c + 1) + " [N m]", "Eq. (2.9)",
        gyroscopic_torque(b.inertia, b.R * (3 * Vec3::Unit(c))), Vec3::Zero(), roundings(64, 40), {},
        "About a principal axis L is along ω: the body does not wobble.");
}

EXERCISE_TEST(GyroscopicTorque, DropsNoSmallTorque) {
  for (const double part : relative_scales) {
    // Euler's equations again: a body with nearly equal moments, and one that spins nearly about a principal
    // axis.
    const Vec3 round(1, 1 + part, 1 - part),
        differences(round[1] - round[2], round[2] - round[0], round[0] - round[1]);
    expect_near_vector<Vec3>(
        "gyroscopic torque for moments 1, 1 + p and 1 - p, p = " + show(part) + ", and ω = (1, 1, 1) [N m]",
        "Eq. (2.9)", gyroscopic_torque(round.asDiagonal().toDenseMatrix(), Vec3(1, 1, 1)), differences,
        roundings(4), {{Vec3::Zero(), "There is none. " + small_is_dropped}}, small_is_dropped);
    for (const Vec3& w : lopsided(part))
      expect_each_near<Vec3>("gyroscopic torque for moments 1, 2, 4 [N m]", "Eq. (2.9)",
                             gyroscopic_torque(Vec3(1, 2, 4).asDiagonal().toDenseMatrix(), w),
                             Vec3(-2 * w[1] * w[2], 3 * w[2] * w[0], -w[0] * w[1]), 8);
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(GyroscopicTorque, DoesNoWork) {
  const FreeTop b;
  const Vec3 got = gyroscopic_torque(b.inertia, b.omega);
  expect_near("power ω · τ [W]", "Eq. (2.9)", b.omega.dot(got), 0, roundings(64, 100), {},
              "The torque must be at right angles to ω: a body that spins freely gains no energy.");
  expect_near("L · τ, half the rate of |L|² [kg² m⁴/s³]", "Eq. (2.9)", (b.inertia * b.omega).dot(got), 0,
              roundings(64, 400), {}, "The torque must be at right angles to L = Iω: it only turns it.");
}

EXERCISE_TEST(GyroscopicTorque, GrowsWithTheSquareOfOmega) {
  const FreeTop b;
  const Vec3 once = gyroscopic_torque(b.inertia, b.omega);
  expect_near_vector<Vec3>("torque at -3 ω, which must be 9 τ(ω) [N m]", "Eq. (2.9)",
                           gyroscopic_torque(b.inertia, -3 * b.omega), 9 * once, roundings(64, 400), {},
                           "Eq. (2.9) has ω twice, so the sign of ω does not matter.");
}

}  // namespace
