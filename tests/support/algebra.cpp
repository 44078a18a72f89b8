#include "algebra.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace spook::testing {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd solution_of(const MatrixXd& A, const VectorXd& b) {
  return A.fullPivLu().solve(b);
}

VectorXd eigenvalues(const MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(symmetric).eigenvalues();
}

double spectral_radius(const MatrixXd& A) {
  return Eigen::EigenSolver<MatrixXd>(A, false).eigenvalues().cwiseAbs().maxCoeff();
}

MatrixXd sweep_matrix(const MatrixXd& S) {
  const MatrixXd upper = S.triangularView<Eigen::StrictlyUpper>();
  return -S.triangularView<Eigen::Lower>().solve(upper);
}

}  // namespace spook::testing
