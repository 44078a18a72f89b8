// Beyond chapter 14's own tests: turned tangents, valid colours, the same bits.
#include <algorithm>
#include <set>

#include "14_fast_rows/fast_rows.hpp"
#include "dense_rows.hpp"
#include "exercise_test.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(SolveOnCone, "14.1 solve_on_cone");
EXERCISE(ColourPairs, "14.3 colour_pairs");
EXERCISE(SolveInColours, "14.5 solve_in_colours");

EXERCISE_TEST(SolveOnCone, TurnsWithTheTangents) {
  Random random;
  for (int k = 0; k < 20; ++k) {
    Mat3 A = Mat3::Identity();
    for (int column = 0; column < 3; ++column) A.col(column) += 0.2 * random.vector();
    const Mat3 S = A * A.transpose();
    Vec3 q = random.vector(2);
    q[0] = random.uniform(0.5, 2);
    const double mu = random.uniform(0.1, 0.5), angle = random.uniform(0, 6);
    Mat3 R = Mat3::Identity();
    R.bottomRightCorner<2, 2>() = Eigen::Rotation2Dd(angle).toRotationMatrix();
    const Vec3 lambda = solve_on_cone(S, q, mu);
    expect_near_vector("λ for turned tangents [N s]", "Eq. (14.5)",
                       solve_on_cone(R * S * R.transpose(), R * q, mu), Vec3(R * lambda),
                       {1e-9 * (1 + lambda.norm()), "an iteration's stop, far above round-off"});
    expect_at_most("|λ_t| - μ λ_n [N s]", "Eq. (14.5)", lambda.tail<2>().norm() - mu * lambda[0],
                   1e-9 * (1 + lambda.norm()), "an iteration's stop");
  }
}

EXERCISE_TEST(ColourPairs, NeverMeetInOneColour) {
  Random random;
  std::vector<Pair> pairs;
  for (int k = 0; k < many; ++k) {
    const int i = random.integer(0, 39);
    pairs.emplace_back(i, (i + random.integer(1, 39)) % 40);
  }
  const std::vector<int> colours = colour_pairs(pairs, 40);
  std::set<std::pair<int, int>> met;  // colour and body
  std::vector<int> degree(40);
  bool apart = colours.size() == pairs.size();
  for (std::size_t k = 0; apart && k < pairs.size(); ++k)
    for (const int body : {pairs[k].first, pairs[k].second}) {
      apart = apart && met.insert({colours[k], body}).second;
      ++degree[static_cast<std::size_t>(body)];
    }
  expect_true("no two pairs of one colour share a body", "Eq. (14.7)", apart);
  const int most = *std::max_element(degree.begin(), degree.end());
  const int last = colours.empty() ? 0 : *std::max_element(colours.begin(), colours.end());
  expect_at_most("number of colours", "Eq. (14.8)", last + 1, 2 * most - 1, "2 Δ - 1");
}

EXERCISE_TEST(SolveInColours, GivesTheSameBitsOnAnyThreads) {
  Random random;
  Motion<6> motion;
  for (int k = 0; k < 12; ++k) {
    motion.inverse_mass.push_back(random_body(random));
    motion.W.push_back(random.twist());
    motion.Wf.push_back(random.twist(0.2));
  }
  std::vector<Row<6>> rows;
  for (int k = 0; k < 40; ++k) {
    const int i = random.integer(0, 11);
    const int j = (i + random.integer(1, 11)) % 12;
    const Twist<6> Gi = random.twist(), Gj = random.twist();
    rows.push_back(make_row<6>(
        {.i = i, .j = j, .Gi = Gi, .Gj = Gj, .gap = 0, .spook = {.a = 4, .b = 0.8, .Sigma = 0.5}}, motion));
  }
  std::vector<double> first;
  for (const int threads : {1, 2, 3}) {
    std::vector<Colour<6>> colours = packed(rows, 12);
    std::vector<Twist<6>> V(12, Twist<6>::Zero());
    solve_in_colours(colours, V, {.max_sweeps = 30, .tolerance = 0}, threads);
    std::vector<Row<6>> solved = rows;
    unpack(colours, solved);
    std::vector<double> bits;
    for (const Row<6>& row : solved) bits.push_back(row.lambda);
    if (first.empty()) first = bits;
    expect_true("λ on " + std::to_string(threads) + " threads is that on one, to the last bit", "Eq. (14.10)",
                bits == first);
  }
}

}  // namespace
