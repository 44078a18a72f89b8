#pragma once
// Joints in impacts: the joints of a mechanism take their impulses at the same time as its contacts.
//
//   G_k Δv + Σ_k λ_k = 0    an impact changes no velocity along the row k of a joint             Eq. (7.19)
//
// A limit that is reached, or a taut rope, has λ >= 0 and u' >= 0 in place of the equation: it holds what closes, and
// lets go what opens. Springs and motors have bounded forces, and so no impulse. Σ is that of the step: a joint that is
// softer than a step resolves takes almost none.
#include <cstddef>
#include <vector>

#include "engine/constraints/joints.hpp"

namespace spook {

/// The joints by mechanism: engine/constraints/mechanisms.hpp.
template <int Dof>
class ImpactJoints {
 public:
  ImpactJoints(const std::vector<Joint>& joints, const Bodies<Dof>& bodies);

  /// Returns all joints in the mechanisms of these dynamic bodies; none for free bodies.
  std::vector<Joint> of(const std::vector<std::size_t>& bodies) const;

 private:
  std::vector<std::vector<Joint>> joints_;  // of each mechanism
  std::vector<int> mechanism_of_;           // of each body; empty without joints
};

/// Returns the rows of the joints that take impulses, at the present positions of the bodies, with B = 0, or -u
/// for limits and ropes. Defaults of the joints must be filled in, as a world does. `h` is the length of a step [s].
template <int Dof>
std::vector<Row<Dof>> impact_rows(const std::vector<Joint>& joints, double h, const Bodies<Dof>& bodies);

}  // namespace spook
