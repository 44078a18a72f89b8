#pragma once
// What nature keeps, to be looked at beside a run. Sums over the bodies that can move.
//
//   T = Σ ½ m v² + ½ ω·I ω        p = Σ m v        L = Σ x × m v + I ω,   I in the world, Eq. (2.7)
//
// Leapfrog's v is half a step behind x, so T is that of t - h/2 unless the start was not shifted and v is read as it is.
#include "engine/bodies/bodies.hpp"

namespace spook {

template <int Dof>
double kinetic_energy(const Bodies<Dof>& bodies);  ///< [J]

/// -Σ m g·x [J], of the weight: 0 at the height of the origin.
template <int Dof>
double potential_energy(const Bodies<Dof>& bodies, const Vec3& gravity);

template <int Dof>
Vec3 momentum(const Bodies<Dof>& bodies);  ///< [kg m/s]

/// About the origin of the world [kg m²/s].
template <int Dof>
Vec3 angular_momentum(const Bodies<Dof>& bodies);

}  // namespace spook
