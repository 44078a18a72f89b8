#pragma once
// Impacts, detected after penetration: a step has already moved the bodies into each other.
//
//   delay τ      two bodies approach at speed u and relative acceleration a, and touched τ ago:
//                -gap = u τ - ½ a τ²                                                         Eq. (7.15)
//   correction   back by τ, impulse J with the velocities of that time, forward by τ with the new velocities:
//                x += τ Δv                                                                   Eq. (7.16)
//
// After the correction the gap is open, e times the overlap. So the rows need not push the bodies apart, which would
// add energy. In a chain of balls each impact passes the delay on. An impact is resolved with τ = 0 if its correction
// would close another overlap, out of which rows push a body: the body would return there in each step. Impacts are
// resolved in the order of their times, and those at one time together: engine/impacts/simultaneous_impacts.hpp. Lever
// arms, and the normal of two spheres, are those of the time of impact, so angular momentum is kept up to round-off.
// Free bodies keep their orientations. The bodies of a mechanism also turn back and forward, so that their joints stay
// closed.
#include <functional>
#include <vector>

#include "07_impacts/impacts.hpp"
#include "engine/collision/contacts.hpp"
#include "engine/constraints/joints.hpp"

namespace spook {

/// The impact of a contact.
struct Impact {
  int i, j;      ///< its bodies
  double speed;  ///< at which they approached along the normal [m/s]
};

/// Returns the impact law of a contact.
using LawOf = std::function<ImpactLaw(const Contact& contact)>;

/// Moves a body with its present velocity for a time [s], which may be negative.
using MoveFreely = std::function<void(std::size_t body, double time)>;

/// The normal velocity u_n of Eq. (7.1) at x_n [m/s]; negative if the bodies approach.
template <int Dof>
double separation_speed(const Contact& contact, const Motion<Dof>& motion);

/// Resolves the impacts of all closed contacts, the longest delay first: Eq. (7.1)-(7.16). Contacts whose delays differ
/// by at most a millionth of a step, and that dynamic bodies or joints connect, are resolved together: Eq. (7.18).
/// Joints of these bodies take their impulses, Eq. (7.19); their defaults must be filled in. `move_freely` moves their
/// bodies. A contact has at most `max_passes` impacts in a call. A delay is at most two steps, of `h` or of the last
/// step `last_h` [s]. Updates velocities, positions and gaps. Returns the impacts. Of several contacts that are resolved
/// together, some may separate at the earlier time: their speed is not positive.
template <int Dof>
std::vector<Impact> resolve_late_impacts(std::vector<Contact>& contacts, const LawOf& law, double h,
                                         double last_h, const Shapes& shapes, const std::vector<Joint>& joints,
                                         const MoveFreely& move_freely, Bodies<Dof>& bodies);

}  // namespace spook
