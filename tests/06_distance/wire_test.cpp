// Distances under load: tensions, stretch, and two distances that contradict each other.
#include "exercise_test.hpp"
#include "regions.hpp"
#include "systems.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(DistanceConstraint, "6.1 distance_constraint");

struct Setting {
  double h, k, d;
  std::string text() const { return "h = " + show(h) + " s, k = " + show(k) + " N/m, d = " + show(d); }
};
const std::vector<Setting> settings = {{1.0 / 30, 1e4, 2}, {1.0 / 60, 1e4, 1},  {1.0 / 60, 1e4, 4},
                                       {1.0 / 60, 1e5, 3}, {1.0 / 120, 1e5, 5}, {1.0 / 240, 1e6, 3}};

/// Links of 1 m between points of 1 kg, from a hook downwards; 10 kg on the last.
struct Wire {
  static constexpr int links = 5;
  static constexpr double m = 1, M = 10;
  Setting setting;
  Points points = {};

  /// Each link is longer by `times` T/k.
  Wire(const Setting& of, double stretch) : setting(of) {
    points.add(Vec3::Zero(), 0);
    for (int i = 1; i <= links; ++i)
      points.add(points.x.back() - (1 + stretch * tension(i) / setting.k) * Vec3::UnitZ(),
                 1 / (i < links ? m : M));
  }

  static double tension(int i) { return (M + (links - i) * m) * gravity; }  // Eq. (6.8)

  std::vector<Constraint<3>> constraints() const {
    std::vector<Constraint<3>> result;
    for (int i = 1; i <= links; ++i)
      result.push_back(distance_constraint<3>(points.at(i - 1), points.at(i), 1,
                                              spook_parameters(setting.h, setting.k, setting.d)));
    return result;
  }

  std::vector<double> step() {
    return points.step(constraints(), setting.h, {.max_sweeps = 5000, .tolerance = 1e-14});
  }

  double stretch(int i) const {
    return (points.x[static_cast<std::size_t>(i - 1)] - points.x[static_cast<std::size_t>(i)]).norm() - 1;
  }
};

EXERCISE_TEST(DistanceConstraint, CarriesWhatHangsOnIt) {
  for (const Setting& setting : settings) {
    Wire wire(setting, 1);
    const std::vector<double> lambda = wire.step();
    for (int i = 1; i <= Wire::links && !::testing::Test::HasFailure(); ++i) {
      const double T = Wire::tension(i), got = -lambda[static_cast<std::size_t>(i - 1)] / setting.h;
      expect_near(
          "tension -λ/h of link " + std::to_string(i) + " of 5, hanging at rest, " + setting.text() + " [N]",
          "Eq. (6.7), (6.8)", got, T,
          {1e-9 * T, "1e-14 m/s that a sweep may still change, over S of 15 kg on 1 kg and h"},
          {{-T, "The sign of the tension: a link that pulls has λ < 0. Is it the gap's sign, or n's?"},
           {0, "It does not pull at all. Are these a contact's bounds, or has the gap the wrong sign?"}},
          "The link carries everything below it, T = (M + (N - i) m) g.");
    }
    if (::testing::Test::HasFailure()) return;
    for (int n = 0; n < 50; ++n) wire.step();
    expect_at_most("largest speed of a point after 50 steps, " + setting.text() + " [m/s]", "Eq. (6.9)",
                   wire.points.fastest(), 1e-9, "at rest, within the error that the sweeps leave",
                   "A wire whose links are each longer by T/k hangs at rest and stays there.");
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(DistanceConstraint, StretchesByTensionOverStiffness) {
  for (const Setting& setting : settings) {
    Wire wire(setting, 0);
    int steps = 0;
    do wire.step();
    while (wire.points.fastest() > 1e-9 && ++steps < 5000);
    expect_at_most("largest speed of a point of a wire that was released unstretched, after " +
                       std::to_string(steps) + " steps, " + setting.text() + " [m/s]",
                   "Eq. (6.9)", wire.points.fastest(), 1e-9, "at rest",
                   "It does not settle: the gap is missing, or it pulls the wrong way.");
    double sum = 0;
    for (int i = 1; i <= Wire::links && !::testing::Test::HasFailure(); ++i) {
      const double expected = Wire::tension(i) / setting.k;
      sum += expected;
      expect_near("stretch of link " + std::to_string(i) + " of 5 at rest, " + setting.text() + " [m]",
                  "Eq. (6.9)", wire.stretch(i), expected,
                  {1e-5 * expected, "1e-9 m/s over the slowest decay, 0.1 /s, is 1e-8 m of 1e-4 m to 1e-2 m"},
                  {}, "A link is stretched by T/k, for any h and d.");
    }
    if (::testing::Test::HasFailure()) return;
    expect_near("stretch of the whole wire at rest, " + setting.text() + " [m]", "Eq. (6.9)",
                -wire.points.x.back().z() - Wire::links, sum, {1e-5 * sum, "that of its links"});
  }
}

EXERCISE_TEST(DistanceConstraint, FindsTheMeanOfTwoLengths) {
  Random random;
  Regions regions(
      {"the first is longer", "the second is longer", "the first is stiffer", "the second is stiffer"}, 2);
  while (regions.lack_draws()) {
    const double l1 = random.uniform(1, 2), l2 = random.uniform(1, 2);
    const double k1 = random.log_uniform(1e2, 1e4), k2 = random.log_uniform(1e2, 1e4), h = 1.0 / 60, d = 3;
    const Vec3 along = random.unit_vector();
    regions.draw({{"the first is longer", l1 > l2},
                  {"the second is longer", l2 > l1},
                  {"the first is stiffer", k1 > k2},
                  {"the second is stiffer", k2 > k1}});
    Points points{.g = 0};
    points.add(Vec3::Zero(), 0);
    points.add(1.5 * along, 1);
    for (int n = 0; n < 500; ++n) {
      const Attachment i = points.at(0), j = points.at(1);
      points.step({distance_constraint<3>(i, j, l1, spook_parameters(h, k1, d)),
                   distance_constraint<3>(j, i, l2, spook_parameters(h, k2, d))},
                  h, {.max_sweeps = 10000, .tolerance = 1e-14});
    }
    expect_near(
        "distance at rest, held at " + show(l1) + " m with k = " + show(k1) + " N/m and at " + show(l2) +
            " m with k = " + show(k2) + " N/m [m]",
        "Eq. (3.13), (6.2)", points.x[1].norm(), (k1 * l1 + k2 * l2) / (k1 + k2),
        {1e-9, "what 500 steps leave of the start, and 1e-14 m/s of every solve"},
        {{l1, "Only the first constraint has an effect."},
         {l2,
          "Only the second constraint has an effect, and "
          "i and j are exchanged."}},
        "Each pulls or pushes with k times its gap, and the two forces are opposite. The result is the mean, "
        "weighted by stiffness.");
  }
}

EXERCISE_TEST(DistanceConstraint, PullsWhenTooLongAndPushesWhenTooShort) {
  const double h = 0.01;
  for (const double length : {0.9, 1.1}) {
    Points points{.g = 0};
    points.add(Vec3::Zero(), 0);
    points.add(Vec3(1, 0, 0), 2);  // 0.5 kg
    const SpookParameters spook{.a = 10, .b = 1, .Sigma = 0.5};
    const double lambda = points.step({distance_constraint<3>(points.at(0), points.at(1), length, spook)}, h,
                                      {.max_sweeps = 1})[0];
    const double gap = 1 - length;
    expect_near("λ of 0.5 kg at 1 m from a hook, held at " + show(length) + " m [N s]", "Eq. (6.4)", lambda,
                -10 * gap / 2.5, roundings(16),
                {{10 * gap / 2.5,
                  "The sign is wrong: points that are too far apart are pulled, λ < 0, and points that "
                  "are too close are pushed."},
                 {0, "It does nothing this way: one of the bounds is 0."}},
                "λ = -a g/(S + Σ), without a bound.");
  }
}

}  // namespace
