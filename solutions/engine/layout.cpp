#include "engine/layout.hpp"

namespace spook {

template <>
const char Layout::found = 1;

}  // namespace spook
