#pragma once
// Points between bounds, for the tests of the steps that an interior point is made of.
#include "systems.hpp"

namespace spook::testing {

/// A point of a system with four kinds of rows in turn: no bound, one below, one above, two. λ, rooms and pushes do not
/// solve it.
struct Inside {
  MatrixXd S;
  VectorXd B;
  Interior now;
  Target target;
};

inline Inside random_inside(Random& random, int rows) {
  const System<6> s = random_system(random, 4, rows);
  const VectorXd none = VectorXd::Zero(rows);
  Inside p{.S = dense_S(s.rows),
           .B = gathered(s.rows, &Row<6>::B),
           .now = {.lambda = none, .room_lo = none, .room_hi = none, .push_lo = none, .push_hi = none},
           .target = {.lo = none, .hi = none}};
  for (Eigen::Index k = 0; k < rows; ++k) {
    const bool lo = k % 4 == 1 || k % 4 == 3, hi = k % 4 == 2 || k % 4 == 3;
    p.now.lambda[k] = random.uniform(-1, 1);
    p.now.room_lo[k] = lo ? random.uniform(0.1, 2) : infinity;
    p.now.room_hi[k] = hi ? random.uniform(0.1, 2) : infinity;
    p.now.push_lo[k] = lo ? random.uniform(0.1, 2) : 0;
    p.now.push_hi[k] = hi ? random.uniform(0.1, 2) : 0;
    p.target.lo[k] = random.uniform(-0.2, 1);  // there where there is no bound, too
    p.target.hi[k] = random.uniform(-0.2, 1);
  }
  return p;
}

/// S̃ of Eq. (11.7).
inline MatrixXd dense_barrier(const Inside& p) {
  MatrixXd S = p.S;
  S.diagonal() += p.now.push_lo.cwiseQuotient(p.now.room_lo) + p.now.push_hi.cwiseQuotient(p.now.room_hi);
  return S;
}

inline bool has_lo(const Interior& now, Eigen::Index k) {
  return std::isfinite(now.room_lo[k]);
}
inline bool has_hi(const Interior& now, Eigen::Index k) {
  return std::isfinite(now.room_hi[k]);
}

}  // namespace spook::testing
