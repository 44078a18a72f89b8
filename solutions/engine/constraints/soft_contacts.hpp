#pragma once
// Contacts of soft steps in a layout of their own. A sweep reads 528 bytes of a contact with friction, where the rows
// of chapter 04 have 768. It writes λ alone, and computes the target of a row where the row is updated.
//
//   G of a contact      -e and e in the linear parts, so e is stored once, and M⁻¹ Gᵀ is e times the inverse masses
//   velocity of a row   u = e·(v_j - v_i) + A_i·ω_i + A_j·ω_j,  A the angular parts of G            Eq. (3.3)
//   normal              Δλ = σ (w - u)/S - (1 - σ) λ,  λ >= 0;  w = -a g, or -g/h of an open gap    Eq. (10.21)
//   friction            the nearest λ_t of the disc μ λ_n to λ_t + r/s                              Eq. (9.5), (9.6)
#include "09_better_friction/better_friction.hpp"
#include "engine/constraints/constraint_set.hpp"
#include "engine/constraints/soft_rows.hpp"
#include "engine/constraints/stripes.hpp"

namespace spook {

/// A row whose linear parts are opposite on its two bodies, without its right-hand side.
template <int Dof>
struct PointRow {
  int i, j;
  Vec3 e;                                    ///< linear part of G on body j
  double inverse_mass_i, inverse_mass_j;     ///< [1/kg]
  Eigen::Matrix<double, Dof - 3, 1> Ai, Aj;  ///< angular parts of G
  Eigen::Matrix<double, Dof - 3, 1> MinvAi, MinvAj;
  double lambda;  ///< [N s]
};

/// The contacts of soft steps: normal rows, and the two friction rows of each if any pair has friction.
template <int Dof>
class SoftContacts {
 public:
  /// Takes the rows of the contacts, with the `impulses` of all rows for their λ; empty: 0 [N s]. Sweeps go through the
  /// `stripes` of contacts on so many threads; without stripes, through all contacts in their order.
  void assign(const std::vector<Contact>& contacts, const ConstraintSet<Dof>& constraints,
              const std::vector<double>& impulses, Stripes stripes = {}, int threads = 1);

  /// Adds M⁻¹ Gᵀ λ to W: Eq. (10.2).
  void warm_start(std::vector<Twist<Dof>>& W);

  /// Updates friction, and returns the largest s |Δλ_t| [m/s].
  double sweep_friction(std::vector<Twist<Dof>>& W);

  /// Updates the normal rows as soft or as rigid ones in a substep of `h` [s], and returns the largest S_kk |Δλ| [m/s].
  /// An overlap is moved apart at most with the closing speed [m/s].
  double sweep_soft(const SoftSpring& spring, double closing_speed, double h, std::vector<Twist<Dof>>& W);
  double sweep_rigid(double h, std::vector<Twist<Dof>>& W);

  /// Moves each gap as far as its points move along the normal: Eq. (10.19).
  void move_gaps(double h, const std::vector<Twist<Dof>>& W);

  /// Tells whether λ of a contact was above 0 when the gaps moved.
  bool pressed(std::size_t contact) const { return normals_[contact].pressed; }

  /// Copies λ to the rows of the contacts, and makes these the rows of the relaxing sweep in a substep of `h` [s]:
  /// their residual is what this sweep has left.
  void return_rows(double h, ConstraintSet<Dof>& constraints) const;

 private:
  /// Calls update(c) for each contact, in the order of a sweep. Returns the largest value.
  template <class Update>
  double sweep(const Update& update);

  template <class Target>
  double sweep_normals(const Target& target, double softness, double h, std::vector<Twist<Dof>>& W);

  struct Normal {
    PointRow<Dof> row;
    double gap;      ///< [m]
    double S, mass;  ///< S_kk without Σ [1/kg], 1/S
    bool pressed;
  };
  struct Friction {
    PointRow<Dof> row1, row2;
    double s, mass;    ///< s of Eq. (9.5) [1/kg], 1/s
    double Sigma, mu;  ///< [1/kg], μ
  };
  std::vector<Normal> normals_;
  std::vector<Friction> friction_;
  Stripes stripes_;
  int threads_ = 1;
};

}  // namespace spook
