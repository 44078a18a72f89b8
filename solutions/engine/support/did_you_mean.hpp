#pragma once
// What to say of a word that is not known: "Did you mean ...?", or what it is called now.
#include <string>
#include <vector>

namespace spook {

/// Returns `; did you mean "orbit"?` when one of `known` is within two typing slips of `given`, and less than half wrong;
/// `; it is now called "row-order"` for a name of an earlier release; else `; there are: ...`, all of them.
std::string did_you_mean(const std::string& given, const std::vector<std::string>& known);

/// Returns the present name of an option or solver that an earlier release called `name`; empty if there is none.
std::string present_name(const std::string& name);

}  // namespace spook
