// Beyond chapter 09's own tests: any size, any heading.
#include <numbers>

#include "09_better_friction/better_friction.hpp"
#include "exercise_test.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(SlidingTangents, "9.1 sliding_tangents");
EXERCISE(OntoDisc, "9.4 onto_disc");
EXERCISE(TwoPassSolve, "9.3 two_pass_solve");
EXERCISE(ConeSolve, "9.8 cone_solve");

EXERCISE_TEST(SlidingTangents, FollowTheSlip) {
  Random random;
  const Vec3 n = random.unit_vector(), u = random.vector_of_length(1, 5);
  const Vec3 along = u - u.dot(n) * n;
  if (along.norm() < 0.1) return;
  const Tangents t = sliding_tangents(n, u, 1e-6);
  expect_near_vector("t1", "Eq. (9.2)", t.t1, Vec3(along.normalized()), roundings(64 / along.norm(), 5));
  expect_near_vector("t2", "Eq. (9.2)", t.t2, Vec3(n.cross(along.normalized())),
                     roundings(64 / along.norm(), 5));
}

EXERCISE_TEST(OntoDisc, DoesNotAskHowLargeAnImpulseIs) {
  Random random;
  const double along = random.uniform(1, 3);
  const Vec2 lambda(along, random.uniform(-3, -1));
  const double radius = random.uniform(0.2, 1);
  for (const double size : {1e-100, 1e-8, 1e8, 1e100}) {
    const Vec2 got = onto_disc(size * lambda, size * radius) / size;
    expect_near_vector("λ_t over its size", "Eq. (9.4)", got, Vec2(radius * lambda.normalized()),
                       roundings(32, 1));
  }
}

struct Thrown {
  Motion<3> motion;
  std::vector<Row<3>> rows;
  std::vector<FrictionContact> contacts;
  std::vector<Twist<3>> V{Twist<3>::Zero(), Twist<3>::Zero()};
  double m, mu, h = 0.01, heading;

  /// A point mass on the floor, thrown along it.
  Thrown(Random& random, double speed) {
    m = random.uniform(0.5, 5);
    mu = random.uniform(0.1, 0.8);
    heading = random.uniform(0, 2 * std::numbers::pi);
    motion.inverse_mass = {{.linear = 0}, {.linear = 1 / m}};
    motion.W = {Vec3::Zero(), speed * Vec3(std::cos(heading), std::sin(heading), 0)};
    motion.Wf = {Vec3::Zero(), Vec3(0, 0, -h * 9.81)};
    for (const Vec3& axis : {Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, 1, 0)}) {
      const bool normal = axis.z() > 0;
      rows.push_back(make_row<3>({.i = 0,
                                  .j = 1,
                                  .Gi = -axis,
                                  .Gj = axis,
                                  .gap = 0,
                                  .spook = {.a = 0, .b = 1, .Sigma = 0},
                                  .lo = normal ? 0 : -infinity,
                                  .hi = infinity},
                                 motion));
    }
    contacts = {{.normal = 0, .mu = mu}};
  }

  void expect_coulomb(double speed) const {
    const double held = std::min(m * speed, mu * m * 9.81 * h);
    expect_near("λ_n [N s]", "Eq. (9.3)", rows[0].lambda, m * 9.81 * h, roundings(64, m));
    expect_near("λ_t along x [N s]", "Eq. (9.3)", rows[1].lambda, -held * std::cos(heading),
                roundings(200, m * (speed + 1)));
    expect_near("λ_t along y [N s]", "Eq. (9.3)", rows[2].lambda, -held * std::sin(heading),
                roundings(200, m * (speed + 1)));
  }
};

EXERCISE_TEST(ConeSolve, BrakesEveryHeadingAlike) {
  Random random;
  for (int k = 0; k < 20; ++k)
    for (const double speed : {0.001, 3.0}) {  // it stops, and it slides on
      Thrown t(random, speed);
      cone_solve(t.contacts, t.rows, t.V, {.max_sweeps = 50, .tolerance = 1e-15});
      t.expect_coulomb(speed);
    }
}

EXERCISE_TEST(TwoPassSolve, StopsWhatIsSlow) {
  Random random;
  for (int k = 0; k < 20; ++k) {
    Thrown t(random, 0.001);
    two_pass_solve(t.contacts, t.rows, t.V, {.max_sweeps = 50, .tolerance = 1e-15});
    t.expect_coulomb(0.001);
  }
}

}  // namespace
