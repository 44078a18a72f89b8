#pragma once
// Check of an index that a caller gives.
#include <cstddef>
#include <stdexcept>
#include <string>

namespace spook {

/// Returns the index of one of `count` bodies, joints or contacts. Throws std::invalid_argument, with `name` and the
/// index, if there is none of that index.
inline std::size_t require_index(const std::string& name, int index, std::size_t count) {
  if (index >= 0 && static_cast<std::size_t>(index) < count) return static_cast<std::size_t>(index);
  const std::string allowed =
      count == 0 ? " is " : " must be an index below " + std::to_string(count) + ", but is ";
  throw std::invalid_argument(name + allowed + std::to_string(index) +
                              (count == 0 ? ", where there is none" : ""));
}

}  // namespace spook
