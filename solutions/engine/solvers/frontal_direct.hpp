#pragma once
// Many rows by sparse factors of S in dense fronts: engine/linear/frontal_cholesky.hpp. For rows of joints, which
// mostly have no bounds.
#include <optional>

#include "engine/linear/frontal_cholesky.hpp"
#include "engine/linear/row_system.hpp"

namespace spook {

/// A cache for the next step: which bodies rows act on, and the order and pattern of the factors.
struct FrontalFactors {
  RowSystem row_system;
  FrontalCholesky factors;
};

/// Solves the rows, as solve_inside does. Also returns nothing if a pivot fails Eq. (11.4). Throws as direct_solve
/// does.
template <int Dof>
std::optional<SolveReport> frontal_direct(std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V,
                                          const StopRule& stop, FrontalFactors& kept);

}  // namespace spook
