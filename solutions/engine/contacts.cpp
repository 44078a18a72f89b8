#include "engine/contacts.hpp"

namespace spook {

static const Vec3& centre(const std::vector<Vec3>& x, int body) {
  return x[static_cast<std::size_t>(body)];
}

static void touch(const Plane& plane, const Sphere& sphere, const std::vector<Vec3>& x,
                  std::vector<Contact>& contacts) {
  const Vec3& c = centre(x, sphere.body);
  const double height = plane.n.dot(c) - plane.offset;
  const double gap = height - sphere.radius;
  if (!(gap <= 0)) return;
  contacts.push_back({.i = plane.body,
                      .j = sphere.body,
                      .n = plane.n,
                      .gap = gap,
                      .r_i = c - height * plane.n - centre(x, plane.body),
                      .r_j = -sphere.radius * plane.n});
}

static void touch(const Sphere& a, const Sphere& b, const std::vector<Vec3>& x,
                  std::vector<Contact>& contacts) {
  const Vec3 apart = centre(x, b.body) - centre(x, a.body);
  const double reach = a.radius + b.radius;
  if (!(apart.squaredNorm() <= reach * reach) || (a.fixed && b.fixed)) return;
  const double distance = apart.norm();
  // Two centres at one place have no direction between them; any will part them.
  const Vec3 n = distance > 0 ? Vec3(apart / distance) : Vec3::UnitZ();
  contacts.push_back(
      {.i = a.body, .j = b.body, .n = n, .gap = distance - reach, .r_i = a.radius * n, .r_j = -b.radius * n});
}

static void touch(const Plane& plane, const Corners& corners, const Bodies<6>& bodies,
                  std::vector<Contact>& contacts) {
  const Vec3& c = centre(bodies.x, corners.body);
  const Quat& q = bodies.orientations.q[static_cast<std::size_t>(corners.body)];
  const double height = plane.n.dot(c) - plane.offset;
  const Vec3 n_in_body = q.conjugate() * plane.n;
  for (const Vec3& point : corners.points) {
    const double gap = height + n_in_body.dot(point);
    if (!(gap <= 0)) continue;
    const Vec3 r = q * point;
    contacts.push_back({.i = plane.body,
                        .j = corners.body,
                        .n = plane.n,
                        .gap = gap,
                        .r_i = c + r - gap * plane.n - centre(bodies.x, plane.body),
                        .r_j = r});
  }
}

template <int Dof>
int find_contacts(const Shapes& shapes, const Bodies<Dof>& bodies, std::vector<Contact>& contacts) {
  const std::vector<Vec3>& x = bodies.x;
  contacts.clear();
  int pairs = 0;
  for (const Plane& plane : shapes.planes)
    for (const Sphere& sphere : shapes.spheres) {
      ++pairs;
      if (!sphere.fixed) touch(plane, sphere, x, contacts);
    }
  if constexpr (Dof == 6)
    for (const Plane& plane : shapes.planes)
      for (const Corners& corners : shapes.corners) {
        ++pairs;
        touch(plane, corners, bodies, contacts);
      }
  for (auto a = shapes.spheres.begin(); a != shapes.spheres.end(); ++a)
    for (auto b = a + 1; b != shapes.spheres.end(); ++b) {
      ++pairs;
      touch(*a, *b, x, contacts);
    }
  return pairs;
}

template int find_contacts<3>(const Shapes&, const Bodies<3>&, std::vector<Contact>&);
template int find_contacts<6>(const Shapes&, const Bodies<6>&, std::vector<Contact>&);

}  // namespace spook
