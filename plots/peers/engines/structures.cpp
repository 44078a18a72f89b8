#include "peers/engines/structures.hpp"

namespace spook::peers {

namespace {

void add_box(World<6>& world, const Vec3& x, const Vec3& half_sides) {
  world.add({.x = x, .mass = 800 * half_sides.prod(), .half_sides = half_sides});
}

void add_pyramid(World<6>& world, int base, const Vec3& middle) {
  for (int course = 0; course < base; ++course)
    for (int k = 0; k < base - course; ++k)
      add_box(world, middle + Vec3(k - (base - course - 1) / 2.0, 0, course + 0.5), Vec3::Constant(0.5));
}

void add_wall(World<6>& world, int size) {
  for (int course = 0; course < size; ++course) {
    // By less than half a brick: the centre of the uppermost brick at the end is over the brick below.
    const double shift = course % 2 == 1 ? 0 : -0.98, pitch = 2.002;
    for (int k = 0; k < size; ++k) add_box(world, Vec3(pitch * k + shift, 0, course + 0.5), Vec3(1, 0.5, 0.5));
  }
}

void add_grid(World<6>& world, int size) {
  std::vector<int> bodies;
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column) {
      const Vec3 x(column, 0, -row);
      bodies.push_back(row == 0 ? world.add_fixed(x)
                                : world.add({.x = x, .mass = 1, .principal = solid_sphere_moments(1, 0.4)}));
    }
  const Vec3 right(0.5, 0, 0), down(0, 0, -0.5);
  const auto join = [&](int from, int to, const Vec3& p) {
    world.add_joint({.i = bodies[static_cast<std::size_t>(from)],
                     .j = bodies[static_cast<std::size_t>(to)],
                     .p_i = p,
                     .p_j = -p});
  };
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column) {
      const int body = row * size + column;
      if (row > 0 && column + 1 < size) join(body, body + 1, right);
      if (row + 1 < size) join(body, body + size, down);
    }
}

}  // namespace

World<6> structure(Structure which, int size, Settings<6> settings) {
  World<6> world(std::move(settings));
  if (which == Structure::grid) {
    add_grid(world, size);
    return world;
  }
  world.add_plane(Vec3::UnitZ(), 0);
  if (which == Structure::pyramid) add_pyramid(world, size, Vec3::Zero());
  if (which == Structure::wall) add_wall(world, size);
  if (which == Structure::field)
    for (int row = 0; row < size; ++row)
      for (int column = 0; column < size; ++column) add_pyramid(world, 5, Vec3(6 * column, 2 * row, 0));
  return world;
}

}  // namespace spook::peers
