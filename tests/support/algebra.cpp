#include "algebra.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

namespace spook::testing {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd solution_of(const MatrixXd& A, const VectorXd& b) {
  return A.fullPivLu().solve(b);
}

double norm_of_inverse(const MatrixXd& A) {
  return A.fullPivLu().inverse().norm();
}

VectorXd eigenvalues(const MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(symmetric).eigenvalues();
}

double spectral_radius(const MatrixXd& A) {
  // ρ is the limit of |A^n|^(1/n). Each square doubles n. At n = 2^40 a factor beside ρ^n no longer matters.
  MatrixXd power = A;
  double logarithm = 0, n = 1;
  for (int squares = 0; squares <= 40; ++squares, n *= 2) {
    const double size = power.norm();
    if (size == 0) return 0;
    logarithm += std::log(size) / n;
    power /= size;
    power *= power;
  }
  return std::exp(logarithm);
}

MatrixXd sweep_matrix(const MatrixXd& S) {
  const MatrixXd upper = S.triangularView<Eigen::StrictlyUpper>();
  return -S.triangularView<Eigen::Lower>().solve(upper);
}

}  // namespace spook::testing
