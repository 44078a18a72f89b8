#pragma once
// Points, rows and springs between them, for the tests of chapter 12.
#include <stdexcept>
#include <string>
#include <vector>

#include "12_stiff_wires/stiff_wires.hpp"
#include "checks.hpp"
#include "random_input.hpp"

namespace spook::testing {

/// The arguments of stiff_solve.
struct Springs {
  Motion<3> motion = {};
  std::vector<Row<3>> rows = {};
  std::vector<Stiffness> stiffness = {};
  double h = 1;

  int bodies() const { return static_cast<int>(motion.inverse_mass.size()); }
  bool moves(int body) const { return motion.inverse_mass[static_cast<std::size_t>(body)].linear != 0; }
  double mass(int body) const {
    const double inverse = motion.inverse_mass[static_cast<std::size_t>(body)].linear;
    return inverse == 0 ? 1 : 1 / inverse;  // as in Eq. (11.2)
  }

  void add(double inverse_mass, const Vec3& W, const Vec3& Wf) {
    motion.inverse_mass.push_back({.linear = inverse_mass});
    motion.W.push_back(W);
    motion.Wf.push_back(inverse_mass == 0 ? Vec3::Zero() : Wf);
  }

  void add_row(int i, int j, const Vec3& n, double gap, const SpookParameters& spook) {
    rows.push_back(make_row<3>(
        {.i = i, .j = j, .Gi = -n, .Gj = n, .gap = gap, .spook = spook, .lo = -infinity, .hi = infinity},
        motion));
  }
};

/// T/l across a direction.
inline Mat3 across(const Vec3& n, double k) {
  return k * (Mat3::Identity() - n * n.transpose());
}

/// A chain from the first body to the last, and some more springs between any two, in either order. Of the bodies,
/// `fixed` are static: the first ones, or the last ones.
inline Springs random_springs(Random& random, int bodies, int fixed, int more, bool last_are_fixed = false) {
  Springs s{.h = random.log_uniform(1e-3, 0.1)};
  for (int body = 0; body < bodies; ++body) {
    const bool is_fixed = last_are_fixed ? body >= bodies - fixed : body < fixed;
    const double inverse_mass = is_fixed ? 0 : 1 / random.log_uniform(0.1, 10);
    const Vec3 W = random.vector(3), Wf = random.vector(0.2);
    s.add(inverse_mass, W, Wf);
  }
  std::vector<int> order;  // a static one may be anywhere in the chain
  for (int body = 0; body < bodies; ++body) order.insert(order.begin() + random.integer(0, body), body);
  const auto pair = [&](int i, int j) {
    const Vec3 n = random.unit_vector();
    s.stiffness.push_back({.i = i, .j = j, .K = across(n, random.log_uniform(0.1, 10) / (s.h * s.h))});
    if (s.moves(i) || s.moves(j))
      s.add_row(i, j, n, random.uniform(-0.01, 0.01), spook_parameters(s.h, 1 / (s.h * s.h), 3));
  };
  for (std::size_t k = 0; k + 1 < order.size(); ++k) pair(order[k], order[k + 1]);
  for (int k = 0; k < more; ++k) {
    const int i = random.integer(0, bodies - 1);
    pair(i, (i + random.integer(1, bodies - 1)) % bodies);
  }
  return s;
}

/// The matrix of Eq. (12.5) in Eq. (11.2), both triangles, with `times` h² before K.
inline Eigen::MatrixXd dense_matrix(const Springs& s, double times = 1) {
  const int first = 3 * s.bodies(), n = first + static_cast<int>(s.rows.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  for (int k = 0; k < first; ++k) A(k, k) = s.mass(k / 3);
  for (const Stiffness& spring : s.stiffness) {
    // The difference of the two ends' velocities. A static end counts as 0.
    Eigen::MatrixXd ends = Eigen::MatrixXd::Zero(3, n);
    if (s.moves(spring.i)) ends.block<3, 3>(0, 3 * spring.i) = -Mat3::Identity();
    if (s.moves(spring.j)) ends.block<3, 3>(0, 3 * spring.j) = Mat3::Identity();
    A += times * s.h * s.h * ends.transpose() * spring.K * ends;
  }
  for (std::size_t k = 0; k < s.rows.size(); ++k) {
    const Row<3>& row = s.rows[k];
    const int line = first + static_cast<int>(k);
    if (s.moves(row.i)) A.block<1, 3>(line, 3 * row.i) = row.Gi.transpose();
    if (s.moves(row.j)) A.block<1, 3>(line, 3 * row.j) = row.Gj.transpose();
    A(line, line) = -row.Sigma;
  }
  return A.selfadjointView<Eigen::Lower>();
}

/// That matrix times x, spring by spring and row by row: fast enough for hundreds of them.
inline Eigen::VectorXd times_matrix(const Springs& s, const Eigen::VectorXd& x) {
  Eigen::VectorXd y(x.size());
  const auto of = [&](int body) -> Vec3 { return s.moves(body) ? Vec3(x.segment<3>(3 * body)) : Vec3::Zero(); };
  const auto add = [&](int body, const Vec3& what) {
    if (s.moves(body)) y.segment<3>(3 * body) += what;
  };
  for (int body = 0; body < s.bodies(); ++body) y.segment<3>(3 * body) = s.mass(body) * x.segment<3>(3 * body);
  for (const Stiffness& spring : s.stiffness) {
    const Vec3 pull = s.h * s.h * spring.K * (of(spring.j) - of(spring.i));
    add(spring.i, -pull);
    add(spring.j, pull);
  }
  for (std::size_t k = 0; k < s.rows.size(); ++k) {
    const Row<3>& row = s.rows[k];
    const auto line = 3 * s.bodies() + static_cast<Eigen::Index>(k);
    add(row.i, x[line] * row.Gi);
    add(row.j, x[line] * row.Gj);
    y[line] = row.Gi.dot(of(row.i)) + row.Gj.dot(of(row.j)) - row.Sigma * x[line];
  }
  return y;
}

/// Throws an error that explains the size if the matrix has a wrong one.
inline void require_size(const SparseMatrix& A, const Springs& s) {
  const auto n = 3 * s.bodies() + std::ssize(s.rows);
  if (A.rows() != n || A.cols() != n)
    throw std::logic_error("the matrix is " + std::to_string(A.rows()) + " x " + std::to_string(A.cols()) +
                           "; three unknowns a body and one a row are " + std::to_string(n));
}

/// All stored entries, of a matrix of the right size.
inline Eigen::MatrixXd entries(const SparseMatrix& A, const Springs& s) {
  require_size(A, s);
  return Eigen::MatrixXd(A);
}

}  // namespace spook::testing
