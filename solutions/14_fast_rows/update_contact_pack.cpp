// Contacts with friction in the lanes: chapter 09's updates, side by side.
#include <cmath>

#include "14_fast_rows/lanes.hpp"

namespace spook {

namespace {

/// Residuals of the rows in their lanes, Eq. (4.6) [m/s].
template <int Dof>
Lanes lacked_by(const LaneRows<Dof>& row, const LaneTwists<Dof>& Vi, const LaneTwists<Dof>& Vj) {
  return row.B - dot<Dof>(row.Gi, Vi) - dot<Dof>(row.Gj, Vj) - row.Sigma * row.lambda;
}

/// Adds Δλ to V, Eq. (4.5).
template <int Dof>
void apply(const LaneRows<Dof>& row, const Lanes& delta, LaneTwists<Dof>& Vi, LaneTwists<Dof>& Vj) {
  for (int d = 0; d < Dof; ++d) {
    Vi.col(d) += delta * row.MinvGi.col(d);
    Vj.col(d) += delta * row.MinvGj.col(d);
  }
}

/// Updates normal rows by Eq. (4.7) with λ >= 0. Returns S_kk |Δλ_k|.
template <int Dof>
Lanes update_normal(LaneRows<Dof>& row, LaneTwists<Dof>& Vi, LaneTwists<Dof>& Vj) {
  const Lanes wanted = row.lambda + lacked_by<Dof>(row, Vi, Vj) / row.diagonal;
  const Lanes after = (wanted < 0).select(0.0, wanted), delta = after - row.lambda;
  row.lambda = after;
  apply<Dof>(row, delta, Vi, Vj);
  return row.diagonal * delta.abs();
}

/// Updates friction rows by Eq. (9.5), (9.6), on discs of these radii. Returns s |Δλ_t|.
template <int Dof>
Lanes update_pairs(LaneRows<Dof>& row1, LaneRows<Dof>& row2, const Lanes& radius, LaneTwists<Dof>& Vi,
                   LaneTwists<Dof>& Vj) {
  const Lanes S12 = dot<Dof>(row1.Gi, row2.MinvGi) + dot<Dof>(row1.Gj, row2.MinvGj);
  const Lanes mean = (row1.diagonal + row2.diagonal) / 2, difference = (row1.diagonal - row2.diagonal) / 2;
  const Lanes s = mean + (difference * difference + S12 * S12).sqrt();
  LanePairs before, lacked;
  before << row1.lambda, row2.lambda;
  lacked << lacked_by<Dof>(row1, Vi, Vj), lacked_by<Dof>(row2, Vi, Vj);
  const LanePairs after = onto_discs(before + lacked.colwise() / s, radius), change = after - before;
  row1.lambda = after.col(0);
  row2.lambda = after.col(1);
  apply<Dof>(row1, change.col(0), Vi, Vj);
  apply<Dof>(row2, change.col(1), Vi, Vj);
  return s * (change.col(0) * change.col(0) + change.col(1) * change.col(1)).sqrt();
}

}  // namespace

template <int Dof>
double update_contact_pack(Pack<Dof>& pack, std::vector<Twist<Dof>>& V) {
  LaneTwists<Dof> Vi = gathered(pack.i, V), Vj = gathered(pack.j, V);
  Lanes largest = Lanes::Zero();
  const auto note = [&](const Lanes& lacked) {
    largest = (lacked > largest || lacked.isNaN()).select(lacked, largest);
  };
  for (std::size_t c = 0; c < pack.mu.size(); ++c) {
    LaneRows<Dof>* const rows = &pack.rows[3 * c];
    note(update_normal(rows[0], Vi, Vj));
    note(update_pairs<Dof>(rows[1], rows[2], pack.mu[c] * rows[0].lambda, Vi, Vj));
  }
  scatter<Dof>(Vi, pack.i, V);
  scatter<Dof>(Vj, pack.j, V);
  double most = 0;
  for (const double lacked : largest)
    if (std::isnan(lacked) || lacked > most) most = lacked;
  return most;
}

template double update_contact_pack<3>(Pack<3>&, std::vector<Twist<3>>&);
template double update_contact_pack<6>(Pack<6>&, std::vector<Twist<6>>&);

}  // namespace spook
