#pragma once
// Builds the world that a scene file describes.
#include <map>

#include "engine/world/world.hpp"
#include "spook/place.hpp"

namespace spook {

/// Returns the choice that the text at `place` names. Rejects the text, with all choices, if it names none.
template <class Value>
Value one_of(const Place& place, const std::map<std::string, Value>& choices) {
  const auto found = choices.find(place.text());
  if (found != choices.end()) return found->second;
  std::string names;
  for (const auto& [name, value] : choices) names += (names.empty() ? "" : " or ") + name;
  place.reject(names);
}

/// Finds bodies by index or by name. Throws std::invalid_argument for a name that two bodies have.
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

/// Adds the bodies, joints, materials and excluded contacts of a file to a world.
template <int Dof>
void add_all(const Place& file, const BodyNames& names, World<Dof>& world);

/// Returns the bodies, joints, materials and excluded contacts of a world, as add_all reads them.
template <int Dof>
Json content_of(const World<Dof>& world);

}  // namespace spook
