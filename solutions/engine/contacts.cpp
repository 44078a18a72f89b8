#include "engine/contacts.hpp"

namespace spook {

void Shapes::remove(int body) {
  const auto from = [&](auto& all) {
    std::erase_if(all, [&](const auto& shape) { return shape.body == body; });
    for (auto& shape : all) shape.body -= shape.body > body;
  };
  from(planes);
  from(solids);
  from(corners);
}

namespace {

/// The shapes, as they are now.
template <int Dof>
struct Now {
  const Bodies<Dof>& bodies;
  double grown;  ///< half the margin

  const Vec3& x(int body) const { return bodies.x[static_cast<std::size_t>(body)]; }
  Ball ball(const Solid& solid) const {
    return {.body = solid.body, .x = x(solid.body), .radius = solid.radius + grown};
  }
  Box box(const Solid& solid) const {
    if constexpr (Dof == 3) {
      return {.body = solid.body,
              .x = x(solid.body),
              .axes = Mat3::Identity(),
              .half_sides = solid.half_sides + Vec3::Constant(grown)};
    } else {
      return {.body = solid.body,
              .x = x(solid.body),
              .axes = bodies.orientations.q[static_cast<std::size_t>(solid.body)].toRotationMatrix(),
              .half_sides = solid.half_sides + Vec3::Constant(grown)};
    }
  }
  Bounds bounds_of(const Solid& solid) const {
    if (solid.radius == 0) return bounds(box(solid));
    const Vec3 half = Vec3::Constant(solid.radius + grown);
    return {.lower = x(solid.body) - half, .upper = x(solid.body) + half};
  }
};

void add(const std::optional<Contact>& contact, std::vector<Contact>& contacts) {
  if (contact) contacts.push_back(*contact);
}

template <int Dof>
void touch(const Plane& plane, const Solid& solid, const Now<Dof>& now, std::vector<Contact>& contacts) {
  if (solid.radius > 0) return add(plane_ball(plane, now.ball(solid)), contacts);
  plane_box(plane, now.box(solid), contacts);
}

template <int Dof>
void touch(const Solid& a, const Solid& b, const Now<Dof>& now, std::vector<Contact>& contacts) {
  if (a.radius > 0 && b.radius > 0) return add(ball_ball(now.ball(a), now.ball(b)), contacts);
  if (a.radius > 0) return add(box_ball(now.box(b), now.ball(a)), contacts);
  if (b.radius > 0) return add(box_ball(now.box(a), now.ball(b)), contacts);
  box_box(now.box(a), now.box(b), contacts);
}

void touch(const Plane& plane, const Corners& corners, const Bodies<6>& bodies, double margin,
           std::vector<Contact>& contacts) {
  const Vec3& x = bodies.x[static_cast<std::size_t>(corners.body)];
  const Quat& q = bodies.orientations.q[static_cast<std::size_t>(corners.body)];
  const double height = plane.n.dot(x) - plane.offset;
  const Vec3 n_in_body = q.conjugate() * plane.n;
  for (const Vec3& point : corners.points) {
    const double gap = height + n_in_body.dot(point);
    if (!(gap <= margin)) continue;
    const Vec3 r = q * point;
    contacts.push_back(
        {.i = plane.body, .j = corners.body, .n = plane.n, .gap = gap, .r_i = x + r - plane.x, .r_j = r});
  }
}

/// The pairs of solids that are worth a closer look.
template <int Dof>
std::vector<Pair> broad_phase(const std::vector<Solid>& solids, const Now<Dof>& now) {
  const auto n = static_cast<int>(solids.size());
  std::vector<Pair> pairs;
  if (n <= 32) {
    for (int a = 0; a < n; ++a)
      for (int b = a + 1; b < n; ++b) pairs.emplace_back(a, b);
    return pairs;
  }
  std::vector<Bounds> all;
  all.reserve(solids.size());
  for (const Solid& solid : solids) all.push_back(now.bounds_of(solid));
  return n <= 2000 ? sweep_and_prune(all) : spatial_hash(all);
}

}  // namespace

template <int Dof>
int find_contacts(const Shapes& shapes, const Bodies<Dof>& bodies, double margin,
                  std::vector<Contact>& contacts) {
  const Now<Dof> now{bodies, margin / 2};
  contacts.clear();
  int pairs = 0;
  for (Plane plane : shapes.planes) {
    plane.offset += now.grown;
    for (const Solid& solid : shapes.solids) {
      ++pairs;
      if (!solid.fixed) touch(plane, solid, now, contacts);
    }
  }
  // The point of a contact with a plane is the body's own: without what it has grown by.
  for (Contact& contact : contacts) {
    contact.r_i += now.grown * contact.n;
    contact.r_j += now.grown * contact.n;
  }
  if (shapes.solids.size() > 1)
    for (const auto& [a, b] : broad_phase(shapes.solids, now)) {
      const Solid& one = shapes.solids[static_cast<std::size_t>(a)];
      const Solid& other = shapes.solids[static_cast<std::size_t>(b)];
      ++pairs;
      if (!(one.fixed && other.fixed)) touch(one, other, now, contacts);
    }
  for (Contact& contact : contacts) contact.gap += margin;
  if constexpr (Dof == 6)
    for (const Plane& plane : shapes.planes)
      for (const Corners& corners : shapes.corners) {
        ++pairs;
        touch(plane, corners, bodies, margin, contacts);
      }
  return pairs;
}

template int find_contacts<3>(const Shapes&, const Bodies<3>&, double, std::vector<Contact>&);
template int find_contacts<6>(const Shapes&, const Bodies<6>&, double, std::vector<Contact>&);

}  // namespace spook
