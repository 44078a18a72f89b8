#pragma once
// An experiment: independent points, each of which computes some rows of a table; and claims about the table.
//
// run_experiment() makes a program of one. It computes the points on all cores, goes on where it was interrupted, and
// can take a share of them (--shard i/n); it writes the table as CSV and the claims as JSON, and says with its exit
// code whether they hold.
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

/// A piece of work that needs no other. Its key says what it is, and is unique in its experiment.
struct Point {
  std::string key;
  std::function<std::vector<Row>()> rows;
};

struct Experiment {
  std::vector<std::string> columns;  ///< units in brackets
  std::vector<Point> points;
  bool timed = false;  ///< points measure time, and so are computed one at a time
  std::function<void(const Table&, Claims&)> check;
};

/// The quick size is what the tests run: less of the same, so that every claim can be checked in a second or two.
enum class Size { quick, full };

/// A program's main(). `options` may add its own to the command line before `make` is called.
/// Exit codes: 0 the claims hold, or a shard is done; 1 one does not; 2 bad input.
int run_experiment(int argc, char** argv, const std::function<Experiment(Size)>& make,
                   const std::function<void(CLI::App&)>& options = nullptr);

}  // namespace spook::plots
