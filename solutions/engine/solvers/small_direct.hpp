#pragma once
// A few rows by dense factors: S fits the stack, and is solved before a sparse matrix would have been written down.
//
//   factors     S λ = B, S = L D Lᵀ, Eq. (11.1), (11.3), (11.4): engine/linear/dense_ldlt.hpp
//   roundings   refined once, Eq. (11.14), and looked at, Eq. (4.8)
//
// Returns nothing if a bound is active: if a λ is not strictly inside, chapter 11 begins anew. Where rows outnumber the velocities
// of their bodies roundings alone may take one to its bound, and fewer are worth a try.
#include <optional>

#include "09_better_friction/better_friction.hpp"
#include "11_direct/direct.hpp"
#include "engine/linear/dense_ldlt.hpp"

namespace spook {

/// How many rows are few, and how many where they outnumber the velocities.
inline constexpr int most_dense_rows = DenseLdlt::most, most_dense_rows_on_bodies = 12;

/// Solves the rows, whatever V is; the history has one entry. Nothing where there are none or more than a few, a pivot is not
/// sound, a λ is not strictly within its bounds, or what is left exceeds stop.tolerance and the roundings of Eq. (11.13). Then
/// rows and V are as they were, or V is M⁻¹ Gᵀ λ with each λ within its bounds. `rubbing`: contacts whose friction is to
/// be within its cone, too, Eq. (9.3). Throws as direct_solve does.
template <int Dof>
std::optional<SolveReport> small_direct(std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V,
                                        const StopRule& stop, const std::vector<FrictionContact>& rubbing = {});

}  // namespace spook
