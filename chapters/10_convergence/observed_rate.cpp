#include "10_convergence/convergence.hpp"
#include "common/not_implemented.hpp"

namespace spook {

double observed_rate(const std::vector<double>& history) {
  // Eq. (10.5); what goes in and out, and in which units, is in convergence.hpp.
  not_implemented("10.6 observed_rate", history);
}

}  // namespace spook
