// The choice of an impact's impulse, and the properties that all of them have.
#include "collisions.hpp"
#include "exercise_test.hpp"
#include "regions.hpp"
#include "relative_scales.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(ImpactImpulse, "7.6 impact_impulse");

Vec3 impulse_of(const Impact& impact) {
  return impact_impulse(impact.K, impact.u, impact.n, impact.e, impact.mu);
}

// The notes' choice, Eq. (7.3) or (7.5), without a test of the energy or the denominator.
Vec3 unguarded(const Impact& impact) {
  const Vec3 stick = impact.stick();
  return impact.inside(stick) ? stick : impact.slide();
}

EXERCISE_TEST(ImpactImpulse, LeavesBodiesThatPartAlone) {
  Random random;
  for (int trial = 0; trial < 200 && !::testing::Test::HasFailure(); ++trial) {
    Impact impact = random_impact(random);
    impact.u = -impact.u;
    given() = impact.text();
    expect_near_vector("J of two boxes that separate, u·n > 0 [N s]", "Eq. (7.2)", impulse_of(impact),
                       Vec3::Zero(), {0, "exact"}, {},
                       "They separate already. There is an impact only if u·n < 0.");
  }
  given().clear();
  expect_near_vector(
      "J of a rod that slips along the floor, u·n = 0 [N s]", "Eq. (7.2)",
      impact_impulse(K_of_rod(), Vec3(-1, 0, 0), Vec3(0, 0, 1), 0.5, 2), Vec3::Zero(), {0, "exact"},
      {{Vec3(0.625, 0, 0.375), "This stops the slip. Without approach there is no impact: u·n < 0."}},
      "Without approach there is no impact: u·n < 0.");
}

// A solid sphere on a plane sticks if 2/7 m |u_t| <= μ (1+e) m |u·n|.
EXERCISE_TEST(ImpactImpulse, LetsASphereStickUpToItsLargestSlip) {
  const double m = 3, R = 0.5, w = 2;
  const Vec3 n(0, 0, 1), t(0.6, 0.8, 0), r(0, 0, -R);
  for (const double e : {0.0, 0.5, 1.0})
    for (const double mu : {0.1, 0.5, 2.0}) {
      const double largest = 3.5 * mu * (1 + e) * w;
      for (const double part : {0.0, 0.3, 0.999, 1.001, 3.0}) {
        const double slip = part * largest;
        const Vec3 stick = (1 + e) * m * w * n - 2 * m * slip / 7 * t, slide = (1 + e) * m * w * (n - mu * t);
        const Vec3 J = impact_impulse(K_of_sphere(m), slip * t - w * n, n, e, mu);
        const std::string text = "sphere, e = " + show(e) + ", μ = " + show(mu) + ", |u_t| = " + show(part) +
                                 " of 7/2 μ (1+e) |u·n|";
        expect_near_vector(
            "J of a solid " + text + " [N s]", "Eq. (7.3)-(7.5)", J, part < 1 ? stick : slide,
            roundings(64, (1 + mu) * 12),
            {{stick, "It sticks, although |J_t| > μ J_n: use inside_cone."},
             {slide, "It slides, although it can stick: |J_t| <= μ J_n for the impulse of Eq. (7.3)."},
             {(1 + e) * m * w * n, "The friction is missing."}},
            "It sticks if the impulse that sticks is inside the cone, and slides otherwise.");
        const Vec3 omega = r.cross(J) / (0.4 * m * R * R);
        const double spin = (part < 1 ? slip / 3.5 : mu * (1 + e) * w) * 2.5 / R;
        expect_near_vector("ω after the impact of a solid " + text + " [rad/s]", "Eq. (7.9)", omega,
                           spin * n.cross(t), roundings(64, 5 * (1 + mu) * 12), {},
                           "5/7 |u_t|/R if it sticks: it rolls. 5/2 μ (1+e) |u·n|/R if it slides.");
        if (::testing::Test::HasFailure()) return;
      }
    }
}

EXERCISE_TEST(ImpactImpulse, IsThatOfTheNotesWhereItLosesEnergy) {
  Random random;
  Regions regions({"sticks, e = 0", "sticks, e = 1", "sticks, e between", "slides, e = 0", "slides, e = 1",
                   "slides, e between", "little friction", "much friction"},
                  20);
  while (regions.lack_draws()) {
    const Impact impact = random_impact(random);
    const Vec3 got = impulse_of(impact), stick = impact.stick();
    const bool inside = impact.inside(stick);
    const Vec3 J = unguarded(impact);
    if (!(impact.work(J) <= 0)) continue;
    const double e = impact.e;
    regions.draw({{"sticks, e = 0", inside && e == 0},
                  {"sticks, e = 1", inside && e == 1},
                  {"sticks, e between", inside && e > 0 && e < 1},
                  {"slides, e = 0", !inside && e == 0},
                  {"slides, e = 1", !inside && e == 1},
                  {"slides, e between", !inside && e > 0 && e < 1},
                  {"little friction", impact.mu < 0.2},
                  {"much friction", impact.mu > 2}});
    given() = impact.text();
    expect_near_vector(
        std::string("J of two boxes; the impulse that ") + (inside ? "sticks" : "slides") +
            " is possible, and loses energy [N s]",
        inside ? "Eq. (7.3), (7.4)" : "Eq. (7.4), (7.5)", got, J,
        inside ? impact.impulse_roundings(64) : impact.slide_roundings(64),
        {{impact.safe(), "This is the safe impulse, Eq. (7.7). It is for impacts that would add energy."},
         {stick, "This sticks, although |J_t| > μ J_n: use inside_cone."},
         {impact.slide(), "This slides, though the impulse that sticks is inside the cone."},
         {Vec3::Zero(), "They approach each other, u·n < 0: there must be an impulse."}},
        "Eq. (7.3) if it is inside the cone, else Eq. (7.5); only if energy would be added, Eq. (7.7).");
  }
  if (::testing::Test::HasFailure()) return;
  given().clear();
  const Vec3 n(0, 0, 1), u(0, 0, -1);  // no slip, but a push along n makes one
  const Vec3 stick = stick_impulse(K_of_rod(), u, n, 0.5), J = impact_impulse(K_of_rod(), u, n, 0.5, 0.1);
  if ((J - stick).norm() < 1e-9) this_failure_explains();
  expect_near_vector(
      "J of a rod at 45° that comes straight down, e = 0.5, μ = 0.1 [N s]", "Eq. (7.5)", J, Vec3(0.6 * n),
      roundings(64, 2),
      {{stick,
        "This sticks, although |J_t| > μ J_n: use inside_cone without a slip, too, since K may couple."}},
      "Without slip the impulse of Eq. (7.5) is along n.");
}

EXERCISE_TEST(ImpactImpulse, SlidesOnIce) {
  Random random;
  for (int trial = 0; trial < 20 && !::testing::Test::HasFailure(); ++trial) {
    Impact impact = random_impact(random);
    impact.mu = 0;
    given() = impact.text();
    const double j = (1 + impact.e) * impact.approach() / impact.n.dot(impact.K * impact.n);
    expect_near_vector("J of two boxes on ice, μ = 0 [N s]", "Eq. (7.4), (7.5)", impulse_of(impact),
                       Vec3(j * impact.n), roundings(256 * impact.condition(), j),
                       {{impact.stick(), "This sticks, although |J_t| > μ J_n = 0: use inside_cone."}},
                       "μ = 0 needs no special case: nothing sticks, and J is along n.");
  }
}

// Masses of any size: the sign of ΔE decides, not its size.
constexpr double rod_masses[] = {1, 1e-9};

std::string end_of(double mass, const std::string& numbers) {
  return "J of a rod of " + show(mass) + " kg at 45°, " + numbers + " [N s]";
}

const std::string safe_rule = "Where Eq. (7.6) is positive, even slightly, use the safe impulse.";

EXERCISE_TEST(ImpactImpulse, DoesNotLetStickingAddEnergy) {
  // With u' = (0, 0, 1): ½ u'·K⁻¹u' = 0.3125 m after, ½ u·K⁻¹u = 0.2 m before. And Q = P, so that J = (1+e) P.
  for (const double m : rod_masses) {
    const Impact rod{.K = K_of_rod() / m, .u = Vec3(0.6, 0, -1), .n = Vec3(0, 0, 1), .e = 1, .mu = 1};
    const Vec3 J = impulse_of(rod), stick = m * Vec3(0.375, 0, 1.025);
    expect_near("ΔE if the rod's end sticks, which is inside the cone but wrong [J]", "Eq. (7.3), (7.6)",
                rod.work(stick), 0.1125 * m, roundings(64, m));
    expect_near_vector(end_of(m, "u = (0.6, 0, -1) m/s, e = 1, μ = 1"), "Eq. (7.6), (7.7)", J,
                       Vec3(0, 0, 0.8 * m), roundings(64, m),
                       {{stick, "This sticks, and adds 0.11 J/kg to 0.2 J/kg. " + safe_rule},
                        {rod.slide(), "This slides, though the impulse that sticks is inside the cone."}},
                       safe_rule);
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(ImpactImpulse, DoesNotSlideWhereStickingAddsEnergy) {
  // J = (1, 0, 7)/8 N s would stick, and add 1/16 J; (-4, 0, 8)/13 N s would slide, and take 8/169 J away. But the
  // first is inside the cone, and no law lets a contact slide that can stick. κ = 1 in Eq. (7.7).
  for (const double m : rod_masses) {
    const Impact rod{.K = K_of_rod() / m, .u = Vec3(1, 0, -1), .n = Vec3(0, 0, 1), .e = 1, .mu = 0.5};
    const Vec3 J = impulse_of(rod), stick = m * Vec3(0.125, 0, 0.875), slide = m * Vec3(-4, 0, 8) / 13;
    expect_near_vector(
        end_of(m, "u = (1, 0, -1) m/s, e = 1, μ = 0.5, which would gain energy if it stuck"),
        "Eq. (7.6), (7.7)", J, m * Vec3(-0.25, 0, 0.65), roundings(64, m),
        {{slide,
          "This slides, though the impulse that sticks is inside the cone. If that one adds energy, use the "
          "safe impulse, not the sliding one, even if sliding would lose energy."},
         {stick, "This sticks, and adds 0.06 J/kg to 0.25 J/kg. " + safe_rule}},
        safe_rule);
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(ImpactImpulse, DoesNotLetSlidingAddEnergy) {
  // The cone is left at |J_t|/J_n = 0.514, and (7.5) has j = 8/13 m.
  for (const double m : rod_masses) {
    const Impact rod{.K = K_of_rod() / m, .u = Vec3(0.25, 0, -1), .n = Vec3(0, 0, 1), .e = 1, .mu = 0.5};
    const Vec3 J = impulse_of(rod), slide = m * Vec3(-4, 0, 8) / 13;
    expect_near("ΔE if the rod's end slides by Eq. (7.5), which is wrong [J]", "Eq. (7.5), (7.6)",
                rod.work(slide), 31.0 / 169 * m, roundings(64, m));
    expect_near_vector(end_of(m, "u = (0.25, 0, -1) m/s, e = 1, μ = 0.5"), "Eq. (7.6), (7.7)", J,
                       m * Vec3(0.21875, 0, 0.93125), roundings(64, m),
                       {{slide, "This slides, and adds 0.18 J/kg to 0.24 J/kg. " + safe_rule},
                        {rod.stick(), "This sticks, although |J_t| > μ J_n: use inside_cone."}},
                       safe_rule);
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(ImpactImpulse, IsTheSafeImpulseWhereSlidingHasNone) {
  // K of bodies with unusual shapes: n·K(n - μt) = 1 - 1.125, and the impulse that sticks has |J_t| = 1.149
  // J_n.
  const Mat3 K = (Mat3() << 2, 0.75, 1, 0.75, 1, 0, 1, 0, 1).finished();
  const Impact odd{.K = K, .u = Vec3(4, 0, -1), .n = Vec3(0, 0, 1), .e = 0, .mu = 1.125};
  const Vec3 J = impulse_of(odd);
  expect_near_vector("J where neither the sticking nor a sliding impulse is possible [N s]", "Eq. (7.5), (7.7)",
                     J, odd.safe(), odd.safe_roundings(64),
                     {{odd.slide(),
                       "n·K(n - μt) is negative, and so is this J·n: it pulls. sliding_impulse then returns "
                       "nothing."},
                      {odd.stick(), "This sticks, though |J_t| > μ J_n."},
                      {odd.P(), "This has no friction, but the safe impulse has."},
                      {Vec3::Zero(), "They approach each other, u·n < 0: there must be an impulse."}},
                     "Where Eq. (7.5) has no impulse, use the safe impulse.");
}

EXERCISE_TEST(ImpactImpulse, HasTheRestitutionWhateverK) {
  Random random;
  for (int trial = 0; trial < 5000 && !::testing::Test::HasFailure(); ++trial) {
    const Impact impact = trial % 2 ? random_impact(random) : impact_of_any_K(random);
    given() = impact.text();
    const Vec3 J = impulse_of(impact);
    const double w = impact.approach();
    expect_near("u'·n = (u + K J)·n [m/s]", "Eq. (7.2)", impact.n.dot(impact.u + impact.K * J), impact.e * w,
                impact.velocity_roundings(64, J), {{-w, "Nothing has changed along n."}},
                "By each of the laws, u'·n = -e u·n.");
  }
}

EXERCISE_TEST(ImpactImpulse, StaysInsideTheCone) {
  Random random;
  for (int trial = 0; trial < 5000 && !::testing::Test::HasFailure(); ++trial) {
    const Impact impact = trial % 2 ? random_impact(random) : impact_of_any_K(random);
    given() = impact.text();
    const Vec3 J = impulse_of(impact);
    const double J_n = J.dot(impact.n), mu = impact.mu;
    const Tolerance of_t = roundings(64 * (1 + mu) * impact.u.norm() / impact.slip().norm(), J.norm());
    expect_at_most("|J_t| - μ J_n [N s]", "Eq. (7.4)", (J - J_n * impact.n).norm() - mu * J_n,
                   (1 + mu) * (of_t.value + impact.safe_roundings(64).value),
                   "64 roundings of t and of solving with K", "Outside the cone.");
  }
}

EXERCISE_TEST(ImpactImpulse, NeverAddsEnergy) {
  Random random;
  int sticks = 0, slides = 0, none = 0;
  for (int trial = 0; trial < 100000 && !::testing::Test::HasFailure(); ++trial) {
    const Impact impact = trial % 2 ? random_impact(random) : impact_of_any_K(random);
    const Vec3 J = impulse_of(impact), stick = impact.stick();
    if (impact.inside(stick))
      sticks += impact.work(stick) > 0;
    else if (impact.eased() > 0)
      slides += impact.work(impact.slide()) > 0;
    else
      ++none;
    if (impact.work(J) <= 0) continue;
    given() = impact.text();
    const std::string unguarded_stick =
        "This is the impulse that sticks, and it adds energy: call impact_work first.";
    const std::string unguarded_slide =
        "This is the impulse that slides, and it adds energy: call impact_work.";
    const double close = 1e-9 * J.norm();
    expect_at_most("ΔE of an impact [J]", "Eq. (7.6)", impact.work(J), impact.energy_roundings(64, J).value,
                   "64 roundings of the energies in it",
                   (J - stick).norm() <= close            ? unguarded_stick
                   : (J - impact.slide()).norm() <= close ? unguarded_slide
                                                          : "An impact cannot add energy.");
  }
  if (::testing::Test::HasFailure()) return;
  given().clear();
  // Shows that the guard is needed: the notes' laws alone add energy to some of these impacts.
  const std::string needed = "otherwise the guard is not tested", rare = "Has the random input changed?";
  expect_at_least("impacts of 100,000 that would add energy if they stuck", "Eq. (7.3)", sticks, 100, needed,
                  rare);
  expect_at_least("impacts of 100,000 that would add energy if they slid", "Eq. (7.5)", slides, 100, needed,
                  rare);
  expect_at_least("impacts of 100,000 that can neither stick nor slide", "Eq. (7.5)", none, 10, needed, rare);
}

EXERCISE_TEST(ImpactImpulse, IsTheSameWhicheverBodyIsCalledI) {
  Random random;
  for (int trial = 0; trial < 500 && !::testing::Test::HasFailure(); ++trial) {
    const Impact impact = random_impact(random);
    Impact exchanged = impact;
    exchanged.u = -impact.u;
    exchanged.n = -impact.n;
    given() = impact.text();
    const Vec3 J = impulse_of(impact);
    expect_near_vector("J with i and j exchanged: -u for u, -n for n [N s]", "Eq. (7.2)", impulse_of(exchanged),
                       -J, impact.safe_roundings(64), {{J, "J must change its sign with u and n."}},
                       "It is the same impact with the bodies exchanged.");
  }
}

EXERCISE_TEST(ImpactImpulse, DropsNothingSmall) {
  // Turned so that J nearly lies along an axis: one that sticks, one that slides, and one that can do neither.
  const Mat3 odd = (Mat3() << 2, 0.75, 1, 0.75, 1, 0, 1, 0, 1).finished();
  for (const Impact& straight : {Impact{K_of_rod(), Vec3(-0.1, 0.2, -1), Vec3::UnitZ(), 0.5, 0.8},
                                 Impact{K_of_rod(), Vec3(9, 8, -1), Vec3::UnitZ(), 0.5, 0.1},
                                 Impact{odd, Vec3(4, 0, -1), Vec3::UnitZ(), 0, 1.125}})
    for (const double part : relative_scales)
      for (const Vec3& leaning : lopsided(part)) {
        const Vec3 J = straight.inside(straight.stick()) ? straight.stick()
                       : straight.eased() > 0            ? straight.slide()
                                                         : straight.safe();
        const Vec3 axis = J.cross(leaning);
        const Mat3 R =
            Eigen::AngleAxisd(std::atan2(axis.norm(), J.dot(leaning)), axis.normalized()).toRotationMatrix();
        Impact turned = straight;
        turned.K = R * straight.K * R.transpose(), turned.u = R * straight.u, turned.n = R * straight.n;
        given() = turned.text();
        expect_near_vector(
            "J of an impact, turned so that J is along " + show(Eigen::MatrixXd(leaning)) + " [N s]",
            "Eq. (7.3)-(7.8)", impulse_of(turned), Vec3(J.norm() * leaning.normalized()),
            straight.safe_roundings(64), {}, small_is_dropped);
        if (::testing::Test::HasFailure()) return;
      }
}

EXERCISE_TEST(ImpactImpulse, KeepsANaN) {
  const double NaN = std::nan("");
  for (const Vec3& u : {Vec3(NaN, 0, -1), Vec3(0, 0, NaN), Vec3(NaN, NaN, NaN)})
    for (const double mu : {0.0, 0.5}) {
      const Vec3 J = impact_impulse(K_of_rod(), u, Vec3(0, 0, 1), 0.5, mu);
      expect_true(
          "J is NaN for u = " + show(u) + ", μ = " + show(mu), "Eq. (7.2)", J.hasNaN(),
          "The NaN was lost. Every comparison with NaN is false: return early if u·n >= 0, not if u·n < 0 "
          "fails.");
    }
}

}  // namespace
