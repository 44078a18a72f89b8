#include "08_pairs/pairs.hpp"
#include "common/not_implemented.hpp"

namespace spook {

SolveReport step_pairs(Simulation& simulation, double h) {
  // Contacts by Eq. (8.1)-(8.12) where bodies are at t_n, then step_impacts; see pairs.hpp.
  not_implemented("8.12 step_pairs", simulation, h);
}

}  // namespace spook
