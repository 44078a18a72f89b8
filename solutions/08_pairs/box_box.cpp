#include <algorithm>
#include <cmath>
#include <optional>

#include "08_pairs/farthest_corner.hpp"
#include "08_pairs/pairs.hpp"

namespace spook {

namespace {

/// Returns the corners of the face whose normal is closest to n, in order around the face, from the centre of the box.
std::vector<Vec3> face_towards(const Box& box, const Vec3& n) {
  int axis;
  (box.axes.transpose() * n).cwiseAbs().maxCoeff(&axis);
  std::vector<Vec3> corners;
  corners.reserve(4);
  corners.push_back(farthest_corner(box, n));
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

/// Leaves out, of more than four contacts around a face, those that are closer than `close` to the line through their
/// neighbours. Without these the hull is nearly the same, Eq. (8.10).
void leave_out_flat_corners(double close, std::vector<Contact>& contacts) {
  for (std::size_t k = 0; k < contacts.size() && contacts.size() > 4;) {
    const std::size_t count = contacts.size();
    const Vec3 &before = contacts[(k + count - 1) % count].r_i, &after = contacts[(k + 1) % count].r_i;
    const Vec3 side = after - before;
    if (side.cross(contacts[k].r_i - before).norm() < close * side.norm())
      contacts.erase(contacts.begin() + static_cast<std::ptrdiff_t>(k));
    else
      ++k;
  }
}

/// Returns the contacts of the face of `box` along its axis `face`, with outward normal n, with the box `other`; i is
/// `box`.
std::vector<Contact> face_contacts(const Box& box, int face, const Vec3& n, const Box& other) {
  const Vec3 apart = other.x - box.x;
  std::vector<Vec3> face_of_other = face_towards(other, -n);
  for (Vec3& corner : face_of_other) corner += apart;
  std::vector<Vec3> corners = face_of_other;
  const double smallest = box.half_sides.cwiseMin(other.half_sides).minCoeff();
  const double slack = 1e-6 * smallest;
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
  leave_out_flat_corners(0.02 * smallest, contacts);
  return contacts;
}

Contact exchanged(const Contact& contact) {
  return {.i = contact.j,
          .j = contact.i,
          .n = -contact.n,
          .gap = contact.gap,
          .r_i = contact.r_j,
          .r_j = contact.r_i};
}

/// Returns the contacts on the face that the axis belongs to; i is `first`.
std::vector<Contact> on_a_face(const Box& first, const Box& second, const SeparatingAxis& axis) {
  if (axis.face_i >= 0) return face_contacts(first, axis.face_i, axis.n, second);
  std::vector<Contact> found = face_contacts(second, axis.face_j, -axis.n, first);
  for (Contact& contact : found) contact = exchanged(contact);
  return found;
}

/// Returns the axis of a face whose normal is within 8 degrees of n, which is that of two edges: a face of i, else of j.
/// Its gap is not computed.
std::optional<SeparatingAxis> nearly_flat(const Box& i, const Box& j, const Vec3& n) {
  constexpr double flat = 0.99;  // the cosine
  const Vec3 along_i = i.axes.transpose() * n, along_j = j.axes.transpose() * n;
  int k;
  if (along_i.cwiseAbs().maxCoeff(&k) >= flat)
    return SeparatingAxis{.n = std::copysign(1.0, along_i[k]) * i.axes.col(k), .gap = 0, .face_i = k};
  if (along_j.cwiseAbs().maxCoeff(&k) >= flat)
    return SeparatingAxis{.n = std::copysign(1.0, along_j[k]) * j.axes.col(k), .gap = 0, .face_j = k};
  return {};
}

/// Returns the contacts of two edges: those on a nearly flat face if there are at least two, else that of the edges.
std::vector<Contact> on_edges(const Box& first, const Box& second, const SeparatingAxis& axis) {
  if (const auto face = nearly_flat(first, second, axis.n)) {
    std::vector<Contact> found = on_a_face(first, second, *face);
    if (found.size() >= 2) return found;
  }
  return {edge_contact(first, second, axis)};
}

}  // namespace

void box_box(const Box& i, const Box& j, std::vector<Contact>& contacts) {
  const bool exchange = j.body < i.body;
  const Box &first = exchange ? j : i, &second = exchange ? i : j;
  const SeparatingAxis axis = separating_axis(first, second);
  if (!(axis.gap <= 0 && std::isfinite(axis.gap))) return;
  const std::vector<Contact> found =
      axis.edge_i >= 0 ? on_edges(first, second, axis) : on_a_face(first, second, axis);
  for (const Contact& contact : found) contacts.push_back(exchange ? exchanged(contact) : contact);
}

}  // namespace spook
