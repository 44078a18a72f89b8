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
  for (const Solid& solid : shapes.solids)
    placed_.push_back(placed(solid, bodies.x[static_cast<std::size_t>(solid.body)],
                             bodies.orientations.of(static_cast<std::size_t>(solid.body))));
  last_.swap(with_ghosts_.empty() ? contacts : with_ghosts_);
  with_ghosts_.clear();
  contacts.clear();
  int pairs = 0;
  for (const Plane& plane : shapes.planes)
    for (std::size_t s = 0; s < shapes.solids.size(); ++s) {
      ++pairs;
      const Solid& solid = shapes.solids[s];
      if (solid.is_static || shapes.exclusions.excludes(plane.body, solid.body)) continue;
      add_contacts_within(margin, plane, placed_[s], contacts);
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
        add_contacts_within(margin, placed_[a], placed_[b], found);
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
