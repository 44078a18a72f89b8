// The highest frequency of a tight wire: by hand, against the modes of a string, and as the limit of leapfrog.
#include <numbers>

#include "12_stiff_wires/stiff_wires.hpp"
#include "algebra.hpp"
#include "exercise_test.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(TransverseFrequency, "12.1 transverse_frequency");

EXERCISE_TEST(TransverseFrequency, IsThatOfNeighboursOnEitherSide) {
  const double T = 36, m = 0.4, l = 0.1;  // 4T/(ml) = 3600
  expect_near(
      "ω of points of 0.4 kg, 0.1 m apart, under 36 N [rad/s]", "Eq. (12.1)", transverse_frequency(T, m, l), 60,
      roundings(8, 60),
      {{std::sqrt(2 * T / (m * l)),
        "This is √(2T/(m l)), of a point between two that are held. Its neighbours stand out on the other "
        "side: each link is turned twice as far."},
       {std::sqrt(T / (m * l)), "This is √(T/(m l)): the factor 4 is missing."},
       {3600, "This is ω²: take the root."},
       {60 / (2 * std::numbers::pi), "This is in turns a second. ω is in radians a second."},
       {std::sqrt(4 * T / m) / l,
        "This divides by l twice. One l too many: T/l is the spring constant of a turned link."},
       {std::sqrt(4 * T / m), "l is missing: T/l is the spring constant of a turned link."},
       {2.0 / 60, "This is 2/ω, the step of Eq. (12.2)."},
       {1.0 / 60, "This is 1/ω."}});
}

EXERCISE_TEST(TransverseFrequency, IsTheEdgeOfTheModesOfAString) {
  Random random;
  for (int points = 1; points <= 64 && !::testing::Test::HasFailure(); points *= 2) {
    const double T = random.log_uniform(1, 1e4), m = random.log_uniform(1e-3, 10);
    const double l = random.log_uniform(1e-3, 1);
    const double omega = transverse_frequency(T, m, l);
    // m x'' = T/l (x_left - 2x + x_right), with the ends held.
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(points, points);
    A.diagonal().setConstant(2 * T / (m * l));
    if (points > 1) {
      A.diagonal(1).setConstant(-T / (m * l));
      A.diagonal(-1).setConstant(-T / (m * l));
    }
    const double fastest = std::sqrt(eigenvalues(A).maxCoeff());
    const double share = std::sin(points * std::numbers::pi / (2 * (points + 1)));
    expect_near("highest frequency of a string of " + std::to_string(points) +
                    " points between fixed ends, as ω sin(Nπ/(2(N+1))), T = " + show(T) + " N, m = " + show(m) +
                    " kg, l = " + show(l) + " m [rad/s]",
                "Eq. (12.1), (12.10)", omega * share, fastest,
                {1e-12 * fastest, "the eigenvalues of a matrix of up to 64 points, in units of round-off"}, {},
                "The eigenvalues of the string's matrix are exact; ω is their upper limit.");
  }
}

/// The largest distance of the points, over the initial one, if leapfrog steps them in the highest mode of a string.
double amplitude(double h, double T, double m, double l, int points, int steps) {
  Particles string;
  for (int k = 0; k <= points + 1; ++k) {
    const double out = std::sin(points * k * std::numbers::pi / (points + 1));
    string.x.push_back(Vec3(k * l, k <= points ? out : 0, 0));
    string.v.push_back(Vec3::Zero());
    string.inverse_mass.push_back(k == 0 || k == points + 1 ? 0 : 1 / m);
  }
  const auto pull = [&](std::size_t k, const std::vector<Vec3>& x) -> Vec3 {
    if (string.inverse_mass[k] == 0) return Vec3::Zero();
    return T / l * (x[k - 1].y() - 2 * x[k].y() + x[k + 1].y()) * Vec3::UnitY();
  };
  for (std::size_t k = 0; k < string.x.size(); ++k)
    string.v[k] = half_step_start(string.v[k], pull(k, string.x), string.inverse_mass[k], h);
  double largest = 0;
  for (int n = 0; n < steps; ++n) {
    leapfrog_step(string, pull, h);
    for (const Vec3& x : string.x) largest = std::max(largest, std::abs(x.y()));
  }
  return largest;
}

EXERCISE_TEST(TransverseFrequency, IsTheStabilityLimitOfLeapfrog) {
  const double T = 50, m = 0.02, l = 0.1;
  const double largest = 2 / transverse_frequency(T, m, l);
  expect_at_most("largest distance in a string of 30 points with h = 0.99·2/ω, from 1 m, in 200 steps [m]",
                 "Eq. (12.2)", amplitude(0.99 * largest, T, m, l, 30, 200), 1 + 1e-9,
                 "cos(nθ), Eq. (1.8); round-off in other modes stays as small",
                 "Leapfrog is unstable for this string at a step below your 2/ω: your ω is too small.");
  expect_at_least("largest distance with h = 1.05·2/ω, in 200 steps [m]", "Eq. (12.2)",
                  amplitude(1.05 * largest, T, m, l, 30, 200), 1e6, "beyond 2/ω it grows by 1.9 a step",
                  "Leapfrog is stable for this string at a step above your 2/ω: your ω is too large.");
}

EXERCISE_TEST(TransverseFrequency, OfASlackWireIsZero) {
  expect_near("ω without tension [rad/s]", "Eq. (12.1)", transverse_frequency(0, 1, 1), 0, {0, "exact"});
}

EXERCISE_TEST(TransverseFrequency, RefusesWhatIsNoWire) {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  for (const double bad : {-1.0, nan, inf})
    expect_rejects(
        "a tension of " + show(bad) + " N", "tension", [=] { transverse_frequency(bad, 1, 1); },
        "A wire under a negative tension has no frequency: the root would be a NaN.");
  for (const double bad : {0.0, -1.0, nan, inf}) {
    expect_rejects("a mass of " + show(bad) + " kg", "mass", [=] { transverse_frequency(1, bad, 1); });
    expect_rejects("a length of " + show(bad) + " m", "length", [=] { transverse_frequency(1, 1, bad); });
    const std::string slack = "Check all arguments before you return, also where the tension is 0.";
    expect_rejects(
        "a mass of " + show(bad) + " kg, slack", "mass", [=] { transverse_frequency(0, bad, 1); }, slack);
    expect_rejects(
        "a length of " + show(bad) + " m, slack", "length", [=] { transverse_frequency(0, 1, bad); }, slack);
  }
}

}  // namespace
