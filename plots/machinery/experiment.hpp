#pragma once
// An experiment: independent points, each of which computes some rows of a table; and claims about the table.
//
// run_experiment() is the main program of an experiment. It computes the points on all cores, and continues after an
// interruption. With --shard i/n it computes a share of them. It writes the table as CSV and the claims as JSON; the
// exit code tells whether the claims hold.
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "machinery/claims.hpp"
#include "machinery/table.hpp"

namespace CLI {
class App;
}

namespace spook::plots {

using Cell = std::variant<double, std::string>;
using Row = std::vector<Cell>;

/// An independent piece of work. Its key describes it, and is unique in its experiment.
struct Point {
  std::string key;
  std::function<std::vector<Row>()> rows;
};

struct Experiment {
  std::vector<std::string> columns;  ///< units in brackets
  std::vector<Point> points;
  bool timed = false;  ///< points measure time, so they are computed one at a time
  std::function<void(const Table&, Claims&)> check;
};

/// The size of an experiment. The tests run the quick size, which is smaller but makes the same claims, in a second or
/// two.
enum class Size { quick, full };

/// Runs an experiment as a program's main(). `options` may add options to the command line before `make` is called.
/// Exit codes: 0 if the claims hold, or a shard is done; 1 if a claim does not hold; 2 for bad input.
int run_experiment(int argc, char** argv, const std::function<Experiment(Size)>& make,
                   const std::function<void(CLI::App&)>& options = nullptr);

}  // namespace spook::plots
