#pragma once
// Lists that are longer than those of most tests: for loops that end early, and for room that was enough for ten.
#include <string>

namespace spook::testing {

inline constexpr int many = 100;

inline const std::string ends_early = "A loop that ends early leaves the rest as they were.";

}  // namespace spook::testing
