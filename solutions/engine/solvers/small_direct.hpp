#pragma once
// A few rows by dense factors on the stack, which takes less time than setting up a sparse matrix.
//
//   factors      S λ = B, S = L D Lᵀ, Eq. (11.1), (11.3), (11.4): engine/linear/dense_ldlt.hpp
//   refinement   once, Eq. (11.14); then the residual is checked, Eq. (4.8)
//
// Returns nothing if a bound is active, that is if a λ is not strictly inside; chapter 11's method then starts anew. If
// there are more rows than velocities, round-off alone can move a λ to its bound. So the limit is then 12 rows instead
// of 32.
#include <optional>

#include "09_better_friction/better_friction.hpp"
#include "11_direct/direct.hpp"
#include "engine/linear/dense_ldlt.hpp"

namespace spook {

/// The largest number of rows, and the largest if the rows outnumber the velocities.
inline constexpr int most_dense_rows = DenseLdlt::most, most_dense_rows_on_bodies = 12;

/// Solves the rows for any initial V; the history has one entry. Returns nothing without rows, for too many rows, if a
/// pivot fails Eq. (11.4), if a λ is not strictly within its bounds, or if the residual exceeds stop.tolerance and the
/// round-off of Eq. (11.13). On failure, rows and V are unchanged if no solution was tried. Otherwise each λ is within
/// its bounds, and V is M⁻¹ Gᵀ λ. `friction`: contacts whose friction must also be within its cone, Eq. (9.3). Throws
/// as direct_solve does.
template <int Dof>
std::optional<SolveReport> small_direct(std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V,
                                        const StopRule& stop,
                                        const std::vector<FrictionContact>& friction = {});

}  // namespace spook
