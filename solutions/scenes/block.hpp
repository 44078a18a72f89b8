#pragma once
// The block of `incline` and `sliding_block`, on the plane z = 0: a point mass with a sphere, which cannot
// turn, or a box on its corners, which can.
#include "engine/world/world.hpp"
#include "scenes/parameters.hpp"

namespace spook {

struct Block {
  double mass;          ///< [kg]
  double base, height;  ///< side of its square base, and height [m]

  Vec3 half_sides() const { return Vec3(base, base, height) / 2; }
};

/// m, base and height of a scene.
Block block(const Parameters& parameters);

/// The block as it lies above the origin, settled: its contacts, of stiffness `k`, as deep as the load N [N]
/// presses them while `friction` F [N], in the plane, acts on its base.
///
///   point   depth N/k
///   box     depth N/(4k) on average; friction's torque makes it deeper in front than behind, by a turn of
///           (height/2)/(k base²) (F_y, -F_x, 0)
///
/// Throws std::invalid_argument that names height when the box would tip over: height (|F_x| + |F_y|) > base N.
template <int Dof>
Body<Dof> lying(const Block& block, double load, const Vec3& friction, double k);

namespace parameter {

Parameter base(double value);
Parameter height(double value);
Parameter block_model();

}  // namespace parameter

}  // namespace spook
