#include "engine/diagnostics/tunnelling.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/constraints/mechanisms.hpp"

namespace spook {

static bool has_interior(const Shape& shape) {
  return match(shape, []<class Type>(const Type&) { return HasInterior<Type>; });
}

/// Tells whether the shape contains a point in its axes.
static bool contains(const Shape& shape, const Vec3& x) {
  return match(shape, [&]<class Type>(const Type& solid) {
    if constexpr (HasInterior<Type>) return solid.signed_distance(x) <= 0;
    return false;
  });
}

/// Tells whether the straight way from `start`, outside the shape, to `end` enters it, all in the shape's axes.
static bool enters(const Shape& shape, const Vec3& start, const Vec3& end) {
  const double length = (end - start).norm();
  if (length == 0) return false;
  return match(shape, [&]<class Type>(const Type& solid) {
    if constexpr (HasInterior<Type>) {
      const std::optional<LineEntry> in = solid.entry(start, (end - start) / length);
      return in && in->t >= 0 && in->t < length;
    }
    return false;
  });
}

/// Returns the turn of a body's surface in the last step, as a rotation vector in world coordinates [rad].
template <int Dof>
static Vec3 turn_of(const Bodies<Dof>& bodies, std::size_t body, const Shape& shape, double h) {
  if constexpr (Dof == 6) {
    const Quat& q = bodies.orientations.q[body];
    const Vec3 turn = q.conjugate() * (h * bodies.motion.W[body].template tail<3>());
    return match(shape, [&]<class Type>(const Type& solid) -> Vec3 {
      if constexpr (HasInterior<Type>) return q * solid.visible_turn(turn);
      return Vec3::Zero();
    });
  }
  return Vec3::Zero();
}

/// Returns points on the way from `start` to `end`, relative to a body, in the body's axes: two, or more if it turns by
/// more than a tenth of a radian. More than one turn is as one.
template <int Dof>
static std::vector<Vec3> way_beside(const Bodies<Dof>& bodies, std::size_t body, const Vec3& start,
                                    const Vec3& end, const Vec3& turn) {
  if constexpr (Dof == 3) {
    return {start, end};
  } else {
    const Quat to_axes = bodies.orientations.q[body].conjugate();
    const double angle = std::min(turn.norm(), 2 * std::numbers::pi);
    const Vec3 axis = angle > 0 ? turn.normalized() : Vec3::UnitX();
    const int parts = 1 + static_cast<int>(angle / 0.1);
    std::vector<Vec3> way;
    for (int k = 0; k <= parts; ++k) {
      const double done = static_cast<double>(k) / parts;
      const Quat turns_left(Eigen::AngleAxisd((1 - done) * angle, axis));
      way.push_back(to_axes * (turns_left * (start + done * (end - start))));
    }
    return way;
  }
}

/// Returns the length of a way that enters the shape from outside; 0 if it does not.
static double length_if_it_enters(const Shape& shape, const std::vector<Vec3>& way) {
  if (contains(shape, way.front())) return 0;
  double length = 0;
  bool in = false;
  for (std::size_t k = 1; k < way.size(); ++k) {
    length += (way[k] - way[k - 1]).norm();
    in = in || enters(shape, way[k - 1], way[k]);
  }
  return in ? length : 0;
}

template <int Dof>
std::optional<Tunnelling> find_tunnelling(const World<Dof>& world, const std::vector<Vec3>& before,
                                          const std::vector<Shape>& shapes, const std::vector<double>& sizes,
                                          double h) {
  const Bodies<Dof>& bodies = world.bodies();
  // Soft steps look for contacts once in a step, others in each part.
  const double searches = world.settings().soft_steps ? 1 : world.parts();
  std::vector<int> solids;
  std::vector<Vec3> turns;
  bool any = false;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    turns.push_back(turn_of(bodies, i, shapes[i], h));
    if (!has_interior(shapes[i])) continue;
    const double far = reach_of(shapes[i]);
    solids.push_back(static_cast<int>(i));
    any = any || (bodies.x[i] - before[i]).norm() + turns[i].norm() * far > searches * sizes[i];
  }
  if (!any) return {};
  std::vector<Bounds> ways;
  for (const int i : solids) {
    const Vec3 far = Vec3::Constant(reach_of(shapes[i]));
    ways.push_back({bodies.x[i].cwiseMin(before[i]) - far, bodies.x[i].cwiseMax(before[i]) + far});
  }
  std::vector<Joint> rigid;
  for (const Joint& joint : world.joints())
    if (!joint.needs_length()) rigid.push_back(joint);
  Mechanisms<Dof> mechanisms(rigid, bodies);
  for (const Pair& pair : sweep_and_prune(ways)) {
    const int i = solids[pair.first], j = solids[pair.second];
    const bool i_moves = !bodies.is_fixed(static_cast<std::size_t>(i)),
               j_moves = !bodies.is_fixed(static_cast<std::size_t>(j));
    if (!i_moves && !j_moves) continue;
    if (world.shapes().exclusions.excludes(i, j) || mechanisms.connect(i, j)) continue;
    const Vec3 start = before[i] - before[j], end = bodies.x[i] - bodies.x[j];
    const double reach = std::max(start.norm(), end.norm()), detected_within = sizes[i] + sizes[j];
    const double angle = std::max(turns[i].norm(), turns[j].norm());
    if ((end - start).norm() + angle * reach <= searches * detected_within) continue;
    const auto length = [&](int other, const Vec3& from, const Vec3& to) {
      const auto at = static_cast<std::size_t>(other);
      return length_if_it_enters(shapes[at], way_beside(bodies, at, from, to, turns[at]));
    };
    const double way = std::max(length(j, start, end), length(i, -start, -end)) / searches;
    if (way <= detected_within) continue;
    return Tunnelling{.body = i_moves ? i : j,
                      .other = i_moves ? j : i,
                      .way = way,
                      .detected_within = detected_within,
                      .longest_step = detected_within / way};
  }
  return {};
}

template std::optional<Tunnelling> find_tunnelling<3>(const World<3>&, const std::vector<Vec3>&,
                                                      const std::vector<Shape>&, const std::vector<double>&,
                                                      double);
template std::optional<Tunnelling> find_tunnelling<6>(const World<6>&, const std::vector<Vec3>&,
                                                      const std::vector<Shape>&, const std::vector<double>&,
                                                      double);

}  // namespace spook
