#pragma once
// Rows and contacts on Coulomb's cones, for methods that factorise a matrix over bodies.
//
//   Δλ = k - K G v,  (M + Gᵀ K G) v = Gᵀ k     a linear step: each method defines K and k of a contact
#include <cstdint>

#include "09_better_friction/better_friction.hpp"
#include "engine/linear/contact_velocity_system.hpp"

namespace spook {

/// The three rows of a contact with friction, or a single row.
struct ContactBlock {
  std::size_t row;
  int count;
  double mu = 0, s = 0;   ///< friction coefficient, and s of Eq. (9.5)
  Mat3 K = Mat3::Zero();  ///< [kg]
  Vec3 k = Vec3::Zero();  ///< [N s]
};

template <int Dof>
class ConeProblem {
 public:
  /// Keeps references to its arguments. `friction` lists the contacts on cones, in the order of their rows; if it is
  /// empty, all rows have bounds only.
  ConeProblem(std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V,
              const std::vector<FrictionContact>& friction, const std::vector<InverseMass<Dof>>& inverse_mass,
              ContactVelocitySystem<Dof>& system);

  const Row<Dof>& row(std::size_t k) const { return rows_[k]; }
  std::vector<ContactBlock>& blocks() { return blocks_; }
  const std::vector<ContactBlock>& blocks() const { return blocks_; }
  Vec2 friction(const ContactBlock& block) const {
    return {rows_[block.row + 1].lambda, rows_[block.row + 2].lambda};
  }

  double rhs_norm() const { return rhs_norm_; }  ///< the largest |B| [m/s]
  double row_residual(std::size_t k) const;      ///< of one row, without bounds: Eq. (4.6) [m/s]
  double residual() const;                       ///< Eq. (9.7) [m/s]

  /// Tells whether a residual is at most the tolerance, or the round-off of the current λ, Eq. (11.13) [m/s].
  bool is_solved(double residual, double tolerance) const;

  std::vector<double> impulses() const;
  void set_impulses(const std::vector<double>& lambda);  ///< also updates V
  void sweep(int count);                                 ///< Eq. (4.7), (9.6)
  /// Makes accelerated sweeps, Eq. (10.14), until one changes contacts by at most the tolerance [m/s].
  void accelerated_sweeps(int most, double tolerance);
  std::int64_t row_updates() const { return sweeps_ * std::ssize(rows_); }

  /// Projects each contact: on its bounds, then on the disc of Eq. (9.4).
  void project(std::vector<double>& lambda) const;

  /// Factorises M + Gᵀ K G with the K of the blocks.
  void factorise();

  /// Solves for Δλ of each row with the k of the blocks; returns false if Δλ is not finite.
  bool solve(std::vector<double>& step);

 private:
  std::vector<Row<Dof>>& rows_;
  std::vector<Twist<Dof>>& V_;
  const std::vector<FrictionContact>& friction_;
  const std::vector<InverseMass<Dof>>& inverse_mass_;
  ContactVelocitySystem<Dof>& system_;
  std::vector<ContactBlock> blocks_;
  double rhs_norm_;
  std::int64_t sweeps_ = 0;
};

}  // namespace spook
