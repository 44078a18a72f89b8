#pragma once
// Rows of contacts; joint_rows.hpp has the rows of joints.
//
//   dg/dt = G W          G of a contact, Eq. (3.3); for a point mass only its linear part
//   a, b, Σ              from h, k, d, Eq. (3.4)-(3.6); for friction 0, 1, Γ, Eq. (5.4)
//   0 <= λ < ∞           normal row: a contact pushes, never pulls
//   -Λ <= λ <= Λ         friction: two more rows, with the bound of Eq. (5.7), or of chapter 09
//   S_kk, B              Eq. (4.3), (4.4)
#include <string>
#include <vector>

#include "engine/bodies/materials.hpp"
#include "engine/constraints/constraint_set.hpp"

namespace spook {

/// Returns the constraint of a contact's normal direction.
template <int Dof>
Constraint<Dof> contact_constraint(const Contact& contact, const SpookParameters& spook);

/// The source of the friction limit Λ.
enum class FrictionModel {
  box,       ///< a constant, from a mass and gravity: Eq. (5.6)-(5.8)
  two_pass,  ///< the normal impulses of a first solve without friction: Eq. (9.1)
  cone       ///< the current normal impulse, on Coulomb's cone: Eq. (9.3)-(9.6)
};

inline std::string name_of(FrictionModel model) {
  return model == FrictionModel::box ? "box" : model == FrictionModel::cone ? "cone" : "two_pass";
}

/// Throws std::invalid_argument, naming the solver, for friction in two passes.
inline void require_box_or_cone(const std::string& solver, FrictionModel model) {
  if (model == FrictionModel::two_pass)
    throw std::invalid_argument("the friction model of " + solver + " must be box or cone, but is two_pass");
}

/// Friction settings.
struct Friction {
  double c = 1e12;  ///< viscosity [N s/m]: under a force F a sticking contact creeps at F/c, Eq. (5.5)
  Vec3 gravity = Vec3::Zero();  ///< g of Eq. (5.7) [m/s²]
  FrictionModel model = FrictionModel::box;
  /// First tangent along the slip, Eq. (9.2), if the slip is faster than a thousandth of the speed that gravity adds in
  /// a step.
  bool sliding_tangents = false;
};

/// Replaces the rows of the contacts. Friction rows have the bounds of the box; 0 for two passes; infinite for the
/// cone. For the last two, `constraints.friction` lists the contacts. The rows are the same for any number of
/// `threads`.
template <int Dof>
void set_contact_rows(const std::vector<Contact>& contacts, double h, const Materials& materials,
                      const Friction& friction, const Motion<Dof>& motion, int threads,
                      ConstraintSet<Dof>& constraints);

}  // namespace spook
