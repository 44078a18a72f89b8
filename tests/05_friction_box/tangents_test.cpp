// Two directions along a plane: of unit length, perpendicular, right-handed, and at every normal.
#include "05_friction_box/friction_box.hpp"
#include "exercise_test.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(Tangents, "5.1 tangents");

// Each coefficient is made by a few products of numbers up to 1, and is good to a rounding or two; n has one.
const Tolerance few = roundings(8);

bool is_axis(const Vec3& t) {
  return t.cwiseAbs().maxCoeff() == 1 && (t.array() != 0).count() == 1;
}

// Clues for lost digits, which have other causes than wrong answers.
std::string clue(const Vec3& n, const Tangents& t, double error, const std::string& rule) {
  if (!(std::abs(error) < 1e-4)) return rule;
  if ((n.array() != 0 && n.array().abs() < 1e-150).any())
    return "The square of 1e-160 underflows: it is 0, or has few digits left. The vector that is normalised "
           "here is that short. Take a second factor that is far from n.";
  if (is_axis(t.t1) || is_axis(t.t2))
    return "This tangent is an axis, as if n were an axis, too. n is slightly tilted against its axis, and the "
           "tangents tilt with it.";
  return "This is right except for lost digits: near this n a term of the formula nearly cancels, or is nearly "
         "0.";
}

void expect_unit(const Vec3& n, const Tangents& t) {
  const double off1 = t.t1.norm() - 1, off2 = t.t2.norm() - 1;
  expect_near("length of t1, less 1", "Eq. (5.1)", off1, 0, few,
              {{-1, "t1 is zero: n has been crossed with itself. Choose the other factor by looking at n."}},
              clue(n, t, off1,
                   "A cross product is as long as the sine of the angle between its factors: normalise it, and "
                   "take a second factor that is far from n."));
  expect_near(
      "length of t2, less 1", "Eq. (5.1)", off2, 0, few, {},
      clue(n, t, off2, "n × t1 is a unit vector once t1 is one, and perpendicular to n: normalise t1 first."));
}

void expect_perpendicular(const Vec3& n, const Tangents& t) {
  const std::string leaves = "This tangent leaves the plane of contact: friction would push along the normal.";
  const double off1 = t.t1.dot(n), off2 = t.t2.dot(n), off = t.t1.dot(t.t2);
  expect_near("t1·n", "Eq. (5.1)", off1, 0, few, {}, clue(n, t, off1, leaves));
  expect_near("t2·n", "Eq. (5.1)", off2, 0, few, {}, clue(n, t, off2, leaves));
  expect_near("t1·t2", "Eq. (5.1)", off, 0, few, {},
              clue(n, t, off, "The cross product of n and t1 is perpendicular to both."));
}

void expect_right_handed(const Vec3& n, const Tangents& t) {
  const Vec3 product = t.t1.cross(t.t2);
  expect_near_vector("t1 × t2", "Eq. (5.1)", product, n, few,
                     {{-n, "This is -n: the tangents are left-handed. Exchange them, or turn one around."}},
                     clue(n, t, (product - n).norm(), "With t1 across n, t2 = n × t1 gives t1 × t2 = n."));
}

void expect_frame(const Vec3& n, const Tangents& t) {
  for (const auto expect : {expect_unit, expect_perpendicular, expect_right_handed})
    if (!::testing::Test::HasFailure()) expect(n, t);
}

// Checks tangents(n). Returns false to stop.
bool holds_at(const Vec3& n, void (*expect)(const Vec3&, const Tangents&), const std::string& note = "") {
  const Tangents t = tangents(n);
  given() = "n = " + show(n) + ", t1 = " + show(t.t1) + ", t2 = " + show(t.t2) + note;
  expect(n, t);
  return !::testing::Test::HasFailure();
}

void look_at_random_normals(void (*expect)(const Vec3&, const Tangents&)) {
  Random random;
  for (int trial = 0; trial < 1000 && holds_at(random.unit_vector(), expect); ++trial) {
  }
}

EXERCISE_TEST(Tangents, AreUnitVectors) {
  look_at_random_normals(expect_unit);
}

EXERCISE_TEST(Tangents, ArePerpendicularToTheNormalAndToEachOther) {
  look_at_random_normals(expect_perpendicular);
}

EXERCISE_TEST(Tangents, AreRightHanded) {
  look_at_random_normals(expect_right_handed);
}

// Contacts with a floor or a wall have such normals, exactly or nearly. 1e-160 is lost when it is squared, 1e-8
// when its square is added to 1; what a comparison takes for an axis may be off it by 1e-12, or 1e-4; and some
// formulas ask for the sign of a zero.
EXERCISE_TEST(Tangents, HoldAtAndNearEveryAxis) {
  std::vector<double> small = {0.0, -0.0, 1e-160, -1e-160};
  for (const double tilt :
       {1e-16, 1e-15, 1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-4, 1e-3})
    for (const double sign : {1.0, -1.0}) small.push_back(sign * tilt);
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0})
      for (const double p : small)
        for (const double q : small) {
          Vec3 n;
          n[axis] = sign * std::sqrt(1 - p * p - q * q);
          n[(axis + 1) % 3] = p;
          n[(axis + 2) % 3] = q;
          if (!holds_at(n, expect_frame)) return;
        }
}

// Where |n_x|, |n_y| or |n_z| are equal, "the smallest" and "smaller than the others" are different conditions.
EXERCISE_TEST(Tangents, HoldWhereCoefficientsAreEqual) {
  for (const double x : {-1.0, 0.0, 1.0})
    for (const double y : {-1.0, 0.0, 1.0})
      for (const double z : {-1.0, 0.0, 1.0})
        if (x != 0 || y != 0 || z != 0)
          if (!holds_at(Vec3(x, y, z).normalized(), expect_frame)) return;
}

// Crossed with one and the same vector, every n gives a t1 (or a t2) perpendicular to it: two of them give the
// vector away. There the formula breaks, as somewhere does every formula that is continuous over the sphere.
EXERCISE_TEST(Tangents, HaveNoSingularDirection) {
  Random random;
  for (int trial = 0; trial < 100; ++trial) {
    const Tangents a = tangents(random.unit_vector()), b = tangents(random.unit_vector());
    for (const Vec3& fixed : {Vec3(a.t1.cross(b.t1)), Vec3(a.t2.cross(b.t2))}) {
      if (!(fixed.norm() > 0.1)) continue;  // too close to each other to give anything away
      for (const double sign : {1.0, -1.0})
        if (!holds_at(sign * fixed.normalized(), expect_frame,
                      ". Do you cross every n with the same vector? That vector is along this n, so the "
                      "product is 0."))
          return;
    }
  }
}

}  // namespace
