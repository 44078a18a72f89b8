#pragma once
// Suggestions for unknown names: the nearest name, or the new name of a renamed option.
#include <string>
#include <vector>

namespace spook {

/// Returns `; did you mean "orbit"?` if a name of `known` is within two typing errors of `given`, and differs in less
/// than half of its letters. Returns `; it is now called "row-order"` for a name of an earlier release, else `; there
/// are: ...` with all known names.
std::string did_you_mean(const std::string& given, const std::vector<std::string>& known);

/// Returns the current name of an option or solver that an earlier release called `name`; empty if there is none.
std::string present_name(const std::string& name);

}  // namespace spook
