#pragma once
// Common code of scenes made of boxes: a world with a floor, and the sideways motion of its boxes.
#include "scenes/scene.hpp"

namespace spook {

/// A scene of boxes on a floor with friction.
class BoxesOnFloor : public WorldScene<6> {
 protected:
  BoxesOnFloor(const Parameters& p, const Method& method);

  /// Adds a box with its sides along the axes.
  int add_box(const Vec3& x, double mass, const Vec3& half_sides);

  /// The largest horizontal distance of a box from its initial position [m].
  double farthest_sideways() const;

  /// The load of the floor in the last step [N].
  double floor_load() const;

  int floor_;
  std::vector<Vec3> put_;  // initial position of each body, the floor included

 private:
  static Settings<6> settings(const Parameters& p);
};

}  // namespace spook
