#pragma once
// `spook scenes`: what there is, and how it can be set.
#include <ostream>
#include <string>
#include <vector>

namespace spook {

struct ScenesCommand {
  std::string scene;  ///< empty: all
  bool json = false;
  bool as_file = false;          ///< as a file, with these parameters
  std::vector<std::string> set;  ///< as typed after --set

  /// Throws std::invalid_argument for a scene that there is not, or that no file can hold.
  void execute(std::ostream& out) const;
};

}  // namespace spook
