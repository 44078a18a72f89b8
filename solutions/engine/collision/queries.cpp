#include "engine/collision/queries.hpp"

#include <algorithm>
#include <cmath>

#include "common/require.hpp"

namespace spook {

namespace {

std::optional<LineEntry> entry(const Plane& plane, const Vec3& o, const Vec3& u) {
  const double slope = plane.n.dot(u);
  if (!(slope < 0)) return {};
  return LineEntry{(plane.offset - plane.n.dot(o)) / slope, plane.n};
}

}  // namespace

template <int Dof>
std::optional<RayHit> cast_ray(const Shapes& shapes, const Bodies<Dof>& bodies, const Vec3& origin,
                               const Vec3& direction, double longest) {
  require_all_finite("origin", origin);
  require_all_finite("direction", direction);
  if (direction == Vec3::Zero()) reject("direction", 0, "a vector that is not zero");
  if (!(longest >= 0)) reject("longest", longest, "zero or positive");
  const Vec3 u = direction.stableNormalized();
  std::optional<RayHit> first;
  const auto look_at = [&](int body, const std::optional<LineEntry>& in, const Quat& q) {
    if (!in || !(in->t >= 0 && in->t <= longest && std::isfinite(in->t))) return;
    if (first && (in->t > first->distance || (in->t == first->distance && body > first->body))) return;
    // -0 + 0 is 0.
    first =
        RayHit{.body = body, .point = origin + in->t * u, .normal = q * in->normal, .distance = in->t + 0.0};
  };
  for (const Plane& plane : shapes.planes) look_at(plane.body, entry(plane, origin, u), Quat::Identity());
  for (const Solid& solid : shapes.solids) {
    const auto i = static_cast<std::size_t>(solid.body);
    const Quat q = bodies.orientations.of(i), back = q.conjugate();
    const Vec3 o = back * (origin - bodies.x[i]), along = back * u;
    look_at(solid.body, match(solid.shape, [&](const auto& shape) { return shape.entry(o, along); }), q);
  }
  return first;
}

template <int Dof>
std::vector<int> overlapping(const Shapes& shapes, const Bodies<Dof>& bodies, const Vec3& centre,
                             double radius) {
  require_all_finite("centre", centre);
  require_not_negative("radius", radius);
  std::vector<int> found;
  for (const Plane& plane : shapes.planes)
    if (plane.n.dot(centre) - plane.offset <= radius) found.push_back(plane.body);
  for (const Solid& solid : shapes.solids) {
    const auto i = static_cast<std::size_t>(solid.body);
    const Vec3 x = bodies.orientations.of(i).conjugate() * (centre - bodies.x[i]);
    const double apart = match(solid.shape, [&](const auto& shape) { return shape.signed_distance(x); });
    if (apart <= radius) found.push_back(solid.body);
  }
  std::sort(found.begin(), found.end());
  return found;
}

template std::optional<RayHit> cast_ray<3>(const Shapes&, const Bodies<3>&, const Vec3&, const Vec3&, double);
template std::optional<RayHit> cast_ray<6>(const Shapes&, const Bodies<6>&, const Vec3&, const Vec3&, double);
template std::vector<int> overlapping<3>(const Shapes&, const Bodies<3>&, const Vec3&, double);
template std::vector<int> overlapping<6>(const Shapes&, const Bodies<6>&, const Vec3&, double);

}  // namespace spook
