// The rate of a quaternion: the side of ω, the factor ½, and the velocity of points of the body.
#include "exercise_test.hpp"
#include "rotations.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(QuaternionRate, "2.1 quaternion_rate");

struct SpinningBody {
  Random random;
  Quat q = random.rotation();
  Vec3 omega = random.vector_of_length(1, 3);
};

EXERCISE_TEST(QuaternionRate, IsHalfOmegaForAnUnturnedBody) {
  const Vec3 omega(1, 2, 3);
  const Quat got = quaternion_rate(Quat(1, 0, 0, 0), omega);
  expect_near_vector<Vec4>(
      "q' as (w, x, y, z) for q = (1, 0, 0, 0), ω = (1, 2, 3) [1/s]", "Eq. (2.3)", coefficients(got),
      {0, 0.5, 1, 1.5}, roundings(4, 2),
      {{{0, 1, 2, 3}, "This is ω q: the ½ is missing."},
       {{0.5, 1, 1.5, 0},
        "The four numbers are in the wrong places: Quat(w, x, y, z) takes w first; only coeffs() has it last."},
       {{3, 0, 1, 2}, "The ½ is missing, and w has been read from the place where coeffs() keeps z."},
       {{0, -0.5, -1, -1.5}, "The sign: a positive turn about e_3 takes e_1 towards e_2."}},
      "With q = 1, Eq. (2.3) leaves ½ (0, ω).");
}

EXERCISE_TEST(QuaternionRate, IsHalfOmegaTimesQ) {
  const SpinningBody b;
  const Quat got = quaternion_rate(b.q, b.omega);
  // Eq. (2.2), written out for a first factor (0, ω).
  const double w = -b.omega.dot(b.q.vec());
  const Vec3 v = b.q.w() * b.omega + b.omega.cross(b.q.vec());
  const Vec3 v_other_side = b.q.w() * b.omega - b.omega.cross(b.q.vec());
  const Vec4 expected = Vec4(w, v.x(), v.y(), v.z()) / 2;
  const Quat omega_w_last(b.omega.x(), b.omega.y(), b.omega.z(), 0);
  expect_near_vector<Vec4>(
      "q' as (w, x, y, z) [1/s]", "Eq. (2.3)", coefficients(got), expected, roundings(16, 3),
      {{Vec4(w, v_other_side.x(), v_other_side.y(), v_other_side.z()) / 2,
        "This is ½ q ω: right if ω were in body coordinates. Ours is in world coordinates: ω stands on the "
        "left."},
       {2 * expected, "This is ω q: the ½ is missing."},
       {-expected,
        b.q.w() < 0 ? "The sign: this body turns backwards. If it does so for w < 0 only, this is the rate of "
                      "-q: take q as it is given."
                    : "The sign: this body turns backwards."},
       {expected.normalized(),
        "The rate has been normalised. Only orientations have length 1; this is a rate, of length |ω|/2."},
       {Vec4(w, v.x() / 2, v.y() / 2, v.z() / 2), "The ½ belongs to all four numbers. Here w lacks it."},
       {coefficients(omega_w_last * b.q) / 2,
        "ω was put in as (ωx, ωy, ωz, 0), but Quat(w, x, y, z) takes w first: only coeffs() has it last."}},
      "Eq. (2.3): ½ times the quaternion product of (0, ω) and q, in this order.");
}

EXERCISE_TEST(QuaternionRate, IsAtRightAnglesToQ) {
  const SpinningBody b;
  const Quat rate = quaternion_rate(b.q, b.omega);
  expect_near("q · q' of a random body, half the rate of |q|² [1/s]", "Eq. (2.3)",
              coefficients(rate).dot(coefficients(b.q)), 0, roundings(16, 3),
              {{b.omega.x() / 2,
                "ω has a real part: it was put in as (ωx, ωy, ωz, 0), but Quat(w, x, y, z) takes w first."}},
              "A turning body keeps |q| = 1, so its rate cannot point along q.");
  expect_near("|q'| [1/s]", "Eq. (2.3)", rate.norm(), b.omega.norm() / 2, roundings(16, 3),
              {{b.omega.norm(), "Twice too long: the ½ is missing."}}, "The rate has the length |ω|/2.");
}

EXERCISE_TEST(QuaternionRate, MovesPointsByOmegaCrossR) {
  SpinningBody b;
  const Quat rate = quaternion_rate(b.q, b.omega);
  const Vec3 r = b.random.vector(2);  // body coordinates
  const Quat point(0, r.x(), r.y(), r.z());
  // The product rule on Eq. (2.1), q r q*.
  const Vec3 velocity = (rate * point * b.q.conjugate()).vec() + (b.q * point * rate.conjugate()).vec();
  const Vec3 expected = b.omega.cross(b.q * r);
  expect_near_vector<Vec3>(
      "velocity of a point of the body, from q' and Eq. (2.1) [m/s]", "Eq. (2.1), (2.3)", velocity, expected,
      roundings(64, 6),
      {{(b.q * b.omega).cross(b.q * r),
        "The point turns about q ω q*, as if ω were in body coordinates. Multiply from the left."},
       {2 * expected, "Twice too fast: the ½ is missing."},
       {-expected, "The sign: the point moves backwards."}},
      "A point r of a turning body moves with ω × r.");
}

EXERCISE_TEST(QuaternionRate, GrowsWithOmega) {
  const SpinningBody b;
  const Vec4 once = coefficients(quaternion_rate(b.q, b.omega));
  const Vec4 thrice = coefficients(quaternion_rate(b.q, 3 * b.omega));
  expect_near_vector<Vec4>(
      "q' at 3 ω, which must be 3 q'(ω) [1/s]", "Eq. (2.3)", thrice, 3 * once, roundings(32, 6),
      {{once, "This does not depend on |ω|: do not normalise the rate."}}, "Eq. (2.3) is linear in ω.");
  expect_near_vector<Vec4>("q' of a body at rest [1/s]", "Eq. (2.3)",
                           coefficients(quaternion_rate(b.q, Vec3::Zero())), Vec4::Zero(), {0, "exact"}, {},
                           "With ω = 0 the orientation does not change.");
}

}  // namespace
