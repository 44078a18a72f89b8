#pragma once
// From contacts to rows; joint_rows.hpp has those of joints.
//
//   dg/dt = G W          G of a contact, Eq. (3.3); of a point mass the linear part of it
//   a, b, Σ              from h, k, d, Eq. (3.4)-(3.6); of friction 0, 1, Γ, Eq. (5.4)
//   0 <= λ < ∞           a contact pushes, never pulls
//   -Λ <= λ <= Λ         friction: two rows more, with the bound of Eq. (5.7), or of chapter 09
//   S_kk, B              Eq. (4.3), (4.4)
#include <string>
#include <vector>

#include "09_better_friction/better_friction.hpp"
#include "engine/bodies/materials.hpp"

namespace spook {

template <int Dof>
Constraint<Dof> contact_constraint(const Contact& contact, const SpookParameters& spook);

/// Where the limit of friction comes from.
enum class FrictionModel {
  box,       ///< a mass and gravity: Eq. (5.6)-(5.8)
  two_pass,  ///< the normal impulses of a first pass, without friction: Eq. (9.1)
  cone       ///< the normal impulse of now, on Coulomb's cone: Eq. (9.3)-(9.6)
};

inline std::string name_of(FrictionModel model) {
  return model == FrictionModel::box ? "box" : model == FrictionModel::cone ? "cone" : "two_pass";
}

/// Friction settings.
struct Friction {
  double c = 1e12;              ///< viscosity that is left [N s/m]: what sticks creeps at F/c, Eq. (5.5)
  Vec3 gravity = Vec3::Zero();  ///< what presses, in Eq. (5.7) [m/s²]
  FrictionModel model = FrictionModel::box;
  /// Tangents along the slip, Eq. (9.2), where the slip is faster than a thousandth of what gravity adds in a step.
  bool sliding_tangents = false;
};

/// One for the normal, and where anything rubs two for the tangents.
inline int rows_per_contact(bool rub) {
  return rub ? 3 : 1;
}

/// Adds the rows of each contact in turn: the normal one, and where anything rubs those of its two tangents. The latter
/// have the bounds of the box; without one, of 0 for two passes, and none for the cone, and are in `rubbing`. The rows do not
/// depend on `threads`.
template <int Dof>
void add_contact_rows(const std::vector<Contact>& contacts, double h, const Materials& materials,
                      const Friction& friction, const Motion<Dof>& motion, int threads, std::size_t first_row,
                      std::vector<Row<Dof>>& rows, std::vector<FrictionContact>& rubbing);

}  // namespace spook
