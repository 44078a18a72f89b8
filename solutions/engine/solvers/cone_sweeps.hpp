#pragma once
// Sweeps of chapter 09 in a layout of their own: the three rows of a contact on a cone are one block. A sweep reads
// 352 bytes of a contact, where the rows of chapter 04 have 768. It reads and writes each velocity once.
//
//   E, A_i, A_j     linear part of G on j, and angular parts on i and j: a column for n, t1 and t2 each
//   speed           u = Eᵀ (v_j - v_i) + A_iᵀ ω_i + A_jᵀ ω_j, of all three rows                        Eq. (3.3)
//   normal          Δλ_n by Eq. (4.6), (4.7); then u_t grows by (S_1n, S_2n) Δλ_n, without a look at the bodies
//   friction        the nearest λ_t of the disc μ λ_n to λ_t + r_t/s                                   Eq. (9.5), (9.6)
//   velocities      v changes by ∓E Δλ/m, ω by I⁻¹ A Δλ
#include "09_better_friction/better_friction.hpp"

namespace spook {

/// A contact on a cone: its three rows in one block. Vectors have an entry for n, t1 and t2 each.
template <int Dof>
struct ConeBlock {
  using Angular = Eigen::Matrix<double, Dof - 3, 3>;

  int i, j;
  Mat3 E;                 ///< linear parts of G on body j; those on i are opposite
  Angular Ai, Aj;         ///< angular parts of G
  Vec2 S_tn;              ///< (S_1n, S_2n) [1/kg]
  double S_nn, s;         ///< S_nn with Σ, and s of Eq. (9.5) [1/kg]
  double mass_n, mass_t;  ///< 1/S_nn, 1/s [kg]
  Vec3 B;                 ///< right-hand sides [m/s]
  Vec3 Sigma;             ///< regularisation [1/kg]
  double mu;
  Vec3 lambda;  ///< [N s]
};

/// Sweeps over plain rows, and over contacts with a cone. Refers to its arguments. Stores the impulses of contacts
/// until `write_back`.
template <int Dof>
class ConeSweeps {
 public:
  /// `contacts` are in the order of their rows. All normal rows have bounds of 0 and infinity.
  ConeSweeps(const std::vector<FrictionContact>& contacts, std::vector<Row<Dof>>& rows,
             std::vector<Twist<Dof>>& V, const std::vector<InverseMass<Dof>>& inverse_mass);

  /// Updates the rows without cones in order, then the contacts: as sweep_on_cones does, to round-off. Returns the
  /// largest S_kk |Δλ_k| or s |Δλ_t| [m/s].
  double sweep();

  /// Returns √S_kk λ_k of each row, so that the square of a change is Σ S_kk Δλ_k².
  Eigen::VectorXd scaled_impulses() const;

  /// Sets λ to these impulses, projected on the bounds and the cones, and V to M⁻¹ Gᵀ λ.
  void start_from(const Eigen::VectorXd& impulses);

  /// Copies λ of the contacts to their rows.
  void write_back() const;

 private:
  std::vector<Row<Dof>>& rows_;
  std::vector<Twist<Dof>>& V_;
  const std::vector<InverseMass<Dof>>& inverse_mass_;
  std::vector<std::size_t> others_;  // rows that are no contact's
  std::vector<ConeBlock<Dof>> blocks_;
  std::vector<std::size_t> normals_;  // the normal row of each block
  Eigen::VectorXd weights_;           // √S_kk
};

}  // namespace spook
