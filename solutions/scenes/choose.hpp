#pragma once
// Values of typed words.
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "engine/support/did_you_mean.hpp"

namespace spook {

/// Returns the value that `text` names in `choices`. Throws std::invalid_argument for an unknown word, with `option`
/// and the nearest known word.
template <class Value>
Value choose(const std::string& option, const std::string& text,
             const std::vector<std::pair<std::string, Value>>& choices) {
  std::vector<std::string> names;
  for (const auto& [name, value] : choices) {
    if (name == text) return value;
    names.push_back(name);
  }
  throw std::invalid_argument("unknown " + option + " \"" + text + "\"" + did_you_mean(text, names));
}

}  // namespace spook
