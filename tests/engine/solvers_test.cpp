// Solvers by one signature: each by its name, one within another, copies, and combinations that are refused.
#include "engine/solvers/registry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "12_stiff_wires/stiff_wires.hpp"
#include "engine/solvers/factor_cost.hpp"
#include "engine/solvers/small_direct.hpp"
#include "engine/world/world.hpp"
#include "raw_system.hpp"
#include "refusals.hpp"
#include "scenes/method.hpp"

namespace spook::solvers_test {
namespace {

constexpr double h = 1.0 / 60, g = 9.81, k = 1e6, rigid = 1e12, radius = 0.5;
const StopRule to_the_end{.max_sweeps = 200'000, .tolerance = 1e-14};

/// A point mass that is pushed along a floor, and others on top of it: three rows each, μ = 0.5.
struct RoughSystem {
  std::vector<Row<3>> rows;
  std::vector<Twist<3>> V;
  std::vector<FrictionContact> friction;
  Motion<3> motion;

  explicit RoughSystem(double bound, int masses = 2) : V(masses + 1, Twist<3>::Zero()) {
    motion.inverse_mass = {{.linear = 0}};
    motion.Wf = {Vec3::Zero()};
    motion.W.assign(V.size(), Twist<3>::Zero());
    for (int i = 0; i < masses; ++i) {
      motion.inverse_mass.push_back({.linear = 1});
      motion.Wf.push_back(h * (i % 2 == 0 ? Vec3(3, 1, -g) : Vec3(-1, 2, -g)));
      const Contact contact{
          .i = i, .j = i + 1, .n = Vec3::UnitZ(), .gap = 0, .r_i = Vec3::Zero(), .r_j = Vec3::Zero()};
      friction.push_back({.normal = rows.size(), .mu = 0.5});
      rows.push_back(make_row(contact_constraint<3>(contact, spook_parameters(h, rigid, 3)), motion));
      for (const Constraint<3>& row :
           friction_constraints<3>(contact, tangents(contact.n), bound, friction_parameters(h, 1e9)))
        rows.push_back(make_row(row, motion));
    }
  }

  std::vector<double> impulses() const {
    std::vector<double> all;
    for (const Row<3>& row : rows) all.push_back(row.lambda);
    return all;
  }
};

/// The result of `solver` for rows with such bounds of friction.
std::vector<double> by(const Solver<3>& solver, double bound, const StopRule& stop = {}, int masses = 2) {
  RoughSystem s(bound, masses);
  solve_by(solver, s.motion, s.rows, s.V, stop, s.friction);
  return s.impulses();
}

TEST(Solvers, AreTheirChaptersFunctions) {
  constexpr int many = 11;  // more rows than the few that have dense factors
  static_assert(3 * many > most_dense_rows);
  RoughSystem swept(0.1), conjugate(0.1), direct_(0.1, many), on_cones(infinity), twice(0);
  solve(swept.rows, swept.V, {});
  conjugate_solve(conjugate.rows, conjugate.V, {});
  Factors factors;
  direct_solve(direct_.rows, direct_.V, {}, factors);
  cone_solve(on_cones.friction, on_cones.rows, on_cones.V, {});
  two_pass_solve(twice.friction, twice.rows, twice.V, {});
  EXPECT_EQ(by(gauss_seidel<3>(), 0.1), swept.impulses());
  EXPECT_EQ(by(conjugate_gradients<3>(), 0.1), conjugate.impulses());
  EXPECT_EQ(by(direct<3>(), 0.1, {}, many), direct_.impulses());
  EXPECT_EQ(by(automatic<3>(FrictionModel::box), 0.1, {}, many), direct_.impulses())
      << "so small an island gets the direct solver";
  EXPECT_EQ(by(cone_gauss_seidel<3>(), infinity), on_cones.impulses());
  EXPECT_EQ(by(two_pass(gauss_seidel<3>()), 0), twice.impulses());
}

TEST(Solvers, TwoPassesTakeAnyOther) {
  // One on the other, both slide: the second pass has limits of μ times the first pass's impulses, h g and 2 h g.
  const std::vector<double> sweeps = by(two_pass(gauss_seidel<3>()), 0, to_the_end);
  EXPECT_NEAR(sweeps[0], 2 * h * g, 1e-8);
  EXPECT_GT(std::abs(sweeps[1]) + std::abs(sweeps[2]), 0.01) << "they have friction";
  for (const Solver<3>& inner : {conjugate_gradients<3>(), direct<3>(), automatic<3>(FrictionModel::box),
                                 ordered_gauss_seidel<3>(RowOrder::random, 4)}) {
    const std::vector<double> other = by(two_pass(inner), 0, to_the_end);
    for (std::size_t row = 0; row < sweeps.size(); ++row) EXPECT_NEAR(other[row], sweeps[row], 1e-12);
  }
  RoughSystem s(0);
  const SolverResult result = solve_by(two_pass(direct<3>()), s.motion, s.rows, s.V, {}, s.friction);
  EXPECT_EQ(result.row_updates, 0) << "neither pass sweeps";
  EXPECT_GE(result.report.history.size(), 2U) << "a factorisation each, at least";
  RoughSystem smooth(0);
  EXPECT_EQ(
      solve_by(two_pass(gauss_seidel<3>()), smooth.motion, smooth.rows, smooth.V, {.max_sweeps = 3}).updates(6),
      3 * 6)
      << "without friction there is one pass";
}

/// A mass whose friction also lifts it, as at the corner of a body that may turn.
struct LiftingSystem {
  std::vector<Row<3>> rows;
  std::vector<Twist<3>> V = {Twist<3>::Zero(), Twist<3>::Zero()};
  Motion<3> motion{.inverse_mass = {{.linear = 0}, {.linear = 1}}, .W = V, .Wf = V};

  LiftingSystem() {
    for (const Vec3& G : {Vec3(0, 0, 1), Vec3(1, 0, 0.5), Vec3(0, 1, 0)})
      rows.push_back({.i = 0,
                      .j = 1,
                      .Gi = -G,
                      .Gj = G,
                      .MinvGi = Vec3::Zero(),
                      .MinvGj = G,
                      .B = rows.empty() ? 1.0 : -2.0,
                      .Sigma = 1e-9,
                      .diagonal = G.squaredNorm() + 1e-9,
                      .lo = 0,
                      .hi = rows.empty() ? infinity : 0});
  }
};

TEST(Solvers, TwoPassesForgetTheLimitsOfAnEarlierSolve) {
  // A step solves the same rows twice where overlaps recover. The first pass of both has no friction.
  LiftingSystem s;
  const Solver<3> solver = two_pass(gauss_seidel<3>());
  const auto solve_once = [&] {
    solve_by(solver, s.motion, s.rows, s.V, to_the_end, {{.normal = 0, .mu = 0.5}});
    EXPECT_NEAR(s.rows[1].hi, 0.5, 1e-8) << "μ times what carries the mass without friction";
    return s.rows;
  };
  const std::vector<Row<3>> first = solve_once(), second = solve_once();
  for (std::size_t row = 0; row < 3; ++row) EXPECT_NEAR(second[row].lambda, first[row].lambda, 1e-8);
  EXPECT_GT(std::abs(first[1].lambda), 0.1) << "it has friction";
}

TEST(Solvers, ColoursAndBlocksEndWhereSweepsRowByRowDo) {
  for (const int masses : {1, 2, 7}) {
    const auto expect_same = [&](const Solver<3>& solver, const Solver<3>& known, double bound) {
      const std::vector<double> got = by(solver, bound, to_the_end, masses),
                                expected = by(known, bound, to_the_end, masses);
      for (std::size_t row = 0; row < expected.size(); ++row)
        EXPECT_NEAR(got[row], expected[row], 1e-11) << "row " << row << " of " << masses << " masses";
    };
    expect_same(colours<3>(FrictionModel::box), gauss_seidel<3>(), 0.1);
    expect_same(colours<3>(FrictionModel::cone), cone_gauss_seidel<3>(), infinity);
    expect_same(blocks<3>(), cone_gauss_seidel<3>(), infinity);
    expect_same(two_pass(colours<3>(FrictionModel::box)), two_pass(gauss_seidel<3>()), 0);
  }
}

// All four contacts of one pair are in one lane, in their order. So sweeps are the same one by one, up to round-off.
TEST(Solvers, ColoursSweepTheContactsOfAPairInTheirOrder) {
  const auto impulses = [](Solver<6> solver, double mu) {
    World<6> world({.friction = mu, .solver = std::move(solver), .solver_limits = {.max_sweeps = 5}});
    world.add_plane(Vec3::UnitZ(), 0);
    world.add({.x = Vec3(0, 0, 0.499),
               .v = Vec3(1, 0.3, 0),
               .omega = Vec3(0, 0, 2),
               .half_sides = Vec3(0.7, 0.4, 0.5)});
    world.step(h);
    std::vector<double> all;
    for (const Row<6>& row : world.rows()) all.push_back(row.lambda);
    return all;
  };
  for (const double mu : {0.0, 0.1, 0.9}) {
    const std::vector<double> row_by_row = impulses(cone_gauss_seidel<6>(), mu),
                              in_lanes = impulses(colours<6>(FrictionModel::cone), mu);
    ASSERT_EQ(row_by_row.size(), mu > 0 ? 12U : 4U);
    ASSERT_EQ(in_lanes.size(), row_by_row.size());
    for (std::size_t row = 0; row < row_by_row.size(); ++row)
      EXPECT_NEAR(in_lanes[row], row_by_row[row], 1e-12) << "row " << row << ", mu = " << mu;
  }
}

TEST(Solvers, SayWhichLimitsTheirRowsComeWith) {
  for (const NamedSolver<3>& named : solvers<3>()) {
    EXPECT_EQ(named.make_on_box().friction, FrictionModel::box) << named.name;
    if (!named.make_on_cones) continue;
    EXPECT_EQ(named.make_on_cones().friction, FrictionModel::cone) << named.name;
  }
  EXPECT_EQ(Settings<6>{}.solver.friction, FrictionModel::cone) << "default friction is Coulomb's";
  EXPECT_EQ(cone_gauss_seidel<6>().friction, FrictionModel::cone);
  EXPECT_EQ(two_pass(direct<6>()).friction, FrictionModel::two_pass);
  EXPECT_EQ(geometric_stiffness(cone_gauss_seidel<3>()).friction, FrictionModel::cone);
}

TEST(Solvers, MayBeWrittenByTheUser) {
  // A floor with half the impulse: a solver may change the system in any way.
  World<3> world({.k = rigid, .solver = {.solve = [](const SolverInput<3>& s) {
                                SolverResult result = gauss_seidel<3>().solve(s);
                                for (Row<3>& row : s.rows()) row.lambda /= 2;
                                for (Twist<3>& V : s.V) V /= 2;
                                EXPECT_EQ(s.contacts.size(), s.rows().size());
                                EXPECT_EQ(s.bodies.size(), s.V.size());
                                EXPECT_EQ(s.h, h);
                                return result;
                              }}});
  world.add_plane(Vec3::UnitZ(), 0);
  world.add({.x = Vec3(0, 0, radius), .radius = radius});
  world.step(h);
  EXPECT_NEAR(world.v(1).z(), -h * g / 2, 1e-9);
}

TEST(Solvers, RefuseWhatTheyCanNotTake) {
  expect_refusal({"two_pass", "null"}, [] { two_pass<3>({}); });
  expect_refusal({"two_pass", "friction model box", "cone"}, [] { two_pass(cone_gauss_seidel<6>()); });
  expect_refusal({"two_pass", "friction model box", "has two_pass"}, [] { two_pass(two_pass(direct<3>())); });
  const auto two_passes = FrictionModel::two_pass;
  expect_refusal({"newton", "box or cone", "two_pass"}, [&] { newton<6>(two_passes); });
  expect_refusal({"anderson", "box or cone", "two_pass"}, [&] { anderson<3>(two_passes); });
  expect_refusal({"auto", "box or cone", "two_pass"}, [&] { automatic<6>(two_passes); });
  expect_refusal({"colours", "box or cone", "two_pass"}, [&] { colours<3>(two_passes); });
  expect_refusal({"geometric_stiffness", "null"}, [] { geometric_stiffness<3>({}); });
  expect_refusal({"geometric_stiffness", "rigid"}, [] { geometric_stiffness(direct<6>()); });
}

TEST(Methods, RefuseTwoSolversAtOnce) {
  expect_refusal({"solver", "dirct", "direct"}, [] { make_solver<3>({.h = h, .solver = "dirct"}); });
  expect_refusal({"order", "solver", "gauss_seidel", "direct"},
                 [] { make_solver<3>({.h = h, .solver = "direct", .row_order = RowOrder::up}); });
  expect_refusal({"cone", "solver", "gauss_seidel", "auto", "direct"},
                 [] { make_solver<6>({.h = h, .solver = "direct", .friction_model = FrictionModel::cone}); });
  expect_refusal({"friction-model", "order", "cone"}, [] {
    make_solver<6>({.h = h, .friction_model = FrictionModel::cone, .row_order = RowOrder::down});
  });
  expect_refusal({"solver", "geometric_stiffness", "geometric_stiffness"},
                 [] { make_solver<6>({.h = h, .solver = "geometric_stiffness"}); });
}

TEST(Methods, LetFrictionFollowNormalForcesUnlessTheBoxIsAskedFor) {
  for (const std::string solver : {"gauss_seidel", "anderson", "newton", "auto"}) {
    EXPECT_EQ(make_solver<6>({.h = h, .solver = solver}).friction, FrictionModel::cone) << solver;
    for (const FrictionModel model : {FrictionModel::box, FrictionModel::two_pass, FrictionModel::cone})
      EXPECT_EQ(make_solver<6>({.h = h, .solver = solver, .friction_model = model}).friction, model) << solver;
  }
  for (const std::string solver : {"direct", "conjugate_gradients", "spatial_decomposition"})
    EXPECT_EQ(make_solver<6>({.h = h, .solver = solver}).friction, FrictionModel::two_pass) << solver;
  EXPECT_EQ(make_solver<6>({.h = h, .row_order = RowOrder::up}).friction, FrictionModel::two_pass);
}

/// A wire that swings freely beside a ball on the floor, which slides.
World<3> wire_and_ball(Solver<3> solver) {
  World<3> world({.k = k, .friction = 0.5, .viscosity = infinity, .solver = std::move(solver)});
  world.add_plane(Vec3::UnitZ(), -5);
  int last = world.add_fixed(Vec3::Zero());
  for (int point = 1; point <= 6; ++point) {
    const int next = world.add({.x = point * Vec3(0.3, 0, -0.4), .mass = point == 6 ? 100.0 : 1.0});
    world.add_joint({.i = last, .j = next, .length = 0.5});
    last = next;
  }
  world.add({.x = Vec3(9, 0, radius - 5 - g / k), .v = Vec3(1, 0, 0), .radius = radius});
  return world;
}
constexpr int load = 7, ball = 8;

TEST(StiffSolver, LeavesTheOthersToItsInnerOne) {
  // The ball is braked by μ g, as if it were alone, with any friction limits; so does the wire swing.
  World<3> smooth = wire_and_ball(geometric_stiffness(direct<3>()));
  for (int step = 0; step < 10; ++step) smooth.step(h);
  for (const Solver<3>& solver :
       {geometric_stiffness(two_pass(direct<3>())), two_pass(geometric_stiffness(direct<3>())),
        geometric_stiffness(cone_gauss_seidel<3>()),
        geometric_stiffness(ordered_gauss_seidel<3>(RowOrder::down))}) {
    World<3> world = wire_and_ball(solver);
    for (int step = 0; step < 10; ++step) world.step(h);
    EXPECT_NEAR(world.v(ball).x(), 1 - 10 * h * 0.5 * g, 1e-9);
    EXPECT_LE((world.x(load) - smooth.x(load)).norm(), 1e-12);
    EXPECT_EQ(world.report().trouble, "");
  }
}

TEST(StiffSolver, ByItsNameIsEquationTwelveSix) {
  // Step by step the result of stiff_solve for the wire's rows, with K from the impulses of the step before.
  const int points = 3;
  World<3> world({.k = k, .solver = find_solver<3>("geometric_stiffness").make_on_box()});
  world.add_fixed(Vec3::Zero());
  for (int point = 1; point <= points; ++point) {
    world.add({.x = point * Vec3(0.3, 0, -0.4), .mass = point == points ? 50.0 : 1.0});
    world.add_joint({.i = point - 1, .j = point, .length = 0.5});
  }
  std::vector<double> tension(points, 0);
  Factors factors;
  for (int step = 0; step < 5; ++step) {
    Bodies<3> bodies = world.bodies();
    for (int point = 1; point <= points; ++point) bodies.motion.Wf[point] = Vec3(0, 0, -g * h);
    std::vector<Row<3>> rows;
    add_joint_rows(world.joints(), h, bodies, rows);
    std::vector<Stiffness> springs;
    for (int link = 0; link < points; ++link) {
      const Vec3 along = bodies.x[link + 1] - bodies.x[link];
      const Mat3 K = geometric_stiffness(along.normalized(), along.norm(), tension[link]);
      springs.push_back({.i = link, .j = link + 1, .K = K});
    }
    std::vector<Twist<3>> V(points + 1, Twist<3>::Zero());
    ASSERT_TRUE(stiff_solve(rows, bodies.motion, springs, h, V, factors));
    world.step(h);
    for (int link = 0; link < points; ++link) {
      EXPECT_NEAR(world.joint_lambda(link), rows[link].lambda, 1e-9) << "step " << step << " link " << link;
      tension[link] = -rows[link].lambda / h;
    }
  }
}

TEST(Sweeps, EndWhereOnlyRoundingsChange) {
  // A single row: the first sweep solves it, and the second finds round-off. In any units, with any number of sweeps.
  for (const double unit : {1.0, 0x1p40, 0x1p-40}) {
    World<3> world({.gravity = Vec3(0, 0, -g * unit), .solver_limits = {.max_sweeps = 1000}});
    world.add_fixed(Vec3::Zero());
    world.add({.x = Vec3(unit, 0, 0)});
    world.add_joint({.i = 0, .j = 1, .length = unit});
    for (int step = 0; step < 100; ++step) {
      world.step(h);
      ASSERT_LE(world.report().iterations, 3) << "step " << step << " unit " << unit;
      ASSERT_LE(world.report().residual, 1e-15 * g * h * unit);
    }
  }
}

/// Spheres in a stack that is slightly too high, so that they move.
World<3> stack(Solver<3> solver, bool warm = false) {
  World<3> world({.k = k, .solver = std::move(solver), .warm_start = warm, .solver_limits = {.max_sweeps = 3}});
  world.add_plane(Vec3::UnitZ(), 0);
  for (int i = 0; i < 6; ++i) world.add({.x = Vec3(0, 0, radius * (2 * i + 1)), .radius = radius});
  return world;
}

/// Cubes of 1 m that touch exactly, `base` of them in the lowest row.
World<6> pyramid(int base, const StopRule& stop = {}) {
  World<6> world({.friction = 0.6, .solver_limits = stop});
  world.add_plane(Vec3::UnitZ(), 0);
  for (int row = 0; row < base; ++row)
    for (int n = 0; n < base - row; ++n)
      world.add({.x = Vec3(n + 0.5 * row, 0, row + 0.5), .mass = 100, .half_sides = Vec3::Constant(0.5)});
  return world;
}

TEST(Default, SolvesASettlingPyramidInFewIterationsOfAStep) {
  // Most contacts at the sides of the cubes carry nothing. If they take part in Newton's step as all others do, it
  // fails, and each step takes some 25 factorisations of the interior-point method besides. Left to the sweeps they
  // need four in all.
  World<6> world = pyramid(12);
  const int steps = 60;
  int iterations = 0;
  for (int n = 0; n < steps; ++n) {
    world.step(1.0 / 60);
    iterations += world.report().iterations;
    double largest = 0;
    for (const Row<6>& row : world.rows()) largest = std::max(largest, std::abs(row.B));
    EXPECT_LE(world.report().residual, 1e-6 * largest) << "step " << n;
  }
  EXPECT_LE(iterations, 8 * steps);
  for (int b = 1; b < std::ssize(world.bodies().x); ++b) EXPECT_LT(world.v(b).norm(), 1e-6) << "body " << b;
}

TEST(Default, SolvesPyramidsOfAllHeightsInFewIterationsOfAStep) {
  // Contacts at the sides that carry some per cent of the largest |B| beside the edge of their discs harm Newton's step
  // as those do that carry nothing. It depended on the height whether a pyramid had such contacts.
  for (const int base : {15, 19, 22}) {
    World<6> world = pyramid(base);
    const int steps = 60;
    int iterations = 0;
    for (int n = 0; n < steps; ++n) {
      world.step(1.0 / 60);
      iterations += world.report().iterations;
    }
    EXPECT_LE(iterations, 3.5 * steps) << "base " << base;
  }
}

TEST(Default, SolvesAWallAtRestInFewIterationsOfAStep) {
  // What the solve of a step leaves moves the bricks a little, so that half of the steps must be solved again. Newton's
  // method fails there, as contacts at the edges of bricks change in turn: then a step takes eight iterations.
  World<6> world({.friction = 0.6});
  world.add_plane(Vec3::UnitZ(), 0);
  for (int course = 0; course < 6; ++course)
    for (int n = 0; n < 6; ++n)
      world.add({.x = Vec3(2.002 * n - 0.98 * (course % 2), 0, course + 0.5), .half_sides = Vec3(1, 0.5, 0.5)});
  int iterations = 0;
  while (world.time() < 2) world.step(1.0 / 60);
  while (world.time() < 4) {
    world.step(1.0 / 60);
    iterations += world.report().iterations;
    EXPECT_TRUE(world.solved().converged);
  }
  EXPECT_LE(iterations, 4 * 120);
}

TEST(Default, HoldsAPyramidWhoseFactorsSeemTooDear) {
  // The pyramid is wide, so the bound of their cost exceeds a hundred times the allowed sweeps. The counted cost is less
  // than five times these.
  const StopRule few{.max_sweeps = 6};
  World<6> world = pyramid(30, few);
  world.step(1.0 / 60);
  ASSERT_GT(velocity_factor_cost(world.rows()), 100 * few.max_sweeps);
  ASSERT_LT(counted_velocity_factor_cost(world.rows()), 5 * few.max_sweeps);
  for (int n = 0; n < 10; ++n) {
    world.step(1.0 / 60);
    double largest = 0;
    for (const Row<6>& row : world.rows()) largest = std::max(largest, std::abs(row.B));
    EXPECT_LE(world.report().residual, 1e-6 * largest) << "step " << n;
  }
}

/// Turned cubes of 1 m above each other in a pit, which will fall into a heap; another for each `number`.
World<6> heap(int number) {
  World<6> world({.friction = 0.6});
  world.add_plane(Vec3::UnitZ(), 0);
  for (const Vec3& inwards : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)})
    world.add_plane(inwards, -2.4);
  for (int n = 0; n < 27; ++n) {
    const auto any = [&](int which) { return std::sin(100.0 * number + 7 * n + 2.3 * which); };
    world.add({.x = Vec3(1.75 * (n % 2 - 0.5) + 0.03 * any(0), 1.75 * (n / 2 % 2 - 0.5) + 0.03 * any(1),
                         1 + 1.8 * (n / 4)),
               .q = Quat(1 + 0.3 * any(2), 0.5 * any(3), 0.5 * any(4), 0.5 * any(5)).normalized(),
               .half_sides = Vec3::Constant(0.5)});
  }
  return world;
}

TEST(Default, LooksAtAHeapThatRestsInFewIterations) {
  // Two cubes whose faces lie on each other keep their contacts, although they sag. If they change in a step, the last
  // impulses are no solution, and a step takes some thirty iterations.
  const int heaps = 8;
  int iterations = 0;
  for (int number = 0; number < heaps; ++number) {
    World<6> world = heap(number);
    while (world.time() < 12) world.step(1.0 / 60);
    while (world.time() < 13) {
      world.step(1.0 / 60);
      iterations += world.report().iterations;
    }
    for (const Twist<6>& W : world.bodies().motion.W) EXPECT_LT(W.norm(), 1e-3) << "heap " << number;
  }
  EXPECT_LE(iterations, 5 * 60 * heaps);
}

/// Returns forty cubes of 1 kg and 12 cm that fall into a box, in soft contact: mg/k is 0.1 mm. `number` makes one heap
/// differ from another.
World<6> soft_heap(int number) {
  World<6> world({.k = 1e5, .friction = 0.5});
  world.add_plane(Vec3::UnitZ(), 0);
  for (const Vec3& inwards : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)})
    world.set_material(world.add_plane(inwards, -0.375), {.friction = 0});
  for (int n = 0; n < 40; ++n) {
    const auto any = [&](int which) { return std::sin(100.0 * number + 7 * n + 2.3 * which); };
    world.add({.x = Vec3(0.25 * (n % 3 - 1) + 0.02 * any(0), 0.25 * (n / 3 % 3 - 1) + 0.02 * any(1),
                         0.125 + 0.25 * (n / 9)),
               .q = Quat(any(2), any(3), any(4), any(5)).normalized(),
               .half_sides = Vec3::Constant(0.06)});
  }
  return world;
}

TEST(Default, LetsEveryHeapRest) {
  // Each of these heaps trembled for ever, at millimetres a second and more, when two boxes had at most four contacts,
  // or only that of two edges where their faces were nearly parallel. Of 151 heaps of this kind 12 did so.
  for (const int number : {17, 35, 60, 92, 98, 115}) {
    World<6> world = soft_heap(number);
    while (world.time() < 5) world.step(1.0 / 60);
    int iterations = 0;
    while (world.time() < 6) {
      world.step(1.0 / 60);
      iterations += world.report().iterations;
    }
    EXPECT_LE(iterations, 15 * 60) << "heap " << number;
    for (const Twist<6>& W : world.bodies().motion.W) EXPECT_LT(W.norm(), 1e-3) << "heap " << number;
  }
}

TEST(Default, SolvesAFallingHeapInFewIterationsOfAStep) {
  // More than forty if the interior point starts far from the impulses that sweeps have found.
  const int heaps = 12;
  int steps = 0, iterations = 0;
  for (int number = 0; number < heaps; ++number) {
    World<6> world = soft_heap(number);
    for (; world.time() < 2; ++steps) {
      world.step(1.0 / 60);
      iterations += world.report().iterations;
    }
  }
  EXPECT_LE(iterations, 35 * steps);
}

TEST(Default, HoldsAGridOfJoints) {
  // As wide as it is high, so that its factors cost far less than those of a band of its width, for which sweeps would
  // be the cheaper. Fifty sweeps let it sag by millimetres.
  constexpr int n = 40;
  World<6> world({});
  const auto place = [](int row, int column) { return Vec3(column, 0, -row); };
  const auto join = [&](int i, int j, const Vec3& half) {
    world.add_joint({.i = i, .j = j, .p_i = half, .p_j = -half});
  };
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {
      const Vec3 x = place(row, column);
      const int body = row == 0 ? world.add_fixed(x) : world.add({.x = x, .principal = Vec3::Constant(0.1)});
      if (row > 0) join(body - n, body, Vec3(0, 0, -0.5));
      if (row > 0 && column > 0) join(body - 1, body, Vec3(0.5, 0, 0));
    }
  for (int step = 0; step < 5; ++step) {
    world.step(1.0 / 60);
    EXPECT_TRUE(world.solved().converged) << "step " << step;
  }
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column)
      EXPECT_LT((world.x(row * n + column) - place(row, column)).norm(), 1e-7) << row << ", " << column;
}

TEST(Automatic, EndsAtTheShareThatIsAskedFor) {
  // Balls and cubes fall on each other, so that some steps have contacts at rest and others in motion. A step in which
  // friction nearly jams may be out of reach of every method; it says so.
  std::vector<int> iterations;
  for (const double accuracy : {1e-2, 1e-3, 1e-5}) {
    World<6> world({.friction = 0.6, .solver = automatic<6>(FrictionModel::cone, accuracy)});
    world.add_plane(Vec3::UnitZ(), 0);
    for (int n = 0; n < 24; ++n) {
      const Vec3 x(0.9 * (n % 2) + 0.03 * n, 0.9 * (n / 2 % 2) - 0.02 * n, 0.6 + 1.1 * (n / 4));
      if (n % 3 == 0)
        world.add({.x = x, .radius = 0.5});
      else
        world.add({.x = x, .half_sides = Vec3::Constant(0.5)});
    }
    iterations.push_back(0);
    int unsolved = 0;
    for (int step = 0; step < 90; ++step) {
      world.step(1.0 / 60);
      iterations.back() += world.report().iterations;
      double largest = 0;
      for (const Row<6>& row : world.rows()) largest = std::max(largest, std::abs(row.B));
      const SolveReport& solved = world.solved();
      if (!solved.converged) {
        ++unsolved;
      } else if (!solved.history.empty()) {
        EXPECT_LE(solved.history.back(), accuracy * largest) << "accuracy " << accuracy << ", step " << step;
      }
    }
    EXPECT_LE(unsolved, 2) << "accuracy " << accuracy;
  }
  EXPECT_TRUE(std::is_sorted(iterations.begin(), iterations.end())) << ::testing::PrintToString(iterations);
  EXPECT_LT(iterations.front(), iterations.back());
}

TEST(Automatic, RefusesAnAccuracyThatIsNoShare) {
  for (const double accuracy : {0.0, -1e-6, 1.0, std::nan("")})
    expect_refusal({"accuracy", "between 0 and 1"}, [&] { automatic<6>(FrictionModel::cone, accuracy); });
}

TEST(CopiesOfAWorld, GoOnAlikeAndShareNothing) {
  for (const Solver<3>& solver :
       {gauss_seidel<3>(), ordered_gauss_seidel<3>(RowOrder::random, 5), direct<3>(), automatic<3>(),
        two_pass(ordered_gauss_seidel<3>(RowOrder::random, 5)), geometric_stiffness(automatic<3>())}) {
    World<3> first = stack(solver, true), alone = stack(solver, true);
    for (int step = 0; step < 5; ++step) first.step(h), alone.step(h);
    World<3> copy = first;
    for (int step = 0; step < 5; ++step) first.step(h);  // its random numbers must continue in the copy
    for (int step = 0; step < 5; ++step) copy.step(h), alone.step(h);
    for (int body = 1; body <= 6; ++body) {
      EXPECT_EQ(first.x(body), alone.x(body)) << body;
      EXPECT_EQ(copy.x(body), alone.x(body)) << body;
    }
  }
}

TEST(CopiesOfAWorld, AssignedToItGoBackToAStep) {
  for (const Solver<3>& solver :
       {ordered_gauss_seidel<3>(RowOrder::random, 5), automatic<3>(), geometric_stiffness(automatic<3>())}) {
    World<3> world = stack(solver, true), saved({});
    for (int step = 0; step < 5; ++step) world.step(h);
    saved = world;
    for (int step = 0; step < 5; ++step) world.step(h);
    const World<3> once = world;
    world = saved;
    for (int step = 0; step < 5; ++step) world.step(h);
    for (int body = 1; body <= 6; ++body) EXPECT_EQ(world.x(body), once.x(body)) << body;
  }
}

TEST(CopiesOfAWorld, OfAWireKeepItsTension) {
  World<3> first = wire_and_ball(find_solver<3>("geometric_stiffness").make_on_box());
  for (int step = 0; step < 5; ++step) first.step(h);
  World<3> copy = first;
  for (int step = 0; step < 5; ++step) first.step(h);
  for (int step = 0; step < 5; ++step) copy.step(h);
  EXPECT_EQ(first.x(load), copy.x(load));
}

// Islands, patterns and factors are kept as long as rows act on the same bodies. A copy begins without them.
TEST(CopiesOfAWorld, WithoutCachesHaveTheSameBits) {
  for (const char* solver : {"auto", "direct"}) {
    World<6> world({.friction = 0.4, .solver = find_solver<6>(solver).make_on_box()});
    world.add_plane(Vec3::UnitZ(), 0);
    const Vec3 half = Vec3::Constant(0.2);
    for (int n = 0; n < 8; ++n)  // two heaps that grow together as they fall, and slide apart
      world.add({.x = Vec3(0.3 * (n % 2), 0.05 * n, 0.3 + 0.5 * n),
                 .q = Quat(Eigen::AngleAxisd(0.3 * n, Vec3(1, 2, 3).normalized())),
                 .principal = solid_box_moments(1, half),
                 .half_sides = half});
    std::set<int> contacts;  // the number before
    for (int step = 0; step < 150; ++step) {
      World<6> copy = world;
      copy.step(h);
      world.step(h);
      contacts.insert(world.report().contacts);
      for (int body = 1; body <= 8; ++body) {
        ASSERT_EQ(world.x(body), copy.x(body)) << solver << ", step " << step << ", body " << body;
        ASSERT_EQ(orientation(world, body).coeffs(), orientation(copy, body).coeffs())
            << solver << ", step " << step << ", body " << body;
      }
    }
    EXPECT_GT(contacts.size(), 10U) << "so that much of it was new, again and again";
  }
}

}  // namespace
}  // namespace spook::solvers_test
