#include "machinery/parts.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace spook::plots {

namespace fs = std::filesystem;

static std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

static void write_whole(const fs::path& file, const std::string& text) {
  const fs::path beside = file.string() + "." + std::to_string(getpid()) + ".new";  // shards may share a folder
  std::ofstream out(beside);
  out << text;
  if (!out.flush()) throw std::runtime_error(beside.string() + " cannot be written");
  out.close();
  fs::rename(beside, file);
}

/// While it lives, no other process has the lock of the same file.
class Lock {
 public:
  explicit Lock(const fs::path& file) : file_(open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
    if (file_ < 0 || flock(file_, LOCK_EX) != 0) throw std::runtime_error(file.string() + " cannot be locked");
  }
  Lock(const Lock&) = delete;
  ~Lock() { close(file_); }

 private:
  int file_;
};

Parts::Parts(fs::path folder, const std::string& plan, const std::string& program)
    : folder_(std::move(folder)) {
  // Shards begin at the same time: what one finds of another plan, and removes, would be its neighbour's by then.
  fs::create_directories(folder_.parent_path());
  const Lock alone(folder_.string() + ".lock");
  const std::string other = text_of(folder_ / "program.txt");
  if (text_of(folder_ / "plan.txt") != plan || !(other.empty() || other == program)) remove_all();
  fs::create_directories(folder_);
  write_whole(folder_ / "plan.txt", plan);
  write_whole(folder_ / "program.txt", program);
}

fs::path Parts::file(std::size_t point) const {
  std::ostringstream name;
  name.width(6);
  name.fill('0');
  name << point;
  return folder_ / (name.str() + ".csv");
}

bool Parts::has(std::size_t point) const {
  return fs::exists(file(point));
}

void Parts::write(std::size_t point, const std::string& rows) const {
  write_whole(file(point), rows);
}

std::string Parts::read(std::size_t point) const {
  return text_of(file(point));
}

void Parts::remove_all() const {
  fs::remove_all(folder_);
}

}  // namespace spook::plots
