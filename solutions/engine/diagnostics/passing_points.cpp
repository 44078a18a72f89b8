#include "engine/diagnostics/passing_points.hpp"

#include <algorithm>
#include <cmath>

#include "engine/constraints/mechanisms.hpp"

namespace spook {

static constexpr double share_inside = 0.99;  // of a body's extent; a point farther out may just touch

static bool is_inside(const Vec3& point, const Eigen::AlignedBox3d& box) {
  const Vec3 from_centre = (point - box.center()).cwiseAbs();
  return (from_centre.array() < share_inside / 2 * box.sizes().array()).all();
}

static Eigen::AlignedBox3d box_around(const std::vector<Vec3>& points) {
  Eigen::AlignedBox3d box;
  for (const Vec3& point : points) box.extend(point);
  return box;
}

/// Tells whether a point, in the shape's axes, is inside the shape.
static bool is_inside(const Vec3& point, const Shape& shape) {
  return match(
      shape, [](const NoShape&) { return false; },
      [&](const PointSet& set) { return is_inside(point, box_around(set.points)); },
      [&](const auto& solid) { return solid.signed_distance(point) < -(1 - share_inside) * solid.size(); });
}

/// Tells whether the centre of body i, or one of its points, is inside body j.
template <int Dof>
static bool reaches_into(const Bodies<Dof>& bodies, const std::vector<Shape>& shapes, std::size_t i,
                         std::size_t j) {
  const auto point_is_inside = [&](const Vec3& point) {
    Vec3 from_j = bodies.x[i] - bodies.x[j];
    if constexpr (Dof == 6) {
      const auto& q = bodies.orientations.q;
      from_j = q[j].conjugate() * (from_j + q[i] * point);
    } else {
      from_j += point;
    }
    return is_inside(from_j, shapes[j]);
  };
  if (const auto* set = std::get_if<PointSet>(&shapes[i]))
    return point_is_inside(box_around(set->points).center()) ||
           std::any_of(set->points.begin(), set->points.end(), point_is_inside);
  return point_is_inside(Vec3::Zero());
}

template <int Dof>
std::optional<std::pair<int, int>> find_passing_points(const World<Dof>& world,
                                                       const std::vector<Shape>& shapes) {
  const Shapes& all = world.shapes();
  if (all.corners.empty() || all.corners.size() + all.solids.size() < 2) return {};
  const Bodies<Dof>& bodies = world.bodies();
  std::vector<int> numbers;
  std::vector<Bounds> bounds;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Vec3 far = Vec3::Constant(reach_of(shapes[i]));
    if (far.isZero(0)) continue;
    numbers.push_back(static_cast<int>(i));
    bounds.push_back({bodies.x[i] - far, bodies.x[i] + far});
  }
  const auto is_points = [&](std::size_t i) { return std::holds_alternative<PointSet>(shapes[i]); };
  Mechanisms<Dof> mechanisms(world.joints(), bodies);
  for (const Pair& pair : sweep_and_prune(bounds)) {
    const int i = numbers[pair.first], j = numbers[pair.second];
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    if ((!is_points(a) && !is_points(b)) || mechanisms.connect(i, j) || all.exclusions.excludes(i, j)) continue;
    if (!reaches_into(bodies, shapes, a, b) && !reaches_into(bodies, shapes, b, a)) continue;
    return is_points(a) ? std::pair{i, j} : std::pair{j, i};
  }
  return {};
}

template std::optional<std::pair<int, int>> find_passing_points<3>(const World<3>&, const std::vector<Shape>&);
template std::optional<std::pair<int, int>> find_passing_points<6>(const World<6>&, const std::vector<Shape>&);

}  // namespace spook
