#pragma once
// How small one thing may be beside another. A threshold that is a part of something, such as `if (x < 1e-6 * y)`, is
// the same in any units, and no better than `if (x < 1e-9)`: what it drops may be all that changes, step after step.
// So tests put small things beside large ones, down to what roundings let through.
#include <string>

namespace spook::testing {

inline constexpr double small_parts[] = {1e-1, 1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13};

inline const std::string small_is_dropped =
    "Has something been left out because it is small beside something else, as in `if (x < 1e-6 * y)`? It is "
    "small, "
    "and it counts: there is no size below which the rule is another.";

}  // namespace spook::testing
