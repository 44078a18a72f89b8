#include "engine/diagnostics/tunnelling.hpp"

#include <algorithm>
#include <cmath>

namespace spook {

/// Returns the half sides of a box around a solid, along its axes; 0 for other bodies.
static Vec3 half_sides_of(const Shape& shape) {
  return match(
      shape, [](const Sphere& sphere) -> Vec3 { return Vec3::Constant(sphere.radius); },
      [](const Capsule& capsule) -> Vec3 {
        return Vec3(capsule.radius, capsule.radius, capsule.radius + capsule.half_length);
      },
      [](const Cuboid& box) { return box.half_sides; }, [](const NoShape&) -> Vec3 { return Vec3::Zero(); },
      [](const PointSet&) -> Vec3 { return Vec3::Zero(); });
}

/// Tells whether the way from `start` to `end` enters the shape from outside, all in the shape's axes. A capsule counts
/// as its box.
static bool enters(const Shape& shape, const Vec3& start, const Vec3& end) {
  const Vec3 half = half_sides_of(shape), way = end - start;
  if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    const double nearest = std::clamp(-start.dot(way) / way.squaredNorm(), 0.0, 1.0);
    return start.norm() > sphere->radius && (start + nearest * way).norm() < sphere->radius;
  }
  if ((start.cwiseAbs().array() <= half.array()).all()) return false;
  double in = 0, out = 1;  // the part of the way inside all slabs
  for (int axis = 0; axis < 3; ++axis) {
    if (way[axis] == 0) {
      if (std::abs(start[axis]) > half[axis]) return false;
      continue;
    }
    const double one = (-half[axis] - start[axis]) / way[axis], other = (half[axis] - start[axis]) / way[axis];
    in = std::max(in, std::min(one, other));
    out = std::min(out, std::max(one, other));
  }
  return in < out;
}

template <int Dof>
static Vec3 in_axes_of(const Bodies<Dof>& bodies, std::size_t body, const Vec3& x) {
  if constexpr (Dof == 6)
    return bodies.orientations.q[body].conjugate() * x;
  else
    return x;
}

template <int Dof>
std::optional<Tunnelling> find_tunnelling(const World<Dof>& world, const std::vector<Vec3>& before,
                                          const std::vector<Shape>& shapes, const std::vector<double>& sizes) {
  const Bodies<Dof>& bodies = world.bodies();
  // Soft steps look for contacts once in a step, others in each part.
  const double searches = world.settings().soft_steps ? 1 : world.parts();
  const auto is_fast = [&](std::size_t i) { return (bodies.x[i] - before[i]).norm() > searches * sizes[i]; };
  std::vector<int> solids;
  bool any = false;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (half_sides_of(shapes[i]).isZero(0)) continue;
    solids.push_back(static_cast<int>(i));
    any = any || is_fast(i);
  }
  if (!any) return {};
  std::vector<Bounds> ways;
  for (const int i : solids) {
    const Vec3 far = Vec3::Constant(half_sides_of(shapes[i]).norm());
    ways.push_back({bodies.x[i].cwiseMin(before[i]) - far, bodies.x[i].cwiseMax(before[i]) + far});
  }
  for (const Pair& pair : sweep_and_prune(ways)) {
    const int i = solids[pair.first], j = solids[pair.second];
    const Vec3 start = before[i] - before[j], end = bodies.x[i] - bodies.x[j];
    const double way = (end - start).norm() / searches, detected_within = sizes[i] + sizes[j];
    if (way <= detected_within || world.shapes().exclusions.excludes(i, j)) continue;
    const auto meets = [&](int other, const Vec3& from, const Vec3& to) {
      const auto at = static_cast<std::size_t>(other);
      return enters(shapes[at], in_axes_of(bodies, at, from), in_axes_of(bodies, at, to));
    };
    if (!meets(j, start, end) && !meets(i, -start, -end)) continue;
    const bool i_moves = !bodies.is_fixed(static_cast<std::size_t>(i));
    return Tunnelling{.body = i_moves ? i : j,
                      .other = i_moves ? j : i,
                      .way = way,
                      .detected_within = detected_within,
                      .longest_step = detected_within / way};
  }
  return {};
}

template std::optional<Tunnelling> find_tunnelling<3>(const World<3>&, const std::vector<Vec3>&,
                                                      const std::vector<Shape>&, const std::vector<double>&);
template std::optional<Tunnelling> find_tunnelling<6>(const World<6>&, const std::vector<Vec3>&,
                                                      const std::vector<Shape>&, const std::vector<double>&);

}  // namespace spook
