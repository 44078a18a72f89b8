#pragma once
// Rows with known solutions, and slow solvers for any rows, for the tests of chapter 11.
#include <Eigen/Dense>
#include <string>
#include <vector>

#include "11_direct/direct.hpp"
#include "dense_rows.hpp"

namespace spook::testing {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Solves until only round-off is left.
constexpr StopRule exact{.max_sweeps = 100, .tolerance = 0};

/// Bodies, the rows between them, and room for V.
template <int Dof>
struct System {
  Motion<Dof> motion;
  std::vector<Row<Dof>> rows;
  std::vector<Twist<Dof>> V;

  int add(double inverse, const Twist<Dof>& Wf);
  void add(const Constraint<Dof>& constraint) { rows.push_back(make_row(constraint, motion)); }
};

template <>
inline int System<3>::add(double inverse, const Twist<3>& Wf) {
  motion.inverse_mass.push_back({.linear = inverse});
  motion.W.push_back(Twist<3>::Zero());
  motion.Wf.push_back(Wf);
  V.push_back(Twist<3>::Zero());
  return static_cast<int>(V.size()) - 1;
}

/// Rigid bodies, the first of them static, and rows of contacts between any two of them, without bounds.
System<6> random_system(Random& random, int bodies, int rows);

/// Gives each row one of: no bound, one below, one above, two; some of them 0. About half of the rows end at a bound.
void add_random_bounds(Random& random, std::vector<Row<6>>& rows);

/// Points that hang straight down in `links` links from a static point, at rest, each link stretched by T/k. The last
/// has `ratio` times the mass of the others, 1 kg. λ of link k is -h tension(k), with 0 at the top.
struct HangingWire {
  int links;
  double ratio, k, h, d = 2, g = 9.81;

  double mass(int point) const { return point == links ? ratio : 1; }
  double tension(int link) const { return (ratio + links - 1 - link) * g; }  ///< [N]
  System<3> system() const;
};

/// Points around a central one, each tied to it by a row along its own direction; Σ = 0.1.
System<3> star(Random& random, int points);

/// A tower of boxes of 1 kg with edges of 1 m on a floor. Each has four contacts of three rows: normal, t1, t2. The
/// friction rows have bounds ±mu h g/4 times the mass that rests on the contact, and Σ = 1e-10. The boxes slide
/// at the velocity `slide`.
System<6> box_tower(int boxes, double h, double mu, const Vec3& slide);

/// The lower triangle, compressed.
SparseMatrix lower_triangle(const MatrixXd& A);

/// The symmetric matrix with this lower triangle.
MatrixXd full(const SparseMatrix& lower);

/// V = M⁻¹ Gᵀ λ, with the rows' λ.
template <int Dof>
std::vector<Twist<Dof>> velocities(const std::vector<Row<Dof>>& rows, std::size_t bodies) {
  std::vector<Twist<Dof>> V(bodies, Twist<Dof>::Zero());
  for (const Row<Dof>& row : rows) {
    V[row.i] += row.lambda * row.MinvGi;
    V[row.j] += row.lambda * row.MinvGj;
  }
  return V;
}

/// The largest difference of two lists of velocities; NaN if there is one.
template <int Dof>
double difference(const std::vector<Twist<Dof>>& a, const std::vector<Twist<Dof>>& b) {
  double largest = a.size() == b.size() ? 0 : infinity;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) {
    const double one = (a[k] - b[k]).cwiseAbs().template maxCoeff<Eigen::PropagateNaN>();
    if (!(one <= largest)) largest = one;
    if (std::isnan(largest)) break;
  }
  return largest;
}

/// Eq. (4.8).
double dense_residual(const Bounded& problem, const VectorXd& lambda);

}  // namespace spook::testing
