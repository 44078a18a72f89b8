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

int find_contacts(const Shapes& shapes, const std::vector<Vec3>& x, std::vector<Contact>& contacts) {
  contacts.clear();
  int pairs = 0;
  for (const Plane& plane : shapes.planes)
    for (const Sphere& sphere : shapes.spheres) {
      ++pairs;
      if (!sphere.fixed) touch(plane, sphere, x, contacts);
    }
  for (auto a = shapes.spheres.begin(); a != shapes.spheres.end(); ++a)
    for (auto b = a + 1; b != shapes.spheres.end(); ++b) {
      ++pairs;
      touch(*a, *b, x, contacts);
    }
  return pairs;
}

}  // namespace spook
