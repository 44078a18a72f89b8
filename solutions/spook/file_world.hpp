#pragma once
// The world that a file describes.
#include <map>

#include "engine/world/world.hpp"
#include "spook/place.hpp"

namespace spook {

/// What `place` says, by the names of what it may say.
template <class Value>
Value one_of(const Place& place, const std::map<std::string, Value>& choices) {
  const auto found = choices.find(place.text());
  if (found != choices.end()) return found->second;
  std::string names;
  for (const auto& [name, value] : choices) names += (names.empty() ? "" : " or ") + name;
  place.reject(names);
}

/// Bodies by number or by name. Throws std::invalid_argument for a name that two have.
class BodyNames {
 public:
  explicit BodyNames(const Place& bodies);
  int index(const Place& place) const;

 private:
  std::map<std::string, int> indices_;
  int count_ = 0;
};

template <int Dof>
Settings<Dof> settings_in(const Place& file);

/// Adds the file's bodies and joints.
template <int Dof>
void add_all(const Place& file, const BodyNames& names, World<Dof>& world);

}  // namespace spook
