#include "engine/support/abi_check.hpp"

namespace spook {

template <>
const char Layout::found = 1;

}  // namespace spook
