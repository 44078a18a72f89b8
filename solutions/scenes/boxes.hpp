#pragma once
// What the scenes made of boxes share: worlds on a floor, and how far their boxes have strayed.
#include "scenes/scene.hpp"

namespace spook {

/// A floor with boxes on it, and with friction.
class BoxesOnFloor : public WorldScene<6> {
 protected:
  BoxesOnFloor(const Parameters& p, const Method& method);

  /// Adds a box that is not turned.
  int add_box(const Vec3& x, double mass, const Vec3& half_sides);

  /// The farthest that a box has gone sideways from where it was put [m].
  double farthest_sideways() const;

  /// What the floor carried in the last step [N].
  double floor_load() const;

  int floor_;
  std::vector<Vec3> put_;  // where each body was put, the floor included

 private:
  static Settings<6> settings(const Parameters& p);
};

}  // namespace spook
