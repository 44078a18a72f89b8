#include <algorithm>
#include <cmath>

#include "08_pairs/pairs.hpp"

namespace spook {

namespace {

/// Returns the corner of a box with the largest n·(p - x), as p - x. Of corners that are equal up to round-off, returns
/// the one that plane_box has first. So the contacts of a resting box are in the same order in every step.
Vec3 deepest_corner(const Box& box, const Vec3& n) {
  Vec3 corner = box.half_sides;
  for (int k = 0; k < 3; ++k) corner[k] = std::copysign(corner[k], n.dot(box.axes.col(k)) - 1e-12);
  return box.axes * corner;
}

/// Returns the corners of the face whose normal is closest to n, in order around the face, from the centre of the box.
std::vector<Vec3> face_towards(const Box& box, const Vec3& n) {
  int axis;
  (box.axes.transpose() * n).cwiseAbs().maxCoeff(&axis);
  std::vector<Vec3> corners;
  corners.reserve(4);
  corners.push_back(deepest_corner(box, n));
  // Each corner is the one before, mirrored along one of the other two axes.
  for (const int along : {1, 2, 1}) {
    const Vec3 e = box.axes.col((axis + along) % 3);
    corners.push_back(corners.back() - 2 * e.dot(corners.back()) * e);
  }
  return corners;
}

/// Clips a polygon to n·p <= offset. Usually the whole polygon is inside, and nothing is copied.
void cut(std::vector<Vec3>& polygon, const Vec3& n, double offset) {
  const auto stays = [&](const Vec3& p) { return n.dot(p) <= offset; };
  if (!std::all_of(polygon.begin(), polygon.end(), stays)) polygon = clip(polygon, n, offset);
}

/// Returns the contacts of the face of `box` along its axis `face`, with outward normal n, with the box `other`; i is
/// `box`.
std::vector<Contact> face_contacts(const Box& box, int face, const Vec3& n, const Box& other) {
  const Vec3 apart = other.x - box.x;
  std::vector<Vec3> face_of_other = face_towards(other, -n);
  for (Vec3& corner : face_of_other) corner += apart;
  std::vector<Vec3> corners = face_of_other;
  const double slack = 1e-6 * box.half_sides.cwiseMin(other.half_sides).minCoeff();
  for (int k = 0; k < 3; ++k)
    if (k != face)
      for (const double side : {-1.0, 1.0})
        cut(corners, side * box.axes.col(k), box.half_sides[k] + slack);  // Eq. (8.8)

  std::vector<Contact> contacts;
  contacts.reserve(corners.size() + 1);
  const auto add = [&](const Vec3& corner) {
    const double gap = n.dot(corner) - box.half_sides[face];
    const Vec3 r = corner - gap / 2 * n;
    if (gap <= 0)
      contacts.push_back({.i = box.body, .j = other.body, .n = n, .gap = gap, .r_i = r, .r_j = r - apart});
  };
  for (const Vec3& corner : corners) add(corner);
  // Beside the face: its lowest corner, or two at the ends of a level edge.
  if (contacts.empty())
    for (const Vec3& corner : face_of_other) add(corner);
  if (contacts.size() <= 4) return contacts;
  return well_spread(contacts);
}

/// Returns the contact of the two edges that define the axis.
Contact edge_contact(const Box& i, const Box& j, const SeparatingAxis& axis) {
  const Vec3 a = i.axes.col(axis.edge_i), b = j.axes.col(axis.edge_j), apart = j.x - i.x;
  // The corners deepest in the other box are ends of the edges: a line through them is a line through the edges.
  const Vec3 on_i = deepest_corner(i, axis.n), on_j = apart + deepest_corner(j, -axis.n);
  const Vec3 across = a.cross(b), between = on_j - on_i;
  const double s = between.cross(b).dot(across) / across.squaredNorm();  // Eq. (8.9)
  const double t = between.cross(a).dot(across) / across.squaredNorm();
  const Vec3 r = (on_i + s * a + on_j + t * b) / 2;
  return {.i = i.body, .j = j.body, .n = axis.n, .gap = axis.gap, .r_i = r, .r_j = r - apart};
}

Contact exchanged(const Contact& contact) {
  return {.i = contact.j,
          .j = contact.i,
          .n = -contact.n,
          .gap = contact.gap,
          .r_i = contact.r_j,
          .r_j = contact.r_i};
}

}  // namespace

void box_box(const Box& i, const Box& j, std::vector<Contact>& contacts) {
  const bool exchange = j.body < i.body;
  const Box &first = exchange ? j : i, &second = exchange ? i : j;
  const SeparatingAxis axis = separating_axis(first, second);
  if (!(axis.gap <= 0 && std::isfinite(axis.gap))) return;

  std::vector<Contact> found;  // of first, as i, with second
  if (axis.face_i >= 0) {
    found = face_contacts(first, axis.face_i, axis.n, second);
  } else if (axis.face_j >= 0) {
    found = face_contacts(second, axis.face_j, -axis.n, first);
    for (Contact& contact : found) contact = exchanged(contact);
  } else {
    found = {edge_contact(first, second, axis)};
  }
  for (const Contact& contact : found) contacts.push_back(exchange ? exchanged(contact) : contact);
}

}  // namespace spook
