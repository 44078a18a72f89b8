// Beyond chapter 14's own tests: the laws of a cone, valid colours, lanes row by row, the same bits.
#include <algorithm>
#include <set>

#include "14_fast_rows/fast_rows.hpp"
#include "dense_rows.hpp"
#include "exercise_test.hpp"
#include "stop_rule.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(SolveOnCone, "14.1 solve_on_cone");
EXERCISE(UpdateContact, "14.2 update_contact");
EXERCISE(ColourPairs, "14.3 colour_pairs");
EXERCISE(UpdatePack, "14.4 update_pack");
EXERCISE(SolveInColours, "14.5 solve_in_colours");
EXERCISE(OntoDiscs, "14.6 onto_discs");

EXERCISE_TEST(SolveOnCone, DoesNotAskForTheTangents) {
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

EXERCISE_TEST(SolveOnCone, ObeysTheLawsOfACone) {
  Random random;
  for (int k = 0; k < 60; ++k) {
    Mat3 A = Mat3::Identity();
    for (int column = 0; column < 3; ++column) A.col(column) += 0.3 * random.vector();
    const Mat3 S = A * A.transpose();
    const Vec3 q = random.vector(2);
    const double mu = k % 5 == 0 ? 0 : random.uniform(0.05, 1);
    const Vec3 lambda = solve_on_cone(S, q, mu);
    const double close = 1e-8 * (1 + lambda.norm());
    if (q[0] <= 0) {
      expect_near_vector("λ of what parts [N s]", "Eq. (14.3)", lambda, Vec3(0, 0, 0),
                         {0, "no push, no friction"});
      continue;
    }
    const Vec3 u = S * lambda - q;
    const Vec2 slip = u.tail<2>(), rub = lambda.tail<2>();
    const double room = mu * lambda[0] - rub.norm();
    expect_near("normal velocity after it [m/s]", "Eq. (14.5)", u[0], 0, {close, "an iteration's stop"});
    expect_at_least("μ λ_n - |λ_t| [N s]", "Eq. (14.5)", room, -close, "an iteration's stop");
    if (room > 10 * close)
      expect_near("slip of what sticks [m/s]", "Eq. (14.4)", slip.norm(), 0, {close, "an iteration's stop"});
    else
      expect_near("λ_t·u_t + |λ_t||u_t|: friction is against the slip [J]", "Eq. (14.5)",
                  rub.dot(slip) + rub.norm() * slip.norm(), 0,
                  {10 * close * (1 + slip.norm()), "an iteration's stop"});
  }
}

struct Heap {
  Random random;
  std::vector<Row<6>> rows;
  std::vector<FrictionContact> contacts;
  std::vector<Twist<6>> V;

  /// Contacts of three rows each, or rows with any bounds; body 0 is static.
  Heap(int count, bool rubs) {
    Motion<6> motion;
    for (int b = 0; b < 12; ++b) {
      motion.inverse_mass.push_back(b == 0 ? InverseMass<6>{} : random_body(random));
      motion.W.push_back(random.twist());
      motion.Wf.push_back(random.twist(0.2));
      V.push_back(b == 0 ? Twist<6>(Twist<6>::Zero()) : random.twist(0.2));
    }
    for (int k = 0; k < count; ++k) {
      const int i = random.integer(0, 11), step = random.integer(1, 11), j = (i + step) % 12;
      const Vec3 n = random.unit_vector(), r_i = random.vector(), r_j = random.vector();
      const Tangents t = tangents(n);
      if (rubs) contacts.push_back({.normal = rows.size(), .mu = random.uniform(0.1, 1)});
      for (const Vec3& along : {n, t.t1, t.t2}) {
        const ContactJacobian G = contact_jacobian({i, j, along, 0, r_i, r_j});
        rows.push_back(make_row<6>({.i = i,
                                    .j = j,
                                    .Gi = G.Gi,
                                    .Gj = G.Gj,
                                    .gap = -0.05,
                                    .spook = {.a = 4, .b = 0.8, .Sigma = 0.3},
                                    .lo = rubs && along == n ? 0 : -infinity,
                                    .hi = infinity},
                                   motion));
        if (!rubs) give_any_bounds(random, rows.back());
        if (!rubs && k % 3 == 0) break;  // runs of one row and of three
      }
    }
  }
};

EXERCISE_TEST(UpdateContact, LeavesItsContactSolved) {
  Heap t(60, true);
  for (const FrictionContact& c : t.contacts) {
    const std::vector<Twist<6>> before = t.V;
    const auto lacks = [&](std::size_t k) {
      const Row<6>& row = t.rows[k];
      return row.B - row.Gi.dot(t.V[static_cast<std::size_t>(row.i)]) -
             row.Gj.dot(t.V[static_cast<std::size_t>(row.j)]) - row.Sigma * row.lambda;
    };
    Vec3 were, was_lacking;
    for (int a = 0; a < 3; ++a)
      were[a] = t.rows[c.normal + static_cast<std::size_t>(a)].lambda,
      was_lacking[a] = lacks(c.normal + static_cast<std::size_t>(a));
    const double returned = update_contact(c, t.rows, t.V);
    Vec3 lambda, now;
    std::vector<Twist<6>> expected = before;
    for (int a = 0; a < 3; ++a) {
      const Row<6>& row = t.rows[c.normal + static_cast<std::size_t>(a)];
      lambda[a] = row.lambda, now[a] = lacks(c.normal + static_cast<std::size_t>(a));
      apply_impulse(row, row.lambda - were[a], expected);
    }
    for (std::size_t b = 0; b < 12; ++b)
      expect_near_vector("V of body " + std::to_string(b), "Eq. (4.5)", t.V[b], expected[b], roundings(200, 5));
    const double close = 1e-8 * (1 + lambda.norm()), room = c.mu * lambda[0] - lambda.tail<2>().norm();
    expect_at_least("μ λ_n - |λ_t| [N s]", "Eq. (14.5)", room, -close, "an iteration's stop");
    if (lambda[0] > 0)
      expect_near("what the normal row lacks [m/s]", "Eq. (14.2)", now[0], 0, {close, "an iteration's stop"});
    if (room > 10 * close)
      expect_near("what the tangents lack [m/s]", "Eq. (14.4)", now.tail<2>().norm(), 0,
                  {close, "an iteration's stop"});
    expect_near("|S Δλ|, which is returned [m/s]", "Eq. (14.2)", returned, (was_lacking - now).norm(),
                {close, "an iteration's stop"});
  }
}

EXERCISE_TEST(ColourPairs, TakesTheFirstColourThatIsFree) {
  Random random;
  std::vector<Pair> pairs;
  for (int k = 0; k < many; ++k) {
    const int i = random.integer(-1, 15), step = random.integer(1, 15);
    pairs.emplace_back(i, k % 6 == 0 ? -1 : (i + 1 + step) % 16);  // -1 is a static body, which may be in all
  }
  std::vector<int> expected;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    int colour = 0;
    for (bool free = false; !free; colour += free ? 0 : 1) {
      free = true;
      for (std::size_t l = 0; l < k; ++l)
        for (const int body : {pairs[k].first, pairs[k].second})
          if (expected[l] == colour && body >= 0 && (pairs[l].first == body || pairs[l].second == body))
            free = false;
    }
    expected.push_back(colour);
  }
  expect_true("each pair has the first colour that neither body has", "Eq. (14.7)",
              colour_pairs(pairs, 16) == expected);
  expect_true("of no pairs there are no colours", "Eq. (14.7)", colour_pairs({}, 3).empty());
}

/// Sweeps the rows of all packs one by one.
double sweep_by_hand(const std::vector<Colour<6>>& colours, std::vector<Row<6>>& rows,
                     std::vector<Twist<6>>& V) {
  double most = 0;
  for (const Colour<6>& colour : colours)
    for (const Pack<6>& pack : colour)
      for (int lane = 0; lane < lane_count; ++lane)
        for (std::size_t m = 0; pack.first[static_cast<std::size_t>(lane)] >= 0 && m < pack.rows.size(); ++m) {
          const std::size_t first = static_cast<std::size_t>(pack.first[static_cast<std::size_t>(lane)]),
                            k = first + m;
          if (k >= rows.size() || rows[k].i != rows[first].i || rows[k].j != rows[first].j) break;
          most = std::max(most, rows[k].diagonal * std::abs(update_row(rows[k], V)));
        }
  return most;
}

void expect_same_rows(const std::string& equation, const std::vector<Row<6>>& got,
                      const std::vector<Row<6>>& expected, const std::vector<Twist<6>>& V,
                      const std::vector<Twist<6>>& V_expected) {
  for (std::size_t k = 0; k < got.size(); ++k)
    expect_near("λ of row " + std::to_string(k) + " [N s]", equation, got[k].lambda, expected[k].lambda,
                {1e-10, "roundings of the rows before"});
  for (std::size_t b = 0; b < V.size(); ++b)
    expect_near_vector("V of body " + std::to_string(b), equation, V[b], V_expected[b],
                       {1e-9, "roundings of the rows before"});
}

EXERCISE_TEST(UpdatePack, IsFourUpdatesAtOnce) {
  Heap t(40, false);
  std::vector<Colour<6>> colours = packed(t.rows, 12);
  std::vector<Row<6>> got = t.rows, expected = t.rows;
  std::vector<Twist<6>> V = t.V, V_expected = t.V;
  double most = 0;
  for (Colour<6>& colour : colours)
    for (Pack<6>& pack : colour) most = std::max(most, update_pack(pack, V));
  unpack(colours, got);
  expect_near("the largest change, which is returned [m/s]", "Eq. (4.9)", most,
              sweep_by_hand(colours, expected, V_expected), {1e-10, "roundings of a sweep"});
  expect_same_rows("Eq. (14.9)", got, expected, V, V_expected);
  colours[0][0].rows[0].B[0] = std::nan("");
  expect_true("a NaN stays one", "Eq. (4.9)", std::isnan(update_pack(colours[0][0], V)));
}

EXERCISE_TEST(SolveInColours, MakesItsSweepsAndStopsByTheRule) {
  const Heap t(40, false);
  std::vector<Colour<6>> colours = packed(t.rows, 12);
  std::vector<Row<6>> got = t.rows, expected = t.rows;
  std::vector<Twist<6>> V = t.V, V_expected = t.V;
  const SolveReport report = solve_in_colours(colours, V, {.max_sweeps = 3}, 2);
  unpack(colours, got);
  std::vector<double> history;
  for (int k = 0; k < 3; ++k) history.push_back(sweep_by_hand(colours, expected, V_expected));
  expect_same_rows("Eq. (14.10)", got, expected, V, V_expected);
  expect_true("it makes three sweeps", "Eq. (4.9)", report.history.size() == 3 && !report.converged);
  for (std::size_t k = 0; k < std::min<std::size_t>(report.history.size(), 3); ++k)
    expect_near("what sweep " + std::to_string(k) + " lacked [m/s]", "Eq. (4.9)", report.history[k], history[k],
                {1e-10, "roundings of a sweep"});
  expect_stops_by_the_rule("Eq. (4.9)", 20, [](const StopRule& stop) {
    Heap fresh(12, false);
    std::vector<Colour<6>> in_colours = packed(fresh.rows, 12);
    return solve_in_colours(in_colours, fresh.V, stop, 1);
  });
  for (const int threads : {0, 257})
    expect_rejects("threads = " + std::to_string(threads), "threads",
                   [&] { solve_in_colours(colours, V, {}, threads); });
  expect_rejects("max_sweeps = 0", "max_sweeps", [&] { solve_in_colours(colours, V, {.max_sweeps = 0}, 1); });
  expect_rejects("tolerance = -1", "tolerance", [&] { solve_in_colours(colours, V, {.tolerance = -1}, 1); });
}

EXERCISE_TEST(OntoDiscs, IsOneDiscALane) {
  Random random;
  for (const double size : {1.0, 1e-9, 1e9}) {
    LanePairs lambda;
    Lanes radius;
    for (int lane = 0; lane < lane_count; ++lane) {
      lambda(lane, 0) = size * random.uniform(-1, 1);
      lambda(lane, 1) = size * random.uniform(-1, 1);
      radius[lane] = lane == 0 ? 0 : size * random.uniform(0.1, 1.5);
    }
    if (size == 1) lambda.row(0).setZero();
    const LanePairs got = onto_discs(lambda, radius);
    for (int lane = 0; lane < lane_count; ++lane) {
      const Vec2 expected = onto_disc(Vec2(lambda(lane, 0), lambda(lane, 1)), radius[lane]);
      expect_near_vector("λ_t of lane " + std::to_string(lane), "Eq. (14.14)", Vec2(got(lane, 0), got(lane, 1)),
                         expected, roundings(16, size));
    }
  }
}

}  // namespace
