#pragma once
// Impacts at one time: contacts that share bodies, such as the corners of a box that lands flat, have one solution.
//
//   u' = u + S λ,  S = G M⁻¹ Gᵀ                     velocities after the impulses λ of all these contacts
//   λ_n >= 0,  u'_n + e u_n >= 0,  one of them 0     restitution, Eq. (7.18); its u' does not depend on the order
//   |λ_t| <= μ λ_n, against the slip u'_t            friction on cones, Eq. (9.3)
//   λ = λ⁰ + κ (λ¹ - λ⁰)                             λ⁰ without friction, which adds no energy if e <= 1; λ¹ with it;
//                                                    κ the largest in [0, 1] that adds no energy
//   u'_k + Σ_k λ_k = u_k                             a joint of these bodies, Eq. (7.19)
//
// Without friction this is Moreau's impact. With e = 1 the closed contacts reflect, and the energy is kept. Joints do
// not bounce, so with them λ⁰ may add energy. Then λᵖ + κ (λ⁰ - λᵖ) takes its place, with the largest κ in [0, 1] that
// adds none; λᵖ is the plastic impact, e = 0 in all rows. Friction then starts from λᵖ.
#include <vector>

#include "07_impacts/impacts.hpp"

namespace spook {

/// Resolves the impacts of several contacts at one time, each with its own restitution and friction: Eq. (7.18), with u
/// of Eq. (7.1). `joints` are the rows of the joints that take impulses, as impact_rows returns them. Changes W of the
/// bodies of contacts and joints. The contacts approach. Each row has at least 1e-12 of S_kk as its Σ, since the
/// corners of a box are redundant: velocities are right to about 1e-12 of u.
template <int Dof>
void resolve_together(const std::vector<Contact>& contacts, const std::vector<ImpactLaw>& laws,
                      const std::vector<Row<Dof>>& joints, Motion<Dof>& motion);

}  // namespace spook
