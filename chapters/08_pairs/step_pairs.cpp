#include "08_pairs/pairs.hpp"
#include "common/not_implemented.hpp"

namespace spook {

SolveReport step_pairs(Simulation& simulation, double h) {
  // Find the contacts at the positions of t_n, Eq. (8.1)-(8.12). Then call step_impacts. See pairs.hpp.
  not_implemented("8.12 step_pairs", simulation, h);
}

}  // namespace spook
