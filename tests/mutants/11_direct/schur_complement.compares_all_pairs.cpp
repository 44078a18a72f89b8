// Wrong: compares every row with every other.
// Killed by: SchurComplement.DoesNotCompareAllPairs
// Says: All pairs are compared, or the work grows like that
#include "11_direct/direct.hpp"

namespace spook {

template <int Dof>
SparseMatrix schur_complement(const std::vector<Row<Dof>>& rows) {
  const int n = static_cast<int>(rows.size());
  std::vector<Eigen::Triplet<double>> entries;
  for (int k = 0; k < n; ++k) {
    for (int l = 0; l < k; ++l) {
      const Row<Dof>&a = rows[k], &b = rows[l];
      double share = 0;
      if (a.i == b.i) share += a.MinvGi.dot(b.Gi);
      if (a.i == b.j) share += a.MinvGi.dot(b.Gj);
      if (a.j == b.i) share += a.MinvGj.dot(b.Gi);
      if (a.j == b.j) share += a.MinvGj.dot(b.Gj);
      if (share != 0) entries.emplace_back(k, l, share);
    }
    entries.emplace_back(k, k, rows[k].diagonal);
  }
  SparseMatrix S(n, n);
  S.setFromTriplets(entries.begin(), entries.end());
  return S;
}

template SparseMatrix schur_complement<3>(const std::vector<Row<3>>&);
template SparseMatrix schur_complement<6>(const std::vector<Row<6>>&);

}  // namespace spook
