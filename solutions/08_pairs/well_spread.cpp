#include <algorithm>
#include <array>
#include <cmath>

#include "08_pairs/pairs.hpp"

namespace spook {

namespace {

/// A contact as seen from the mean of all.
struct Seen {
  const Contact* contact;
  Vec3 from_mean;
  double angle;  ///< about n
};

/// Of those that are as deep as the deepest, to within `tolerance`, always the same: the farthest in a direction that
/// is special to no box.
std::size_t choose_deepest(const std::vector<Contact>& contacts, double tolerance) {
  const Vec3 direction(1, 0.618, 0.303);
  double deepest = infinity;
  for (const Contact& contact : contacts) deepest = std::min(deepest, contact.gap);
  std::size_t chosen = contacts.size();
  for (std::size_t k = 0; k < contacts.size(); ++k)
    if (contacts[k].gap <= deepest + tolerance &&
        (chosen == contacts.size() || direction.dot(contacts[k].r_i) > direction.dot(contacts[chosen].r_i)))
      chosen = k;
  return chosen;
}

/// All contacts in order of their angle around the mean, beginning with `first`.
std::vector<Seen> around_the_mean(const std::vector<Contact>& contacts, const Vec3& mean, std::size_t first) {
  const Vec3 n = contacts.front().n;
  const auto [t1, t2] = tangents(n);
  std::vector<Seen> ring;
  for (const Contact& contact : contacts) {
    const Vec3 from_mean = contact.r_i - mean;
    ring.push_back({&contact, from_mean, std::atan2(t2.dot(from_mean), t1.dot(from_mean))});
  }
  std::sort(ring.begin(), ring.end(), [](const Seen& a, const Seen& b) { return a.angle < b.angle; });
  const auto is_first = [&](const Seen& seen) { return seen.contact == &contacts[first]; };
  std::rotate(ring.begin(), std::find_if(ring.begin(), ring.end(), is_first), ring.end());
  return ring;
}

/// Areas of what lies around the mean, in order.
struct Area {
  const std::vector<Seen>& ring;
  Vec3 n = ring.front().contact->n;

  /// Twice that of the triangle with the mean, positive where the second is to the left of the first.
  double between(std::size_t a, std::size_t b) const {
    return n.dot(ring[a].from_mean.cross(ring[b].from_mean));
  }

  /// Twice that of four which surround the mean: Eq. (8.10).
  double of(std::size_t a, std::size_t b, std::size_t c, std::size_t d) const {
    return between(a, b) + between(b, c) + between(c, d) + between(d, a);
  }

  /// Whether the mean is within four: from there each turns left to the next.
  bool surround(std::size_t a, std::size_t b, std::size_t c, std::size_t d, double tolerance) const {
    return std::min({between(a, b), between(b, c), between(c, d), between(d, a)}) >= -tolerance;
  }
};

}  // namespace

std::vector<Contact> well_spread(const std::vector<Contact>& contacts) {
  if (contacts.size() <= 4) return contacts;
  Vec3 mean = Vec3::Zero();
  for (const Contact& contact : contacts) mean += contact.r_i / static_cast<double>(contacts.size());
  double extent = 0;
  for (const Contact& contact : contacts) extent = std::max(extent, (contact.r_i - mean).norm());
  const std::size_t deepest = choose_deepest(contacts, 1e-6 * extent);
  const std::vector<Seen> ring = around_the_mean(contacts, mean, deepest);

  const Area area{ring};
  const double square = extent * extent;
  std::array<std::size_t, 4> best{};
  double largest = -infinity;
  for (std::size_t a = 1; a < ring.size(); ++a)
    for (std::size_t b = a + 1; b < ring.size(); ++b)
      for (std::size_t c = b + 1; c < ring.size(); ++c)
        if (area.surround(0, a, b, c, 1e-12 * square) && area.of(0, a, b, c) > largest + 1e-6 * square) {
          largest = area.of(0, a, b, c);
          best = {0, a, b, c};
        }
  std::vector<Contact> kept;
  for (const std::size_t k : best) kept.push_back(*ring[k].contact);
  return kept;
}

}  // namespace spook
