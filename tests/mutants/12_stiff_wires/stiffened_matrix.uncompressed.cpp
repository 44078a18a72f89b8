// Wrong: adds its entries to a matrix that is compressed already.
// Killed by: StiffenedMatrix.HasTheLayoutOfTheSaddlePoint
// Says: need makeCompressed
#include "12_stiff_wires/stiff_wires.hpp"

namespace spook {

/// Block (a, b) of the lower triangle.
static void add_block(int a, int b, const Mat3& block, SparseMatrix& A) {
  for (int column = 0; column < 3; ++column)
    for (int line = a == b ? column : 0; line < 3; ++line)
      A.coeffRef(3 * a + line, 3 * b + column) += block(line, column);
}

SparseMatrix stiffened_matrix(const std::vector<Row<3>>& rows, const std::vector<InverseMass<3>>& inverse_mass,
                              const std::vector<Stiffness>& stiffness, double h) {
  const auto moves = [&](int body) { return inverse_mass[body].linear != 0; };
  SparseMatrix A = saddle_matrix(rows, inverse_mass);
  for (const auto& [i, j, K] : stiffness) {
    if (moves(i)) add_block(i, i, h * h * K, A);
    if (moves(j)) add_block(j, j, h * h * K, A);
    if (moves(i) && moves(j)) add_block(std::max(i, j), std::min(i, j), -h * h * K, A);
  }
  return A;
}

}  // namespace spook
