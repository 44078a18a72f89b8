// Wrong: shares K between its two ends.
// Killed by: StiffenedMatrix.PutsASpringBetweenTwoPoints
// Says: Half of K is missing
#include "12_stiff_wires/stiff_wires.hpp"

namespace spook {

using Entries = std::vector<Eigen::Triplet<double>>;

/// Block (a, b) of the lower triangle.
static void add_block(int a, int b, const Mat3& block, Entries& entries) {
  for (int column = 0; column < 3; ++column)
    for (int line = a == b ? column : 0; line < 3; ++line)
      entries.emplace_back(3 * a + line, 3 * b + column, block(line, column));
}

SparseMatrix stiffened_matrix(const std::vector<Row<3>>& rows, const std::vector<InverseMass<3>>& inverse_mass,
                              const std::vector<Stiffness>& stiffness, double h) {
  const int first = 3 * static_cast<int>(inverse_mass.size()), n = first + static_cast<int>(rows.size());
  const auto moves = [&](int body) { return inverse_mass[body].linear != 0; };
  Entries entries;
  entries.reserve(first + 21 * stiffness.size() + 7 * rows.size());

  for (int k = 0; k < first; ++k) entries.emplace_back(k, k, moves(k / 3) ? 1 / inverse_mass[k / 3].linear : 1);
  for (const auto& [i, j, K] : stiffness) {  // Eq. (12.5)
    if (moves(i)) add_block(i, i, 0.5 * h * h * K, entries);
    if (moves(j)) add_block(j, j, 0.5 * h * h * K, entries);
    if (moves(i) && moves(j)) add_block(std::max(i, j), std::min(i, j), -0.5 * h * h * K, entries);
  }
  for (int line = first; line < n; ++line) {  // Eq. (11.2)
    const Row<3>& row = rows[line - first];
    for (int k = 0; k < 3; ++k) {
      if (moves(row.i)) entries.emplace_back(line, 3 * row.i + k, row.Gi[k]);
      if (moves(row.j)) entries.emplace_back(line, 3 * row.j + k, row.Gj[k]);
    }
    entries.emplace_back(line, line, -row.Sigma);
  }

  SparseMatrix A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

}  // namespace spook
