#include "spook/checkpoint.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "engine/support/state_stream.hpp"
#include "spook/scene_file.hpp"

namespace spook {

/// Returns the FNV-1a hash of some bytes.
static std::uint64_t checksum(const std::string& bytes) {
  std::uint64_t hash = 14695981039346656037u;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211u;
  return hash;
}

static std::string unfinished_name(const std::string& file) {
  return file + ".unfinished";
}

[[noreturn]] static void reject(const std::string& file) {
  throw std::invalid_argument("checkpoint \"" + file + "\" cannot be written");
}

static std::string all_bytes(std::istream& in) {
  return {std::istreambuf_iterator<char>(in), {}};
}

Json continued_run(const std::string& scene, const SceneDescription& description, const Parameters& parameters,
                   const Method& method) {
  Json run = {{"scene", description.name}};
  if (is_scene_file(scene)) {
    std::ifstream file(scene);
    run["text of the scene's file"] = checksum(all_bytes(file));
  }
  run.update(to_json(parameters));
  Json options = to_json(method, description.solves);
  options.erase("threads");
  run.update(options);
  run["seed of the row order"] = method.seed;
  return run;
}

void require_writable_checkpoint(const std::string& file) {
  const std::string unfinished = unfinished_name(file);
  if (!std::ofstream(unfinished) || std::filesystem::is_directory(file)) reject(file);
  std::remove(unfinished.c_str());
}

void write_checkpoint(const std::string& file, const Json& run, std::int64_t substep, Scene& scene) {
  std::ostringstream state;
  StateStream stream(state);
  scene.state(stream);
  const std::string bytes = state.str(), unfinished = unfinished_name(file);
  const Json first = {{"format", "spook checkpoint"}, {"version", 1},          {"run", run},
                      {"substep", substep},           {"bytes", bytes.size()}, {"checksum", checksum(bytes)}};
  std::ofstream out(unfinished, std::ios::binary);
  out << first.dump() << '\n' << bytes;
  out.close();
  if (!out || std::rename(unfinished.c_str(), file.c_str()) != 0) {
    std::remove(unfinished.c_str());
    reject(file);
  }
}

/// Throws std::invalid_argument with the first difference of two runs.
static void require_same(const Json& written, const Json& now) {
  for (const auto& [name, value] : now.items()) {
    const Json before = written.value(name, Json());
    if (before == value) continue;
    const bool is_number = name.find(' ') != std::string::npos;
    throw std::invalid_argument(is_number ? "it belongs to a run with another " + name
                                          : "it belongs to a run with " + name + " " + before.dump() +
                                                ", but " + name + " is " + value.dump());
  }
}

static RunStart read(const std::string& file, const Json& run) {
  std::ifstream in(file, std::ios::binary);
  std::string line;
  if (!std::getline(in, line)) throw std::invalid_argument("the file cannot be read");
  const Json first = Json::parse(line, nullptr, false);
  if (!first.is_object() || first.value("format", Json()) != "spook checkpoint")
    throw std::invalid_argument("the file is no checkpoint");
  if (first.value("version", Json()) != 1)
    throw std::invalid_argument("the checkpoint is of another version of spook");
  require_same(first.value("run", Json::object()), run);
  RunStart start{.substep = first.value("substep", std::int64_t{0}), .state = all_bytes(in)};
  if (first.value("bytes", Json()) != start.state.size() ||
      first.value("checksum", Json()) != checksum(start.state))
    throw std::invalid_argument("the checkpoint is damaged");
  return start;
}

RunStart read_checkpoint(const std::string& file, const Json& run) {
  try {
    return read(file, run);
  } catch (const std::exception& error) {
    throw std::invalid_argument("restart \"" + file + "\": " + error.what());
  }
}

}  // namespace spook
