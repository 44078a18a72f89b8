#include "scenes/boxes.hpp"

#include "scenes/load.hpp"

namespace spook {

Settings<6> BoxesOnFloor::settings(const Parameters& p) {
  return {.gravity = Vec3(0, 0, -p.number("g")),
          .k = p.number("k"),
          .d = p.number("d"),
          .friction = p.number("mu"),
          .viscosity = p.number("viscosity")};
}

BoxesOnFloor::BoxesOnFloor(const Parameters& p, const Method& method) : WorldScene(settings(p), method) {
  floor_ = world_.add_plane(Vec3::UnitZ(), 0);
  put_.push_back(world_.x(floor_));
}

int BoxesOnFloor::add_box(const Vec3& x, double mass, const Vec3& half_sides) {
  put_.push_back(x);
  return world_.add(
      {.x = x, .mass = mass, .principal = solid_box_moments(mass, half_sides), .half_sides = half_sides});
}

double BoxesOnFloor::farthest_sideways() const {
  double farthest = 0;
  for (std::size_t body = 0; body < put_.size(); ++body)
    farthest = larger(farthest, (world_.bodies().x[body] - put_[body]).head<2>().norm());
  return farthest;
}

double BoxesOnFloor::floor_load() const {
  return load_on(floor_, world_, h_);
}

}  // namespace spook
