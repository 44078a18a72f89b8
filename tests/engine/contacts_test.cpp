// The values kept from step to step change no contact: each is the same as in a search without them.
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "engine/collision/contacts.hpp"
#include "engine/world/world.hpp"
#include "random_input.hpp"
#include "refusals.hpp"

namespace spook::contacts_test {
namespace {

/// Expects the same contacts, of one pair of shapes or none, to the last bit.
bool same(const Contact& a, const Contact& b) {
  return a.i == b.i && a.j == b.j && a.n == b.n && a.gap == b.gap && a.r_i == b.r_i && a.r_j == b.r_j;
}

void expect_same(const std::vector<Contact>& found, const std::vector<Contact>& wanted,
                 const std::string& when) {
  ASSERT_EQ(found.size(), wanted.size()) << when;
  for (std::size_t c = 0; c < found.size(); ++c)
    ASSERT_TRUE(same(found[c], wanted[c]))
        << when << ", contact " << c << " is of " << found[c].i << " and " << found[c].j
        << ", and should be of " << wanted[c].i << " and " << wanted[c].j;
}

std::vector<Contact> found_from_nothing(const Shapes& shapes, const Bodies<6>& bodies, double margin) {
  std::vector<Contact> contacts;
  ContactFinder().find(shapes, bodies, margin, contacts);
  return contacts;
}

/// A floor, a wall, and a heap of balls and boxes; many of them overlap the wall.
World<6> heap(int n, testing::Random& random) {
  World<6> world({.k = 1e6});
  world.add_plane(Vec3::UnitZ(), 0);
  world.add_plane(Vec3::UnitX(), 0);
  const double side = 1.5 * std::cbrt(n);
  for (int i = 0; i < n; ++i) {
    Body<6> body{.x = Vec3::Constant(side / 2) + random.vector(side / 2),
                 .q = random.rotation(),
                 .principal = Vec3::Ones()};
    if (i % 3 == 0)
      body.radius = random.uniform(0.3, 0.9);
    else
      body.half_sides = random.vector(0.2, 0.8);
    if (i == 1) {  // points, which collide with planes only
      body.half_sides.setZero();
      body.corners = {Vec3(0.5, 0, 0), Vec3(-0.5, 0, 0)};
    }
    world.add(body);
  }
  return world;
}

/// Moves some of the bodies, each by at most `far`.
std::vector<bool> move_some(Bodies<6>& bodies, double share, double far, testing::Random& random) {
  std::vector<bool> moved(bodies.size(), false);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (bodies.is_fixed(b) || random.uniform(0, 1) > share) continue;
    moved[b] = true;
    bodies.x[b] += random.vector(far);
    bodies.orientations.q[b] = bodies.orientations.q[b].slerp(std::min(1.0, far), random.rotation());
  }
  return moved;
}

TEST(Contacts, AreThoseOfASearchFromNothingHoweverFarBodiesHaveMoved) {
  testing::Random random;
  for (const int n : {2, 30, 33, 200}) {
    const World<6> world = heap(n, random);
    const Shapes& shapes = world.shapes();
    Bodies<6> bodies = world.bodies();
    ContactFinder finder;
    std::vector<Contact> contacts;
    std::size_t all = 0;
    for (int step = 0; step < 40; ++step) {
      // Most moves are within the margin of kept pairs, and some are far larger.
      const double far = step % 5 == 4 ? 1 : 0.02, margin = step % 3 == 2 ? 0.05 : 0;
      move_some(bodies, 1, far, random);
      finder.find(shapes, bodies, margin, contacts);
      expect_same(contacts, found_from_nothing(shapes, bodies, margin),
                  std::to_string(n) + " bodies, step " + std::to_string(step));
      const std::vector<bool> moved = move_some(bodies, 0.2, far / 4, random);
      finder.find_moved(moved, shapes, bodies, margin, contacts);
      expect_same(contacts, found_from_nothing(shapes, bodies, margin),
                  std::to_string(n) + " bodies, some moved in step " + std::to_string(step));
      all += contacts.size();
    }
    EXPECT_GT(all, 0U) << "some should touch";
  }
}

TEST(Contacts, AreFoundAnewWhereABodyHasGone) {
  testing::Random random;
  const World<6> world = heap(100, random);
  Shapes shapes = world.shapes();
  ContactFinder finder;
  std::vector<Contact> contacts;
  finder.find(shapes, world.bodies(), 0, contacts);
  // The last body's shape is removed: all others keep their numbers.
  shapes.remove(static_cast<int>(world.bodies().size()) - 1);
  finder.find(shapes, world.bodies(), 0, contacts);
  expect_same(contacts, found_from_nothing(shapes, world.bodies(), 0), "without the last body");
}

/// Returns the bounds of 40 balls in a row, a tenth of a radius apart.
std::vector<Bounds> row_of_bounds() {
  std::vector<Bounds> bounds;
  for (int k = 0; k < 40; ++k) {
    const Vec3 x(2.1 * k, 0, 0);
    bounds.push_back({.lower = x - Vec3::Ones(), .upper = x + Vec3::Ones()});
  }
  return bounds;
}

TEST(Contacts, StayInOrderWhileOneBoxRestsOnAnother) {
  testing::Random random;
  const auto tilted = [&](const Vec3& x) {
    const Vec3 by = random.vector(1e-14);  // by round-off
    const Quat q = Quat(1, by.x(), by.y(), by.z()).normalized();
    return Body<6>{.x = x, .q = q, .half_sides = Vec3(0.5, 0.4, 0.3)};
  };
  const auto contacts = [&] {
    World<6> world({.k = 1e6});
    world.add(tilted(Vec3::Zero()));
    world.add(tilted(Vec3(0.1, 0.1, 0.6 - 1e-6)));
    return found_from_nothing(world.shapes(), world.bodies(), 0);
  };
  const std::vector<Contact> first = contacts();
  ASSERT_EQ(first.size(), 4u);
  for (int again = 0; again < 20; ++again) {
    const std::vector<Contact> now = contacts();
    ASSERT_EQ(now.size(), 4u);
    for (std::size_t c = 0; c < 4; ++c)
      EXPECT_LE((now[c].r_j - first[c].r_j).norm(), 1e-5) << "contact " << c << " is another corner";
  }
}

TEST(PairCache, TouchOnlyWhereTheirBoundsDo) {
  PairCache neighbours;
  EXPECT_TRUE(neighbours.touching(row_of_bounds()).empty())
      << "the margin of bounds keeps pairs, but adds no contacts";
  std::vector<Bounds> bounds = row_of_bounds();
  bounds[7].upper.x() += 0.15;
  EXPECT_EQ(neighbours.touching(bounds), std::vector<Pair>({{7, 8}}));
  bounds[7].upper.x() += 4.2;
  EXPECT_EQ(neighbours.touching(bounds), std::vector<Pair>({{7, 8}, {7, 9}, {7, 10}}));
}

/// All pairs that touch, each tested.
std::vector<Pair> all_touching(const std::vector<Bounds>& bounds) {
  std::vector<Pair> pairs;
  for (int a = 0; a < std::ssize(bounds); ++a)
    for (int b = a + 1; b < std::ssize(bounds); ++b)
      if ((bounds[a].lower.array() <= bounds[b].upper.array()).all() &&
          (bounds[b].lower.array() <= bounds[a].upper.array()).all())
        pairs.emplace_back(a, b);
  return pairs;
}

TEST(PairCache, AreAllThatTouchWhoeverHasMoved) {
  testing::Random random;
  std::vector<Bounds> bounds(600);
  for (Bounds& one : bounds) {
    one.lower = random.vector(3);
    const Vec3 half = random.vector(0.1);
    one.upper = one.lower + half.cwiseAbs() + Vec3::Constant(0.2);
  }
  PairCache neighbours;
  // First no body moves, a few jump, most move, and all creep; then one body is removed.
  for (int round = 0; round < 30; ++round) {
    const int moving = std::array{0, 1, 40, 400, 600}[round % 5];
    const double far = moving == 600 ? 0.01 : 1;
    for (int n = 0; n < moving; ++n) {
      Bounds& one = bounds[random.integer(0, static_cast<int>(bounds.size()) - 1)];
      const Vec3 by = random.vector(far);
      one.lower += by;
      one.upper += by;
    }
    if (round % 7 == 6) bounds.erase(bounds.begin() + round);
    EXPECT_EQ(neighbours.touching(bounds), all_touching(bounds))
        << "round " << round << ", " << moving << " moved";
  }
}

TEST(PairCache, AreRefusedWhereTheyReachToInfinityEachTime) {
  PairCache neighbours;
  std::vector<Bounds> bounds = row_of_bounds();
  neighbours.touching(bounds);
  bounds[3].upper.y() = infinity;
  for (int again = 0; again < 2; ++again)
    expect_refusal({"upper", "inf"}, [&] { neighbours.touching(bounds); });
}

}  // namespace
}  // namespace spook::contacts_test
