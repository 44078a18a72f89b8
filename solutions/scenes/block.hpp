#pragma once
// The block of `incline` and `sliding_block`, on the plane z = 0: a point mass with a sphere, which cannot turn, or a
// box on its corners, which can turn.
#include "engine/world/world.hpp"
#include "scenes/parameters.hpp"

namespace spook {

struct Block {
  double mass;          ///< [kg]
  double base, height;  ///< side of its square base, and height [m]

  Vec3 half_sides() const { return Vec3(base, base, height) / 2; }
};

/// The block that a scene's parameters mass, base and height describe.
Block block(const Parameters& parameters);

/// The block at rest above the origin, at equilibrium with contacts of stiffness `k`. Its load is N [N], and `friction`
/// F [N], in the plane, acts on its base.
///
/// point   depth N/k
/// box     depth N/(4k) on average; friction's torque makes the front deeper than the back, by a rotation of
/// (height/2)/(k base²) (F_y, -F_x, 0)
///
/// Throws std::invalid_argument, naming height, if the box would tip over: height (|F_x| + |F_y|) > base N.
template <int Dof>
Body<Dof> lying(const Block& block, double load, const Vec3& friction, double k);

namespace parameter {

Parameter base(double value);
Parameter height(double value);
Parameter block_model();

}  // namespace parameter

}  // namespace spook
