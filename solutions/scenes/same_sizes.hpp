#pragma once
// Whether two builds of a scene have bodies and joints of the same sizes.
#include "engine/world/world.hpp"

namespace spook {

/// Tells whether the bodies and joints of `world` have the shapes, planes, points and lengths of the first ones of
/// `before`. Only then do they fit where those of `before` are. `before` may have further bodies and joints.
template <int Dof>
bool has_same_sizes(const World<Dof>& world, const World<Dof>& before);

}  // namespace spook
