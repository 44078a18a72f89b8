#pragma once
// Velocities and scalar products in lanes.
#include "14_fast_rows/fast_rows.hpp"

namespace spook {

/// Returns the velocities of the bodies, 0 for an index of -1. Copies component by component, because a processor waits
/// when it reads in other pieces what it has just written.
template <int Dof>
LaneTwists<Dof> gathered(const std::array<int, lane_count>& bodies, const std::vector<Twist<Dof>>& V) {
  static const Twist<Dof> none = Twist<Dof>::Zero();
  const auto of = [&](int lane) -> const Twist<Dof>& { return bodies[lane] < 0 ? none : V[bodies[lane]]; };
  const Twist<Dof>&a = of(0), &b = of(1), &c = of(2), &d = of(3);
  LaneTwists<Dof> all;
  for (int k = 0; k < Dof; ++k) all.col(k) = Lanes(a[k], b[k], c[k], d[k]);
  return all;
}

/// Stores the velocities; an index of -1 is skipped.
template <int Dof>
void scatter(const LaneTwists<Dof>& all, const std::array<int, lane_count>& bodies,
             std::vector<Twist<Dof>>& V) {
  for (int lane = 0; lane < lane_count; ++lane) {
    if (bodies[lane] < 0) continue;
    Twist<Dof>& v = V[bodies[lane]];
    for (int k = 0; k < Dof; ++k) v[k] = all(lane, k);
  }
}

/// Returns a·b of each lane, summed component by component.
template <int Dof>
Lanes dot(const LaneTwists<Dof>& a, const LaneTwists<Dof>& b) {
  Lanes sum = a.col(0) * b.col(0);
  for (int d = 1; d < Dof; ++d) sum += a.col(d) * b.col(d);
  return sum;
}

}  // namespace spook
