#include "11_direct/direct.hpp"
#include "common/not_implemented.hpp"

namespace spook {

double longest_step(const Interior& now, const Interior& step) {
  // Eq. (11.10); what goes in and out, and in which units, is in direct.hpp.
  not_implemented("11.7 longest_step", now, step);
}

}  // namespace spook
