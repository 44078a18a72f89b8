#pragma once
// Conserved quantities: energies, momentum and angular momentum, summed over the dynamic bodies.
//
//   T = Σ ½ m v² + ½ ω·I ω        p = Σ m v        L = Σ x × m v + I ω,   I in the world, Eq. (2.7)
//
// Leapfrog's v is half a step older than x, so T belongs to the time t - h/2, unless the start was not shifted.
#include "engine/bodies/bodies.hpp"

namespace spook {

/// The kinetic energy T [J]; the second is that of body i with a velocity W.
template <int Dof>
double kinetic_energy(const Bodies<Dof>& bodies);
template <int Dof>
double kinetic_energy(const Bodies<Dof>& bodies, std::size_t i, const Twist<Dof>& W);

/// The potential energy of the weight, -Σ m g·x [J]: 0 at the height of the origin.
template <int Dof>
double potential_energy(const Bodies<Dof>& bodies, const Vec3& gravity);

/// The momentum p [kg m/s].
template <int Dof>
Vec3 momentum(const Bodies<Dof>& bodies);

/// The angular momentum L about the origin of the world [kg m²/s].
template <int Dof>
Vec3 angular_momentum(const Bodies<Dof>& bodies);

}  // namespace spook
