#pragma once
// Handles of bodies and joints: numbers, from 0 on, that stay valid when other bodies or joints are removed. Indices do
// not: those of later ones decrease.
//
// A program may keep data on each body in a vector of its own, indexed by handles. A world without handles pays nothing
// for them.
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/support/require_index.hpp"
#include "engine/world/world.hpp"

namespace spook {

/// Handles of one kind of things, which are numbered from 0 on without gaps.
class HandleList {
 public:
  /// Returns the handle of an index. Things that were added since the last call get new handles.
  int handle(int index, std::size_t count) {
    for (std::size_t k = handles_.size(); k < count; ++k) {
      handles_.push_back(static_cast<int>(indices_.size()));
      indices_.push_back(static_cast<int>(k));
    }
    return handles_[static_cast<std::size_t>(index)];
  }

  /// Returns the index of a handle. Throws std::invalid_argument for a handle of something that was removed, or of
  /// none.
  int index(const char* name, int handle) const {
    const bool known = handle >= 0 && static_cast<std::size_t>(handle) < indices_.size();
    if (!known || indices_[static_cast<std::size_t>(handle)] < 0)
      throw std::invalid_argument(
          std::string(name) + " must be the handle of a " + name + " of this world, but is " +
          std::to_string(handle) +
          (known ? ", which was removed" : ", which of_" + std::string(name) + " never returned"));
    return indices_[static_cast<std::size_t>(handle)];
  }

  /// Removes the handle at an index; later indices decrease by one.
  void remove(int index) {
    if (static_cast<std::size_t>(index) >= handles_.size()) return;  // it has no handle
    indices_[static_cast<std::size_t>(handles_[static_cast<std::size_t>(index)])] = removed;
    handles_.erase(handles_.begin() + index);
    for (std::size_t k = static_cast<std::size_t>(index); k < handles_.size(); ++k)
      --indices_[static_cast<std::size_t>(handles_[k])];
  }

 private:
  static constexpr int removed = -1;
  std::vector<int> handles_;  // by index
  std::vector<int> indices_;  // by handle
};

/// The handles of a world's bodies and joints. Remove bodies and joints by it, not by the world. A copy of the world
/// needs a copy of the handles: if you assign the one to go back to an earlier step, assign the other, too.
template <int Dof>
class Handles {
 public:
  /// `world` must live as long as this.
  explicit Handles(World<Dof>& world) : world_(&world) {}

  /// Returns the handle of the body, or joint, at an index. Throws std::invalid_argument for an index of none.
  int of_body(int index) {
    world_->index(index);
    return bodies_.handle(index, world_->bodies().size());
  }
  int of_joint(int index) {
    const std::size_t count = world_->joints().size();
    require_index("joint", index, count);
    return joints_.handle(index, count);
  }

  /// Returns the index of a handle. Throws std::invalid_argument for what was removed.
  int body(int handle) const { return bodies_.index("body", handle); }
  int joint(int handle) const { return joints_.index("joint", handle); }

  /// Removes a body with its joints, or a joint. Throws std::invalid_argument for what was removed before.
  void remove_body(int handle) {
    const int index = body(handle);
    std::vector<int> attached;
    for (int k = static_cast<int>(world_->joints().size()) - 1; k >= 0; --k) {
      const Joint& joint = world_->joints()[static_cast<std::size_t>(k)];
      if (joint.i == index || joint.j == index) attached.push_back(k);
    }
    world_->remove_body(index);
    for (const int k : attached) joints_.remove(k);
    bodies_.remove(index);
  }
  void remove_joint(int handle) {
    const int index = joint(handle);
    world_->remove_joint(index);
    joints_.remove(index);
  }

 private:
  World<Dof>* world_;
  HandleList bodies_, joints_;
};

}  // namespace spook
