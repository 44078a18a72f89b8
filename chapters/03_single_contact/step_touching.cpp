#include "03_single_contact/single_contact.hpp"
#include "common/not_implemented.hpp"

namespace spook {

void step_touching(Simulation& simulation, const Contact& contact, double h) {
  // Eq. (3.10), (3.11) from velocities of t_n - h/2, then step_free; see single_contact.hpp.
  not_implemented("3.5 step_touching", simulation, contact, h);
}

}  // namespace spook
