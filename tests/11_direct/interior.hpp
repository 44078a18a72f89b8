#pragma once
// Points between bounds, for the tests of the parts of an interior-point step.
#include "checks.hpp"
#include "systems.hpp"

namespace spook::testing {

/// A point of a system with four kinds of rows in turn: no bound, one below, one above, two. Its λ, rooms and pushes
/// are not a solution.
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
    p.target.lo[k] = random.uniform(-0.2, 1);  // where there is no bound, too
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

/// Tests that a point, or a step, has one entry a row in each of its vectors.
inline bool has_size(const Interior& got, Eigen::Index rows, const std::string& equation) {
  const bool right = got.lambda.size() == rows && got.room_lo.size() == rows && got.room_hi.size() == rows &&
                     got.push_lo.size() == rows && got.push_hi.size() == rows;
  expect_true("all five vectors have an entry a row", equation, right);
  return right;
}

/// The vectors that have to stay positive.
struct Part {
  const char* name;
  Vector Interior::*vector;
};

inline constexpr Part parts[] = {{"room below", &Interior::room_lo},
                                 {"room above", &Interior::room_hi},
                                 {"push below", &Interior::push_lo},
                                 {"push above", &Interior::push_hi}};

inline bool has_lo(const Interior& now, Eigen::Index k) {
  return std::isfinite(now.room_lo[k]);
}
inline bool has_hi(const Interior& now, Eigen::Index k) {
  return std::isfinite(now.room_hi[k]);
}

}  // namespace spook::testing
