#pragma once
// The rows of finished points, a file each, so that an interrupted experiment can go on and shards can be put together.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace spook::plots {

class Parts {
 public:
  /// Keeps them in `folder`. What was left there by another plan, or another build of the program, is removed.
  /// (Parts that were put there without a program.txt are another machine's, and are taken as they are.)
  Parts(std::filesystem::path folder, const std::string& plan, const std::string& program);

  bool has(std::size_t point) const;

  /// Whole or not at all: written beside, then renamed.
  void write(std::size_t point, const std::string& rows) const;

  std::string read(std::size_t point) const;

  void remove_all() const;

 private:
  std::filesystem::path file(std::size_t point) const;

  std::filesystem::path folder_;
};

}  // namespace spook::plots
