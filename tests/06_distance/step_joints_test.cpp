// The step with joints: its rows, a hanging mass, and conservation laws.
#include "contract.hpp"
#include "exercise_test.hpp"
#include "stages.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(StepJoints, "6.5 step_joints");

/// Returns many bodies with contacts, and with joints of both kinds, each with its own k and d.
Crowd joined_crowd(Random& random, int bodies, int contacts, int joints) {
  Crowd made = crowd(random, bodies, contacts);
  made.all.mu = 0.5;
  made.all.viscosity = 1e3;
  for (int n = 0; n < joints; ++n) {
    PointJoint joint{n % bodies, (n + 1) % bodies, random.vector(0.3), random.vector(0.3)};
    if (n % 5 == 4) joint.i = (n - 1) % bodies, joint.j = n % bodies;  // those of the one before
    joint.length = n % 2 ? random.uniform(0.5, 1) : 0;
    joint.k = random.uniform(100, 200);
    joint.d = random.uniform(0.2, 0.3);
    made.all.joints.push_back(joint);
  }
  return made;
}

const Tolerance of_joints = {1e-10, "roundings of 5 sweeps over some 300 rows, of impulses up to 100"};

EXERCISE_TEST(StepJoints, HasItsStagesInOrder) {
  Random random;
  auto [all, contacts] = joined_crowd(random, 30, 40, 30);
  for (const std::size_t n : {0, 1, 5})  // between bodies that a joint holds
    contacts.push_back(random_contact(random, all.joints[n].i, all.joints[n].j));
  open_every_third(contacts);
  const double h = 0.1;
  Simulation got = all, loose = all;
  step_joints(got, contacts, h);
  loose.joints.pop_back();
  std::vector<std::pair<Stages, std::string>> wrong = {
      {{.without_joints = true}, "The joints do nothing: their rows are missing."},
      {{.overlapping_only = true},
       "The contacts with a gap above 0 are missing. They may close within the step."},
      {{.joints_last = true}, "The rows of the joints come last. Put them first."},
      {{.joints_as_contacts = true}, "The joints have the k and d of contacts: each has its own."},
      {{.joints_d_of_contacts = true}, "The joints have the d of contacts: each has its own."},
      {{.one_joint_a_pair = true}, "Of two joints between the same bodies one is missing: each has its rows."},
      {{.points_unturned = true},
       "p is in body coordinates. Eq. (6.1) converts it to world coordinates, r = q "
       "p."},
      {{.points_by_i = true}, "p_j has been turned by the q of body i. Each point turns with its own body."},
      {{.pulls_only = true}, "Here a distance only pulls. It must push, too: its λ has no bounds, Eq. (6.4)."},
      {{.counts_joints = true}, "N includes the joints of the two bodies. Only their contacts count."},
      {{.unjoined_only = true},
       "Contacts between two bodies that have a joint are missing. All contacts of the list have their rows."},
      {{.length_ignored = true},
       "Here every joint is a ball joint. If its length is above 0, it is a distance."},
      {{.without_friction = true}, "There is no friction. This is the step of chapter 05 with joints."}};
  for (const auto& mistake : mistakes_in_order()) wrong.push_back(mistake);
  std::vector<Mistake> mistakes = mistakes_of(all, contacts, h, wrong);
  mistakes.push_back(
      {assembled(all, {}, h), "The contacts do nothing: joints and contacts are solved together."});
  mistakes.push_back({assembled(loose, contacts, h), "The last joint is missing."});
  const Simulation right = assembled(all, contacts, h);
  expect_same_bodies("after a step of 0.1 s with joints and contacts", "Eq. (6.1)-(6.6)", got, right, of_joints,
                     mistakes,
                     "First the rows of the joints, then those of the contacts; all solved together." +
                         wrong_part(got, right, all, contacts, h, step_joints, of_joints));
}

EXERCISE_TEST(StepJoints, WithoutJointsIsTheStepWithFriction) {
  Random random;
  const auto [start, contacts] = joined_crowd(random, 10, 20, 0);
  for (const double mu : {0.5, 0.0}) {
    Simulation all = start;
    all.mu = mu;
    Simulation got = all, rough = all;
    step_joints(got, contacts, 0.1);
    step_friction(rough, contacts, 0.1);
    expect_same_bodies("after a step without joints, with mu = " + show(mu), "Eq. (5.8)", got, rough,
                       roundings(200, 20),
                       {{assembled(all, {contacts.front()}, 0.1),
                         "Only the first contact has its rows. Where mu is 0 go on with the next one: "
                         "`continue`, not `break`."}},
                       "Without joints this is the step of chapter 05.");
  }
}

EXERCISE_TEST(StepJoints, KeepsMomentum) {
  Random random;
  Simulation all = joined_crowd(random, 4, 0, 0).all;
  all.gravity.setZero();
  all.max_sweeps = 200;
  for (int n = 0; n < 3; ++n) {  // a chain, whose points are together at first
    PointJoint joint{n, n + 1, random.vector(0.3), Vec3::Zero()};
    const RigidBody &i = all.bodies[n], &j = all.bodies[n + 1];
    joint.p_j = j.q.conjugate() * Vec3(i.x + i.q * joint.p_i - j.x);
    joint.k = 1e6;
    all.joints.push_back(joint);
  }
  Simulation got = all;
  step_joints(got, {}, 0.01);
  expect_near_vector<Twist<6>>("momentum and angular momentum of a chain of four [kg m/s, kg m²/s]",
                               "Eq. (6.6)", momenta(got, all), momenta(all, all),
                               {1e-10, "roundings of 200 sweeps over 9 rows"}, {},
                               "A ball joint acts on both bodies at one point.");
  double change = 0;  // of any body: by chance the points of one joint may have nearly the same velocity
  for (std::size_t b = 0; b < all.bodies.size(); ++b)
    change = std::max(change, (twist_of(got.bodies[b]) - twist_of(all.bodies[b])).norm());
  expect_at_least(
      "largest change of a body's velocities by the joints [m/s, rad/s]", "Eq. (6.5)", change, 0.01,
      "the points of three joints have different velocities",
      "The joints do nothing. This simulation has no contacts: joints have their rows without contacts, "
      "too.");
}

/// A mass that hangs at rest stretches its joint by m g/k.
EXERCISE_TEST(StepJoints, StretchesByTheWeight) {
  for (const double length : {0.0, 1.0}) {
    const double mass = 2, k = 1e4;
    Simulation all;
    all.bodies = {{}, {.x = Vec3(0, 0, -length), .mass = mass, .principal = Vec3(0.1, 0.2, 0.25)}};
    all.joints = {{.i = 0, .j = 1, .p_i = Vec3::Zero(), .p_j = Vec3::Zero(), .length = length, .k = k, .d = 3}};
    for (int n = 0; n < 500; ++n) step_joints(all, {}, 1.0 / 60);
    expect_near("stretch of a joint of length " + show(length) + " m after 500 steps [m]", "Eq. (6.7)",
                -all.bodies[1].x.z() - length, mass * 9.81 / k,
                {1e-12, "roundings of x, and what remains of the motion, which halves at least in d + 1 steps"},
                {{-mass * 9.81 / k, "The gap has the wrong sign."}},
                "At rest its impulse is h m g, at a gap of m g/k.");
  }
}

/// Returns the angle of a pendulum that starts at rest at 1 rad, after `time`: 4000 Runge-Kutta steps of
/// θ" = -ω² sin θ.
double angle_of_pendulum(double omega_squared, double time) {
  const double h = time / 4000;
  Vec2 state(1, 0);
  const auto rate = [&](const Vec2& at) { return Vec2(at[1], -omega_squared * std::sin(at[0])); };
  for (int n = 0; n < 4000; ++n) {
    const Vec2 k1 = rate(state), k2 = rate(state + h / 2 * k1), k3 = rate(state + h / 2 * k2),
               k4 = rate(state + h * k3);
    state += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return state[0];
}

// A point mass on a rod, and a block on a ball joint. Both swing as the formula says, except for a stretch of m g/k.
EXERCISE_TEST(StepJoints, IsOfSecondOrderOnAPendulum) {
  const double mass = 2, arm = 0.5, time = 1, k = 1e10;
  for (const bool rod : {true, false}) {
    const double moment = rod ? 0 : 0.3, omega_squared = mass * 9.81 * arm / (moment + mass * arm * arm);
    const double angle = angle_of_pendulum(omega_squared, time);
    const auto error = [&](double h) {
      Simulation all;
      RigidBody bob{
          .x = arm * Vec3(std::sin(1), 0, -std::cos(1)), .mass = mass, .principal = Vec3::Constant(moment)};
      const double before = h / 2 * omega_squared * std::sin(1);  // rad/s, half a step before the start
      bob.v = before * arm * Vec3(std::cos(1), 0, std::sin(1));
      if (!rod) bob.omega = Vec3(0, -before, 0);
      all.bodies = {{}, bob};
      all.joints = {
          {.i = 0, .j = 1, .p_i = Vec3::Zero(), .p_j = rod ? Vec3::Zero().eval() : Vec3(-bob.x), .k = k}};
      if (rod) all.joints[0].length = arm;
      for (int n = 0; n < std::lround(time / h); ++n) step_joints(all, {}, h);
      const Vec3& x = all.bodies[1].x;
      return std::abs(std::atan2(x.x(), -x.z()) - angle);
    };
    expect_order(rod ? "a point mass on a rod, error of its angle at t = 1 s [rad]"
                     : "a block on a ball joint, error of its angle at t = 1 s [rad]",
                 "Eq. (6.5)", error, 0.02, 3, 2, 0.1,
                 "Order 1 means that numbers of different times are mixed. Rows need the positions before the "
                 "step, and W half a step earlier.");
  }
}

EXERCISE_TEST(StepJoints, ReturnsTheReportOfItsSolve) {
  Random random;
  const auto [all, contacts] = joined_crowd(random, 10, 20, 10);
  const double h = 0.1;
  expect_report(
      "Eq. (4.9)", all, [&, touching = contacts](Simulation& now) { return step_joints(now, touching, h); },
      [&, touching = contacts](const Simulation& now) { return solve_of(now, touching, h); }, of_joints);
}

EXERCISE_TEST(StepJoints, RejectsWhatMakesNoSense) {
  Random random;
  const auto [start, contacts] = joined_crowd(random, 5, 5, 4);
  const auto rejects = [&, touching = contacts](const std::string& what, const std::string& name,
                                                Simulation all, double h) {
    expect_rejects(
        what, name, [&] { step_joints(all, touching, h); },
        "A function of the chapters refuses this: call it before you change anything.",
        [&] { return state_of(all); });
  };
  for (const double h : {0.0, -0.1, std::nan("")}) rejects("h = " + show(h), "h", start, h);
  Simulation soft = start, wild = start, together = start, slippery = start;
  soft.joints[3].k = 0, wild.joints[0].d = -1, slippery.mu = -1;
  together.joints[1].p_i = together.joints[1].p_j = Vec3::Zero();
  together.bodies[2].x = together.bodies[1].x;
  rejects("k of joint 3 = 0", "k", soft, 0.1);
  rejects("d of joint 0 = -1", "d", wild, 0.1);
  rejects("two points at one place, to be 0.5 m and more apart", "distance", together, 0.1);
  rejects("mu = -1", "mu", slippery, 0.1);
  Simulation idle = start;
  idle.joints.clear(), idle.max_sweeps = 0;
  expect_rejects(
      "max_sweeps = 0, without a joint or contact", "max_sweeps", [&] { step_joints(idle, {}, 0.1); },
      "solve refuses this, rows or not: call it even if there are no rows.", [&] { return state_of(idle); });
}

EXERCISE_TEST(StepJoints, IsTheSameInAnyUnits) {
  Random random;
  const auto [all, contacts] = joined_crowd(random, 5, 5, 4);
  expect_same_in_any_units("Eq. (6.1)-(6.6)", step_joints, units::by_field, all, contacts, 0.1 * units::s);
}

}  // namespace
