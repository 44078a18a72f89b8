#include "engine/collision/contacts.hpp"

#include <algorithm>
#include <optional>

#include "engine/support/parallel_for.hpp"

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

/// The solids, as they are now, by their numbers; each has grown by half the margin.
template <int Dof>
struct Now {
  const std::vector<Solid>& solids;
  const Bodies<Dof>& bodies;
  double grown;
  const std::vector<Box>& boxes;  ///< by the same numbers; a ball's is empty

  bool is_ball(int solid) const { return of(solid).radius > 0; }
  Ball ball(int solid) const {
    return {.body = of(solid).body, .x = x(of(solid)), .radius = of(solid).radius + grown};
  }
  const Box& box(int solid) const { return boxes[static_cast<std::size_t>(solid)]; }

  Box box_of(const Solid& solid) const {
    Mat3 axes = Mat3::Identity();
    if constexpr (Dof == 6)
      axes = bodies.orientations.q[static_cast<std::size_t>(solid.body)].toRotationMatrix();
    return {.body = solid.body,
            .x = x(solid),
            .axes = axes,
            .half_sides = solid.half_sides + Vec3::Constant(grown)};
  }
  Bounds bounds_of(int solid) const {
    if (!is_ball(solid)) return bounds(box(solid));
    const Vec3 half = Vec3::Constant(of(solid).radius + grown);
    return {.lower = x(of(solid)) - half, .upper = x(of(solid)) + half};
  }

 private:
  const Solid& of(int solid) const { return solids[static_cast<std::size_t>(solid)]; }
  const Vec3& x(const Solid& solid) const { return bodies.x[static_cast<std::size_t>(solid.body)]; }
};

void add(const std::optional<Contact>& contact, std::vector<Contact>& contacts) {
  if (contact) contacts.push_back(*contact);
}

template <int Dof>
void touch(const Plane& plane, int solid, const Now<Dof>& now, std::vector<Contact>& contacts) {
  if (now.is_ball(solid)) return add(plane_ball(plane, now.ball(solid)), contacts);
  const Box& box = now.box(solid);
  const bool in_reach =
      plane.n.dot(box.x) - plane.offset <= 1.001 * box.half_sides.norm();  // more than roundings
  if (in_reach) plane_box(plane, box, contacts);
}

template <int Dof>
void touch(int a, int b, const Now<Dof>& now, std::vector<Contact>& contacts) {
  if (now.is_ball(a) && now.is_ball(b)) return add(ball_ball(now.ball(a), now.ball(b)), contacts);
  if (now.is_ball(a)) return add(box_ball(now.box(b), now.ball(a)), contacts);
  if (now.is_ball(b)) return add(box_ball(now.box(a), now.ball(b)), contacts);
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

Pair pair_of(const Contact& contact) {
  return std::minmax(contact.i, contact.j);
}

/// Those that were found of two solids, which are in the order of their pairs.
class Former {
 public:
  Former(const std::vector<Contact>& contacts, std::size_t begin, std::size_t end)
      : next_(contacts.begin() + static_cast<std::ptrdiff_t>(begin)),
        end_(contacts.begin() + static_cast<std::ptrdiff_t>(std::min(end, contacts.size()))) {}

  /// The same from a pair on.
  Former from(const Pair& bodies) const {
    Former rest = *this;
    const auto before = [](const Contact& contact, const Pair& pair) { return pair_of(contact) < pair; };
    rest.next_ = std::lower_bound(next_, end_, bodies, before);
    return rest;
  }

  /// Those of a pair that comes after all that were asked for before.
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
  const Now<Dof> now{shapes.solids, bodies, margin / 2, boxes_};
  const auto is_box = [](const Solid& solid) { return solid.radius == 0; };
  boxes_.resize(std::any_of(shapes.solids.begin(), shapes.solids.end(), is_box) ? shapes.solids.size() : 0);
  for (std::size_t s = 0; s < boxes_.size(); ++s)
    if (is_box(shapes.solids[s])) boxes_[s] = now.box_of(shapes.solids[s]);
  last_.swap(contacts);
  contacts.clear();
  int pairs = 0;
  for (Plane plane : shapes.planes) {
    plane.offset += now.grown;
    for (std::size_t s = 0; s < shapes.solids.size(); ++s) {
      ++pairs;
      if (!shapes.solids[s].fixed) touch(plane, static_cast<int>(s), now, contacts);
    }
  }
  // The point of a contact with a plane is the body's own: without what it has grown by.
  for (Contact& contact : contacts) {
    contact.r_i += now.grown * contact.n;
    contact.r_j += now.grown * contact.n;
    contact.gap += margin;
  }

  const Former former(last_, first_of_solids_, end_of_solids_);
  first_of_solids_ = contacts.size();
  if (shapes.solids.size() > 1) {
    bounds_.clear();
    for (int s = 0; s < std::ssize(shapes.solids); ++s) bounds_.push_back(now.bounds_of(s));
    const std::vector<Pair>& near = neighbours_.touching(bounds_);
    pairs += static_cast<int>(near.size());
    const auto has_moved = [&](const Solid& solid) { return moved[static_cast<std::size_t>(solid.body)]; };
    const auto look_at = [&](std::size_t first, std::size_t end, std::vector<Contact>& found) {
      std::optional<Former> of_these;
      for (; first < end; ++first) {
        const Solid& one = shapes.solids[static_cast<std::size_t>(near[first].first)];
        const Solid& other = shapes.solids[static_cast<std::size_t>(near[first].second)];
        if (one.fixed && other.fixed) continue;
        if (!has_moved(one) && !has_moved(other)) {
          if (!of_these) of_these = former.from({one.body, other.body});
          of_these->add_those_of({one.body, other.body}, found);
          continue;
        }
        const std::size_t before = found.size();
        touch(near[first].first, near[first].second, now, found);
        for (std::size_t c = before; c < found.size(); ++c) found[c].gap += margin;
      }
    };
    const std::size_t shares = shares_of(threads, near.size());
    found_.resize(shares - 1);  // the first share is found in place
    in_shares(threads, near.size(), [&](std::size_t share, std::size_t first, std::size_t end) {
      if (share == 0) return look_at(first, end, contacts);
      found_[share - 1].clear();
      look_at(first, end, found_[share - 1]);
    });
    for (const std::vector<Contact>& found : found_)
      contacts.insert(contacts.end(), found.begin(), found.end());
  }
  end_of_solids_ = contacts.size();

  if constexpr (Dof == 6)
    for (const Plane& plane : shapes.planes)
      for (const Corners& corners : shapes.corners) {
        ++pairs;
        touch(plane, corners, bodies, margin, contacts);
      }
  return pairs;
}

template int ContactFinder::find<3>(const Shapes&, const Bodies<3>&, double, std::vector<Contact>&, int);
template int ContactFinder::find<6>(const Shapes&, const Bodies<6>&, double, std::vector<Contact>&, int);
template int ContactFinder::find_moved<3>(const std::vector<bool>&, const Shapes&, const Bodies<3>&, double,
                                          std::vector<Contact>&, int);
template int ContactFinder::find_moved<6>(const std::vector<bool>&, const Shapes&, const Bodies<6>&, double,
                                          std::vector<Contact>&, int);

}  // namespace spook
