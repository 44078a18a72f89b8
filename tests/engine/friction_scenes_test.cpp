// Blocks, spheres and discs that slide on a plane, against chapter 05's formulas, and those against independent
// results.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "checks.hpp"
#include "scene_runs.hpp"
#include "scenes/braking.hpp"
#include "scenes/degrees.hpp"
#include "scenes/disc.hpp"

namespace spook::friction_scenes_test {
namespace {

constexpr double epsilon = 2.2e-16;
constexpr double g = 9.81;

// Four corners on soft contacts: a thousand sweeps distribute the load to round-off; on stiff ones they do not.
const SceneSettings a_point = {{"model", "point"}}, a_soft_box = {{"model", "box"}, {"k", "1e4"}};
const StopRule patient = {.max_sweeps = 1000, .tolerance = 1e-15};

SceneSettings operator+(SceneSettings a, const SceneSettings& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// incline

TEST(InclineScene, SticksFromTanThetaOnAndSlidesBelow) {
  const double h = 1.0 / 60, time = 1;
  for (const SceneSettings& model : {a_point, a_soft_box})
    for (const double angle : {1.0, 20.0, 45.0, 70.0}) {
      // With μ a little too small it slides by this fraction of the way without friction.
      const double part = 1e-6;
      const auto moved = [&](double mu) {
        const SceneSettings settings =
            model + SceneSettings{{"mu", exact_text(mu)}, {"angle", exact_text(angle)}};
        const SceneRun run = run_of("incline", settings, h, time, patient);
        return run.last("x [m]") / (g * std::sin(radians(angle)) * time * time / 2);
      };
      SCOPED_TRACE(model.front().second + ", angle " + exact_text(angle));
      const double enough = std::tan(radians(angle));
      // Far below: the creep, and the settling of the box, which starts right to first order in its pitch.
      EXPECT_NEAR(moved(enough * (1 + part)), 0, 0.01 * part);
      EXPECT_NEAR(moved(enough * (1 - part)), part, 0.01 * part);
    }
}

TEST(InclineScene, SlidesWithItsAccelerationToRoundings) {
  const double h = 1.0 / 60, time = 2;
  for (const SceneSettings& model : {a_point, SceneSettings{{"model", "box"}}})
    for (const std::string mu : {"0", "0.1", "0.5"})
      for (const std::string angle : {"27", "45", "80"})
        for (const std::string m : {"0.01", "1", "100"})
          // Each step rounds x and v a few times, at their final size.
          EXPECT_LE(error_of("incline", model + SceneSettings{{"mu", mu}, {"angle", angle}, {"m", m}}, h, time),
                    4 * 120 * epsilon)
              << model.front().second << ", mu " << mu << ", angle " << angle << ", m " << m;
}

TEST(InclineScene, UnshiftedStartIsOfFirstOrder) {
  const auto error = [](double h) { return error_of("incline", {{"start", "unshifted"}}, h, 2); };
  testing::expect_order("incline, unshifted", "Eq. (1.5)", error, 0.04, 3, 1, 0.01);
}

TEST(InclineScene, CreepsAtTheLoadOverTheViscosityOfItsContacts) {
  const double h = 0.01, time = 5, c = 1e3;
  const double load = g * std::sin(radians(20));
  const auto speed = [&](const SceneSettings& model) {
    const SceneSettings settings = model + SceneSettings{{"angle", "20"}, {"viscosity", exact_text(c)}};
    const SceneRun run = run_of("incline", settings, h, time, {.max_sweeps = 10'000, .tolerance = 1e-15});
    return run.last("v at t - h/2 [m/s]");
  };
  EXPECT_NEAR(speed(a_point), load / c, 1e-9 * load / c) << "Eq. (5.5)";
  // Four contacts. Of the box's load, round-off of the pitch (1e-4, squared) may go elsewhere.
  EXPECT_NEAR(speed(a_soft_box), load / (4 * c), 1e-6 * load / c);
}

TEST(InclineScene, DoesNotCreepInTenThousandSteps) {
  // The contacts are so soft that fifty sweeps reach round-off on four of them, too.
  const double h = 1.0 / 60, load = g * std::sin(radians(26.5));
  for (const SceneSettings& model : {a_point, SceneSettings{{"model", "box"}, {"k", "100"}}}) {
    const SceneRun run = run_of("incline", model + SceneSettings{{"angle", "26.5"}}, h, 10'000 * h);
    const std::vector<double>& x = run.all("x [m]");
    const double creep = load / 1e12 * 9'900 * h;  // after a hundred steps, in which the box settles
    EXPECT_LE(std::abs(x.back() - x[100]), 1.001 * creep) << model.front().second;
  }
}

TEST(InclineScene, RefusesABoxThatWouldTipOver) {
  const SceneDescription& incline = find_scene("incline");
  const auto build = [&](const SceneSettings& settings) {
    incline.build(with(incline, settings), {.h = 0.01});
  };
  // base/height is 2: it tips over where both tan θ and mu are above.
  const SceneSettings high = {{"height", "0.5"}, {"model", "box"}};
  EXPECT_NO_THROW(build(high + SceneSettings{{"angle", "70"}, {"mu", "1.99"}}));
  EXPECT_NO_THROW(build(high + SceneSettings{{"angle", "63.4"}, {"mu", "9"}}));
  EXPECT_NO_THROW(build({{"height", "0.5"}, {"angle", "70"}, {"mu", "9"}})) << "a point cannot";
  try {
    build(high + SceneSettings{{"angle", "70"}, {"mu", "2.01"}});
    ADD_FAILURE() << "nothing was thrown";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("height must be at most 0.4975"), std::string::npos)
        << error.what();
  }
}

TEST(InclineScene, ThatBlowsUpNamesStepAndBodyAndLeavesWhatWasWritten) {
  const SceneDescription& incline = find_scene("incline");
  std::ostringstream csv;
  try {
    run(incline, with(incline, {{"g", "1e306"}}), {.method = {.h = 1}, .time = 1000}, {.csv = &csv});
    ADD_FAILURE() << "no SimulationDiverged";
  } catch (const SimulationDiverged& diverged) {
    EXPECT_EQ(diverged.body(), 1) << "the block; 0 is the slope";
    const std::string text = csv.str();
    // The columns, the start, and every step before that one.
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1 + diverged.step());
    EXPECT_GT(diverged.step(), 10);
    EXPECT_EQ(text.find("nan"), std::string::npos);
  }
}

// sliding_block

TEST(Heading, IsExactAlongTheAxes) {
  EXPECT_EQ(heading(0), Vec3(1, 0, 0));
  EXPECT_EQ(heading(90), Vec3(0, 1, 0));
  EXPECT_EQ(heading(-180), Vec3(-1, 0, 0));
  EXPECT_EQ(heading(630), Vec3(0, -1, 0));
  EXPECT_LE((heading(45) - Vec3(1, 1, 0).normalized()).norm(), 2 * epsilon);
}

/// The distance of the time `stops`, when a motion ends, from the nearest step [s].
double to_nearest_step(double stops, double h) {
  return std::abs(stops - h * std::round(stops / h));
}

TEST(SlidingBlockScene, IsOffByWhatTheLastStepMisses) {
  const double v0 = 3, mu = 0.5, stops = v0 / (mu * g), scale = v0 * stops / 2;
  for (const double h : {0.1, 0.04, 0.01, 1.0 / 60, 0.003}) {
    const double off = mu * g * std::pow(to_nearest_step(stops, h), 2) / 2;
    EXPECT_NEAR(error_of("sliding_block", {}, h, 1.2), off / scale, 1e-11) << "h " << h;
    // Far from an axis each component stops at its own time.
    for (const double heading : {30.0, 225.0, -80.0}) {
      const double x =
          mu * g * std::pow(to_nearest_step(std::abs(std::cos(radians(heading))) * stops, h), 2) / 2;
      const double y =
          mu * g * std::pow(to_nearest_step(std::abs(std::sin(radians(heading))) * stops, h), 2) / 2;
      const SceneSettings settings = {{"answer", "box"}, {"heading", exact_text(heading)}};
      EXPECT_NEAR(error_of("sliding_block", settings, h, 1.2), std::hypot(x, y) / scale, 1e-11)
          << "h " << h << ", heading " << heading;
    }
  }
}

TEST(SlidingBlockScene, IsOfSecondOrder) {
  // It stops a third of a step from the nearest one, for every halving.
  const double stops = 3 / (0.5 * g), coarsest = stops / (10 + 1.0 / 3);
  const auto error = [](const SceneSettings& settings) {
    return [=](double h) { return error_of("sliding_block", settings, h, 1); };
  };
  testing::expect_order("sliding_block", "Eq. (5.10)", error({}), coarsest, 4, 2, 0.01);
  // The pitch of the box vanishes when it stops, which moves the centre by 1e-7 m.
  testing::expect_order("sliding_block, box", "Eq. (5.10)", error({{"model", "box"}}), coarsest, 2, 2, 0.05);
  testing::expect_order("sliding_block, unshifted", "Eq. (1.5)", error({{"start", "unshifted"}}), coarsest, 3,
                        1, 0.1);
}

TEST(SlidingBlockScene, StopsTooSoonByItsHeading) {
  const double v0 = 3, mu = 0.5, h = 0.002;
  const double stops = v0 / (mu * g), distance = v0 * stops / 2;
  for (const std::string model : {"point", "box"})
    for (double degrees = -90; degrees <= 180; degrees += 15) {
      const SceneRun run = run_of(
          "sliding_block", {{"model", model}, {"heading", exact_text(degrees)}, {"answer", "box"}}, h, 0.8);
      const double c = std::cos(radians(degrees)), s = std::sin(radians(degrees));
      SCOPED_TRACE(model + ", heading " + exact_text(degrees));
      EXPECT_NEAR(run.last("moving for [s]"), std::max(std::abs(c), std::abs(s)) * stops, h) << "Eq. (5.12)";
      EXPECT_NEAR(run.last("distance [m]"), std::sqrt(std::pow(c, 4) + std::pow(s, 4)) * distance,
                  mu * g * h * h / 4 + 1e-6)
          << "Eq. (5.13)";
      EXPECT_LE(run.error, 1e-5);
      EXPECT_NEAR(run.last("x [m]"), c * std::abs(c) * distance, mu * g * h * h / 4 + 1e-6) << "it bends";
    }
}

TEST(SlidingBlockScene, CoulombIsMissedDiagonallyByTheBoxOnly) {
  EXPECT_NEAR(error_of("sliding_block", {{"heading", "45"}}, 0.001, 1), 1 - std::sqrt(0.5), 1e-5)
      << "Eq. (5.13)";
  for (const std::string heading : {"0", "90", "180", "-90", "3600"})
    EXPECT_LE(error_of("sliding_block", {{"heading", heading}}, 0.001, 1), 1e-6) << heading;
}

TEST(SlidingBlockScene, DoesNotDependOnItsMass) {
  for (const std::string model : {"point", "box"}) {
    // Contacts with stiffness and viscosity in proportion to the mass: the same pitch and the same creep.
    const double light = run_of("sliding_block", {{"model", model}}, 0.01, 1).last("x [m]");
    const double heavy =
        run_of("sliding_block", {{"model", model}, {"m", "1000"}, {"k", "1e9"}, {"viscosity", "1e15"}}, 0.01, 1)
            .last("x [m]");
    EXPECT_NEAR(light, heavy, 1e-12);
  }
}

TEST(Braking, AgreesWithAnIntegration) {
  const Braking brake{3, 2.5};
  double x = 0, v = 3;
  const double dt = 1e-5;
  for (int n = 1; n <= 200'000; ++n) {
    const double before = v;
    v = std::max(0.0, v - 2.5 * dt);
    x += dt * (before + v) / 2;
    if (n % 10'000) continue;
    EXPECT_NEAR(brake.v(n * dt), v, 1e-9);
    EXPECT_NEAR(brake.way(n * dt), x, 1e-9);
  }
  EXPECT_EQ((Braking{3, 0}.way(7)), 21);
}

// slide_to_roll

TEST(SlideToRollScene, AgreesWithAnIntegrationOfCoulombsLaw) {
  // v' = -μg and Rω' = (5/2) μg while it slips, by steps so small that the end of slipping does not matter.
  const double v0 = 3, mu = 0.2, dt = 1e-6;
  double v = v0, surface = 0, x = 0, t = 0;
  while (v > surface) {
    x += dt * v;
    v -= mu * g * dt;
    surface += 2.5 * mu * g * dt;
    t += dt;
  }
  const SceneRun run = run_of("slide_to_roll", {}, 0.001, 0.8);
  EXPECT_NEAR(run.last("x [m]"), x + v * (0.8 - t), 1e-5);
  EXPECT_NEAR(run.last("v at t - h/2 [m/s]"), v, 1e-5);
}

TEST(SlideToRollScene, RollsWithFiveSeventhsAndIsOffByWhatTheLastStepMisses) {
  const double v0 = 3, mu = 0.2, rolls = 2 * v0 / (7 * mu * g), slid = 12 * v0 * v0 / (49 * mu * g);
  for (const double h : {0.05, 0.01, 1.0 / 60, 0.003})
    for (const std::string m : {"1", "50"})
      for (const std::string radius : {"0.5", "0.02"}) {
        const SceneRun run = run_of("slide_to_roll", {{"m", m}, {"radius", radius}}, h, 1);
        const double off = mu * g * std::pow(to_nearest_step(rolls, h), 2) / 2;
        SCOPED_TRACE("h " + exact_text(h) + ", m " + m + ", radius " + radius);
        EXPECT_NEAR(run.error, off / slid, 1e-10);
        EXPECT_NEAR(run.last("v at t - h/2 [m/s]"), v0 * 5 / 7, 1e-10);
        EXPECT_NEAR(run.last("slip at t - h/2 [m/s]"), 0, 1e-10);
      }
}

TEST(SlideToRollScene, IsOfSecondOrder) {
  const double coarsest = 2 * 3 / (7 * 0.2 * g) / (10 + 1.0 / 3);
  const auto error = [](const SceneSettings& settings) {
    return [=](double h) { return error_of("slide_to_roll", settings, h, 1); };
  };
  testing::expect_order("slide_to_roll", "Eq. (5.11)", error({}), coarsest, 4, 2, 0.01);
  testing::expect_order("slide_to_roll, unshifted", "Eq. (1.5)", error({{"start", "unshifted"}}), coarsest, 3,
                        1, 0.1);
}

// spinning_disc

/// The error of a mean over n equal angles, over 4/π: Σ_q 2/(n² q² - 1), q = 1, 2, …
double left_by_angles(int n) {
  return 1 - pi / n / std::tan(pi / n);
}

TEST(DiscPoints, HaveTheDiscsMeanDistanceAndNearlyItsMeanOfAngles) {
  const double R = 0.7;
  for (const int rings : {1, 2, 5})
    for (const int points : {4, 8, 16, 60}) {
      const std::vector<Vec3> all = disc_points(R, rings, points);
      ASSERT_EQ(all.size(), static_cast<std::size_t>(rings * points));
      for (double turn = 0; turn < 90; turn += 3.7) {
        const Vec3 along = heading(turn), across(-along.y(), along.x(), 0);
        double distance = 0, box = 0;
        Vec3 sum = Vec3::Zero(), push = Vec3::Zero();
        for (const Vec3& p : all) {
          distance += p.norm() / static_cast<double>(all.size());
          box += (std::abs(p.dot(along)) + std::abs(p.dot(across))) / static_cast<double>(all.size());
          sum += p;
          for (const Vec3& t : {along, across})
            if (std::abs(p.dot(t)) > 1e-12) push += std::copysign(1, p.dot(t)) * t;
        }
        EXPECT_NEAR(distance, 2 * R / 3, 1e-14);
        EXPECT_NEAR(box / distance, 4 / pi, 4 / pi * left_by_angles(points) + 1e-14)
            << rings << " rings of " << points;
        EXPECT_LE(sum.norm(), 1e-12);
        EXPECT_LE(push.norm(), 1e-12) << "sideways";
      }
    }
}

TEST(DiscPoints, LieWithinRingsOfEqualArea) {
  const std::vector<Vec3> all = disc_points(1, 4, 8);
  for (int ring = 0; ring < 4; ++ring)
    for (int point = 0; point < 8; ++point) {
      const double area = all[static_cast<std::size_t>(8 * ring + point)].squaredNorm();
      EXPECT_GT(area, ring / 4.0);
      EXPECT_LT(area, (ring + 1) / 4.0);
    }
}

TEST(SpinningDiscScene, TorquesAreThoseOfAQuadrature) {
  // ∫ r dr dφ of the pressure, over the area: r times 1, or times |sin φ| + |cos φ|.
  const double R = 0.5, mu = 0.5, w0 = 10;
  const int n = 1000;
  double coulomb = 0, box = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double r = (i + 0.5) * R / n, phi = (j + 0.5) * 2 * pi / n, area = r * (R / n) * (2 * pi / n);
      coulomb += mu * g / (pi * R * R) * r * area;
      box += mu * g / (pi * R * R) * r * (std::abs(std::sin(phi)) + std::abs(std::cos(phi))) * area;
    }
  for (const auto& [law, torque] : {std::pair("coulomb", coulomb), std::pair("box", box)}) {
    const SceneRun run = run_of("spinning_disc", {{"answer", law}}, 0.01, 0.3);
    EXPECT_NEAR(run.last("answer [rad/s]"), w0 - torque / (R * R / 2) * 0.3, 1e-4) << law << ", Eq. (5.14)";
  }
}

TEST(SpinningDiscScene, IsStoppedByTheBoxAfterPiOver4OfCoulombsTime) {
  const double h = 0.01, coulomb = 3 * 0.5 * 10 / (4 * 0.5 * g);
  for (const int points : {4, 8, 16}) {
    const SceneRun run = run_of("spinning_disc", {{"points", std::to_string(points)}}, h, 1);
    EXPECT_LE(run.error, left_by_angles(points)) << points << " points";
    EXPECT_NEAR(run.last("spinning for [s]"), pi / 4 * coulomb, h + left_by_angles(points) * coulomb);
    EXPECT_LE(run.last("off the centre [m]"), 1e-6) << "no force acts sideways";
  }
  EXPECT_NEAR(error_of("spinning_disc", {{"answer", "coulomb"}}, h, 1), 1 - pi / 4, left_by_angles(16));
  // (On still softer contacts: a longer step needs more sweeps.)
  for (const double any_h : {0.04, 0.02, 0.005})
    EXPECT_LE(error_of("spinning_disc", {{"k", "1e3"}}, any_h, 1), left_by_angles(16)) << "h " << any_h;
}

TEST(SpinningDiscScene, RefusesPointsThatAreNotSymmetric) {
  const SceneDescription& disc = find_scene("spinning_disc");
  for (const std::string points : {"5", "6", "7"}) try {
      disc.build(with(disc, {{"points", points}}), {.h = 0.01});
      ADD_FAILURE() << "nothing was thrown";
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find("points must be a multiple of 4"), std::string::npos);
      EXPECT_NE(std::string(error.what()).find("is " + points), std::string::npos);
    }
}

}  // namespace
}  // namespace spook::friction_scenes_test
