// The step with friction: its rows and bounds, and a ball that slides until it rolls.
#include "contract.hpp"
#include "exercise_test.hpp"
#include "stages.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(StepFriction, "5.7 step_friction");

Crowd rough_crowd(Random& random, int bodies, int contacts) {
  Crowd made = crowd(random, bodies, contacts);
  made.all.mu = 0.5;
  made.all.viscosity = 1e3;
  return made;
}

const Tolerance of_rough_contacts = {1e-10, "roundings of 5 sweeps over some 450 rows, of impulses up to 100"};

EXERCISE_TEST(StepFriction, HasItsStagesInOrder) {
  Random random;
  auto [all, contacts] = rough_crowd(random, 30, many);
  open_every_third(contacts);
  const double h = 0.1;
  Simulation got = all;
  step_friction(got, contacts, h);
  std::vector<std::pair<Stages, std::string>> wrong = {
      {{.without_friction = true}, "There is no friction: the two rows of the tangents are missing."},
      {{.counts_no_pairs = true},
       "N is 1 for every contact. N counts the contacts of the same two bodies, which share the load."},
      {{.overlapping_only = true},
       "The contacts with a gap above 0 are missing. They may close within the step."},
      {{.counts_bodies = true},
       "N has been counted over all contacts that share a body. Only those with the same i and j count."},
      {{.mass_of_j = true},
       "The mass is that of one body alone. Where both move their inverse masses are added, Eq. (5.6)."},
      {{.open_is_ice = true},
       "Where a gap is above 0 there is no friction. Its rows have the bound of Eq. (5.7), open or not."},
      {{.whole_gravity = true}, "The bound uses all of gravity. g_n is the component along the normal, |g·n|."},
      {{.one_way_weight = true},
       "There is no friction where gravity pulls along n. g_n is |g·n|: n points from i to j, up or down."},
      {{.tangents_of_first = true},
       "All contacts have the tangents of the first: each has its own, tangents(contact.n)."},
      {{.contact_parameters = true},
       "The friction rows have the contact's a, b and Σ: they need those of friction_parameters."},
      {{.normals_first = true},
       "The rows of all normals come first. Put the tangents' rows right behind the normal row of their "
       "contact."}};
  for (const auto& mistake : mistakes_in_order()) wrong.push_back(mistake);
  const Simulation right = assembled(all, contacts, h);
  expect_same_bodies("after a step of 0.1 s with 100 rough contacts and more", "Eq. (5.3)-(5.8)", got, right,
                     of_rough_contacts, mistakes_of(all, contacts, h, wrong),
                     "The step of chapter 04, with two additional rows for each contact. N of a contact counts "
                     "those with the same i and the same j, itself included." +
                         wrong_part(got, right, all, contacts, h, step_friction, of_rough_contacts));
}

EXERCISE_TEST(StepFriction, WithoutFrictionIsTheStepOfContacts) {
  Random random;
  auto [all, contacts] = rough_crowd(random, 10, 20);
  all.mu = 0;
  Simulation got = all, smooth = all;
  step_friction(got, contacts, 0.1);
  step_contacts(smooth, contacts, 0.1);
  expect_same_bodies("after a step with mu = 0", "Eq. (5.8)", got, smooth, roundings(200, 20),
                     {{assembled(all, {contacts.front()}, 0.1),
                       "Only the first contact has a row. Where mu is 0 go on with the next one: `continue`, "
                       "not `break`."}},
                     "With mu = 0 there are no friction rows, and the step is that of chapter 04.");
}

// A point mass at rest has no slip, but without friction its weight along a slope would set it in motion.
EXERCISE_TEST(StepFriction, HoldsWhatRestsOnASlope) {
  const double h = 0.01, mass = 2;
  Simulation all;
  all.gravity = Vec3(3, 0, -9);
  all.k = 1e5;
  all.mu = 0.5;
  all.bodies = {{.normal = Vec3::UnitZ()},
                {.x = Vec3(0, 0, -mass * 9 / all.k), .mass = mass},
                {.x = Vec3(0, 0, 1), .mass = mass}};
  const Contact touching{
      .i = 0, .j = 1, .n = Vec3::UnitZ(), .gap = all.bodies[1].x.z(), .r_i = Vec3::Zero(), .r_j = Vec3::Zero()};
  step_friction(all, {touching}, h);
  expect_near("v along the slope of a point mass in the air, after a step [m/s]", "Eq. (1.1)",
              all.bodies[2].v.x(), 3 * h, {1e-12, "two roundings"}, {},
              "Nothing touches this one: it takes h g, as all that is free does.");
  expect_near("v along the slope of a point mass that rested, after a step [m/s]", "Eq. (5.3)",
              all.bodies[1].v.x(), 0, {1e-9, "a creep of F/c = 6e-12 m/s, and roundings"},
              {{3 * h,
                "It begins to slide, as if there were no friction. Friction rows act on bodies at rest, too: "
                "they hold what forces would move."}},
              "μ g_n = 4.5 m/s² is more than the 3 m/s² along the slope: it stays at rest.");
}

/// A ball on a floor, at a speed of 3 m/s.
Simulation sliding_ball() {
  Simulation all;
  all.k = 1e5;
  all.mu = 0.2;
  const double mass = 2, radius = 0.5;
  all.bodies = {{.normal = Vec3::UnitZ()},
                {.x = Vec3(0, 0, radius - mass * 9.81 / all.k),
                 .v = Vec3(3, 0, 0),
                 .mass = mass,
                 .principal = Vec3::Constant(0.4 * mass * radius * radius),
                 .radius = radius}};
  return all;
}

void roll(Simulation& all, double h) {
  const RigidBody& ball = all.bodies[1];
  const Contact touching{.i = 0,
                         .j = 1,
                         .n = Vec3::UnitZ(),
                         .gap = ball.x.z() - ball.radius,
                         .r_i = Vec3(ball.x.x(), ball.x.y(), 0),
                         .r_j = Vec3(0, 0, -ball.radius)};
  step_friction(all, {touching}, h);
}

EXERCISE_TEST(StepFriction, SlidesAtTheBound) {
  const double h = 0.01;
  Simulation all = sliding_ball();
  for (int n = 0; n < 10; ++n) roll(all, h);
  const double lost = all.mu * 9.81 * 10 * h;
  expect_near("v of a sliding ball after 10 steps of 0.01 s [m/s]", "Eq. (5.7), (5.8)", all.bodies[1].v.x(),
              3 - lost, {1e-9, "roundings, and a contact that begins at rest"},
              {{3, "Nothing slows it down."}, {3 - lost * h, "The bound has one factor h too many."}},
              "While it slides each step takes μ g h of its speed.");
}

// Friction changes v by λ/m and ω by R λ/I: it rolls at 5/7 of its speed, whatever μ.
EXERCISE_TEST(StepFriction, RollsAtFiveSeventhsOfItsSpeed) {
  Simulation all = sliding_ball();
  for (int n = 0; n < 200; ++n) roll(all, 0.01);
  const RigidBody& ball = all.bodies[1];
  expect_near(
      "v of a ball that slid and now rolls [m/s]", "Eq. (5.8)", ball.v.x(), 15.0 / 7,
      {1e-9, "a creep of F/c = 4e-12 m/s a step, and roundings"},
      {{3, "It goes on sliding: there is no friction."},
       {0, "It has come to rest. Friction must turn the ball, too, and a rolling ball has no friction."}},
      "A solid ball that starts at 3 m/s rolls at 5/7 of that.");
  expect_near("speed of its lowest point [m/s]", "Eq. (5.2)", ball.v.x() - ball.omega.y() * ball.radius, 0,
              {1e-9, "a creep of F/c, and roundings"}, {}, "A ball that rolls touches the floor at rest.");
}

EXERCISE_TEST(StepFriction, ReturnsTheReportOfItsSolve) {
  Random random;
  auto [all, contacts] = crowd(random, 10, 20);
  all.mu = 0.5;
  all.viscosity = 1e3;
  const double h = 0.1;
  expect_report(
      "Eq. (4.9)", all, [&, touching = contacts](Simulation& now) { return step_friction(now, touching, h); },
      [&, touching = contacts](const Simulation& now) { return solve_of(now, touching, h); },
      {1e-10, "roundings of 5 sweeps over some 100 rows, of impulses up to 100"});
}

EXERCISE_TEST(StepFriction, RejectsWhatMakesNoSense) {
  Random random;
  const auto [start, contacts] = rough_crowd(random, 5, 5);
  const auto rejects = [&, touching = contacts](const std::string& what, const std::string& name,
                                                Simulation all, double h) {
    expect_rejects(
        what, name, [&] { step_friction(all, touching, h); },
        "A function that you call refuses this: call it before you change anything.",
        [&] { return state_of(all); });
  };
  for (const double h : {0.0, -0.1, std::nan("")}) rejects("h = " + show(h), "h", start, h);
  Simulation pulled = start, stuck = start, idle = start;
  pulled.mu = -0.1, stuck.viscosity = 0, idle.max_sweeps = 0;
  rejects("mu = -0.1", "mu", pulled, 0.1);
  rejects("viscosity = 0", "c", stuck, 0.1);
  rejects("max_sweeps = 0", "max_sweeps", idle, 0.1);
  expect_rejects(
      "max_sweeps = 0, without a contact", "max_sweeps", [&] { step_friction(idle, {}, 0.1); },
      "solve refuses this, rows or not: call it even if there are no rows.", [&] { return state_of(idle); });
}

EXERCISE_TEST(StepFriction, IsTheSameInAnyUnits) {
  Random random;
  const auto [all, contacts] = rough_crowd(random, 5, 5);
  expect_same_in_any_units("Eq. (5.3)-(5.8)", step_friction, units::by_field, all, contacts, 0.1 * units::s);
}

}  // namespace
