#include "engine/collision/placed_solids.hpp"

#include <algorithm>
#include <optional>

namespace spook {
namespace {

Ball place(const Sphere& sphere, int body, const Vec3& x, const Quat&) {
  return {.body = body, .x = x, .radius = sphere.radius};
}

Box place(const Cuboid& box, int body, const Vec3& x, const Quat& q) {
  return {.body = body, .x = x, .axes = q.toRotationMatrix(), .half_sides = box.half_sides};
}

void add(const std::optional<Contact>& contact, std::vector<Contact>& contacts) {
  if (contact) contacts.push_back(*contact);
}

// Contacts by the functions of chapter 08. Other kinds of solids have them in their own files.
void add_contacts(const Plane& plane, const Ball& ball, std::vector<Contact>& contacts) {
  add(plane_ball(plane, ball), contacts);
}
void add_contacts(const Plane& plane, const Box& box, std::vector<Contact>& contacts) {
  const bool in_reach =
      plane.n.dot(box.x) - plane.offset <= 1.001 * box.half_sides.norm();  // more than round-off
  if (in_reach) plane_box(plane, box, contacts);
}
void add_contacts(const Ball& a, const Ball& b, std::vector<Contact>& contacts) {
  add(ball_ball(a, b), contacts);
}
void add_contacts(const Box& a, const Ball& b, std::vector<Contact>& contacts) {
  add(box_ball(a, b), contacts);
}
void add_contacts(const Box& a, const Box& b, std::vector<Contact>& contacts) {
  box_box(a, b, contacts);
}

/// Appends the contacts of two solids that overlap or touch, in the order for which there is a function.
template <class One, class Other>
void touch(const One& a, const Other& b, std::vector<Contact>& contacts) {
  if constexpr (requires { add_contacts(a, b, contacts); })
    add_contacts(a, b, contacts);
  else
    add_contacts(b, a, contacts);
}

/// Returns a round solid with a larger radius.
template <class Round>
Round grown(Round solid, double by) {
  solid.radius += by;
  return solid;
}

/// Appends the contacts of two round solids, both grown by half the margin: their points stay in the middle.
template <class One, class Other>
void touch_within(double margin, const One& a, const Other& b, std::vector<Contact>& contacts) {
  const std::size_t before = contacts.size();
  touch(grown(a, margin / 2), grown(b, margin / 2), contacts);
  for (std::size_t c = before; c < contacts.size(); ++c) contacts[c].gap += margin;
}

/// Appends the contacts of a box and a round solid, which alone grows: a box would grow more at its corners.
template <class Round>
void touch_within(double margin, const Box& box, const Round& round, std::vector<Contact>& contacts) {
  const std::size_t before = contacts.size();
  touch(box, grown(round, margin), contacts);
  for (std::size_t c = before; c < contacts.size(); ++c) {
    Contact& contact = contacts[c];
    const Vec3 by = (contact.i == box.body ? margin : -margin) / 2 * contact.n;  // back to the middle
    contact.gap += margin;
    contact.r_i += by;
    contact.r_j += by;
  }
}
template <class Round>
void touch_within(double margin, const Round& round, const Box& box, std::vector<Contact>& contacts) {
  touch_within(margin, box, round, contacts);
}

/// Returns the point of a box that is nearest to a point; both are relative to its centre.
Vec3 nearest_in(const Box& box, const Vec3& point) {
  const Vec3 inside = box.axes.transpose() * point;
  return box.axes * inside.cwiseMax(-box.half_sides).cwiseMin(box.half_sides);
}

/// Moves the point of a contact of two grown boxes back to the boxes `i` and `j`, and computes their gap.
void move_to(const Box& i, const Box& j, Contact& contact) {
  const Vec3 from_i_to_j = j.x - i.x, half_gap = contact.gap / 2 * contact.n;
  const Vec3 on_i = nearest_in(i, contact.r_i - half_gap), on_j = nearest_in(j, contact.r_j + half_gap);
  contact.gap = contact.n.dot(from_i_to_j + on_j - on_i);
  // A corner of j is exact now. A corner that the sides of i have cut off is still beside them.
  const Vec3 below = nearest_in(i, from_i_to_j + on_j - contact.gap * contact.n);
  contact.r_i = below + contact.gap / 2 * contact.n;  // Eq. (8.3)
  contact.r_j = contact.r_i - from_i_to_j;
}

/// Appends the contacts of two boxes: those of boxes grown by half the margin, whose corners grow by more.
void touch_within(double margin, const Box& a, const Box& b, std::vector<Contact>& contacts) {
  if (margin == 0) return touch(a, b, contacts);
  const auto grown_box = [&](Box box) {
    box.half_sides += Vec3::Constant(margin / 2);
    return box;
  };
  const auto before = static_cast<std::ptrdiff_t>(contacts.size());
  touch(grown_box(a), grown_box(b), contacts);
  for (std::size_t c = static_cast<std::size_t>(before); c < contacts.size(); ++c)
    contacts[c].i == a.body ? move_to(a, b, contacts[c]) : move_to(b, a, contacts[c]);
  contacts.erase(std::remove_if(contacts.begin() + before, contacts.end(),
                                [&](const Contact& contact) { return !(contact.gap <= margin); }),
                 contacts.end());
}

}  // namespace

PlacedSolid placed(const Solid& solid, const Vec3& x, const Quat& q) {
  return match(solid.shape, [&](const auto& shape) -> PlacedSolid { return place(shape, solid.body, x, q); });
}

Bounds bounds_of(const PlacedSolid& solid, double more) {
  Bounds found = match(
      solid,
      [](const Ball& ball) {
        const Vec3 half = Vec3::Constant(ball.radius);
        return Bounds{.lower = ball.x - half, .upper = ball.x + half};
      },
      [](const auto& other) { return bounds(other); });
  found.lower -= Vec3::Constant(more);
  found.upper += Vec3::Constant(more);
  return found;
}

void add_contacts_within(double margin, Plane plane, const PlacedSolid& solid, std::vector<Contact>& contacts) {
  const std::size_t before = contacts.size();
  plane.offset += margin;
  match(solid, [&](const auto& shape) { add_contacts(plane, shape, contacts); });
  for (std::size_t c = before; c < contacts.size(); ++c) contacts[c].gap += margin;
}

void add_contacts_within(double margin, const PlacedSolid& one, const PlacedSolid& other,
                         std::vector<Contact>& contacts) {
  std::visit([&](const auto& a, const auto& b) { touch_within(margin, a, b, contacts); }, one, other);
}

}  // namespace spook
