// The collision matrix: how easily two contact points move apart.

#include "03_single_contact/single_contact.hpp"
#include "algebra.hpp"
#include "bodies.hpp"
#include "exercise_test.hpp"
#include "regions.hpp"
#include "relative_scales.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(CollisionMatrix, "3.3 collision_matrix");

Mat3 K_of(const RandomPair& pair) {
  return collision_matrix(pair.i.inverse_mass, pair.contact.r_i, pair.j.inverse_mass, pair.contact.r_j);
}

Mat3 cross_matrix(const Vec3& r) {
  Mat3 result;
  for (int k = 0; k < 3; ++k) result.col(k) = r.cross(Vec3::Unit(k));
  return result;
}

// Returns the change of velocity of the point at r by an impulse J there: one body's share of K J.
Vec3 point_kick(const InverseMass<6>& body, const Vec3& r, const Vec3& J) {
  const Vec3 dv = body.linear * J, domega = body.angular * r.cross(J);
  return dv + domega.cross(r);
}

EXERCISE_TEST(CollisionMatrix, TimesImpulseIsTheChangeOfRelativeVelocity) {
  Random random;
  const RandomPair pair(random);
  const Vec3 J = random.vector(2);
  const InverseMass<6>&i = pair.i.inverse_mass, &j = pair.j.inverse_mass;
  const Vec3 &r_i = pair.contact.r_i, &r_j = pair.contact.r_j;
  const Vec3 got = K_of(pair) * J;

  const Vec3 from_i = point_kick(i, r_i, J), from_j = point_kick(j, r_j, J);  // -(-J) on i: both add up
  const Vec3 linear = (i.linear + j.linear) * J, angular = from_i + from_j - linear;
  const Mat3 Ri = cross_matrix(r_i), Rj = cross_matrix(r_j);
  const Mat3 Ai = i.angular, Aj = j.angular;
  const Mat3 diagonal_i = Ai.diagonal().asDiagonal(), diagonal_j = Aj.diagonal().asDiagonal();
  expect_near_vector(
      "K J, change of the relative contact velocity [m/s]", "Eq. (3.8)", got, Vec3(from_i + from_j),
      roundings(64, pair.size() * J.norm()),
      {{from_j, "This is the share of body j alone. Body i has a share of the same form."},
       {from_i, "This is the share of body i alone. Body j has a share of the same form."},
       {from_j - from_i,
        "The shares of the two bodies add up: the impulse on i is -J, and i counts with a minus."},
       {linear, "The rotation is missing: an impulse beside the centre also turns both bodies."},
       {linear - angular,
        "The sign of the rotation: K = (1/m_i + 1/m_j) 1 - [r] I⁻¹ [r] …, with a minus, as [r][r] is "
        "negative."},
       {angular, "The linear share, (1/m_i + 1/m_j) 1, is missing."},
       {(1 / i.linear + 1 / j.linear) * J + angular,
        "K is an inverse mass: InverseMass::linear is 1/m already."},
       {linear / (i.linear + j.linear) / (1 / i.linear + 1 / j.linear) + angular,
        "The inverse masses add up, 1/m_i + 1/m_j. This is 1/(m_i + m_j)."},
       {point_kick(i, r_j, J) + point_kick(j, r_i, J),
        "r_i and r_j are swapped: each belongs to its own body."},
       {point_kick(i, r_j, J) + from_j, "This used r_j for both bodies."},
       {from_i + point_kick(j, r_i, J), "This used r_i for both bodies."},
       {linear - (Ri * diagonal_i * Ri + Rj * diagonal_j * Rj) * J,
        "This used the diagonal of I⁻¹ alone. In world coordinates the other six numbers count, too."},
       {linear - (Ri * Ri * Ai + Rj * Rj * Aj) * J,
        "The order matters: [r] I⁻¹ [r], read from the right: torque, then ω, then velocity of the point."},
       {linear - (Ai * Ri * Ri + Aj * Rj * Rj) * J,
        "The order matters: [r] I⁻¹ [r], read from the right: torque, then ω, then velocity of the point."},
       {linear - (Ri * Ri * Ai + Rj * Aj * Rj) * J,
        "The order matters: [r] I⁻¹ [r], read from the right: torque, then ω, then velocity of the point."},
       {linear - (Ri * Ai * Ri + Rj * Ai * Rj) * J, "This used body i's I⁻¹ for both bodies."},
       {linear - (Ri * Aj * Ri + Rj * Aj * Rj) * J, "This used body j's I⁻¹ for both bodies."},
       {linear - (Ri * Aj * Ri + Rj * Ai * Rj) * J, "The two I⁻¹ are swapped: each belongs to its own body."},
       {linear - (Rj * Aj * Rj - Ri * Ai * Ri) * J, "The sign of body i's rotation: both have a minus."},
       {linear - (Ri * Ai * Ri - Rj * Aj * Rj) * J, "The sign of body j's rotation: both have a minus."},
       {linear - (Ri * Ai * Ri + Rj * Aj * Rj).diagonal().cwiseProduct(J),
        "This is only the diagonal of K. A push along x moves the point along y and z, too."},
       {linear - (Ri * Ai.inverse() * Ri + Rj * Aj.inverse() * Rj) * J,
        "InverseMass::angular is I⁻¹ already: do not invert it."}},
      "J turns a body by I⁻¹ (r × J), and its contact point then moves by ω × r.");
}

EXERCISE_TEST(CollisionMatrix, OfASphereOnAPlane) {
  // I = 2/5 m R². Through the centre only 1/m counts. Along the plane the sphere also turns: 1/m + R²/I = 7/(2m).
  const double m = 3, R = 0.5, moment = 0.4 * m * R * R;
  const InverseMass<6> plane, sphere{1 / m, Mat3::Identity() / moment};
  const Mat3 K = collision_matrix(plane, Vec3(2, 1, 0), sphere, Vec3(0, 0, -R));
  const Mat3 expected = Vec3(7 / (2 * m), 7 / (2 * m), 1 / m).asDiagonal();
  expect_near_vector(
      "K of a sphere of 3 kg on a fixed plane, column by column [1/kg]", "Eq. (3.8)", K, expected,
      roundings(16, 2),
      {{Mat3::Identity() / m, "The share of the rotation is missing: a push at its rim also turns a sphere."},
       {Vec3(-1.5 / m, -1.5 / m, 1 / m).asDiagonal(),
        "The rotation makes the point easier to move, not harder: [r] I⁻¹ [r] is negative, and so is its sign "
        "in K."},
       {Mat3::Zero(), "This is the share of body i alone. An impulse moves both bodies."},
       {-expected, "K is the sum of both shares: the sphere's has a minus here."},
       {Mat3::Identity() * (3.5 / m),
        "The rotation adds only across r: [r] I⁻¹ [r] has I⁻¹ in the middle, and |r|² alone is not enough."}},
      "1/m through the centre, 7/(2m) along the plane.");
}

EXERCISE_TEST(CollisionMatrix, HasNoShareOfAStaticBody) {
  Random random;
  const RandomPair pair(random);
  const InverseMass<6> fixed, &free = pair.j.inverse_mass;
  const Vec3 far(1e6, -2e6, 3e6), r = pair.contact.r_j;
  Mat3 share;
  for (int k = 0; k < 3; ++k) share.col(k) = point_kick(free, r, Vec3::Unit(k));
  const std::string missing = "The share of the free body is missing.";
  const std::string short_arm =
      "This is 1/m alone: the free body's lever arm has been left out. It counts, however long the other one "
      "is.";
  const std::string rule =
      "A static body has inverse masses of 0, so it adds nothing. Multiply by them; never "
      "divide by 0.";
  expect_near_vector("K when body i is fixed, column by column [1/kg]", "Eq. (3.8)",
                     collision_matrix(fixed, far, free, r), share, roundings(64, pair.size()),
                     {{Mat3::Zero(), missing}, {free.linear * Mat3::Identity(), short_arm}}, rule);
  expect_near_vector("K when body j is fixed, column by column [1/kg]", "Eq. (3.8)",
                     collision_matrix(free, r, fixed, far), share, roundings(64, pair.size()),
                     {{Mat3::Zero(), missing}, {free.linear * Mat3::Identity(), short_arm}}, rule);
}

EXERCISE_TEST(CollisionMatrix, DropsNothingSmall) {
  const InverseMass<6> fixed, ball{0.5, 2 * Mat3::Identity()};
  for (const double part : relative_scales)
    for (const Vec3& r : lopsided(part)) {
      Mat3 expected = -2 * r * r.transpose();  // -[r] 2 [r] = 2 (|r|² - r rᵀ)
      for (int k = 0; k < 3; ++k)
        expected(k, k) = 0.5 + 2 * (std::pow(r[(k + 1) % 3], 2) + std::pow(r[(k + 2) % 3], 2));
      expect_each_near<Mat3>("K of a fixed body and one of 2 kg [1/kg]", "Eq. (3.8)",
                             collision_matrix(fixed, r, ball, r), expected, 8);
      expect_each_near<Mat3>("K of one of 2 kg and a fixed body [1/kg]", "Eq. (3.8)",
                             collision_matrix(ball, r, fixed, r), expected, 8);
      if (::testing::Test::HasFailure()) return;
    }
}

EXERCISE_TEST(CollisionMatrix, IsSymmetricAndPositiveDefinite) {
  Random random;
  for (int trial = 0; trial < 50 && !::testing::Test::HasFailure(); ++trial) {
    const RandomPair pair(random);
    const Mat3 K = K_of(pair);
    const Mat3 skew = K - K.transpose();
    expect_near("|K - Kᵀ| [1/kg]", "Eq. (3.8)", skew.norm(), 0, roundings(64, pair.size()), {},
                "K is symmetric: the transpose of [r] I⁻¹ [r] is itself. Keep the order of [r] and I⁻¹.");
    const double smallest = eigenvalues(K).minCoeff();
    expect_at_least(
        "smallest eigenvalue of K [1/kg]", "Eq. (3.8)", smallest,
        1 / pair.i.mass + 1 / pair.j.mass - roundings(64, pair.size()).value,
        "1/m_i + 1/m_j, less 64 roundings: turning can only make a point easier to move",
        "[r] is antisymmetric, so [r] I⁻¹ [r] is negative or zero in every direction: subtract it.");
  }
}

EXERCISE_TEST(CollisionMatrix, AlongTheNormalIsTheInverseMassOfTheRow) {
  Random random;
  for (int trial = 0; trial < 50 && !::testing::Test::HasFailure(); ++trial) {
    const RandomPair pair(random);
    const Vec3& n = pair.contact.n;
    const double nKn = n.dot(K_of(pair) * n);
    const auto [Gi, Gj] = contact_jacobian(pair.contact);
    const double from_i = Gi.dot(pair.i.inverse_mass.times(Gi)), from_j = Gj.dot(pair.j.inverse_mass.times(Gj));
    const double linear = 1 / pair.i.mass + 1 / pair.j.mass;
    expect_near("n·Kn against G M⁻¹ Gᵀ [1/kg]", "Eq. (3.9)", nKn, from_i + from_j, roundings(64, pair.size()),
                {{from_i, "The share of body j is missing."},
                 {from_j, "The share of body i is missing."},
                 {linear, "The rotation is missing."},
                 {2 * linear - from_i - from_j, "The sign of the rotation: it makes n·Kn larger."}},
                "With G of Eq. (3.3), G M⁻¹ Gᵀ is n·Kn.");
  }
}

EXERCISE_TEST(CollisionMatrix, CountsLinearAndAngularApart) {
  // A body on a pin turns but does not move. A body in a sleeve moves but does not turn.
  Random random;
  Regions regions(
      {"i does not move", "i does not turn", "j does not move", "j does not turn", "neither moves"});
  while (regions.lack_draws()) {
    RandomPair pair(random);
    InverseMass<6>&i = pair.i.inverse_mass, &j = pair.j.inverse_mass;
    for (InverseMass<6>* body : {&i, &j}) {
      if (random.integer(0, 2) == 0) body->linear = 0;
      if (random.integer(0, 2) == 0) body->angular.setZero();
    }
    regions.draw({{"i does not move", i.linear == 0},
                  {"i does not turn", i.angular.isZero(0)},
                  {"j does not move", j.linear == 0},
                  {"j does not turn", j.angular.isZero(0)},
                  {"neither moves", i.linear + j.linear == 0}});
    const Vec3 J = random.vector(), r_i = pair.contact.r_i, r_j = pair.contact.r_j;
    const auto share = [&](const InverseMass<6>& body, const Vec3& r) -> Vec3 {
      return body.linear * J + (body.angular * r.cross(J)).cross(r);
    };
    const Vec3 expected = share(i, r_i) + share(j, r_j);
    expect_near_vector(
        "K J, for J = " + show(Eigen::MatrixXd(J)) + " N s [m/s]", "Eq. (3.8)",
        Vec3(collision_matrix(i, r_i, j, r_j) * J), expected, roundings(64, pair.size()),
        {{share(i, r_i), "This is body i's share alone."}, {share(j, r_j), "This is body j's share alone."}},
        "1/m and I⁻¹ are independent: where one of them is zero, the other still counts.");
  }
}

}  // namespace
