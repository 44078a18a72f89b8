// The transverse spring of a tight link: against the change of its pull, and by its eigenvalues.

#include "12_stiff_wires/stiff_wires.hpp"
#include "algebra.hpp"
#include "exercise_test.hpp"
#include "relative_scales.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(GeometricStiffness, "12.2 geometric_stiffness");

struct Link {
  Vec3 n;
  double l, T;
};

Link random_link(Random& random) {
  return {.n = random.unit_vector(), .l = random.log_uniform(0.01, 10), .T = random.log_uniform(0.1, 1e4)};
}

std::string text(const Link& link) {
  return "n = " + show(Eigen::MatrixXd(link.n)) + ", l = " + show(link.l) + " m, T = " + show(link.T) + " N";
}

void expect_stiffness(const std::string& what, const Link& link, const Mat3& got, const Mat3& right,
                      const Tolerance& tolerance) {
  const Mat3 one = Mat3::Identity(), along = link.n * link.n.transpose();
  const double k = link.T / link.l;
  expect_near_vector<Mat3>(
      what, "Eq. (12.3)", got, right, tolerance,
      {{-k * (one - along), "The sign: K turns the link back, its force is -K times the change of distance."},
       {k * one, "This is T/l in all directions. Along the link its tension does not change: subtract n nᵀ."},
       {k * along, "This is along the link, where the row holds it. The spring acts across it: 1 - n nᵀ."},
       {link.T * (one - along),
        "The length is missing: turned by the same angle, a short link moves its end less."},
       {k * link.l * link.l * (one - along), "This is T l: divide by the length."}},
      "The pull on the end j is -T n, and n turns with the distance of the ends: K = (T/l)(1 - n nᵀ).");
}

EXERCISE_TEST(GeometricStiffness, ByHand) {
  const Link link{.n = Vec3::UnitZ(), .l = 3, .T = 12};
  expect_stiffness("K of a link of 3 m along z, under 12 N [N/m]", link,
                   geometric_stiffness(link.n, link.l, link.T), Vec3(4, 4, 0).asDiagonal(), roundings(8, 4));
}

EXERCISE_TEST(GeometricStiffness, FollowsALinkThatNearlyLiesAlongAnAxis) {
  for (const double part : relative_scales) {
    const Vec3 n = Vec3(part, -part / 2, 1).normalized();
    const Mat3 K = geometric_stiffness(n, 3, 12);
    expect_near_vector<Vec3>(
        "K of a link of 3 m that leans by " + show(part) + " from z, under 12 N, times z [N/m]", "Eq. (12.3)",
        K.col(2), 4 * Vec3(-n.x() * n.z(), -n.y() * n.z(), n.x() * n.x() + n.y() * n.y()), roundings(8, 4),
        {{Vec3::Zero(), "It was treated as a link along z. " + small_is_dropped},
         {4 * Vec3(-n.x() * n.z(), n.y() * n.z(), n.x() * n.x() + n.y() * n.y()),
          "The signs of n are lost: n nᵀ has the entry n_y n_z, which is negative here."}},
        small_is_dropped);
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(GeometricStiffness, IsTheDerivativeOfThePull) {
  Random random;
  for (int repeat = 0; repeat < 10 && !::testing::Test::HasFailure(); ++repeat) {
    const Link link = random_link(random);
    const Mat3 K = geometric_stiffness(link.n, link.l, link.T);
    const auto pull = [&](const Vec3& distance) -> Vec3 { return -link.T * distance.normalized(); };
    const double delta = 1e-5 * link.l;
    Mat3 change;
    for (int k = 0; k < 3; ++k) {
      const Vec3 aside = delta * Vec3::Unit(k), d = link.l * link.n;
      change.col(k) = -(pull(d + aside) - pull(d - aside)) / (2 * delta);
    }
    expect_stiffness(
        "K against minus the change of the pull over that of the distance, " + text(link) + " [N/m]", link, K,
        change, {1e-9 * link.T / link.l, "differences of 1e-5 of a link, 1e-10, and their round-off, 1e-10"});
  }
}

EXERCISE_TEST(GeometricStiffness, LeavesTheLinksOwnDirectionAlone) {
  Random random;
  for (int repeat = 0; repeat < 10 && !::testing::Test::HasFailure(); ++repeat) {
    const Link link = random_link(random);
    const Mat3 K = geometric_stiffness(link.n, link.l, link.T);
    expect_near_vector<Vec3>("K n, " + text(link) + " [N/m]", "Eq. (12.3)", K * link.n, Vec3::Zero(),
                             roundings(16, link.T / link.l), {},
                             "Along itself the link is held by its row; K must not hold it twice.");
  }
}

EXERCISE_TEST(GeometricStiffness, IsTheSameAllAround) {
  Random random;
  for (int repeat = 0; repeat < 10 && !::testing::Test::HasFailure(); ++repeat) {
    const Link link = random_link(random);
    const Mat3 K = geometric_stiffness(link.n, link.l, link.T);
    const double k = link.T / link.l;
    expect_near_vector<Mat3>("K against its transpose, " + text(link) + " [N/m]", "Eq. (12.3)", K,
                             K.transpose(), roundings(8, k), {},
                             "A force with a potential energy has a symmetric stiffness.");
    const Vec3 found = eigenvalues(K);
    expect_near_vector<Vec3>("eigenvalues of K, from the smallest, " + text(link) + " [N/m]", "Eq. (12.3)",
                             found, Vec3(0, k, k), roundings(50, k),
                             {{Vec3(-k, -k, 0), "Check the sign of K."}},
                             "The eigenvalue is 0 along the link, and T/l in both directions across it.");
  }
}

EXERCISE_TEST(GeometricStiffness, OfALinkThatPushesIsZero) {
  const Vec3 n = Vec3::UnitZ();
  for (const double T : {0.0, -1e-3, -12.0}) {
    const Mat3 across = (Mat3::Identity() - n * n.transpose()) / 3;
    expect_near_vector<Mat3>(
        "K of a link of 3 m along z, for T = " + show(T) + " N [N/m]", "Eq. (12.4)",
        geometric_stiffness(n, 3, T), Mat3::Zero(), {0, "exact"},
        {{T * across,
          "A link under compression would turn away: this K is negative, and could make a mass of M̃ negative."},
         {-T * across, "A link under compression does not turn back: K is not |T|/l, but 0."}},
        "Slack or under compression, a link has K = 0.");
  }
}

EXERCISE_TEST(GeometricStiffness, KeepsANaN) {
  expect_true(
      "a tension that is NaN gives a K with a NaN", "Eq. (12.4)",
      geometric_stiffness(Vec3::UnitZ(), 3, std::nan("")).hasNaN(),
      "T > 0 is false for a NaN, and std::max(0, NaN) is 0: the NaN has become a slack link. Ask for T <= 0.");
}

}  // namespace
