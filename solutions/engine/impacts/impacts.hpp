#pragma once
// Impacts, detected after penetration: a step has already moved the bodies into each other.
//
//   late       two that approach at u and are pulled together by a were at 0 a time τ ago: -gap = u τ - ½ a τ²   Eq. (7.15)
//   made good  back by τ, J with the velocities of then, and on by τ with the new ones: x += τ Δv               Eq. (7.16)
//
// The gap is e times the overlap then, and open: nothing is left for the rows to push apart, which they would do with
// energy that nobody has put in. In a chain each ball hands on the delay with the impact. Lever arms, and the normal of two
// spheres, are those of the time of impact, so that angular momentum is kept to roundings; how bodies are turned stays.
#include <functional>

#include "07_impacts/impacts.hpp"
#include "engine/collision/contacts.hpp"

namespace spook {

/// How the two bodies of a contact hit each other.
using LawOf = std::function<ImpactLaw(const Contact& contact)>;

/// u_n of Eq. (7.1), with the velocities at x_n [m/s]; negative: they approach.
template <int Dof>
double separation_speed(const Contact& contact, const Motion<Dof>& motion);

/// The impacts of the contacts that are closed, one by one, in passes as chapter 07's: Eq. (7.1)-(7.16). Velocities and
/// positions change, and the gaps with them. Returns how many there were.
template <int Dof>
int resolve_late_impacts(std::vector<Contact>& contacts, const LawOf& law, double h, const Shapes& shapes,
                         Bodies<Dof>& bodies);

}  // namespace spook
