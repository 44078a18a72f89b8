#include "14_fast_rows/fast_rows.hpp"
#include "common/not_implemented.hpp"
#include "common/require.hpp"

namespace spook {

template <int Dof>
SolveReport solve_in_colours(std::vector<Colour<Dof>>& colours, std::vector<Twist<Dof>>& V,
                             const StopRule& stop, int threads) {
  // Eq. (14.10), (4.9); what goes in and out, and in which units, is in fast_rows.hpp.
  not_implemented("14.5 solve_in_colours", colours, V, stop, threads);
}

// Compiles the template for point masses (3) and for rigid bodies (6): leave these two lines as they are.
template SolveReport solve_in_colours<3>(std::vector<Colour<3>>&, std::vector<Twist<3>>&, const StopRule&, int);
template SolveReport solve_in_colours<6>(std::vector<Colour<6>>&, std::vector<Twist<6>>&, const StopRule&, int);

}  // namespace spook
