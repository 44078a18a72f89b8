// Four lanes: each computes chapter 04's update_row.
#include "14_fast_rows/fast_rows.hpp"
#include "exercise_test.hpp"
#include "packs.hpp"
#include "random_input.hpp"
#include "regions.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(UpdatePack, "14.4 update_pack");

/// Four pairs of eight dynamic bodies, with so many rows each, and with impulses and velocities on entry.
struct FourPairs {
  Motion<6> motion;
  std::vector<Twist<6>> V;
  std::array<std::vector<Row<6>>, lane_count> lanes;

  FourPairs(Random& random, int rows) {
    for (int k = 0; k < 2 * lane_count; ++k) {
      motion.inverse_mass.push_back(random_body(random));
      Twist<6> v;
      for (int n = 0; n < 6; ++n) v[n] = random.uniform(-0.3, 0.3);
      V.push_back(v);
    }
    motion.W.assign(V.size(), Twist<6>::Zero()), motion.Wf = motion.W;
    for (int lane = 0; lane < lane_count; ++lane)
      for (int m = 0; m < rows; ++m) {
        lanes[lane].push_back(some_row(random, 2 * lane + 1, 2 * lane, motion));
        lanes[lane].back().lambda = random.uniform(lanes[lane].back().lo, lanes[lane].back().hi);
      }
  }
};

/// The round-off of another order of sums: 12 products in each scalar product, of numbers of about 1.
const Tolerance other_order = roundings(500, 1);

EXERCISE_TEST(UpdatePack, IsUpdateRowInEachLane) {
  Random random;
  Regions regions({"free", "at lo", "at hi", "at lo = 0, without hi", "at hi = 0, without lo"}, 20);
  while (regions.lack_draws()) {
    FourPairs t(random, 1);
    for (std::vector<Row<6>>& rows : t.lanes) {  // contacts, and their mirror images, too
      const int kind = random.integer(0, 3);
      if (kind == 0) rows[0].lo = 0, rows[0].hi = infinity;
      if (kind == 1) rows[0].lo = -infinity, rows[0].hi = 0;
    }
    Pack<6> pack = pack_of(t.lanes, 1);
    std::vector<Twist<6>> V = t.V;
    update_pack(pack, V);
    for (int lane = 0; lane < lane_count; ++lane) {
      Row<6> row = t.lanes[lane][0];
      const double before = row.lambda, GVi = row.Gi.dot(t.V[row.i]), GVj = row.Gj.dot(t.V[row.j]),
                   GV = GVi + GVj, S = row.diagonal;
      const double r = row.B - GV - row.Sigma * before;
      update_row(row, t.V);
      const double at = row.lambda;
      regions.draw({{"free", row.lo < at && at < row.hi},
                    {"at lo", at == row.lo},
                    {"at hi", at == row.hi},
                    {"at lo = 0, without hi", at == row.lo && row.lo == 0 && row.hi == infinity},
                    {"at hi = 0, without lo", at == row.hi && row.hi == 0 && row.lo == -infinity}});
      const std::string where = " in lane " + std::to_string(lane);
      const auto clamped = [&](double x) { return std::clamp(x, row.lo, row.hi); };
      expect_near(
          "λ" + where + " [N s]", "Eq. (14.9), (4.7)", pack.rows[0].lambda[lane], at, other_order,
          {{clamped(before + (row.B - GV) / S), "Σ λ is missing in the rows' residual."},
           {clamped(before + (r + GVi) / S), "The velocity of body i is missing."},
           {clamped(before + (r + GVj) / S), "The velocity of body j is missing."},
           {clamped(before + (row.B - row.Sigma * before) / S), "Neither body has been gathered."},
           {before + r / S, at == row.lo ? "The lower bound is missing." : "The upper bound is missing."},
           {before + clamped(r / S), "Δλ has been clamped, and not λ."}},
          "Compute chapter 04's update_row in this lane.");
      expect_near_vector("V of body i" + where, "Eq. (4.5)", V[row.i], t.V[row.i], other_order, {},
                         "Gather, update, then write the velocity back.");
      expect_near_vector("V of body j" + where, "Eq. (4.5)", V[row.j], t.V[row.j], other_order, {},
                         "Gather, update, then write the velocity back.");
    }
  }
}

EXERCISE_TEST(UpdatePack, TakesRowsInTheirOrder) {
  Random random;
  for (int trial = 0; trial < 20 && !::testing::Test::HasFailure(); ++trial) {
    const int count = trial == 0 ? many : 3;
    const Tolerance tolerance = roundings(5000.0 * count / 3, 1);
    FourPairs t(random, count);
    for (std::vector<Row<6>>& rows : t.lanes)
      for (Row<6>& row : rows) row.lo = -infinity, row.hi = infinity;
    Pack<6> pack = pack_of(t.lanes, static_cast<std::size_t>(count));
    const std::vector<Twist<6>> V0 = t.V;
    std::vector<Twist<6>> V = t.V;
    update_pack(pack, V);
    for (int lane = 0; lane < lane_count; ++lane)
      for (int m = 0; m < count && !::testing::Test::HasFailure(); ++m) {
        Row<6>&row = t.lanes[lane][m], blind = row;
        std::vector<Twist<6>> unseen = V0;
        update_row(blind, unseen);
        update_row(row, t.V);
        expect_near(
            "λ of row " + std::to_string(m) + " of " + std::to_string(count) + " in lane " +
                std::to_string(lane) + " [N s]",
            "Eq. (14.9), (4.2)", pack.rows[m].lambda[lane], row.lambda, tolerance,
            {{blind.lambda, "The velocities are old: each row must use the updates of the rows before it."}},
            "Update the velocities from row to row. " + ends_early);
      }
    for (std::size_t body = 0; body < V.size() && !::testing::Test::HasFailure(); ++body)
      expect_near_vector("V of body " + std::to_string(body) + " after them", "Eq. (4.5)", V[body], t.V[body],
                         tolerance, {}, "Update all rows, then scatter.");
  }
}

EXERCISE_TEST(UpdatePack, LeavesBodiesThatDoNotMoveAlone) {
  Random random;
  FourPairs t(random, 2);
  for (std::vector<Row<6>>& rows : t.lanes)
    for (Row<6>& row : rows) row.MinvGi.setZero();  // body i is static: there is no velocity to read
  for (int lane = 0; lane < lane_count; ++lane) t.V[2 * lane + 1].setZero();
  Pack<6> pack = pack_of(t.lanes, 2);
  std::vector<Twist<6>> V = t.V;
  for (int lane = 0; lane < lane_count; ++lane) V[2 * lane + 1].setConstant(77);
  update_pack(pack, V);
  for (int lane = 0; lane < lane_count; ++lane) {
    for (Row<6>& row : t.lanes[lane]) update_row(row, t.V);
    expect_near("λ in lane " + std::to_string(lane) + ", body i is static [N s]", "Eq. (14.9)",
                pack.rows[1].lambda[lane], t.lanes[lane][1].lambda, roundings(5000, 1), {},
                "Where pack.i is -1 the velocity is 0.");
    expect_near_vector("V of a body that is in no lane", "Eq. (14.9)", V[2 * lane + 1],
                       Twist<6>(Twist<6>::Constant(77)), {0, "unchanged"}, {},
                       "Where pack.i is -1 nothing is written.");
  }
}

EXERCISE_TEST(UpdatePack, LeavesEmptyLanesEmpty) {
  Random random;
  for (int filled = 0; filled <= lane_count; ++filled) {
    FourPairs t(random, 2);
    const auto all = t.lanes;
    for (int lane = filled; lane < lane_count; ++lane) t.lanes[lane].clear();
    if (filled == 3) t.lanes[1].pop_back();  // its second row is missing
    Pack<6> pack = pack_of(t.lanes, 2);
    std::vector<Twist<6>> V = t.V;
    const double got = update_pack(pack, V);
    const std::string with = " with " + std::to_string(filled) + " lanes filled";
    expect_true("it returns a number," + with, "Eq. (14.9)", std::isfinite(got),
                "An empty lane has a diagonal of 1, and B = 0.");
    for (int lane = 0; lane < lane_count; ++lane) {
      for (Row<6>& row : t.lanes[lane]) update_row(row, t.V);
      for (std::size_t m = t.lanes[lane].size(); m < 2; ++m)
        expect_near("λ of an empty lane," + with + " [N s]", "Eq. (14.9)", pack.rows[m].lambda[lane], 0,
                    {0, "exact"});
    }
    for (std::size_t body = 0; body < V.size(); ++body)
      expect_near_vector("V of body " + std::to_string(body) + "," + with, "Eq. (14.9)", V[body], t.V[body],
                         roundings(5000, 1), {}, "Only bodies of filled lanes change.");
  }
}

EXERCISE_TEST(UpdatePack, ReturnsTheLargest) {
  Random random;
  for (int trial = 0; trial < 20 && !::testing::Test::HasFailure(); ++trial) {
    FourPairs t(random, 2);
    Pack<6> pack = pack_of(t.lanes, 2);
    std::vector<Twist<6>> V = t.V;
    double expected = 0, impulse = 0, last = 0, first_three = 0;
    for (int m = 0; m < 2; ++m) {
      last = 0;
      for (int lane = 0; lane < lane_count; ++lane) {
        Row<6>& row = t.lanes[lane][m];
        const double change = std::abs(update_row(row, t.V));
        expected = std::max(expected, row.diagonal * change);
        if (lane < 3) first_three = std::max(first_three, row.diagonal * change);
        last = std::max(last, row.diagonal * change);
        impulse = std::max(impulse, change);
      }
    }
    if (first_three == last) continue;  // two mistakes would return it
    expect_near("what update_pack returned [m/s]", "Eq. (4.9)", update_pack(pack, V), expected,
                roundings(5000, 3),
                {{impulse, "This is the largest |Δλ|, an impulse: multiply it by S_kk."},
                 {first_three, "Lane 3 is left out: all four lanes count."},
                 {last, "This is that of the last rows only."}},
                "Return the largest S_kk |Δλ_k| of all lanes and rows.");
  }
}

EXERCISE_TEST(UpdatePack, KeepsANaNInItsLane) {
  Random random;
  for (int lane = 0; lane < lane_count; ++lane) {
    FourPairs t(random, 2);
    t.lanes[lane][0].B = std::nan("");
    Pack<6> pack = pack_of(t.lanes, 2);
    const double got = update_pack(pack, t.V);
    const std::string clue = "min(), max() and select() with the NaN on the wrong side lose it.";
    expect_true("a right side of NaN in lane " + std::to_string(lane) + " makes it return NaN", "Eq. (4.9)",
                std::isnan(got), clue);
    for (int other = 0; other < lane_count; ++other)
      expect_true("λ in lane " + std::to_string(other) + " is " + (other == lane ? "NaN" : "a number") +
                      ", where a NaN is in lane " + std::to_string(lane),
                  "Eq. (4.7)", std::isnan(pack.rows[0].lambda[other]) == (other == lane), clue);
  }
}

}  // namespace
