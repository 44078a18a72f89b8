// Wrong: adds to the impulses that were there.
// Killed by: WarmStart.SetsImpulsesAndWhatTheyDo
// Says: assigned, not added
#include <algorithm>

#include "10_convergence/convergence.hpp"
#include "common/require.hpp"

namespace spook {

template <int Dof>
void warm_start(const std::vector<double>& impulses, std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V) {
  if (impulses.size() != rows.size())
    reject("number of impulses", static_cast<double>(impulses.size()),
           "that of the rows, " + std::to_string(rows.size()));
  std::fill(V.begin(), V.end(), Twist<Dof>::Zero());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    rows[k].lambda = std::clamp(rows[k].lambda + impulses[k], rows[k].lo, rows[k].hi);  // Eq. (10.2)
    apply_impulse(rows[k], rows[k].lambda, V);
  }
}

template void warm_start<3>(const std::vector<double>&, std::vector<Row<3>>&, std::vector<Twist<3>>&);
template void warm_start<6>(const std::vector<double>&, std::vector<Row<6>>&, std::vector<Twist<6>>&);

}  // namespace spook
