// Rays and overlaps: closed forms, limits, and random scenes against signed distances and the contact search.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/collision/queries.hpp"
#include "engine/world/world.hpp"
#include "random_input.hpp"
#include "refusals.hpp"

namespace spook::queries_test {
namespace {

using Hit = std::optional<RayHit>;

const Vec3 X = Vec3::UnitX(), Y = Vec3::UnitY(), Z = Vec3::UnitZ();

World<6> empty_world() {
  return World<6>({.gravity = Vec3::Zero(), .contact_margin = 0});
}

/// A few roundings of numbers up to 10.
constexpr double roundings = 1e-14;

void expect_hit(const Hit& hit, int body, double distance, const Vec3& point, const Vec3& normal) {
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->body, body);
  EXPECT_NEAR(hit->distance, distance, roundings);
  EXPECT_NEAR((hit->point - point).norm(), 0, roundings) << hit->point.transpose();
  EXPECT_NEAR((hit->normal - normal).norm(), 0, roundings) << hit->normal.transpose();
}

double below(double number) {
  return std::nextafter(number, 0);
}

}  // namespace

TEST(CastRay, EntersAPlaneAtItsHeightOverTheSlope) {
  World<6> world = empty_world();
  const int plane = world.add_plane(Z, 0.5);
  expect_hit(cast_ray(world, Vec3(1, 0, 2.5), Vec3(3, 0, -4)), plane, 2.5, Vec3(2.5, 0, 0.5), Z);
  EXPECT_FALSE(cast_ray(world, Vec3(1, 0, 2.5), Vec3(3, 0, 4)));
}

TEST(CastRay, EntersASphereHalfAChordBeforeItsMiddle) {
  World<6> world = empty_world();
  const int ball = world.add({.x = Vec3(1, 0, 0), .radius = 0.5});
  // Half the chord at a distance of 0.3 from the centre is 0.4.
  expect_hit(cast_ray(world, Vec3(-4, 0, 0.3), X), ball, 4.6, Vec3(0.6, 0, 0.3), Vec3(-0.8, 0, 0.6));
}

TEST(CastRay, EntersATurnedBoxByTheFaceThatFacesTheRay) {
  World<6> world = empty_world();
  const Quat q(Eigen::AngleAxisd(std::numbers::pi / 4, Z));
  const int box = world.add({.q = q, .half_sides = Vec3(1, 1, 3)});
  // In the plane of the ray the box is |x| + |y| <= √2.
  const double x = std::sqrt(2) - 0.25;
  expect_hit(cast_ray(world, Vec3(-5, 0.25, 2), X), box, 5 - x, Vec3(-x, 0.25, 2), (Y - X).normalized());
  expect_hit(cast_ray(world, Vec3(5, 0.25, 2), -X), box, 5 - x, Vec3(x, 0.25, 2), (Y + X).normalized());
  EXPECT_FALSE(cast_ray(world, Vec3(-5, 1.5, 2), X));
  EXPECT_FALSE(cast_ray(world, Vec3(-5, 0.25, 3.1), X));
}

TEST(CastRay, EntersACapsuleByItsSideOrByAnEnd) {
  World<6> world = empty_world();
  const Quat q(Eigen::AngleAxisd(std::numbers::pi / 2, Y));  // its segment is along x
  const int capsule = world.add({.x = Vec3(0, 2, 0), .radius = 0.5, .q = q, .half_length = 1});
  expect_hit(cast_ray(world, Vec3(0.7, 2.3, 5), -Z), capsule, 4.6, Vec3(0.7, 2.3, 0.4), Vec3(0, 0.6, 0.8));
  expect_hit(cast_ray(world, Vec3(5, 2.3, 0), -X), capsule, 3.6, Vec3(1.4, 2.3, 0), Vec3(0.8, 0.6, 0));
  expect_hit(cast_ray(world, Vec3(5, 2, 0), -X), capsule, 3.5, Vec3(1.5, 2, 0), X);
  expect_hit(cast_ray(world, Vec3(-5, 2, 0), X), capsule, 3.5, Vec3(-1.5, 2, 0), -X);
  // The corner of the cylinder around it is outside: across the end, 0.4 beyond the segment, the chord has half of 0.3.
  expect_hit(cast_ray(world, Vec3(1.4, 2, 5), -Z), capsule, 4.7, Vec3(1.4, 2, 0.3), Vec3(0.8, 0, 0.6));
  EXPECT_FALSE(cast_ray(world, Vec3(1.4, 2.4, 5), -Z));
}

TEST(CastRay, FindsTheFirstBodyWhateverTheirOrder) {
  for (const bool near_first : {true, false}) {
    World<6> world = empty_world();
    world.add_plane(X, -3);
    const int one = world.add({.x = (near_first ? 2 : 0) * X, .radius = 0.5});
    const int other = world.add({.x = (near_first ? 0 : 2) * X, .half_sides = Vec3::Constant(0.5)});
    expect_hit(cast_ray(world, 5 * X, -X), near_first ? one : other, 2.5, 2.5 * X, X);
  }
  World<6> twins = empty_world();
  twins.add_plane(X, 0);
  const int low = twins.add_fixed(2 * X, 1), high = twins.add_fixed_box(2 * X, Vec3::Constant(1));
  ASSERT_LT(low, high);
  EXPECT_EQ(cast_ray(twins, 5 * X, -X)->body, low);
  const int wall = twins.add_plane(X, 3);
  EXPECT_EQ(cast_ray(twins, 5 * X, -X)->body, low) << wall;
}

TEST(CastRay, GoesNoFartherThanItsLength) {
  World<6> world = empty_world();
  world.add_plane(Z, 0);
  EXPECT_TRUE(cast_ray(world, 2 * Z, -Z, 2));
  EXPECT_FALSE(cast_ray(world, 2 * Z, -Z, below(2)));
  EXPECT_FALSE(cast_ray(world, 2 * Z, -Z, 0));
  EXPECT_TRUE(cast_ray(world, Vec3::Zero(), -Z, 0));
}

TEST(CastRay, HasALengthInMetresWhateverThatOfItsDirection) {
  World<6> world = empty_world();
  world.add({.x = Vec3(0.1, 0.2, 0.3), .radius = 1});
  const Vec3 origin(3, 4, 5), direction(-0.7, -0.9, -1.1);
  const Hit hit = cast_ray(world, origin, direction);
  ASSERT_TRUE(hit);
  for (const int exponent : {-1000, -500, 500, 1000}) {
    const Hit same = cast_ray(world, origin, direction * std::ldexp(1.0, exponent));
    ASSERT_TRUE(same) << exponent;
    EXPECT_EQ(same->distance, hit->distance) << exponent;
    EXPECT_EQ(same->point, hit->point) << exponent;
  }
  const double denormal = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(cast_ray(world, Vec3(3, 0.2, 0.3), -denormal * X)->normal, X);
}

TEST(CastRay, PassesOutOfABodyInWhichItBegins) {
  World<6> world = empty_world();
  const int ball = world.add({.radius = 1});
  const int box = world.add({.half_sides = Vec3::Constant(1)});
  const int capsule = world.add({.radius = 1, .half_length = 1});
  const int plane = world.add_plane(Z, 0.5);
  const int target = world.add_fixed(5 * X, 0.5);
  EXPECT_EQ(overlapping(world, Vec3::Zero(), 0), (std::vector<int>{ball, box, capsule, plane}));
  expect_hit(cast_ray(world, Vec3::Zero(), X), target, 4.5, 4.5 * X, -X);
  EXPECT_FALSE(cast_ray(world, Vec3::Zero(), -Z));
  EXPECT_FALSE(cast_ray(world, Vec3::Zero(), Z));
}

TEST(CastRay, BeginsOnASurface) {
  World<6> world = empty_world();
  const int plane = world.add_plane(Z, 0);
  expect_hit(cast_ray(world, Vec3::Zero(), Vec3(3, 0, -4)), plane, 0, Vec3::Zero(), Z);
  EXPECT_FALSE(cast_ray(world, Vec3::Zero(), Vec3(3, 0, 4)));
  const int box = world.add({.x = Vec3(0, 0, 4), .half_sides = Vec3::Constant(1)});
  expect_hit(cast_ray(world, 5 * Z, -Z), box, 0, 5 * Z, Z);
  EXPECT_FALSE(cast_ray(world, 5 * Z, Z));
}

TEST(CastRay, DoesNotHitWhatItOnlyTouches) {
  World<6> world = empty_world();
  const int plane = world.add_plane(Z, -8);
  const int box = world.add({.half_sides = Vec3(1, 1, 2)});
  const int ball = world.add({.x = 8 * Y, .radius = 0.5});
  const int capsule = world.add({.x = 16 * Y, .radius = 0.5, .half_length = 1});
  const auto hit = [&](const Vec3& origin, const Vec3& direction) {
    const Hit found = cast_ray(world, origin, direction);
    return found ? found->body : -1;
  };
  EXPECT_EQ(hit(Vec3(-5, 0, -8), X), -1) << "in the surface of the plane";
  for (const double zero : {-0.0, 0.0})
    EXPECT_EQ(hit(Vec3(5, 4, 0), Vec3(-1, zero, zero)), -1) << "parallel to the plane, far above";
  for (const double side : {-1.0, 1.0}) {
    EXPECT_EQ(hit(Vec3(-5, side, 0), X), -1) << "in a face";
    EXPECT_EQ(hit(Vec3(-5, below(side), 0), X), box);
    EXPECT_EQ(hit(Vec3(-5, side, 2), X), -1) << "along an edge";
    EXPECT_EQ(hit(Vec3(-5, below(side), below(2)), X), box);
    EXPECT_EQ(hit(Vec3(-5, 8 + side * 0.5, 0), X), -1) << "tangent to the ball";
    EXPECT_EQ(hit(Vec3(-5, 8 + side * 0.499, 0), X), ball);
    EXPECT_EQ(hit(Vec3(-5, 16 + side * 0.5, 0.25), X), -1) << "tangent to the capsule's side";
    EXPECT_EQ(hit(Vec3(-5, 16 + side * 0.499, 0.25), X), capsule);
    EXPECT_EQ(hit(Vec3(side * 0.5, 16, 5), -Z), plane) << "along the capsule's side";
    EXPECT_EQ(hit(Vec3(side * 0.499, 16, 5), -Z), capsule);
    EXPECT_EQ(hit(Vec3(-5, 16, side * 1.5), X), -1) << "tangent to the capsule's end";
    EXPECT_EQ(hit(Vec3(-5, 16, side * 1.499), X), capsule);
  }
  EXPECT_EQ(hit(Vec3(-2, 0, 0), Vec3(1, 1, 0)), -1) << "through an edge";
  EXPECT_EQ(hit(Vec3(below(-2), 0, 0), Vec3(1, 1, 0)), box);
}

TEST(CastRay, FindsBodiesWhereTheyAreNow) {
  World<6> world = empty_world();
  const int gone = world.add({.x = 2 * X, .radius = 0.5});
  world.add({.x = 4 * X, .v = Y, .radius = 0.5});
  EXPECT_EQ(cast_ray(world, Vec3::Zero(), X)->body, gone);
  world.remove_body(gone);
  EXPECT_EQ(cast_ray(world, Vec3::Zero(), X)->body, 0);
  world.step(2);
  EXPECT_FALSE(cast_ray(world, Vec3::Zero(), X));
  expect_hit(cast_ray(world, 2 * Y, X), 0, 3.5, Vec3(3.5, 2, 0), -X);
  EXPECT_EQ(overlapping(world, Vec3(4, 2, 0), 0), std::vector<int>{0});
}

TEST(CastRay, DoesNotFindPointsAndBodiesWithoutShapes) {
  World<6> world = empty_world();
  world.add({.x = X, .principal = Vec3::Ones()});
  world.add({.x = X, .principal = Vec3::Ones(), .corners = box_corners(Vec3::Constant(0.1))});
  world.add_fixed(X);
  EXPECT_FALSE(cast_ray(world, Vec3::Zero(), X));
  EXPECT_TRUE(overlapping(world, X, 1).empty());
}

TEST(CastRay, FindsPointMassesWithARadius) {
  World<3> world({});
  const int plane = world.add_plane(Z, -1), ball = world.add({.x = 3 * X, .radius = 1});
  expect_hit(cast_ray(world, Vec3::Zero(), X), ball, 2, 2 * X, -X);
  expect_hit(cast_ray(world, Vec3::Zero(), -Z), plane, 1, -Z, Z);
  EXPECT_EQ(overlapping(world, Vec3::Zero(), 2), (std::vector<int>{plane, ball}));
  EXPECT_EQ(overlapping(world, Vec3::Zero(), below(2)), std::vector<int>{plane});
}

TEST(CastRay, NamesWhatItRefuses) {
  const World<6> world = empty_world();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_refusal({"direction", "not zero", "is 0"}, [&] { (void)cast_ray(world, X, Vec3::Zero()); });
  expect_refusal({"direction", "nan"}, [&] { (void)cast_ray(world, X, Vec3(0, nan, 1)); });
  expect_refusal({"direction", "inf"}, [&] { (void)cast_ray(world, X, Vec3(infinity, 0, 0)); });
  expect_refusal({"origin", "nan"}, [&] { (void)cast_ray(world, Vec3(0, 0, nan), X); });
  expect_refusal({"longest", "-1"}, [&] { (void)cast_ray(world, X, X, -1); });
  expect_refusal({"longest", "nan"}, [&] { (void)cast_ray(world, X, X, nan); });
  expect_refusal({"centre", "inf"}, [&] { (void)overlapping(world, Vec3(0, infinity, 0), 1); });
  expect_refusal({"radius", "-0.5"}, [&] { (void)overlapping(world, X, -0.5); });
  expect_refusal({"radius", "inf"}, [&] { (void)overlapping(world, X, infinity); });
}

namespace {

/// The signed distances of points from the bodies of a world.
class Surfaces {
 public:
  explicit Surfaces(const World<6>& world)
      : world_(world), shapes_(world.shapes().by_body(world.bodies().size())) {}

  int bodies() const { return static_cast<int>(shapes_.size()); }

  /// Returns the distance of a point from a body's surface, negative inside [m]; infinite without a shape.
  double distance(int body, const Vec3& point) const {
    for (const Plane& plane : world_.shapes().planes)
      if (plane.body == body) return plane.n.dot(point) - plane.offset;
    const Vec3 x = orientation(world_, body).conjugate() * (point - world_.x(body));
    return match(
        shapes_[static_cast<std::size_t>(body)], [](const NoShape&) { return infinity; },
        [](const PointSet&) { return infinity; },
        [&](const Sphere& sphere) { return x.norm() - sphere.radius; },
        [&](const Capsule& capsule) {
          const double z = std::max(std::abs(x.z()) - capsule.half_length, 0.0);
          return Vec3(x.x(), x.y(), z).norm() - capsule.radius;
        },
        [&](const Cuboid& box) {
          const Vec3 beyond = x.cwiseAbs() - box.half_sides;
          return beyond.cwiseMax(0.0).norm() + std::min(beyond.maxCoeff(), 0.0);
        });
  }

 private:
  const World<6>& world_;
  std::vector<Shape> shapes_;
};

/// Draws bodies of each shape within 3 m of the origin, and two planes beyond them.
World<6> some_world(testing::Random& random) {
  World<6> world = empty_world();
  for (int n = 0; n < 4; ++n) {
    const double radius = random.log_uniform(0.05, 1), other = random.log_uniform(0.05, 1),
                 length = random.log_uniform(0.01, 2);
    const Vec3 x = random.vector(3), y = random.vector(3), z = random.vector(3), sides = random.vector(0.05, 1);
    const Quat q = random.rotation(), p = random.rotation();
    world.add({.x = x, .radius = radius});
    world.add({.x = y, .q = q, .half_sides = sides});
    world.add({.x = z, .radius = other, .q = p, .half_length = length});
    world.add_fixed_box(-x, sides.reverse(), p);
  }
  for (int n = 0; n < 2; ++n) world.add_plane(random.unit_vector(), -3);
  return world;
}

/// Steps along a ray by the distance to the nearest body that does not contain its origin. Returns the first t at which
/// this is below `close`; infinity if there is none within `longest`.
double marched(const Surfaces& surfaces, const Vec3& origin, const Vec3& u, double longest, double close) {
  std::vector<int> outside;
  for (int body = 0; body < surfaces.bodies(); ++body)
    if (surfaces.distance(body, origin) > 0) outside.push_back(body);
  for (double t = 0; t <= longest;) {
    double nearest = infinity;
    for (const int body : outside) nearest = std::min(nearest, surfaces.distance(body, origin + t * u));
    if (nearest < close) return t;
    t += nearest;
  }
  return infinity;
}

}  // namespace

TEST(CastRay, AgreesWithAMarchBySignedDistances) {
  testing::Random random;
  const double longest = 10, close = 1e-9;
  int hits = 0, misses = 0, begun_inside = 0;
  for (int draw = 0; draw < 20; ++draw) {
    const World<6> world = some_world(random);
    const Surfaces surfaces(world);
    for (int ray = 0; ray < 20; ++ray) {
      const Vec3 origin = random.vector(4), u = random.unit_vector();
      const Hit hit = cast_ray(world, origin, u, longest);
      const double t = marched(surfaces, origin, u, longest, close);
      begun_inside += !overlapping(world, origin, 0).empty();
      ASSERT_EQ(hit.has_value(), t < infinity) << "draw " << draw << ", ray " << ray << ", t = " << t;
      if (!hit) {
        ++misses;
        continue;
      }
      ++hits;
      // The distance of a convex body is a convex function of t. Before a hit it is at least (t_hit - t) times the
      // slope there.
      const double slope = -hit->normal.dot(u);
      EXPECT_GT(slope, 0);
      EXPECT_GE(hit->distance - t, -roundings) << "draw " << draw << ", ray " << ray;
      EXPECT_LE(hit->distance - t, close / slope + roundings) << "draw " << draw << ", ray " << ray;
      EXPECT_NEAR(surfaces.distance(hit->body, hit->point), 0, 3 * roundings);
      EXPECT_NEAR((origin + hit->distance * u - hit->point).norm(), 0, roundings);
      // The normal is the gradient of the distance outside: at the height e the distance is e.
      EXPECT_NEAR(hit->normal.norm(), 1, roundings);
      EXPECT_NEAR(surfaces.distance(hit->body, hit->point + 0.01 * hit->normal), 0.01, 3 * roundings);
    }
  }
  EXPECT_GT(hits, 100);
  EXPECT_GT(misses, 20);
  EXPECT_GT(begun_inside, 20);
}

TEST(CastRay, IsExactAlongTheSegmentOfACapsule) {
  testing::Random random;
  int sides = 0, ends = 0;
  for (int draw = 0; draw < 2000; ++draw) {
    World<6> world = empty_world();
    const Quat q = random.rotation();
    const double radius = random.log_uniform(0.01, 1), half_length = random.log_uniform(0.01, 3),
                 sine = random.log_uniform(1e-15, 1e-1);
    const int capsule = world.add({.radius = radius, .q = q, .half_length = half_length});
    const double depth = radius * random.log_uniform(1e-10, 1), z = random.uniform(-1, 1) * half_length;
    const Vec3 target = q * Vec3(depth - radius, 0, z);
    const Vec3 u = (q * Vec3(sine, 0, 1)).normalized(), origin = target - 8 * u;
    const Hit hit = cast_ray(world, origin, u);
    ASSERT_TRUE(hit) << "draw " << draw;
    // Where the distance of a convex body is 0 and decreases, the ray has not been inside before.
    EXPECT_NEAR(Surfaces(world).distance(capsule, hit->point), 0, 3 * roundings)
        << "draw " << draw << ", " << sine;
    EXPECT_LT(hit->normal.dot(u), 0);
    EXPECT_LE(hit->distance, 8);
    const bool at_side = std::abs((q.conjugate() * hit->normal).z()) < 1e-12;
    ++(at_side ? sides : ends);
  }
  EXPECT_GT(sides, 50);
  EXPECT_GT(ends, 50);
}

TEST(Overlapping, FindsABodyWithinTheRadiusAndAtIt) {
  World<6> world = empty_world();
  const int plane = world.add_plane(Z, -1);
  const int ball = world.add({.x = 2 * X, .radius = 1});
  const int box = world.add({.x = Vec3(-4, -5, 0), .half_sides = Vec3::Constant(1)});
  const int capsule = world.add({.x = Vec3(0, 9, 4), .radius = 1, .half_length = 1});
  // Distances from the origin: 1, 1, that of the edge at (-3, -4, 0), and that of the end at (0, 9, 3) less 1.
  EXPECT_TRUE(overlapping(world, Vec3::Zero(), below(1)).empty());
  EXPECT_EQ(overlapping(world, Vec3::Zero(), 1), (std::vector<int>{plane, ball}));
  EXPECT_EQ(overlapping(world, Vec3::Zero(), below(5)), (std::vector<int>{plane, ball}));
  EXPECT_EQ(overlapping(world, Vec3::Zero(), 5), (std::vector<int>{plane, ball, box}));
  const double end = std::sqrt(90) - 1;
  EXPECT_EQ(overlapping(world, Vec3::Zero(), end - roundings), (std::vector<int>{plane, ball, box}));
  EXPECT_EQ(overlapping(world, Vec3::Zero(), end + roundings), (std::vector<int>{plane, ball, box, capsule}));
}

TEST(Overlapping, FindsWhatTouchesABallThere) {
  testing::Random random;
  std::size_t found = 0;
  for (int draw = 0; draw < 1000; ++draw) {
    World<6> world = some_world(random);
    const Vec3 centre = random.vector(4);
    const double radius = random.log_uniform(0.01, 2);
    const std::vector<int> bodies = overlapping(world, centre, radius);
    const int ball = world.add({.x = centre, .radius = radius});
    std::vector<int> touching;
    for (int body = 0; body < ball; ++body) {  // alone with the ball: the search removes ghosts from heaps
      Shapes pair = world.shapes();
      const auto is_other = [&](const auto& shape) { return shape.body != body && shape.body != ball; };
      std::erase_if(pair.solids, is_other);
      std::erase_if(pair.planes, is_other);
      std::vector<Contact> contacts;
      ContactFinder().find(pair, world.bodies(), 0, contacts);
      if (!contacts.empty()) touching.push_back(body);
    }
    EXPECT_EQ(bodies, touching) << "draw " << draw;
    found += bodies.size();
  }
  EXPECT_GT(found, 200U);
}

}  // namespace spook::queries_test
