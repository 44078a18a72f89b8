#include "12_stiff_wires/stiff_wires.hpp"
#include "common/not_implemented.hpp"

namespace spook {

bool stiff_solve(std::vector<Row<3>>& rows, const Motion<3>& motion, const std::vector<Stiffness>& stiffness,
                 double h, std::vector<Twist<3>>& V, Factors& factors) {
  // Eq. (12.6); what goes in and out, and in which units, is in stiff_wires.hpp.
  not_implemented("12.4 stiff_solve", rows, motion, stiffness, h, V, factors);
}

}  // namespace spook
