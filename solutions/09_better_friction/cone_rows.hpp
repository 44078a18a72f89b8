#pragma once
// The two friction rows of a contact, as a pair.
#include "09_better_friction/better_friction.hpp"

namespace spook {

/// Eq. (9.5) [1/kg].
template <int Dof>
double stiffest_direction(const Row<Dof>& row1, const Row<Dof>& row2);

/// λ_t of Eq. (9.6).
template <int Dof>
Vec2 next_friction(const FrictionContact& contact, const std::vector<Row<Dof>>& rows,
                   const std::vector<Twist<Dof>>& V, double s);

}  // namespace spook
