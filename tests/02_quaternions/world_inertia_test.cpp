// Inertia in world coordinates: its axes turn with the body, its moments do not.

#include "algebra.hpp"
#include "exercise_test.hpp"
#include "relative_scales.hpp"
#include "rotations.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(WorldInertia, "2.4 world_inertia");

struct TurnedBody {
  Random random;
  Quat q = random.rotation();
  // Moments that are well apart and that a body can have: I1 + I2 > I3.
  Vec3 principal = {random.uniform(2, 2.4), random.uniform(3, 3.4), random.uniform(4, 4.4)};
  Mat3 R = q.toRotationMatrix();
};

EXERCISE_TEST(WorldInertia, QuarterTurnSwapsTwoMoments) {
  const Mat3 unturned = world_inertia(Quat(1, 0, 0, 0), Vec3(1, 2, 3));
  expect_near_vector<Mat3>("inertia of an unturned body, moments 1, 2, 3 [kg m²]", "Eq. (2.7)", unturned,
                           Vec3(1, 2, 3).asDiagonal().toDenseMatrix(), roundings(16, 3),
                           {{Vec3(1, 1 / 2.0, 1 / 3.0).asDiagonal().toDenseMatrix(),
                             "This is the inverse inertia. To get it, a caller passes inverse moments."}},
                           "With q = 1, body and world coordinates are the same.");
  const Mat3 turned = world_inertia(turn_about(Vec3::UnitZ(), std::acos(0.0)), Vec3(1, 2, 3));
  expect_near_vector<Mat3>(
      "the same after a quarter turn about z [kg m²]", "Eq. (2.7)", turned,
      Vec3(2, 1, 3).asDiagonal().toDenseMatrix(), roundings(16, 3),
      {{Vec3(1, 2, 3).asDiagonal().toDenseMatrix(),
        "These are the body's own coordinates: q has not been used."},
       {Vec3(-2, -1, 3).asDiagonal().toDenseMatrix(), "This is R I R: the right one must be transposed."},
       {Vec3(-2, 1, 3).asDiagonal().toDenseMatrix(),
        "The moments are not a vector. They belong to axes, and the axes turn."}},
      "The body's axis 1 points along y now, so the moment about y is I1.");
}

EXERCISE_TEST(WorldInertia, IsTheSumOverTheBodysAxes) {
  const TurnedBody b;
  const Mat3 got = world_inertia(b.q, b.principal);
  Mat3 expected = Mat3::Zero();  // Σ I_c e_c e_cᵀ, with the body's axes e_c in world coordinates
  for (int c = 0; c < 3; ++c) {
    const Vec3 axis = b.q * Vec3::Unit(c);
    expected += b.principal[c] * axis * axis.transpose();
  }
  const Mat3 body = b.principal.asDiagonal();
  const Vec3 turned_moments = b.R * b.principal;
  expect_near_vector<Mat3>(
      "inertia of a random body in world coordinates [kg m²]", "Eq. (2.7)", got, expected, roundings(64, 5),
      {{b.R.transpose() * body * b.R,
        "This is Rᵀ I R: it takes world to body coordinates. A column of R is an axis of the body, so R stands "
        "left."},
       {body, "This is still in body coordinates: q has not been used."},
       {b.R * body, "This is R I: the second half, Rᵀ, is missing. An inertia is multiplied from both sides."},
       {body * b.R.transpose(),
        "This is I Rᵀ: R is missing on the left. An inertia is multiplied from both "
        "sides."},
       {b.R * body * b.R, "This is R I R: the right one must be transposed."},
       {turned_moments.asDiagonal().toDenseMatrix(),
        "The three moments were rotated like a vector. They belong to axes, and only the axes turn."},
       {expected.inverse(), "This is the inverse inertia. To get it, a caller passes inverse moments."}},
      "Eq. (2.7): R diag(I1, I2, I3) Rᵀ with R = R(q).");
}

EXERCISE_TEST(WorldInertia, KeepsSmallDifferencesOfMoments) {
  const TurnedBody b;
  for (const double part : relative_scales) {
    const Vec3 more = part * Vec3(1, -0.5, 0.25);
    const Mat3 got = world_inertia(b.q, Vec3::Ones() + more) - Mat3::Identity();
    expect_near_vector<Mat3>(
        "inertia of a body with moments that differ by " + show(part) + " of 1 kg m², less 1 kg m²",
        "Eq. (2.7)", got, b.R * more.asDiagonal() * b.R.transpose(), roundings(32),
        {{Mat3::Zero(), "This is a sphere's. " + small_is_dropped}}, small_is_dropped);
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(WorldInertia, KeepsTheEffectOfASmallTurn) {
  const Vec3 I(1, 2, 4);
  for (const double part : relative_scales)
    for (int c = 0; c < 3 && !::testing::Test::HasFailure(); ++c) {
      const int a = (c + 1) % 3, b = (c + 2) % 3;
      Mat3 expected = I.asDiagonal();  // turned about its axis c
      expected(a, a) += std::pow(std::sin(part), 2) * (I[b] - I[a]);
      expected(b, b) += std::pow(std::sin(part), 2) * (I[a] - I[b]);
      expected(a, b) = expected(b, a) = std::sin(2 * part) / 2 * (I[a] - I[b]);
      expect_each_near<Mat3>(
          "inertia of moments 1, 2, 4, turned by " + show(part) + " rad about axis " + std::to_string(c + 1),
          "Eq. (2.7)", world_inertia(turn_about(Vec3::Unit(c), part), I), expected, 32);
    }
}

EXERCISE_TEST(WorldInertia, TakesMomentsInAnyOrder) {
  TurnedBody b;
  const double x = 2, y = 3, z = 4;
  for (const Vec3& principal : {Vec3(x, y, z),
                                {x, z, y},
                                {y, x, z},
                                {y, z, x},
                                {z, x, y},
                                {z, y, x},
                                {x, x, z},
                                {x, z, x},
                                {z, x, x},
                                {z, z, x},
                                {z, x, z},
                                {x, z, z},
                                {x, x, x}}) {
    Vec3 sorted = principal;
    std::sort(sorted.begin(), sorted.end());
    const auto with = [&](const Vec3& moments) -> Mat3 { return b.R * moments.asDiagonal() * b.R.transpose(); };
    expect_near_vector<Mat3>(
        "inertia of a body with the moments " + show(Eigen::MatrixXd(principal)) + " [kg m²]", "Eq. (2.7)",
        world_inertia(b.q, principal), with(principal), roundings(64, 5),
        {{with(sorted), "The moments have been sorted. Each must stay with its own axis."},
         {with(sorted.reverse()), "The moments have been sorted. Each must stay with its own axis."}},
        "No axis is special, and two moments may be equal.");
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(WorldInertia, KeepsThePrincipalMoments) {
  const TurnedBody b;
  const Mat3 got = world_inertia(b.q, b.principal);
  expect_near("sum of |I - Iᵀ| over all entries [kg m²]", "Eq. (2.7)", (got - got.transpose()).cwiseAbs().sum(),
              0, roundings(64, 5), {}, "An inertia is symmetric, in any coordinates.");
  expect_near("trace [kg m²]", "Eq. (2.7)", got.trace(), b.principal.sum(), roundings(64, 5), {},
              "Turning keeps the trace, I1 + I2 + I3.");
  const Vec3 moments = eigenvalues(got);  // smallest first, as ours are
  expect_near_vector<Vec3>("eigenvalues [kg m²]", "Eq. (2.7)", moments, b.principal, roundings(128, 5), {},
                           "Turning keeps the eigenvalues: they are the principal moments.");
}

EXERCISE_TEST(WorldInertia, HasTheBodysAxesAsPrincipalAxes) {
  const TurnedBody b;
  const Mat3 got = world_inertia(b.q, b.principal);
  for (int c = 0; c < 3; ++c) {
    const Vec3 axis = b.q * Vec3::Unit(c);
    expect_near_vector<Vec3>("L at 1 rad/s about the body's axis " + std::to_string(c + 1) + " [kg m²/s]",
                             "Eq. (2.7)", got * axis, b.principal[c] * axis, roundings(64, 5),
                             {{b.principal.cwiseProduct(axis), "The inertia is still in body coordinates."}},
                             "Spinning about a principal axis, L = I_c ω. The axes are the columns of R(q).");
  }
}

EXERCISE_TEST(WorldInertia, GivesTheInverseForInverseMoments) {
  const TurnedBody b;
  const Mat3 product = world_inertia(b.q, b.principal.cwiseInverse()) * world_inertia(b.q, b.principal);
  expect_near_vector<Mat3>("I⁻¹ I, with I⁻¹ from the inverse moments", "Eq. (2.7)", product, Mat3::Identity(),
                           roundings(128, 5), {},
                           "Eq. (2.7) of the inverse moments is the inverse: Rᵀ R = 1 in between.");
}

EXERCISE_TEST(WorldInertia, GivesTheSameEnergyInEveryFrame) {
  const TurnedBody b;
  const Mat3 got = world_inertia(b.q, b.principal);
  const Vec3 omega = b.R * Vec3(1, -2, 3);
  const Vec3 as_if_body = b.R.transpose() * omega;
  const double expected = as_if_body.cwiseAbs2().dot(b.principal) / 2;
  expect_near(
      "kinetic energy ½ ω · I ω in world coordinates [J]", "Eq. (2.7)", omega.dot(got * omega) / 2, expected,
      roundings(64, 40),
      {{omega.cwiseAbs2().dot(b.principal) / 2, "The inertia is still in body coordinates, and ω is not."}},
      "The energy is the same number in body coordinates, ½ Σ I_c ω_c².");
}

EXERCISE_TEST(WorldInertia, OfASphereDoesNotTurn) {
  const TurnedBody b;
  expect_near_vector<Mat3>("inertia of a turned sphere [kg m²]", "Eq. (2.7)",
                           world_inertia(b.q, Vec3::Constant(0.4)), 0.4 * Mat3::Identity(), roundings(16), {},
                           "A sphere looks the same from all sides: R 1 Rᵀ = 1.");
}

}  // namespace
