#pragma once
// `spook play`: a scene as it runs, in real time, on standard output; commands on standard input. See
// recording/README.md.
#include "spook/run_command.hpp"

namespace spook {

struct PlayCommand {
  RunCommand run;

  /// Until standard input ends. Throws as RunCommand does, before anything is written.
  void execute(std::ostream& out) const;
};

}  // namespace spook
