#include "engine/collision/capsules.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "05_friction_box/friction_box.hpp"

namespace spook {

namespace {

/// Bisections of the segment after which a position on it is accurate to round-off.
constexpr int halvings = 52;
/// Two positions closer than this, in half lengths, are one contact.
constexpr double apart_along = 1e-3;
/// Gaps with a smaller relative difference than this are equal.
constexpr double roundings_of_gaps = 1e-9;
/// Points closer than this fraction of the radii have no direction from one to the other.
constexpr double in_one_place = 1e-9;
/// A point within this fraction of the smallest half side is beside a face, as in box_box.
constexpr double millionth = 1e-6;

/// Returns the t between -1 and 1 of the minimum of a convex function, from the sign of its slope, to round-off; the
/// first such t if the function is flat there.
template <class Slope>
double lowest_of(const Slope& slope) {
  if (slope(-1) >= 0) return -1;
  if (slope(1) < 0) return 1;
  double low = -1, high = 1;
  for (int n = 0; n < halvings; ++n) {
    const double middle = (low + high) / 2;
    (slope(middle) < 0 ? low : high) = middle;
  }
  return high;
}

/// A part of a segment, from t = first to t = last; empty if last < first.
struct Range {
  double first = -1, last = 1;

  /// Restricts the range to |at_0 + t slope| <= limit.
  void clip(double at_0, double slope, double limit) {
    if (slope == 0) return;  // the condition holds for all t or for none
    const double a = (-limit - at_0) / slope, b = (limit - at_0) / slope;
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
};

/// Appends the contacts of the balls at the ends of a range that touch, and that of the ball at `lowest` if it is a
/// different and deeper one. `contact_at` returns the contact of the ball at t.
template <class ContactAt>
void add_along(double lowest, const Range& along, const ContactAt& contact_at, std::vector<Contact>& contacts) {
  const std::optional<Contact> deepest = contact_at(lowest);
  if (!deepest) return;
  const double deeper = deepest->gap + roundings_of_gaps * std::abs(deepest->gap);
  bool stands_for_it = false;
  if (along.last - along.first > apart_along)
    for (const double t : {along.first, along.last})
      if (const std::optional<Contact> contact = contact_at(t)) {
        contacts.push_back(*contact);
        stands_for_it |= std::abs(t - lowest) <= apart_along || contact->gap <= deeper;
      }
  if (!stands_for_it) contacts.push_back(*deepest);
}

/// Returns the t, from -1 to 1, of the point on a capsule's segment that is nearest to a point.
double nearest(const PlacedCapsule& capsule, const Vec3& point) {
  if (capsule.half_length == 0) return 0;
  return std::clamp(capsule.axis.dot(point - capsule.x) / capsule.half_length, -1.0, 1.0);
}

/// Returns the contact with its lever arm on j measured from the body's centre instead of the ball's.
std::optional<Contact> on_capsule(std::optional<Contact> contact, const PlacedCapsule& j, double t) {
  if (contact) contact->r_j += t * j.half_length * j.axis;
  return contact;
}

/// Returns a unit normal across both axes. Along it two capsules whose segments meet are least deep.
Vec3 across(const PlacedCapsule& i, const PlacedCapsule& j) {
  const Vec3 n = i.axis.cross(j.axis);
  const double sine = n.norm();
  return sine > in_one_place ? Vec3(n / sine) : tangents(i.axis).t1;
}

/// Returns the contact of two balls of capsules, with its lever arms measured from the centres of the balls.
std::optional<Contact> between_balls(const PlacedCapsule& i, double s, const PlacedCapsule& j, double t) {
  const Ball ball_i = i.ball(s), ball_j = j.ball(t);
  std::optional<Contact> contact = ball_ball(ball_i, ball_j);
  const Vec3 from_i = ball_j.x - ball_i.x;
  if (!contact || from_i.norm() > in_one_place * (i.radius + j.radius)) return contact;
  contact->n = across(i, j);
  contact->r_i = (i.radius + contact->gap / 2) * contact->n;  // Eq. (8.3)
  contact->r_j = contact->r_i - from_i;
  return contact;
}

/// Returns the gradient of the signed distance from a box, at a point in the box's axes; of any length.
Vec3 outwards(const Box& box, const Vec3& point) {
  const Vec3& h = box.half_sides;
  const Vec3 out = point - point.cwiseMax(-h).cwiseMin(h);
  if (!out.isZero(0)) return out;
  int axis;
  (h - point.cwiseAbs()).minCoeff(&axis);
  return std::copysign(1, point[axis]) * Vec3::Unit(axis);
}

}  // namespace

PlacedCapsule place(const Capsule& capsule, int body, const Vec3& x, const Quat& q) {
  return {.body = body,
          .x = x,
          .axis = q.toRotationMatrix().col(2),
          .radius = capsule.radius,
          .half_length = capsule.half_length};
}

Bounds bounds(const PlacedCapsule& capsule) {
  const Vec3 half = capsule.half_length * capsule.axis.cwiseAbs() + Vec3::Constant(capsule.radius);
  return {.lower = capsule.x - half, .upper = capsule.x + half};
}

void add_contacts(const Plane& plane, const PlacedCapsule& capsule, std::vector<Contact>& contacts) {
  for (const double t : {-1.0, 1.0})
    if (const auto contact = on_capsule(plane_ball(plane, capsule.ball(t)), capsule, t))
      contacts.push_back(*contact);
}

void add_contacts(const PlacedCapsule& capsule, const Ball& ball, std::vector<Contact>& contacts) {
  const double t = nearest(capsule, ball.x);
  std::optional<Contact> contact = ball_ball(capsule.ball(t), ball);
  if (!contact) return;
  const Vec3 from_i = ball.x - capsule.ball(t).x;
  if (from_i.norm() <= in_one_place * (capsule.radius + ball.radius)) {
    contact->n = tangents(capsule.axis).t1;  // across the segment the ball is least deep
    contact->r_i = (capsule.radius + contact->gap / 2) * contact->n;  // Eq. (8.3)
    contact->r_j = contact->r_i - from_i;
  }
  contact->r_i += t * capsule.half_length * capsule.axis;
  contacts.push_back(*contact);
}

void add_contacts(const PlacedCapsule& i, const PlacedCapsule& j, std::vector<Contact>& contacts) {
  const auto nearest_on_i = [&](double t) { return nearest(i, j.ball(t).x); };
  const auto slope = [&](double t) { return j.axis.dot(j.ball(t).x - i.ball(nearest_on_i(t)).x); };
  Range along;  // where the nearest point of i is not an end
  along.clip(i.axis.dot(j.x - i.x), j.half_length * i.axis.dot(j.axis), i.half_length);
  const auto contact_at = [&](double t) {
    const double s = nearest_on_i(t);
    std::optional<Contact> contact = on_capsule(between_balls(i, s, j, t), j, t);
    if (contact) contact->r_i += s * i.half_length * i.axis;
    return contact;
  };
  add_along(lowest_of(slope), along, contact_at, contacts);
}

void add_contacts(const Box& box, const PlacedCapsule& capsule, std::vector<Contact>& contacts) {
  const auto contact_at = [&](double t) { return on_capsule(box_ball(box, capsule.ball(t)), capsule, t); };
  // In the axes of the box the segment is centre + t step.
  const Vec3 centre = box.axes.transpose() * (capsule.x - box.x),
             step = capsule.half_length * (box.axes.transpose() * capsule.axis);
  const double lowest = lowest_of([&](double t) { return step.dot(outwards(box, centre + t * step)); });
  // The lowest point decides beside which faces, and so along which axes of the box, the segment extends.
  const Vec3 beyond = (centre + lowest * step).cwiseAbs() - box.half_sides;
  int face;
  beyond.maxCoeff(&face);
  Range along;
  for (int k = 0; k < 3; ++k)
    if (k != face && beyond[k] <= millionth * box.half_sides.minCoeff())
      along.clip(centre[k], step[k], box.half_sides[k]);
  add_along(lowest, along, contact_at, contacts);
}

}  // namespace spook
