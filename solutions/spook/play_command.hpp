#pragma once
// `spook play`: runs a scene in real time. Writes frames to standard output, and reads commands from standard input;
// recording/README.md describes both.
#include "spook/run_command.hpp"

namespace spook {

struct PlayCommand {
  RunCommand run;

  /// Runs until standard input ends. Throws as RunCommand does, before it writes anything.
  void execute(std::ostream& out) const;
};

}  // namespace spook
