#include "machinery/experiment.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <exception>
#include <fstream>
#include <iostream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "machinery/parts.hpp"
#include "scenes/number.hpp"
#include "spook/require_nothing_left.hpp"

namespace spook::plots {

namespace fs = std::filesystem;

namespace {

struct Options {
  fs::path out;
  bool quick = false;
  std::string shard = "1/1";
  std::string jobs = std::to_string(std::max(1U, std::thread::hardware_concurrency()));
};

struct Shard {
  std::size_t index, count;
  bool has(std::size_t point) const { return point % count == index; }
};

Shard parse_shard(const std::string& text) {
  const std::size_t slash = text.find('/');
  if (slash != std::string::npos) {
    const int most = 1'000'000;
    const int count = parse_whole("shard", text.substr(slash + 1), 1, most);
    const int index = parse_whole("shard", text.substr(0, slash), 1, most);
    if (index <= count) return {static_cast<std::size_t>(index - 1), static_cast<std::size_t>(count)};
  }
  throw std::invalid_argument("shard must be i/n with 1 <= i <= n, but is " + text);
}

std::string cell_text(const Cell& cell) {
  if (const double* number = std::get_if<double>(&cell)) return exact_text(*number);
  return std::get<std::string>(cell);
}

template <class Cells, class Text>
std::string line(const Cells& cells, const Text& text) {
  std::string joined;
  for (const auto& cell : cells) {
    if (!joined.empty()) joined += ',';
    joined += text(cell);
  }
  return joined + "\n";
}

std::string header(const Experiment& experiment) {
  return line(experiment.columns, [](const std::string& name) { return name; });
}

/// Returns the columns, the size and the keys of all points.
std::string plan(const Experiment& experiment, bool quick) {
  std::string text = header(experiment) + (quick ? "quick\n" : "full\n");
  std::set<std::string> keys;
  for (const Point& point : experiment.points) {
    if (!keys.insert(point.key).second) throw std::logic_error("two points have the key " + point.key);
    text += point.key + "\n";
  }
  return text;
}

/// Changes with every build.
std::string digest(const std::string& program_file) {
  std::ostringstream program;
  program << std::ifstream(program_file, std::ios::binary).rdbuf();
  return std::to_string(std::hash<std::string>()(program.str())) + "\n";
}

/// Progress on stderr: "[12/40] key".
class Progress {
 public:
  explicit Progress(std::size_t all) : all_(all) {}
  void tell(const std::string& key) {
    ++done_;
    std::cerr << "[" << done_ << "/" << all_ << "] " << key << std::endl;
  }

 private:
  std::size_t done_ = 0, all_;
};

/// Computes the points that are missing, on `jobs` threads. The first exception ends it, and is thrown again.
void compute(const Experiment& experiment, const std::vector<std::size_t>& missing, int jobs,
             const Parts& parts) {
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::exception_ptr failure;
  Progress progress(missing.size());
  const auto work = [&] {
    for (std::size_t k; (k = next++) < missing.size();) {
      const Point& point = experiment.points[missing[k]];
      try {
        std::string text;
        for (const Row& row : point.rows()) text += line(row, cell_text);
        const std::lock_guard lock(mutex);
        parts.write(missing[k], text);
        progress.tell(point.key);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        next = missing.size();
      }
    }
  };
  std::vector<std::thread> threads;
  for (int t = 1; t < jobs; ++t) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  if (failure) std::rethrow_exception(failure);
}

Table read_table(const Experiment& experiment, const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(csv);
  for (std::string text; std::getline(lines, text);) {
    std::vector<std::string> cells;
    std::istringstream columns(text);
    for (std::string cell; std::getline(columns, cell, ',');) cells.push_back(cell);
    rows.push_back(cells);
  }
  return {experiment.columns, rows};
}

nlohmann::ordered_json bound(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

void write_claims(const fs::path& file, const Claims& claims) {
  auto all = nlohmann::ordered_json::array();
  for (const Claim& claim : claims.all())
    all.push_back({{"text", claim.text},
                   {"measured", claim.measured},
                   {"low", bound(claim.low)},
                   {"high", bound(claim.high)},
                   {"holds", claim.holds()}});
  std::ofstream(file) << all.dump(1) << '\n';
}

void print_claims(const Claims& claims) {
  for (const Claim& claim : claims.all()) {
    std::cout << (claim.holds() ? "holds  " : "FALSE  ") << claim.text << ": " << short_text(claim.measured);
    if (!claim.holds()) std::cout << ", not from " << short_text(claim.low) << " to " << short_text(claim.high);
    std::cout << '\n';
  }
}

int execute(const Experiment& experiment, const Options& options, const std::string& program_file) {
  const Shard shard = parse_shard(options.shard);
  const int jobs = parse_whole("jobs", options.jobs, 1, 9999);
  const Parts parts(options.out / "parts", plan(experiment, options.quick), digest(program_file));
  std::vector<std::size_t> missing;
  for (std::size_t k = 0; k < experiment.points.size(); ++k)
    if (shard.has(k) && !parts.has(k)) missing.push_back(k);
  compute(experiment, missing, experiment.timed ? 1 : jobs, parts);
  if (shard.count > 1) {  // others may still be at work, in the same folder
    std::cout << "shard " << options.shard
              << " is done; without --shard the parts that are there become a table\n";
    return 0;
  }

  std::string rows;
  for (std::size_t k = 0; k < experiment.points.size(); ++k) rows += parts.read(k);
  std::ofstream(options.out / "table.csv") << header(experiment) << rows;
  Claims claims;
  experiment.check(read_table(experiment, rows), claims);
  write_claims(options.out / "claims.json", claims);
  print_claims(claims);
  parts.remove_all();
  return claims.hold() ? 0 : 1;
}

}  // namespace

int run_experiment(int argc, char** argv, const std::function<Experiment(Size)>& make,
                   const std::function<void(CLI::App&)>& more_options) {
  Options options;
  CLI::App app("An experiment: writes table.csv and claims.json, and fails when a claim is false.");
  app.set_help_flag("--help", "Print this help and exit");  // not -h, which CLI11 takes for --h, too
  app.add_option("--out", options.out, "folder to write to")->required();
  app.add_flag("--quick", options.quick, "the size that the tests run");
  app.add_option("--shard", options.shard, "i/n: only every n-th point, from the i-th");
  app.add_option("--jobs", options.jobs, "how many points at a time");
  if (more_options) more_options(app);
  try {
    app.allow_extras();
    app.parse(argc, argv);
    require_nothing_left(app);
    return execute(make(options.quick ? Size::quick : Size::full), options, argv[0]);
  } catch (const CLI::CallForHelp& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    std::cerr << error.what() << '\n';
    return 2;
  } catch (const std::invalid_argument& error) {
    std::cerr << error.what() << '\n';
    return 2;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}

}  // namespace spook::plots
