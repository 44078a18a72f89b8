#pragma once
// Dense algebra for the tests, compiled once: a compiler takes seconds for each of Eigen's decompositions.
#include <Eigen/Core>

namespace spook::testing {

/// x of A x = b, for any square A that has an inverse.
Eigen::VectorXd solution_of(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// The eigenvalues of a symmetric matrix, the smallest first.
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& symmetric);

/// The largest |eigenvalue| of a square matrix: by which factor its powers grow at last.
double spectral_radius(const Eigen::MatrixXd& A);

/// I - L⁻¹ S, with L the lower triangle of S: what a sweep of Gauss-Seidel makes of an error.
Eigen::MatrixXd sweep_matrix(const Eigen::MatrixXd& S);

}  // namespace spook::testing
