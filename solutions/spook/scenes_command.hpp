#pragma once
// `spook scenes`: lists scenes and their parameters.
#include <ostream>
#include <string>
#include <vector>

namespace spook {

struct ScenesCommand {
  std::string scene;  ///< empty: all scenes
  bool json = false;
  bool as_file = false;          ///< writes the scene as a file, with the parameters of `set`
  std::vector<std::string> set;  ///< as typed after --set

  /// Prints to `out`. Throws std::invalid_argument for an unknown scene, and for a scene that a file cannot describe.
  void execute(std::ostream& out) const;
};

}  // namespace spook
