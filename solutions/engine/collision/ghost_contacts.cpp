#include "engine/collision/ghost_contacts.hpp"

#include <algorithm>
#include <cmath>

namespace spook {

namespace {

constexpr double parallel = 1 - 1e-6;  // cosine of .0014 rad
constexpr double carries = 0.9998;     // cosine of .02 rad: boxes tilt where they sag

/// Returns the bodies with contacts in several directions; only these can have ghosts.
std::vector<bool> touched_from_several_sides(const std::vector<Contact>& contacts, std::size_t bodies,
                                             bool& any) {
  std::vector<const Contact*> first(bodies, nullptr);
  std::vector<bool> several(bodies, false);
  any = false;
  for (const Contact& contact : contacts)
    for (const int body : {contact.i, contact.j}) {
      const auto b = static_cast<std::size_t>(body);
      if (!first[b]) first[b] = &contact;
      if (std::abs(contact.n.dot(first[b]->n)) < parallel) any = several[b] = true;
    }
  return several;
}

/// A body that supports another one, and the direction of its force on that body.
struct Support {
  int other;
  Vec3 m;
  double gap;
  double face;  ///< height of the touched face along m [m]; -infinity without a face
};

class Surfaces {
 public:
  Surfaces(const Shapes& shapes, const std::vector<PlacedSolid>& placed, std::size_t bodies)
      : shapes_(shapes), placed_(placed), solid_of_(bodies, -1) {
    for (std::size_t s = 0; s < placed.size(); ++s)
      solid_of_[static_cast<std::size_t>(shapes.solids[s].body)] = static_cast<int>(s);
  }

  /// Returns the box of a body, or null.
  const Box* box(int body) const {
    const int s = solid_of_[static_cast<std::size_t>(body)];
    return s < 0 ? nullptr : std::get_if<Box>(&placed_[static_cast<std::size_t>(s)]);
  }

  /// Returns false for static bodies and planes.
  bool moves(int body) const {
    const int s = solid_of_[static_cast<std::size_t>(body)];
    return s >= 0 && !shapes_.solids[static_cast<std::size_t>(s)].is_static;
  }

  /// Returns the smallest size of a solid [m].
  double size(int body) const {
    const auto s = static_cast<std::size_t>(solid_of_[static_cast<std::size_t>(body)]);
    return size_of(shapes_.solids[s].shape);
  }

  /// Returns the height of the face with normal m [m]; -infinity if there is none.
  double face_along(const Vec3& m, int body) const {
    if (const Box* found = box(body)) {
      const bool is_face = (found->axes.transpose() * m).cwiseAbs().maxCoeff() >= parallel;
      return is_face ? height(m, *found) : -infinity;
    }
    for (const Plane& plane : shapes_.planes)
      if (plane.body == body) return plane.n.dot(m) >= parallel ? plane.offset : -infinity;
    return -infinity;
  }

  static double height(const Vec3& m, const Box& box) {
    return m.dot(box.x) + (box.axes.transpose() * m).cwiseAbs().dot(box.half_sides);
  }

 private:
  const Shapes& shapes_;
  const std::vector<PlacedSolid>& placed_;
  std::vector<int> solid_of_;
};

/// Tells whether a body that rests on these supports cannot be stopped by `other`, which pushes it along n. `on_face`:
/// by several contacts.
bool is_ghost(int body, int other, const Vec3& n, bool on_face, const std::vector<Support>& supports,
              const Surfaces& surfaces) {
  if (!surfaces.box(other)) return false;
  const double along = on_face && surfaces.moves(other) ? carries : parallel;
  return std::any_of(supports.begin(), supports.end(), [&](const Support& support) {
    if (support.other == other || n.dot(support.m) >= along) return false;
    const double size = std::min(surfaces.size(body), surfaces.size(other)), most = size / 25;
    const double depth = std::max(0.0, -support.gap), face = surfaces.face_along(support.m, other);
    return depth <= surfaces.size(body) / 4 && face > -infinity &&
           face <= support.face + std::min(1e-3 * size + 2 * depth, most);
  });
}

}  // namespace

std::vector<bool> ghost_contacts(const Shapes& shapes, const std::vector<PlacedSolid>& placed,
                                 std::size_t bodies, const std::vector<Contact>& contacts) {
  bool any;
  const std::vector<bool> several = touched_from_several_sides(contacts, bodies, any);
  if (!any) return {};

  const Surfaces surfaces(shapes, placed, bodies);
  std::vector<std::vector<Support>> supports(bodies);
  const auto add = [&](int body, int other, const Vec3& m, double gap) {
    if (!several[static_cast<std::size_t>(body)] || !surfaces.moves(body)) return;
    std::vector<Support>& of_body = supports[static_cast<std::size_t>(body)];
    // Contacts of a pair follow each other; those of two boxes have one normal.
    if (!of_body.empty() && of_body.back().other == other && of_body.back().m.dot(m) >= parallel)
      of_body.back().gap = std::min(of_body.back().gap, gap);
    else
      of_body.push_back({.other = other, .m = m, .gap = gap, .face = surfaces.face_along(m, other)});
  };
  for (const Contact& contact : contacts) {
    add(contact.j, contact.i, contact.n, contact.gap);
    add(contact.i, contact.j, -contact.n, contact.gap);
  }
  std::vector<bool> ghosts(contacts.size(), false);
  any = false;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const bool is_as_before = c > 0 && contacts[c].i == contacts[c - 1].i &&
                              contacts[c].j == contacts[c - 1].j && contacts[c].n == contacts[c - 1].n;
    if (is_as_before) {
      ghosts[c] = ghosts[c - 1];
      continue;
    }
    const int i = contacts[c].i, j = contacts[c].j;
    const Vec3& n = contacts[c].n;
    const bool on_face = c + 1 < contacts.size() && contacts[c + 1].i == i && contacts[c + 1].j == j;
    ghosts[c] = is_ghost(j, i, n, on_face, supports[static_cast<std::size_t>(j)], surfaces) ||
                is_ghost(i, j, -n, on_face, supports[static_cast<std::size_t>(i)], surfaces);
    any = any || ghosts[c];
  }
  if (!any) ghosts.clear();
  return ghosts;
}

}  // namespace spook
