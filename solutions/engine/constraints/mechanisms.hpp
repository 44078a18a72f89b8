#pragma once
// Mechanisms: groups of dynamic bodies that joints connect. A free body, or a static one, is a group of its own.
#include <algorithm>
#include <vector>

#include "engine/constraints/joints.hpp"
#include "engine/support/disjoint_sets.hpp"

namespace spook {

template <int Dof>
class Mechanisms {
 public:
  /// `joints` and `bodies` must live as long as this.
  Mechanisms(const std::vector<Joint>& joints, const Bodies<Dof>& bodies)
      : joints_(joints), bodies_(bodies), sets_(static_cast<int>(bodies.size())) {
    for (const Joint& joint : joints)
      if (!bodies.is_fixed(joint.i) && !bodies.is_fixed(joint.j)) sets_.join(joint.i, joint.j);
  }

  /// Returns the number of the mechanism of a body, or of a joint. It is below the number of bodies.
  int of(int body) { return sets_.find(body); }
  int of(const Joint& joint) { return of(bodies_.is_fixed(joint.i) ? joint.j : joint.i); }

  /// Tells whether a joint connects two bodies, or several joints do so by way of dynamic bodies.
  bool connect(int i, int j) {
    return of(i) == of(j) || std::any_of(joints_.begin(), joints_.end(), [&](const Joint& joint) {
             return (joint.i == i && joint.j == j) || (joint.i == j && joint.j == i);
           });
  }

 private:
  const std::vector<Joint>& joints_;
  const Bodies<Dof>& bodies_;
  DisjointSets sets_;
};

}  // namespace spook
