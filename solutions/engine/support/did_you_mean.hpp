#pragma once
// "Did you mean ...?"
#include <string>
#include <vector>

namespace spook {

/// `; did you mean "orbit"?` when one of `known` is within two typing slips of `given`, and less than half wrong;
/// else `; there are: ...`, all of them.
std::string did_you_mean(const std::string& given, const std::vector<std::string>& known);

}  // namespace spook
