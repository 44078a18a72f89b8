#include <Eigen/LU>

#include "11_direct/direct.hpp"

namespace spook {

/// Returns M of a body: the inverse of its inverse mass, or the identity for a static body.
static Eigen::Matrix<double, 3, 3> mass_matrix(const InverseMass<3>& inverse) {
  return (inverse.linear == 0 ? 1 : 1 / inverse.linear) * Mat3::Identity();
}

static Eigen::Matrix<double, 6, 6> mass_matrix(const InverseMass<6>& inverse) {
  Eigen::Matrix<double, 6, 6> M = Eigen::Matrix<double, 6, 6>::Identity();
  if (inverse.linear == 0) return M;
  M.topLeftCorner<3, 3>() /= inverse.linear;
  M.bottomRightCorner<3, 3>() = inverse.angular.inverse();
  return M;
}

template <int Dof>
SparseMatrix saddle_matrix(const std::vector<Row<Dof>>& rows,
                           const std::vector<InverseMass<Dof>>& inverse_mass) {
  const int bodies = static_cast<int>(inverse_mass.size()), n = Dof * bodies + static_cast<int>(rows.size());
  std::vector<Eigen::Triplet<double>> entries;
  for (int body = 0; body < bodies; ++body) {
    const auto M = mass_matrix(inverse_mass[body]);
    for (int column = 0; column < Dof; ++column)
      for (int line = column; line < Dof; ++line)
        if (M(line, column) != 0) entries.emplace_back(Dof * body + line, Dof * body + column, M(line, column));
  }
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const int line = Dof * bodies + static_cast<int>(k);
    const auto add = [&](int body, const Twist<Dof>& G) {
      if (inverse_mass[body].linear == 0) return;
      for (int column = 0; column < Dof; ++column) entries.emplace_back(line, Dof * body + column, G[column]);
    };
    add(rows[k].i, rows[k].Gi);
    add(rows[k].j, rows[k].Gj);
    entries.emplace_back(line, line, -rows[k].Sigma);
  }
  SparseMatrix A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

template SparseMatrix saddle_matrix<3>(const std::vector<Row<3>>&, const std::vector<InverseMass<3>>&);
template SparseMatrix saddle_matrix<6>(const std::vector<Row<6>>&, const std::vector<InverseMass<6>>&);

}  // namespace spook
