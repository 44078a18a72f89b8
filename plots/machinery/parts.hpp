#pragma once
// Files with the rows of finished points, by which an interrupted experiment continues, and shards are combined.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace spook::plots {

class Parts {
 public:
  /// Keeps the files in `folder`. Removes files of another plan, or of another build of the program. (Files without a
  /// program.txt come from another machine, and are kept.)
  Parts(std::filesystem::path folder, const std::string& plan, const std::string& program);

  bool has(std::size_t point) const;

  /// Writes the file completely or not at all: writes to a temporary file, then renames it.
  void write(std::size_t point, const std::string& rows) const;

  std::string read(std::size_t point) const;

  void remove_all() const;

 private:
  std::filesystem::path file(std::size_t point) const;

  std::filesystem::path folder_;
};

}  // namespace spook::plots
