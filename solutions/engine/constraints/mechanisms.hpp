#pragma once
// Mechanisms: groups of dynamic bodies that joints connect. A free body is a group of its own.
#include <vector>

#include "engine/constraints/joints.hpp"
#include "engine/support/disjoint_sets.hpp"

namespace spook {

template <int Dof>
class Mechanisms {
 public:
  /// `bodies` must live as long as this.
  Mechanisms(const std::vector<Joint>& joints, const Bodies<Dof>& bodies)
      : bodies_(bodies), sets_(static_cast<int>(bodies.size())) {
    for (const Joint& joint : joints)
      if (!bodies.is_fixed(joint.i) && !bodies.is_fixed(joint.j)) sets_.join(joint.i, joint.j);
  }

  /// Returns the number of the mechanism of a dynamic body, or of a joint. It is below the number of bodies.
  int of(int body) { return sets_.find(body); }
  int of(const Joint& joint) { return of(bodies_.is_fixed(joint.i) ? joint.j : joint.i); }

 private:
  const Bodies<Dof>& bodies_;
  DisjointSets sets_;
};

}  // namespace spook
