#include "engine/collision/queries.hpp"

#include <algorithm>
#include <cmath>

#include "common/require.hpp"

namespace spook {

namespace {

/// Entry of a line o + t u, for t from -∞ to ∞, into the interior of a shape.
struct Entry {
  double t;  ///< [m]
  Vec3 normal;
};

std::optional<Entry> entry(const Plane& plane, const Vec3& o, const Vec3& u) {
  const double slope = plane.n.dot(u);
  if (!(slope < 0)) return {};
  return Entry{(plane.offset - plane.n.dot(o)) / slope, plane.n};
}

// Solids: `o` and `u` are in the axes of the body.

std::optional<Entry> entry(const Sphere& sphere, const Vec3& o, const Vec3& u) {
  const double b = o.dot(u), R = sphere.radius;
  const Vec3 across = o - b * u;
  const double c = across.norm();
  if (!(c < R)) return {};
  const double half_chord = std::sqrt((R - c) * (R + c));
  return Entry{-b - half_chord, (across - half_chord * u).normalized()};
}

std::optional<Entry> entry(const Capsule& capsule, const Vec3& o, const Vec3& u) {
  const double sine = u.head<2>().norm(), R = capsule.radius;  // 0: along the segment
  const Eigen::Vector2d along = sine > 0 ? (u.head<2>() / sine).eval() : Eigen::Vector2d(0, 0);
  const double b = o.head<2>().dot(along);
  const Eigen::Vector2d across = o.head<2>() - b * along;
  const double c = across.norm();
  if (!(c < R)) return {};
  const double half_chord = std::sqrt((R - c) * (R + c));
  const double t = sine > 0 ? (-b - half_chord) / sine : -infinity;
  const double z = o.z() + t * u.z(), end = std::clamp(z, -capsule.half_length, capsule.half_length);
  if (z != end) return entry(Sphere{R}, o - end * Vec3::UnitZ(), u);
  Vec3 normal = Vec3::Zero();
  normal.head<2>() = (across - half_chord * along).normalized();
  return Entry{t, normal};
}

std::optional<Entry> entry(const Cuboid& box, const Vec3& o, const Vec3& u) {
  Entry last{-infinity, Vec3::Zero()};
  double exit = infinity;
  for (int k = 0; k < 3; ++k) {
    const double h = box.half_sides[k];
    if (u[k] == 0) {
      if (!(std::abs(o[k]) < h)) return {};
      continue;
    }
    const double towards = std::copysign(1.0, u[k]), in = (-towards * h - o[k]) / u[k];
    if (in > last.t) last = {in, -towards * Vec3::Unit(k)};
    exit = std::min(exit, (towards * h - o[k]) / u[k]);
  }
  if (!(last.t < exit)) return {};
  return last;
}

// The distance of a point from a shape [m], in the axes of the body; 0 inside.

double distance(const Sphere& sphere, const Vec3& x) {
  return std::max(x.norm() - sphere.radius, 0.0);
}

double distance(const Capsule& capsule, const Vec3& x) {
  const double z = std::clamp(x.z(), -capsule.half_length, capsule.half_length);
  return distance(Sphere{capsule.radius}, x - z * Vec3::UnitZ());
}

double distance(const Cuboid& box, const Vec3& x) {
  return (x.cwiseAbs() - box.half_sides).cwiseMax(0.0).norm();
}

/// Returns the orientation of a body, to turn a vector into its axes and back.
template <int Dof>
Quat orientation(const Bodies<Dof>& bodies, std::size_t body) {
  if constexpr (Dof == 6)
    return bodies.orientations.q[body];
  else
    return Quat::Identity();
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
  const auto look_at = [&](int body, const std::optional<Entry>& in, const Quat& q) {
    if (!in || !(in->t >= 0 && in->t <= longest)) return;
    if (first && (in->t > first->distance || (in->t == first->distance && body > first->body))) return;
    // -0 + 0 is 0.
    first =
        RayHit{.body = body, .point = origin + in->t * u, .normal = q * in->normal, .distance = in->t + 0.0};
  };
  for (const Plane& plane : shapes.planes) look_at(plane.body, entry(plane, origin, u), Quat::Identity());
  for (const Solid& solid : shapes.solids) {
    const auto i = static_cast<std::size_t>(solid.body);
    const Quat q = orientation(bodies, i), back = q.conjugate();
    const Vec3 o = back * (origin - bodies.x[i]), along = back * u;
    look_at(solid.body, match(solid.shape, [&](const auto& shape) { return entry(shape, o, along); }), q);
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
    const Vec3 x = orientation(bodies, i).conjugate() * (centre - bodies.x[i]);
    const double apart = match(solid.shape, [&](const auto& shape) { return distance(shape, x); });
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
