#pragma once
// `spook scenes`: what there is, and how it can be set.
#include <ostream>
#include <string>

namespace spook {

struct ScenesCommand {
  std::string scene;  ///< empty: all
  bool json = false;

  /// Throws std::invalid_argument for a scene that there is not.
  void execute(std::ostream& out) const;
};

}  // namespace spook
