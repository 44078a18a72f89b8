#pragma once
// Rows that resist rolling and spinning at contacts, such as those of a tyre, or of a ball on cloth.
//
//   torsion   ω_n = 0, |λ| <= h τ N      about the normal; τ is the torsional resistance [m]
//   rolling   ω_t = 0, |λ| <= h ρ N      about two tangents, the first along the present ω_t; ρ is the rolling one [m]
//
// ω is that of j relative to i, λ is an angular impulse [N m s], and N is the normal force of the contact in the last
// step. A ball of radius r with ρ rests on a slope up to tan θ = ρ/r, and is slowed down on a plane by 5/7 g ρ/r. The
// rows have the form of a motor, Eq. (13.12), with a speed of 0.
#include <vector>

#include "engine/bodies/bodies.hpp"
#include "engine/bodies/materials.hpp"
#include "engine/constraints/warm_start_cache.hpp"

namespace spook {

/// Adds the rows of all contacts with resistance. `last` has the forces of the last step: in its first step a contact
/// has no resistance.
void add_resistance_rows(const std::vector<Contact>& contacts, double h, const Materials& materials,
                         const WarmStartCache& last, const Motion<6>& motion, std::vector<Row<6>>& rows);

}  // namespace spook
