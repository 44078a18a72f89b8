// Balls that hit each other, or the floor, against chapter 07's formulas, and those against independent results.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "checks.hpp"
#include "scene_runs.hpp"
#include "scenes/bounces.hpp"
#include "scenes/pairwise.hpp"

namespace spook::impact_scenes_test {
namespace {

constexpr double epsilon = 2.2e-16;
constexpr double g = 9.81;

// bouncing_ball

TEST(Bounces, AgreesWithFlightsOneByOne) {
  const double h0 = 2.5, e = 0.7;
  Bounces answer(h0, g, e);
  // A flight from z = 0 with v ends where v t - g t²/2 = 0.
  double begin = std::sqrt(2 * h0 / g), v = g * begin;
  for (double t = 0; t < begin; t += 0.01) EXPECT_NEAR(answer.height(t), h0 - g * t * t / 2, 1e-13);
  for (int n = 1; n <= 20; ++n) {
    v *= e;
    EXPECT_NEAR(answer.peak(n), v * v / (2 * g), 1e-13 * h0) << "Eq. (7.11)";
    for (const double part : {0.1, 0.5, 0.9}) {
      const double t = part * 2 * v / g;
      EXPECT_NEAR(answer.height(begin + t), v * t - g * t * t / 2, 1e-12) << "flight " << n;
    }
    begin += 2 * v / g;
  }
  EXPECT_NEAR(answer.end(), begin + 2 * e * v / (g * (1 - e)), 1e-12) << "Eq. (7.12)";
  EXPECT_EQ(answer.height(answer.end() - 1e-16), 0) << "flights shorter than round-off";
  EXPECT_EQ(answer.height(answer.end() + 1), 0);
}

TEST(Bounces, EndAtOnceOrNever) {
  Bounces dead(1, g, 0), alive(1, g, 1);
  EXPECT_EQ(dead.end(), std::sqrt(2 / g));
  EXPECT_EQ(dead.peak(0), 1);
  EXPECT_EQ(dead.peak(1), 0);
  EXPECT_EQ(dead.height(1), 0);
  EXPECT_TRUE(std::isinf(alive.end()));
  EXPECT_NEAR(alive.height(200 * std::sqrt(2 / g)), 1, 1e-10);
}

TEST(BouncingBallScene, ComesBackForEverWithRestitution1) {
  for (const double h : {1.0 / 60, 1.0 / 600})
    for (const std::string h0 : {"1", "0.3"}) {
      const SceneRun run = run_of("bouncing_ball", {{"restitution", "1"}, {"h0", h0}}, h, 20);
      // Each step rounds z, v² and their sum, possibly all in one direction.
      EXPECT_LE(run.error, 8 * epsilon * 20 / h) << "h " << h << ", h0 " << h0;
      EXPECT_GE(run.last("bounces"), 20);
    }
}

TEST(BouncingBallScene, HasTheRightPeaksWhateverTheStep) {
  // Leapfrog is on the parabola, and a late impact is moved to where the two parabolas meet: Eq. (7.15).
  for (const double h : {0.05, 1.0 / 60, 0.01, 1.0 / 600})
    for (const double e : {0.5, 0.8, 0.95}) {
      const SceneRun run = run_of("bouncing_ball", {{"restitution", exact_text(e)}}, h, 0.55);
      ASSERT_EQ(run.last("bounces"), 1);
      EXPECT_NEAR(run.last("peak [m]"), e * e, 1e-13) << "h " << h << ", e " << e;
    }
}

TEST(BouncingBallScene, IsOffByTheBouncesThatTakeLessThanAStep) {
  // Once it returns within a step of half of g h², two parabolas in one step are beyond one impact a step.
  for (const double h : {1.0 / 60, 0.005, 0.001})
    for (const std::string e : {"0", "0.34", "0.5", "0.8", "0.99"})
      EXPECT_LE(error_of("bouncing_ball", {{"restitution", e}}, h, 5), 2 * g * h * h)
          << "h " << h << ", e " << e;
}

TEST(BouncingBallScene, StaysWhereItFallsWithoutRestitution) {
  // It stops on the floor some time τ before x_n, and falls for τ more. So it is g τ²/2 deep, and has the speed of that
  // fall.
  for (const double h : {1.0 / 60, 0.004, 0.0007}) {
    const double time = h * (std::ceil(std::sqrt(2 / g) / h) + 1);
    const SceneRun run = run_of("bouncing_ball", {{"restitution", "0"}}, h, time);
    EXPECT_LE(std::abs(run.last("z [m]")), g * h * h) << "h " << h;
    EXPECT_LE(std::abs(run.last("v [m/s]")), g * h) << "h " << h;
  }
}

TEST(BouncingBallScene, BouncesAboveTheThresholdOnly) {
  const double h = 0.001, e = 0.8, fastest = std::sqrt(2 * g);
  // (Not for less: the floor hides too much of low bounces.)
  for (const double threshold : {0.5, 1.0, 2.0}) {
    int bounces = 0;
    for (double v = fastest; v > threshold + g * std::max(h, std::sqrt(2 / 1e6)); v *= e) ++bounces;
    const SceneRun run = run_of("bouncing_ball", {{"threshold", exact_text(threshold)}}, h, 6);
    EXPECT_EQ(run.last("bounces"), bounces) << "threshold " << threshold;
    EXPECT_NEAR(run.last("z [m]"), -g / 1e6, 1e-9) << "it comes to rest";
  }
  EXPECT_EQ(run_of("bouncing_ball", {{"threshold", "5"}}, h, 1).last("bounces"), 0) << "4.43 m/s is less";
}

TEST(BouncingBallScene, EndsWhenTheSeriesDoes) {
  const double h = 0.0005, e = 0.6;
  const SceneRun run = run_of("bouncing_ball", {{"restitution", exact_text(e)}}, h, 3);
  const double end = Bounces(1, g, e).end();
  // Each bounce is up to a step late, and the bounces below the threshold, g h, would take 2 e h/(1 - e).
  EXPECT_NEAR(run.last("last bounce [s]"), end, h * (run.last("bounces") + 2 / (1 - e))) << "Eq. (7.12)";
  EXPECT_GE(run.last("bounces"), 10);
}

// cradle

TEST(PairByPair, ExchangesVelocitiesOfBallsThatLoseNothing) {
  EXPECT_EQ(pair_by_pair({1, 0, 0}, 1, 0), (std::vector<double>{0, 0, 1})) << "Eq. (7.13)";
  EXPECT_EQ(pair_by_pair({3, 2, 0, -1}, 1, 0), (std::vector<double>{-1, 0, 2, 3}));
}

TEST(PairByPair, KeepsMomentumAndLeavesNoApproach) {
  for (const double e : {0.0, 0.3, 0.9, 1.0}) {
    std::vector<double> v = {2, 0, 0.5, 0, -1};
    const double momentum = std::accumulate(v.begin(), v.end(), 0.0);
    v = pair_by_pair(v, e, 1e-12);
    EXPECT_NEAR(std::accumulate(v.begin(), v.end(), 0.0), momentum, 1e-13);
    for (std::size_t i = 0; i + 1 < v.size(); ++i) EXPECT_LE(v[i] - v[i + 1], 1e-12) << "e " << e;
    if (e == 0) {
      EXPECT_NEAR(v.front(), v.back(), 1e-11) << "they stay together";
    }
  }
  // One impact: the speed of separation is e times that of approach.
  const std::vector<double> two = pair_by_pair({1, 0}, 0.5, 0);
  EXPECT_EQ(two, (std::vector<double>{0.25, 0.75}));
}

TEST(CradleScene, OneInOneOut) {
  for (const std::string bodies : {"1", "2", "3", "5", "50"})
    for (const std::string radius : {"0.1", "0.3", "7"})
      for (const double h : {1.0 / 60, 0.01, 1e-4}) {
        // The remaining overlap, a few units of round-off of x, at most the length of all, returns 4/(13 h) of it as
        // speed.
        const double length = 2 * std::stod(bodies) * std::stod(radius) + 1;
        EXPECT_LE(error_of("cradle", {{"bodies", bodies}, {"radius", radius}}, h, 30 * h),
                  4 * epsilon * length * 4 / (13 * h))
            << bodies << " bodies, radius " << radius << ", h " << h;
      }
}

TEST(CradleScene, ExchangesPairByPairForAnyRestitution) {
  for (const std::string e : {"0", "0.3", "0.5", "0.9", "0.99"})
    for (const int bodies : {2, 3, 5, 20})
      // Each contact ignores an approach of 1e-9 v.
      EXPECT_LE(error_of("cradle", {{"restitution", e}, {"bodies", std::to_string(bodies)}}, 0.01, 0.5),
                bodies * 1e-9)
          << "e " << e << ", " << bodies << " bodies";
}

TEST(CradleScene, LatenessIsMadeGoodWhateverTheStep) {
  for (const std::string bodies : {"2", "3", "20"})
    for (const double h : {0.01, 0.001})
      for (const double late : {0.1, 0.5, 0.9}) {
        const SceneSettings settings = {{"bodies", bodies}, {"late", exact_text(late)}};
        EXPECT_LE(error_of("cradle", settings, h, 12 * h), 1e-12)
            << bodies << " bodies, h " << h << ", late " << late;
      }
}

TEST(CradleScene, PutsTheBallsWhereTheyWouldBe) {
  // The impact was late, and the last ball is as far as if it had not been.
  const auto farthest = [](const std::string& late) {
    const SceneDescription& cradle = find_scene("cradle");
    const auto scene = cradle.build(with(cradle, {{"late", late}}), {.h = 0.01, .solver = "auto"});
    scene->advance(30);
    scene->observe();
    double off = 0;
    const std::vector<Vec3> x = scene->frame().x;
    for (const Ghost& ghost : scene->ghosts())
      off = std::max(off, (x[static_cast<std::size_t>(ghost.body)] - ghost.x).norm());
    return off;
  };
  for (const std::string late : {"0", "0.5", "0.9"}) EXPECT_LE(farthest(late), 1e-12) << late;
}

TEST(CradleScene, RefusesBallsThatJumpThroughEachOther) {
  const SceneDescription& cradle = find_scene("cradle");
  try {
    cradle.build(with(cradle, {{"v0", "11"}}), {.h = 0.01});
    ADD_FAILURE() << "nothing was thrown";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("v0 h must be at most the radius"), std::string::npos)
        << error.what();
  }
}

// pile

TEST(PileScene, ComesToRestOnItsFloor) {
  const SceneRun run = run_of("pile", {{"bodies", "12"}}, 0.01, 4);
  const std::vector<double>& energy = run.all("kinetic energy [J]");
  const double most = *std::max_element(energy.begin(), energy.end());
  EXPECT_GE(most, 1) << "they should fall";
  EXPECT_LE(run.last("fastest centre [m/s]"), 0.01);
  EXPECT_LE(energy.back(), 0.01 * most) << "a sphere may spin for ever about the one point that it stands on";
  EXPECT_NEAR(run.last("floor's load over the weight"), 1, 1e-3);
  const double overlap = run.last("deepest overlap [m]");
  EXPECT_LE(overlap, 12 * g / 1e5) << "the whole weight on one contact, over k";
  EXPECT_GE(overlap, g / 1e5) << "those on the floor carry at least themselves";
}

TEST(PileScene, OverlapsBalanceTheWeightsOnceItRests) {
  // A sphere alone on its floor sinks in by m g/k, to round-off of its height, 1e-17 m. Before it lands nothing is
  // balanced.
  EXPECT_LE(run_of("pile", {{"bodies", "1"}}, 0.01, 4).error, 1e-9);
  EXPECT_NEAR(run_of("pile", {{"bodies", "1"}}, 0.01, 0.05).error, 1, 1e-12);
  for (const std::string shape : {"sphere", "box"}) {
    // Not every heap comes to rest: of twelve seeds of boxes three end in a rocking of 1e-4 m/s, and a sphere may spin.
    const SceneSettings few = {{"bodies", "8"}, {"shape", shape}, {"seed", shape == "box" ? "3" : "1"}};
    EXPECT_LE(run_of("pile", few, 0.01, 8).error, 1e-5) << shape;
    // Too few sweeps let it sink until the impulses suffice: by as many times m g/k as they are short.
    EXPECT_GE(run_of("pile", few, 0.01, 8, {.max_sweeps = 1}, "gauss_seidel").error, 1) << shape;
  }
}

// If impacts stopped each approach, soft springs would never be compressed by the weight, and a pile would jitter: with
// impacts in each step, of |gravity| h and more.
TEST(PileScene, RestsOnSoftSpringsThoughItBounces) {
  for (const std::string k : {"1e4", "1e5"})
    for (const double h : {0.004, 0.001}) {
      SCOPED_TRACE("k " + k + ", h " + exact_text(h));
      const SceneRun run = run_of("pile", {{"bodies", "12"}, {"seed", "2"}, {"k", k}}, h, 8);
      EXPECT_EQ(run.last("impacts"), 0);
      EXPECT_LE(run.last("fastest centre [m/s]"), g * h);
    }
}

// In a step that is too long for the spring, a force comes from an overlap. If it allowed faster approaches, the balls
// would overlap again, and throw each other for ever.
TEST(PileScene, RestsWithStepsThatAreLongForItsSprings) {
  for (const std::string seed : {"1", "5", "6", "7"})
    EXPECT_LE(run_of("pile", {{"seed", seed}}, 1.0 / 30, 8).error, 0.01) << "seed " << seed;
}

// A ball that is too deep in a wall is pushed out, and hits another ball. If the impact returned it into the wall, this
// would repeat in each step: it kept 0.3 to 1.3 m/s for ever.
TEST(PileScene, RestsThoughABallIsPushedFromOneOverlapIntoAnother) {
  const auto fastest = [](const std::string& bodies, const std::string& seed, double h, double time) {
    return run_of("pile", {{"bodies", bodies}, {"seed", seed}}, h, time).last("fastest centre [m/s]");
  };
  for (const std::string seed : {"3", "4", "9", "11", "14", "17", "20"})
    for (const std::string bodies : {"4", "6"})
      EXPECT_LE(fastest(bodies, seed, 1.0 / 30, 4), 1e-3) << bodies << " balls, seed " << seed;
  // Here one ball may roll for long, since nothing resists rolling: at 0.02 m/s.
  EXPECT_LE(fastest("20", "2", 1.0 / 60, 6), 0.05);
}

// A box and a capsule that fall on a frictionless floor: what they get must not depend on a sideways velocity, nor on how
// late the step finds the impact. u = -3 m/s, J = (1 + e) |u| / (1/m + (r x n)²/I), Eq. (7.2).
TEST(Impacts, OfLateCornersDoNotDependOnASidewaysVelocity) {
  const double h = 1.0 / 60, u = 3, e = 0.5;
  for (const bool capsule : {false, true})
    for (const double late : {0.02, 0.5, 0.98})
      for (const double sideways : {0.0, 3.0, 10.0}) {
        World<6> world({.gravity = Vec3::Zero(), .impacts = ImpactLaw{.restitution = e, .friction = 0}});
        world.add_plane(Vec3::UnitZ(), 0);
        const double angle = 0.4;
        const Quat q(Eigen::AngleAxisd(angle, Vec3::UnitY()));
        Body<6> body{.v = Vec3(sideways, 0, -u), .mass = 1, .q = q};
        Vec3 lowest;  // from the centre
        if (capsule) {
          body.radius = 0.1;
          body.half_length = 0.2;
          lowest = q * Vec3(0, 0, -0.2) - Vec3(0, 0, 0.1);
        } else {
          body.half_sides = Vec3(0.1, 0.1, 0.2);
          lowest = q * Vec3(0.1, 0, -0.2);
        }
        // A step moves it, and the next one finds it `late` of a step too deep.
        body.x = Vec3(0, 0, -lowest.z() + (1 - late) * u * h);
        const int n = world.add(body);
        const double I = 1 / world.bodies().orientations.inverse_inertia(1)(1, 1);
        const double arm = lowest.x(), J = (1 + e) * u / (1 + arm * arm / I);
        for (int step = 0; step < 2; ++step) world.step(h);
        const std::string what = (capsule ? "a capsule, " : "a box, ") + std::to_string(late) + " late, at " +
                                 std::to_string(sideways) + " m/s";
        // The corners of a box are two, along y, which share the impulse.
        EXPECT_NEAR(world.v(n).z(), -u + J, 1e-9) << what;
        EXPECT_NEAR(angular_velocity(world, n).y(), -arm * J / I, 1e-9 / I) << what;
        EXPECT_NEAR(world.v(n).x(), sideways, 1e-12) << what;
      }
}

TEST(Impacts, AreOfBodiesThatApproach) {
  // An impact needs 0.16 m/s, which gravity adds in a step. Two steps ago, the longest delay, a corner with less than
  // twice as much went up.
  int impacts = 0;
  for (const double speed : {0.1, 0.2, 0.25, 0.3, 0.5, 2.0})
    for (const double depth : {1e-4, 1e-3, 1e-2, 0.1})
      for (const double spin : {0.0, 0.3, -1.0}) {
        World<6> world({.impacts = ImpactLaw{.restitution = 0.5}});
        world.add_plane(Vec3::UnitZ(), 0);
        world.add({.x = Vec3(0, 0, 0.5 - depth),
                   .v = Vec3(0, 0, -speed),
                   .omega = Vec3(0, spin, 0),
                   .half_sides = Vec3::Constant(0.5)});
        world.step(1.0 / 60);
        for (const Impact& impact : world.impacts())
          EXPECT_GT(impact.speed, 0) << speed << ' ' << depth << ' ' << spin;
        impacts += static_cast<int>(world.impacts().size());
      }
  EXPECT_GT(impacts, 20);
}

// The force of an earlier contact says nothing about a new one. 1000 N would allow 3.2 m/s without an impact.
TEST(Impacts, ForgetTheForceOfAContactThatHasEnded) {
  double pressed = 1000;
  World<3> world({.force = [&](std::size_t body,
                               const std::vector<Vec3>&) { return Vec3(0, 0, body == 1 ? -pressed : 0); },
                  .k = 1e5,
                  .impacts = ImpactLaw{.restitution = 0.5}});
  world.add_plane(Vec3::UnitZ(), 0);
  const int ball = world.add({.x = Vec3(0, 0, 0.1), .mass = 1, .radius = 0.1});
  for (int step = 0; step < 500; ++step) world.step(0.001);
  pressed = 0;
  world.place(ball, Vec3(0, 0, 0.3), Vec3::Zero());  // it falls at up to 2 m/s
  int impacts = 0;
  for (int step = 0; step < 300; ++step) {
    world.step(0.001);
    impacts += world.report().impacts;
  }
  EXPECT_EQ(impacts, 1);
}

// A contact at the bottom carries the balls above, so its spring throws its own two faster than their weight does. If
// that were impacts, forces of many weights would stay unbalanced: nine of them after 4 s.
TEST(PileScene, RestsOnSoftSpringsInShortSteps) {
  for (const std::string seed : {"1", "2", "3"})
    for (const double h : {0.002, 0.001}) {
      const SceneRun run = run_of("pile", {{"seed", seed}}, h, 4);
      EXPECT_EQ(run.last("impacts"), 0) << "seed " << seed << ", h " << exact_text(h);
      EXPECT_LE(run.error, 0.1) << "seed " << seed << ", h " << exact_text(h);
    }
}

// Steps so long and sweeps so few leave deep overlaps. No contact of a heap's tilted boxes is a ghost: if one is left out,
// its bodies sink in until it is back, and are thrown. They kept more than 0.6 J in this way.
TEST(PileScene, OfBoxesComesToRestWithFewSweeps) {
  for (const std::string seed : {"1", "2", "3"}) {
    const SceneSettings boxes = {{"bodies", "100"},    {"shape", "box"}, {"k", "1e6"},
                                 {"restitution", "0"}, {"d", "1"},       {"seed", seed}};
    const SceneRun run = run_of("pile", boxes, 1.0 / 30, 3, {.max_sweeps = 20}, "gauss_seidel");
    EXPECT_LE(run.last("kinetic energy [J]"), 0.2) << "seed " << seed;
  }
}

TEST(PileScene, WithoutFrictionNothingMovesInTheEnd) {
  const SceneRun run = run_of("pile", {{"bodies", "12"}, {"mu", "0"}, {"seed", "7"}}, 0.01, 6);
  EXPECT_LE(run.last("fastest centre [m/s]"), 1e-6);
  EXPECT_NEAR(run.last("floor's load over the weight"), 1, 1e-6);
}

TEST(PileScene, HasImpactsOnlyWhereItBounces) {
  const auto most = [](const std::string& restitution) {
    const SceneRun run = run_of("pile", {{"bodies", "12"}, {"restitution", restitution}}, 0.01, 4);
    EXPECT_NEAR(run.last("floor's load over the weight"), 1, 1e-3) << "with restitution " << restitution;
    const std::vector<double>& impacts = run.all("impacts");
    return *std::max_element(impacts.begin(), impacts.end());
  };
  EXPECT_EQ(most("0"), 0) << "rows hold contacts that do not bounce";
  EXPECT_GT(most("0.2"), 0);
}

TEST(PileScene, IsTheSameForTheSameSeed) {
  const auto energies = [](const std::string& seed) {
    return run_of("pile", {{"bodies", "8"}, {"seed", seed}}, 0.01, 0.5).all("kinetic energy [J]");
  };
  EXPECT_EQ(energies("3"), energies("3"));
  EXPECT_NE(energies("3"), energies("4"));
}

// all of them

TEST(FrictionAndImpactScenes, GiveANumberForWhateverIsAllowed) {
  for (const std::string name :
       {"incline", "sliding_block", "slide_to_roll", "spinning_disc", "bouncing_ball", "cradle", "pile"}) {
    const SceneDescription& scene = find_scene(name);
    for (const Parameter& parameter : scene.parameters)
      for (const double value : {0.0, 1e-9, 1e-3, 0.5, 1.0, 8.0, 1e3, 1e9}) {
        if (!parameter.choices.empty() || !parameter.limits.allow(value)) continue;
        if (parameter.limits.whole && value > 100) continue;  // allowed, but slow
        SCOPED_TRACE(name + " " + parameter.name + "=" + exact_text(value));
        try {
          const SceneRun run = run_of(name, {{parameter.name, exact_text(value)}}, scene.h, 12 * scene.h);
          EXPECT_GE(run.error, 0);
          for (const auto& [column, values] : run.columns)
            for (const double each : values) EXPECT_FALSE(std::isnan(each)) << column;
        } catch (const std::invalid_argument&) {
        } catch (const SimulationDiverged&) {
        }
      }
  }
}

}  // namespace
}  // namespace spook::impact_scenes_test
