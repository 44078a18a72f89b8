#pragma once
// Arguments of a command that belong to no option.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/support/did_you_mean.hpp"

namespace spook {

/// Throws std::invalid_argument, with the nearest option, for an argument that the command does not have.
inline void require_nothing_left(const CLI::App& command) {
  const std::vector<std::string> left = command.remaining();
  if (left.empty()) return;
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    if (!option->get_lnames().empty()) names.push_back("--" + option->get_lnames().front());
  const auto is_option = [](const std::string& text) { return text.rfind('-', 0) == 0; };
  const auto option = std::find_if(left.begin(), left.end(), is_option);
  if (option == left.end())
    throw std::invalid_argument("\"" + left.front() + "\" is an extra argument; leave it out");
  const std::string name = option->substr(0, option->find('='));
  throw std::invalid_argument("unknown option " + name + did_you_mean(name, names));
}

}  // namespace spook
