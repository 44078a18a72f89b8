#pragma once
// The two friction rows of a contact, updated together.
#include "09_better_friction/better_friction.hpp"

namespace spook {

/// The largest diagonal of the friction rows in any tangential direction, s of Eq. (9.5) [1/kg].
template <int Dof>
double stiffest_direction(const Row<Dof>& row1, const Row<Dof>& row2);

/// Returns the updated friction impulse λ_t of Eq. (9.6) [N s].
template <int Dof>
Vec2 next_friction(const FrictionContact& contact, const std::vector<Row<Dof>>& rows,
                   const std::vector<Twist<Dof>>& V, double s);

}  // namespace spook
