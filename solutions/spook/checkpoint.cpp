#include "spook/checkpoint.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "engine/support/state_stream.hpp"
#include "spook/scene_file.hpp"

namespace spook {

static std::string unfinished_name(const std::string& file) {
  return file + ".unfinished";
}

[[noreturn]] static void refuse_to_write(const std::string& file) {
  throw std::invalid_argument("checkpoint \"" + file + "\" cannot be written");
}

static std::string all_bytes(std::istream& in) {
  return {std::istreambuf_iterator<char>(in), {}};
}

Json identity_of_run(const std::string& scene, const SceneDescription& description,
                     const Parameters& parameters, const Method& method) {
  Json options = {{"scene", description.name}};
  options.update(json_of(method, description.solves));
  options.erase("threads");
  options["seed of the row order"] = method.seed;
  if (is_scene_file(scene)) {
    std::ifstream file(scene);
    options["text of the scene's file"] = hash_of(all_bytes(file));
  }
  // Apart, since a parameter may have the name of an option.
  return {{"options", options}, {"parameters", json_of(parameters)}};
}

/// Returns the file that a name means, behind links.
static std::string target_of(const std::string& name) {
  std::error_code failed;
  const std::filesystem::path target = std::filesystem::canonical(name, failed);
  return failed ? name : target.string();
}

void require_writable_checkpoint(const std::string& name) {
  const std::string file = target_of(name), unfinished = unfinished_name(file);
  if (std::filesystem::exists(file) && !std::filesystem::is_regular_file(file))
    throw std::invalid_argument("checkpoint must be a file, but \"" + name + "\" is none");
  if (!std::ofstream(unfinished)) refuse_to_write(name);
  std::remove(unfinished.c_str());
}

void write_checkpoint(const std::string& name, const Json& run, std::int64_t substep, Scene& scene) {
  const std::string file = target_of(name), bytes = bytes_of_state(scene), unfinished = unfinished_name(file);
  const Json first = {{"format", "spook checkpoint"}, {"version", 1}, {"run", run}, {"substep", substep}};
  std::ofstream out(unfinished, std::ios::binary);
  out << first.dump() << '\n' << bytes;
  out.close();
  if (!out || std::rename(unfinished.c_str(), file.c_str()) != 0) {
    std::remove(unfinished.c_str());
    refuse_to_write(name);
  }
}

/// Throws std::invalid_argument with the first difference of two runs.
static void require_same(const Json& written, const Json& now) {
  for (const char* group : {"options", "parameters"})
    for (const auto& [name, value] : now[group].items()) {
      const Json before = written.value(group, Json::object()).value(name, Json());
      if (before == value) continue;
      const bool tells_by_name =
          name.find(' ') != std::string::npos;  // its value is a number that says nothing
      throw std::invalid_argument(tells_by_name ? "it belongs to a run with another " + name
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
  intact_state(start.state);
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
