#include "04_gauss_seidel/gauss_seidel.hpp"
#include "common/not_implemented.hpp"

namespace spook {

SolveReport step_contacts(Simulation& simulation, const std::vector<Contact>& contacts, double h) {
  // Rows by Eq. (4.4), all solved by (4.7), V added, then step_free; see gauss_seidel.hpp.
  not_implemented("4.7 step_contacts", simulation, contacts, h);
}

}  // namespace spook
