#pragma once
// Rows as a dense system S λ = B, solved by enumeration of all active sets, unlike any solver of the course.
#include <Eigen/Dense>
#include <vector>

#include "04_gauss_seidel/gauss_seidel.hpp"
#include "random_input.hpp"

namespace spook::testing {

/// A rigid body of 0.5 to 3 kg, with axes in random directions.
inline InverseMass<6> random_body(Random& random) {
  const Vec3 inverse_moments = random.vector(0.2, 2);
  const Mat3 R = random.rotation().toRotationMatrix();
  return {.linear = 1 / random.uniform(0.5, 3), .angular = R * inverse_moments.asDiagonal() * R.transpose()};
}

/// Random bounds of one of these kinds: a contact's, its mirror image, two-sided, equal, none.
inline void give_any_bounds(Random& random, Row<6>& row) {
  const int kind = random.integer(0, 4);
  const double lo = random.uniform(-0.3, 0.1), room = random.uniform(0, 0.4);
  row.lo = kind == 0 ? 0 : kind == 2 || kind == 3 ? lo : -infinity;
  row.hi = kind == 1 ? 0 : kind == 2 ? lo + room : kind == 3 ? lo : infinity;
}

/// Returns the dense matrix S = G M⁻¹ Gᵀ + Σ: Eq. (11.1).
template <int Dof>
Eigen::MatrixXd dense_S(const std::vector<Row<Dof>>& rows) {
  const auto n = std::ssize(rows);
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    for (std::size_t l = 0; l < rows.size(); ++l) {
      const Row<Dof>&a = rows[k], &b = rows[l];
      if (a.i == b.i) S(k, l) += a.Gi.dot(b.MinvGi);
      if (a.i == b.j) S(k, l) += a.Gi.dot(b.MinvGj);
      if (a.j == b.i) S(k, l) += a.Gj.dot(b.MinvGi);
      if (a.j == b.j) S(k, l) += a.Gj.dot(b.MinvGj);
    }
    S(k, k) += rows[k].Sigma;
  }
  return S;
}

/// Returns one member of all rows as a vector: λ, B, ...
template <int Dof>
Eigen::VectorXd gathered(const std::vector<Row<Dof>>& rows, double Row<Dof>::*member) {
  Eigen::VectorXd values(std::ssize(rows));
  for (std::size_t k = 0; k < rows.size(); ++k) values[static_cast<Eigen::Index>(k)] = rows[k].*member;
  return values;
}

/// The problem S λ = B within bounds, Eq. (4.1).
struct Bounded {
  Eigen::MatrixXd S;
  Eigen::VectorXd B, lo, hi;
};

template <int Dof>
Bounded bounded(const std::vector<Row<Dof>>& rows) {
  return {.S = dense_S(rows),
          .B = gathered(rows, &Row<Dof>::B),
          .lo = gathered(rows, &Row<Dof>::lo),
          .hi = gathered(rows, &Row<Dof>::hi)};
}

/// Returns the unique solution. Tries every choice of rows at the lower bound, at the upper bound, and free. For up to
/// 8 rows.
Eigen::VectorXd enumerate_solution(const Bounded& problem);

/// Returns the factor of an error bound: |λ - λ*| is at most (1 + |S|)/μ times the residual, μ the smallest eigenvalue
/// of S. It is the error bound of a complementarity problem.
double condition(const Eigen::MatrixXd& S);

}  // namespace spook::testing
