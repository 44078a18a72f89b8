#include <cmath>

#include "14_fast_rows/fast_rows.hpp"

namespace spook {

namespace {

/// Component by component: what is written and read again in other pieces makes a processor wait.
template <int Dof>
LaneTwists<Dof> gathered(const std::array<int, lane_count>& bodies, const std::vector<Twist<Dof>>& V) {
  static const Twist<Dof> none = Twist<Dof>::Zero();
  const auto of = [&](int lane) -> const Twist<Dof>& { return bodies[lane] < 0 ? none : V[bodies[lane]]; };
  const Twist<Dof>&a = of(0), &b = of(1), &c = of(2), &d = of(3);
  LaneTwists<Dof> all;
  for (int k = 0; k < Dof; ++k) all.col(k) = Lanes(a[k], b[k], c[k], d[k]);
  return all;
}

template <int Dof>
void scatter(const LaneTwists<Dof>& all, const std::array<int, lane_count>& bodies,
             std::vector<Twist<Dof>>& V) {
  for (int lane = 0; lane < lane_count; ++lane) {
    if (bodies[lane] < 0) continue;
    Twist<Dof>& v = V[bodies[lane]];
    for (int k = 0; k < Dof; ++k) v[k] = all(lane, k);
  }
}

/// a·b in each lane, component by component.
template <int Dof>
Lanes dot(const LaneTwists<Dof>& a, const LaneTwists<Dof>& b) {
  Lanes sum = a.col(0) * b.col(0);
  for (int d = 1; d < Dof; ++d) sum += a.col(d) * b.col(d);
  return sum;
}

}  // namespace

template <int Dof>
double update_pack(Pack<Dof>& pack, std::vector<Twist<Dof>>& V) {
  LaneTwists<Dof> Vi = gathered(pack.i, V), Vj = gathered(pack.j, V);
  Lanes largest = Lanes::Zero();
  for (LaneRows<Dof>& row : pack.rows) {
    const Lanes mass = 1 / row.diagonal;
    const Lanes r = row.B - dot<Dof>(row.Gi, Vi) - dot<Dof>(row.Gj, Vj) - row.Sigma * row.lambda;
    // A comparison with a NaN is false: in this order it stays.
    const Lanes wanted = row.lambda + mass * r;
    const Lanes above = (wanted < row.lo).select(row.lo, wanted);
    const Lanes projected = (row.hi < above).select(row.hi, above);
    const Lanes delta = projected - row.lambda;
    row.lambda = projected;
    for (int d = 0; d < Dof; ++d) {
      Vi.col(d) += delta * row.MinvGi.col(d);
      Vj.col(d) += delta * row.MinvGj.col(d);
    }
    const Lanes lacked = row.diagonal * delta.abs();
    largest = (lacked > largest || lacked.isNaN()).select(lacked, largest);
  }
  scatter<Dof>(Vi, pack.i, V);
  scatter<Dof>(Vj, pack.j, V);
  double most = 0;
  for (const double lacked : largest)
    if (std::isnan(lacked) || lacked > most) most = lacked;
  return most;
}

template double update_pack<3>(Pack<3>&, std::vector<Twist<3>>&);
template double update_pack<6>(Pack<6>&, std::vector<Twist<6>>&);

}  // namespace spook
