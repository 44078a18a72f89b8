#include "03_single_contact/single_contact.hpp"
#include "common/not_implemented.hpp"

namespace spook {

ContactJacobian contact_jacobian(const Contact& contact) {
  // Eq. (3.3); what goes in and out, and in which units, is in single_contact.hpp.
  not_implemented("3.2 contact_jacobian", contact);
}

}  // namespace spook
