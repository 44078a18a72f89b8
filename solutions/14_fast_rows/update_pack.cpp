#include <cmath>

#include "14_fast_rows/lanes.hpp"

namespace spook {

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
