#include "engine/collision/capsules.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace spook {

namespace {

/// Halvings after which a place between -1 and 1 is known to roundings.
constexpr int halvings = 52;
/// Two places that are nearer than this, in half lengths, are one contact.
constexpr double apart = 1e-3;
/// Gaps that are alike to this part of them are one depth.
constexpr double roundings_of_gaps = 1e-9;
/// A point is beside a face up to this part of the smallest half side, as in box_box.
constexpr double millionth = 1e-6;

/// Returns the t between -1 and 1 where a convex function is lowest, by golden sections.
template <class Function>
double lowest_of(const Function& g) {
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double low = -1, high = 1, a = high - golden * (high - low), b = low + golden * (high - low);
  double g_a = g(a), g_b = g(b);
  for (int n = 0; n < halvings; ++n) {
    if (g_a <= g_b) {
      high = b, b = a, g_b = g_a, a = high - golden * (high - low), g_a = g(a);
    } else {
      low = a, a = b, g_a = g_b, b = low + golden * (high - low), g_b = g(b);
    }
  }
  return (low + high) / 2;
}

/// A part of a segment, from t = first to last; empty if last < first.
struct Range {
  double first = -1, last = 1;

  /// Leaves only where |at_0 + t slope| <= limit.
  void clip(double at_0, double slope, double limit) {
    if (slope == 0) return;  // there, or nowhere, all along
    const double a = (-limit - at_0) / slope, b = (limit - at_0) / slope;
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
};

/// Appends the contacts of the balls at the ends of a range that touch, and of that at `lowest` where it is another one
/// and lies deeper. `contact_at` gives that of the ball at t.
template <class ContactAt>
void add_contacts(double lowest, const Range& along, const ContactAt& contact_at,
                  std::vector<Contact>& contacts) {
  const std::optional<Contact> deepest = contact_at(lowest);
  if (!deepest) return;
  const double deeper = deepest->gap + roundings_of_gaps * std::abs(deepest->gap);
  bool stands_for_it = false;
  if (along.last - along.first > apart)
    for (const double t : {along.first, along.last})
      if (const std::optional<Contact> contact = contact_at(t)) {
        contacts.push_back(*contact);
        stands_for_it |= std::abs(t - lowest) <= apart || contact->gap <= deeper;
      }
  if (!stands_for_it) contacts.push_back(*deepest);
}

/// Returns the place, from -1 to 1, on the segment of a capsule that is nearest to a point.
double nearest(const PlacedCapsule& capsule, const Vec3& point) {
  if (capsule.half_length == 0) return 0;
  return std::clamp(capsule.axis.dot(point - capsule.x) / capsule.half_length, -1.0, 1.0);
}

/// Returns the contact with its lever arm on j from the centre of the body and not from that of the ball at t.
std::optional<Contact> on_capsule(std::optional<Contact> contact, const PlacedCapsule& j, double t) {
  if (contact) contact->r_j += t * j.half_length * j.axis;
  return contact;
}

/// Returns the distance of a point from a box, negative inside.
double signed_distance(const Box& box, const Vec3& point) {
  const Vec3 beyond = (box.axes.transpose() * (point - box.x)).cwiseAbs() - box.half_sides;
  const double inside = std::min(beyond.maxCoeff(), 0.0);
  return beyond.cwiseMax(0.0).norm() + inside;
}

}  // namespace

Bounds bounds(const PlacedCapsule& capsule) {
  const Vec3 half = capsule.half_length * capsule.axis.cwiseAbs() + Vec3::Constant(capsule.radius);
  return {.lower = capsule.x - half, .upper = capsule.x + half};
}

void plane_capsule(const Plane& plane, const PlacedCapsule& capsule, std::vector<Contact>& contacts) {
  for (const double t : {-1.0, 1.0})
    if (const auto contact = on_capsule(plane_ball(plane, capsule.ball(t)), capsule, t))
      contacts.push_back(*contact);
}

void capsule_ball(const PlacedCapsule& capsule, const Ball& ball, std::vector<Contact>& contacts) {
  const double t = nearest(capsule, ball.x);
  std::optional<Contact> contact = ball_ball(capsule.ball(t), ball);
  if (!contact) return;
  contact->r_i += t * capsule.half_length * capsule.axis;
  contacts.push_back(*contact);
}

void capsule_capsule(const PlacedCapsule& i, const PlacedCapsule& j, std::vector<Contact>& contacts) {
  const auto nearest_on_i = [&](double t) { return nearest(i, j.ball(t).x); };
  const auto distance = [&](double t) { return (j.ball(t).x - i.ball(nearest_on_i(t)).x).norm(); };
  Range along;  // where the nearest point of i is not one of its ends
  along.clip(i.axis.dot(j.x - i.x), j.half_length * i.axis.dot(j.axis), i.half_length);
  const auto contact_at = [&](double t) {
    const double s = nearest_on_i(t);
    std::optional<Contact> contact = on_capsule(ball_ball(i.ball(s), j.ball(t)), j, t);
    if (contact) contact->r_i += s * i.half_length * i.axis;
    return contact;
  };
  add_contacts(lowest_of(distance), along, contact_at, contacts);
}

void box_capsule(const Box& box, const PlacedCapsule& capsule, std::vector<Contact>& contacts) {
  const auto distance = [&](double t) { return signed_distance(box, capsule.ball(t).x); };
  const auto contact_at = [&](double t) { return on_capsule(box_ball(box, capsule.ball(t)), capsule, t); };
  const double lowest = lowest_of(distance);
  // Beside which faces, and so along which axes of the box the segment may go on, is told by the lowest point.
  const Vec3 centre = box.axes.transpose() * (capsule.x - box.x),
             slope = capsule.half_length * (box.axes.transpose() * capsule.axis);
  const Vec3 beyond = (centre + lowest * slope).cwiseAbs() - box.half_sides;
  int face;
  beyond.maxCoeff(&face);
  Range along;
  for (int k = 0; k < 3; ++k)
    if (k != face && beyond[k] <= millionth * box.half_sides.minCoeff())
      along.clip(centre[k], slope[k], box.half_sides[k]);
  add_contacts(lowest, along, contact_at, contacts);
}

}  // namespace spook
