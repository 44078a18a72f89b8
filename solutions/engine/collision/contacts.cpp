#include "engine/collision/contacts.hpp"

#include <algorithm>
#include <optional>

#include "engine/collision/ghost_contacts.hpp"
#include "engine/support/parallel_for.hpp"

namespace spook {

void Shapes::add(int body, const Shape& shape, bool is_static) {
  match(
      shape, [](const NoShape&) {},
      [&](const PointSet& set) { corners.push_back({.body = body, .points = set.points}); },
      [&](const auto& solid) { solids.push_back({.body = body, .shape = solid, .is_static = is_static}); });
  if (!is_static) smallest = std::min(smallest, size_of(shape));
}

std::vector<Shape> Shapes::by_body(std::size_t bodies) const {
  std::vector<Shape> shapes(bodies);
  for (const Solid& solid : solids)
    shapes[static_cast<std::size_t>(solid.body)] =
        match(solid.shape, [](const auto& shape) { return Shape(shape); });
  for (const Corners& set : corners) shapes[static_cast<std::size_t>(set.body)] = PointSet{set.points};
  return shapes;
}

void Shapes::remove(int body) {
  const auto from = [&](auto& all) {
    std::erase_if(all, [&](const auto& shape) { return shape.body == body; });
    for (auto& shape : all) shape.body -= shape.body > body;
  };
  from(planes);
  from(solids);
  from(corners);
  exclusions.remove(body);
  smallest = infinity;
  for (const Solid& solid : solids)
    if (!solid.is_static) smallest = std::min(smallest, size_of(solid.shape));
  for (const Corners& set : corners) smallest = std::min(smallest, PointSet{set.points}.size());
}

namespace {

Ball place(const Sphere& sphere, int body, const Vec3& x, const Quat&) {
  return {.body = body, .x = x, .radius = sphere.radius};
}

Box place(const Cuboid& box, int body, const Vec3& x, const Quat& q) {
  return {.body = body, .x = x, .axes = q.toRotationMatrix(), .half_sides = box.half_sides};
}

/// Returns a solid at its current position.
template <int Dof>
PlacedSolid placed(const Solid& solid, const Bodies<Dof>& bodies) {
  const auto body = static_cast<std::size_t>(solid.body);
  const Quat& q = bodies.orientations.of(body);
  return match(solid.shape,
               [&](const auto& shape) -> PlacedSolid { return place(shape, solid.body, bodies.x[body], q); });
}

/// Returns the bounds of a solid, grown by `grown` [m].
Bounds bounds_of(const PlacedSolid& solid, double grown) {
  Bounds found = match(
      solid,
      [](const Ball& ball) {
        const Vec3 half = Vec3::Constant(ball.radius);
        return Bounds{.lower = ball.x - half, .upper = ball.x + half};
      },
      [](const auto& other) { return bounds(other); });
  found.lower -= Vec3::Constant(grown);
  found.upper += Vec3::Constant(grown);
  return found;
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

/// Appends the contacts of a plane, raised by the margin, and a solid.
void touch(Plane plane, const PlacedSolid& solid, double margin, std::vector<Contact>& contacts) {
  const std::size_t before = contacts.size();
  plane.offset += margin;
  match(solid, [&](const auto& placed) { add_contacts(plane, placed, contacts); });
  for (std::size_t c = before; c < contacts.size(); ++c) contacts[c].gap += margin;
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

/// Appends the contacts of two solids with a gap of at most `margin` [m].
void touch(const PlacedSolid& one, const PlacedSolid& other, double margin, std::vector<Contact>& contacts) {
  std::visit([&](const auto& a, const auto& b) { touch_within(margin, a, b, contacts); }, one, other);
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

Pair pair_of(const Contact& contact) {
  return std::minmax(contact.i, contact.j);
}

/// The contacts of two solids found in the last call, in the order of their pairs.
class PreviousContacts {
 public:
  PreviousContacts(const std::vector<Contact>& contacts, std::size_t begin, std::size_t end)
      : next_(contacts.begin() + static_cast<std::ptrdiff_t>(std::min(begin, contacts.size()))),
        end_(contacts.begin() + static_cast<std::ptrdiff_t>(std::min(end, contacts.size()))) {}

  /// Starts at a pair.
  PreviousContacts from(const Pair& bodies) const {
    PreviousContacts rest = *this;
    const auto before = [](const Contact& contact, const Pair& pair) { return pair_of(contact) < pair; };
    rest.next_ = std::lower_bound(next_, end_, bodies, before);
    return rest;
  }

  /// Appends the contacts of a pair. Pairs must be requested in order.
  void add_those_of(const Pair& bodies, std::vector<Contact>& contacts) {
    while (next_ < end_ && pair_of(*next_) < bodies) ++next_;
    for (; next_ < end_ && pair_of(*next_) == bodies; ++next_) contacts.push_back(*next_);
  }

 private:
  std::vector<Contact>::const_iterator next_, end_;
};

}  // namespace

template <int Dof>
int ContactFinder::find(const Shapes& shapes, const Bodies<Dof>& bodies, double margin,
                        std::vector<Contact>& contacts, int threads) {
  everyone_.assign(bodies.size(), true);
  return find_moved(everyone_, shapes, bodies, margin, contacts, threads);
}

template <int Dof>
int ContactFinder::find_moved(const std::vector<bool>& moved, const Shapes& shapes, const Bodies<Dof>& bodies,
                              double margin, std::vector<Contact>& contacts, int threads) {
  placed_.clear();
  for (const Solid& solid : shapes.solids) placed_.push_back(placed(solid, bodies));
  last_.swap(with_ghosts_.empty() ? contacts : with_ghosts_);
  with_ghosts_.clear();
  contacts.clear();
  int pairs = 0;
  for (const Plane& plane : shapes.planes)
    for (std::size_t s = 0; s < shapes.solids.size(); ++s) {
      ++pairs;
      const Solid& solid = shapes.solids[s];
      if (solid.is_static || shapes.exclusions.excludes(plane.body, solid.body)) continue;
      touch(plane, placed_[s], margin, contacts);
    }

  const PreviousContacts former(last_, first_of_solids_, end_of_solids_);
  first_of_solids_ = contacts.size();
  if (shapes.solids.size() > 1) {
    bounds_.clear();
    for (const PlacedSolid& solid : placed_) bounds_.push_back(bounds_of(solid, margin / 2));
    const std::vector<Pair>& near = pair_cache_.touching(bounds_);
    pairs += static_cast<int>(near.size());
    const auto has_moved = [&](const Solid& solid) { return moved[static_cast<std::size_t>(solid.body)]; };
    const auto look_at = [&](std::size_t first, std::size_t end, std::vector<Contact>& found) {
      std::optional<PreviousContacts> of_these;
      for (; first < end; ++first) {
        const auto a = static_cast<std::size_t>(near[first].first),
                   b = static_cast<std::size_t>(near[first].second);
        const Solid &one = shapes.solids[a], &other = shapes.solids[b];
        if (one.is_static && other.is_static) continue;
        if (shapes.exclusions.excludes(one.body, other.body)) continue;
        if (!has_moved(one) && !has_moved(other)) {
          if (!of_these) of_these = former.from({one.body, other.body});
          of_these->add_those_of({one.body, other.body}, found);
          continue;
        }
        touch(placed_[a], placed_[b], margin, found);
      }
    };
    const std::size_t shares = shares_of(threads, near.size());
    found_.resize(shares - 1);  // the first share is written in place
    parallel_for(threads, near.size(), [&](std::size_t share, std::size_t first, std::size_t end) {
      if (share == 0) return look_at(first, end, contacts);
      found_[share - 1].clear();
      look_at(first, end, found_[share - 1]);
    });
    for (const std::vector<Contact>& found : found_)
      contacts.insert(contacts.end(), found.begin(), found.end());
  }
  end_of_solids_ = contacts.size();
  remove_ghosts(shapes, bodies.size(), contacts);

  if constexpr (Dof == 6)
    for (const Plane& plane : shapes.planes)
      for (const Corners& corners : shapes.corners) {
        ++pairs;
        if (!shapes.exclusions.excludes(plane.body, corners.body))
          touch(plane, corners, bodies, margin, contacts);
      }
  return pairs;
}

void ContactFinder::remove_ghosts(const Shapes& shapes, std::size_t bodies, std::vector<Contact>& contacts) {
  if (first_of_solids_ == end_of_solids_) return;
  const std::vector<bool> ghosts = ghost_contacts(shapes, placed_, bodies, contacts);
  if (ghosts.empty()) return;
  with_ghosts_ = contacts;
  std::size_t c = 0;
  std::erase_if(contacts, [&](const Contact&) { return ghosts[c++]; });
}

template int ContactFinder::find<3>(const Shapes&, const Bodies<3>&, double, std::vector<Contact>&, int);
template int ContactFinder::find<6>(const Shapes&, const Bodies<6>&, double, std::vector<Contact>&, int);
template int ContactFinder::find_moved<3>(const std::vector<bool>&, const Shapes&, const Bodies<3>&, double,
                                          std::vector<Contact>&, int);
template int ContactFinder::find_moved<6>(const std::vector<bool>&, const Shapes&, const Bodies<6>&, double,
                                          std::vector<Contact>&, int);

}  // namespace spook
