#pragma once
// Systems of rows with known solutions, for the tests of chapter 04.
#include "dense_rows.hpp"

namespace spook::testing {

/// Bodies, rows, and the velocity changes V = M⁻¹ Gᵀ λ.
template <int Dof>
struct Problem {
  Motion<Dof> motion;
  std::vector<Row<Dof>> rows;
  std::vector<Twist<Dof>> V;
};

/// Returns free rigid bodies, all moving.
inline Motion<6> random_motion(Random& random, int bodies) {
  Motion<6> motion;
  for (int k = 0; k < bodies; ++k) {
    motion.inverse_mass.push_back(random_body(random));
    motion.W.push_back(random.twist());
    motion.Wf.push_back(random.twist(0.3));
  }
  return motion;
}

/// A contact, anywhere, between two different bodies.
inline Constraint<6> random_constraint(Random& random, int bodies) {
  const int i = random.integer(0, bodies - 1);
  const int j = (i + random.integer(1, bodies - 1)) % bodies;
  const ContactJacobian G = contact_jacobian(
      {.i = i, .j = j, .n = random.unit_vector(), .gap = 0, .r_i = random.vector(), .r_j = random.vector()});
  const SpookParameters spook{
      .a = random.uniform(1, 10), .b = random.uniform(0.5, 1), .Sigma = random.uniform(0.05, 0.2)};
  return {.i = i, .j = j, .Gi = G.Gi, .Gj = G.Gj, .gap = random.uniform(-0.1, 0.1), .spook = spook};
}

inline Problem<6> random_problem(Random& random, int bodies, int rows) {
  Problem<6> p{.motion = random_motion(random, bodies), .rows = {}, .V = {}};
  for (int k = 0; k < rows; ++k) p.rows.push_back(make_row(random_constraint(random, bodies), p.motion));
  p.V.assign(static_cast<std::size_t>(bodies), Twist<6>::Zero());
  return p;
}

/// Point masses on a floor, one on the other, at rest under gravity; from the bottom up. The exact λ of row k is
/// h g times the mass above the contact, with Σ = 0 and a = 0.
inline Problem<3> stack(const std::vector<double>& masses, double h, double Sigma = 0, double g = 9.81) {
  Problem<3> p;
  const Twist<3> up(0, 0, 1);
  p.motion.inverse_mass.push_back({.linear = 0});  // the floor
  p.motion.Wf.push_back(Twist<3>::Zero());
  for (const double mass : masses) {
    p.motion.inverse_mass.push_back({.linear = 1 / mass});
    p.motion.Wf.push_back(-h * g * up);
  }
  p.motion.W.assign(masses.size() + 1, Twist<3>::Zero());
  p.V = p.motion.W;
  for (int k = 0; k < static_cast<int>(masses.size()); ++k)
    p.rows.push_back(make_row<3>(
        {.i = k, .j = k + 1, .Gi = -up, .Gj = up, .gap = 0, .spook = {.a = 0, .b = 1, .Sigma = Sigma}},
        p.motion));
  return p;
}

/// Returns all entries of V in one vector.
template <int Dof>
Eigen::VectorXd joined_V(const Problem<Dof>& p) {
  Eigen::VectorXd all(Dof * std::ssize(p.V));
  for (Eigen::Index k = 0; k < std::ssize(p.V); ++k)
    all.segment<Dof>(Dof * k) = p.V[static_cast<std::size_t>(k)];
  return all;
}

/// Sets λ in the rows, and the V that belongs to it.
template <int Dof>
void set_lambda(Problem<Dof>& p, const Eigen::VectorXd& lambda) {
  for (auto& V : p.V) V.setZero();
  for (std::size_t k = 0; k < p.rows.size(); ++k) {
    Row<Dof>& row = p.rows[k];
    row.lambda = lambda[static_cast<Eigen::Index>(k)];
    p.V[static_cast<std::size_t>(row.i)] += row.lambda * row.MinvGi;
    p.V[static_cast<std::size_t>(row.j)] += row.lambda * row.MinvGj;
  }
}

/// Rows with bounds of all kinds between so many bodies, and λ anywhere, or at one of its bounds.
inline Problem<6> any_rows(Random& random, int bodies, int rows = 20) {
  Problem<6> p = random_problem(random, bodies, rows);
  Eigen::VectorXd lambda(rows);
  for (Eigen::Index k = 0; k < rows; ++k) {
    Row<6>& row = p.rows[static_cast<std::size_t>(k)];
    give_any_bounds(random, row);
    const double bound = random.integer(0, 1) ? row.lo : row.hi;
    lambda[k] = random.integer(0, 1) && std::abs(bound) < infinity ? bound : random.uniform(-0.5, 0.5);
  }
  set_lambda(p, lambda);
  return p;
}

}  // namespace spook::testing
