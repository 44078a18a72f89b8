#include <algorithm>
#include <array>
#include <cmath>

#include "08_pairs/pairs.hpp"

namespace spook {

namespace {

/// Contacts that are less deep than the deepest by at most this, in distances from the mean, are as deep: at rest gaps
/// differ by what bodies sag.
constexpr double sag = 3e-3;

/// A contact relative to the mean of all contacts.
struct Seen {
  const Contact* contact;
  Vec3 from_mean;
  double angle;  ///< about n
};

/// Returns all contacts in order of their angle around the mean. The first is the farthest in a direction that is special
/// to no box, so that the order is the same in every step.
std::vector<Seen> around_the_mean(const std::vector<Contact>& contacts, const Vec3& mean) {
  const auto [t1, t2] = tangents(contacts.front().n);
  std::vector<Seen> ring;
  for (const Contact& contact : contacts) {
    const Vec3 from_mean = contact.r_i - mean;
    ring.push_back({&contact, from_mean, std::atan2(t2.dot(from_mean), t1.dot(from_mean))});
  }
  std::sort(ring.begin(), ring.end(), [](const Seen& a, const Seen& b) { return a.angle < b.angle; });
  const auto rank = [](const Seen& seen) { return seen.contact->r_i.dot(Vec3(1, 0.618, 0.303)); };
  const auto is_nearer = [&](const Seen& a, const Seen& b) { return rank(a) < rank(b); };
  std::rotate(ring.begin(), std::max_element(ring.begin(), ring.end(), is_nearer), ring.end());
  return ring;
}

using Four = std::array<std::size_t, 4>;

/// Returns twice the area of four contacts in order: Eq. (8.10). -infinity if a term is below -tolerance: then the mean
/// is outside.
double area(const std::vector<Seen>& ring, const Four& four, double tolerance) {
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const Seen &one = ring[four[k]], &other = ring[four[(k + 1) % 4]];
    const double term = one.contact->n.dot(one.from_mean.cross(other.from_mean));
    if (term < -tolerance) return -infinity;
    sum += term;
  }
  return sum;
}

}  // namespace

std::vector<Contact> well_spread(const std::vector<Contact>& contacts) {
  if (contacts.size() <= 4) return contacts;
  Vec3 mean = Vec3::Zero();
  for (const Contact& contact : contacts) mean += contact.r_i / static_cast<double>(contacts.size());
  double extent = 0;
  for (const Contact& contact : contacts) extent = std::max(extent, (contact.r_i - mean).norm());
  const std::vector<Seen> ring = around_the_mean(contacts, mean);
  double deepest = infinity;
  for (const Contact& contact : contacts) deepest = std::min(deepest, contact.gap);
  const auto is_deep = [&](std::size_t k) { return ring[k].contact->gap <= deepest + sag * extent; };

  Four best{};
  double largest = -infinity;
  for (std::size_t a = 0; a < ring.size(); ++a)
    for (std::size_t b = a + 1; b < ring.size(); ++b)
      for (std::size_t c = b + 1; c < ring.size(); ++c)
        for (std::size_t d = c + 1; d < ring.size(); ++d) {
          const Four four = {a, b, c, d};
          if (std::none_of(four.begin(), four.end(), is_deep)) continue;
          const double found = area(ring, four, 1e-12 * extent * extent);
          if (found > largest + 1e-6 * extent * extent) {
            largest = found;
            best = four;
          }
        }
  std::vector<Contact> kept;
  for (const std::size_t k : best) kept.push_back(*ring[k].contact);
  return kept;
}

}  // namespace spook
