#pragma once
// Rows that couple a few bodies, for the tests of packs and colours.
#include <cstring>

#include "14_fast_rows/fast_rows.hpp"
#include "checks.hpp"
#include "dense_rows.hpp"
#include "random_input.hpp"

namespace spook::testing {

/// A row between two bodies, anywhere. Some of the bounds are active.
inline Row<6> some_row(Random& random, int i, int j, const Motion<6>& motion) {
  Constraint<6> c;
  c.i = i, c.j = j, c.gap = random.uniform(-1, 1);
  for (int k = 0; k < 6; ++k) c.Gi[k] = random.uniform(-1, 1), c.Gj[k] = random.uniform(-1, 1);
  c.spook = {.a = 1, .b = 1, .Sigma = random.uniform(0.05, 0.3)};
  c.lo = random.uniform(-0.3, 0), c.hi = random.uniform(0, 0.3);
  return make_row(c, motion);
}

/// Rows among bodies; body 0 is static. Runs of one to three rows are of the same two bodies.
struct Heap {
  Motion<6> motion;
  std::vector<Row<6>> rows;
  std::vector<Twist<6>> V;

  Heap(Random& random, int bodies, int runs) {
    motion.inverse_mass.push_back({.linear = 0, .angular = Mat3::Zero()});
    for (int k = 1; k < bodies; ++k) motion.inverse_mass.push_back(random_body(random));
    for (int k = 0; k < bodies; ++k) {
      Twist<6> W;
      for (int n = 0; n < 6; ++n) W[n] = k == 0 ? 0 : random.uniform(-1, 1);
      motion.W.push_back(W);
    }
    motion.Wf.assign(motion.W.size(), Twist<6>::Zero());
    V = motion.Wf;
    for (int run = 0; run < runs; ++run) {
      const int i = random.integer(0, bodies - 1), j = (i + random.integer(1, bodies - 1)) % bodies;
      for (int n = random.integer(1, 3); n > 0; --n) rows.push_back(some_row(random, i, j, motion));
    }
  }
};

inline bool same_bits(const std::vector<Twist<6>>& a, const std::vector<Twist<6>>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

inline bool same_bits(const Heap& a, const Heap& b) {
  for (std::size_t k = 0; k < a.rows.size(); ++k)
    if (std::memcmp(&a.rows[k].lambda, &b.rows[k].lambda, sizeof(double)) != 0) return false;
  return same_bits(a.V, b.V);
}

/// A pack of rows, with one list of rows for each lane; all lists are equally long. Lanes without rows are empty.
inline Pack<6> pack_of(const std::array<std::vector<Row<6>>, lane_count>& lanes, std::size_t rows) {
  Pack<6> pack{.rows = std::vector<LaneRows<6>>(rows)};
  for (int lane = 0; lane < lane_count; ++lane)
    for (std::size_t m = 0; m < lanes[lane].size(); ++m) {
      const Row<6>& row = lanes[lane][m];
      pack.i[lane] = row.MinvGi.isZero(0) ? -1 : row.i;
      pack.j[lane] = row.MinvGj.isZero(0) ? -1 : row.j;
      LaneRows<6>& into = pack.rows[m];
      into.Gi.row(lane) = row.Gi.array(), into.Gj.row(lane) = row.Gj.array();
      into.MinvGi.row(lane) = row.MinvGi.array(), into.MinvGj.row(lane) = row.MinvGj.array();
      into.B[lane] = row.B, into.Sigma[lane] = row.Sigma, into.diagonal[lane] = row.diagonal;
      into.lo[lane] = row.lo, into.hi[lane] = row.hi, into.lambda[lane] = row.lambda;
    }
  return pack;
}

}  // namespace spook::testing
