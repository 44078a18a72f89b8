#pragma once
// Dense algebra for the tests, compiled once, since each of Eigen's decompositions takes seconds to compile.
#include <Eigen/Core>

namespace spook::testing {

/// Returns x of A x = b, for a regular square matrix A.
Eigen::VectorXd solution_of(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// Returns |A⁻¹|, the root of the sum of its squares, for a regular square matrix A.
double norm_of_inverse(const Eigen::MatrixXd& A);

/// Returns the eigenvalues of a symmetric matrix, the smallest first.
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& symmetric);

/// Returns the spectral radius of a square matrix: the largest |eigenvalue|.
double spectral_radius(const Eigen::MatrixXd& A);

/// Returns the iteration matrix of Gauss-Seidel, I - L⁻¹ S, with L the lower triangle of S.
Eigen::MatrixXd sweep_matrix(const Eigen::MatrixXd& S);

}  // namespace spook::testing
