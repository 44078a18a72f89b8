// The whole step: it finds the contacts of all pairs at the positions before the move.
#include <algorithm>

#include "contract.hpp"
#include "exercise_test.hpp"
#include "quantities.hpp"
#include "shapes.hpp"
#include "simulations.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(StepPairs, "8.12 step_pairs");

/// The contacts that the search finds. Default: all; the others are known mistakes.
struct LookedFor {
  bool planes = true, balls = true, boxes = true, first_plane_only = false, axes_unturned = false;
};

/// Every pair by itself: no broad phase.
std::vector<Contact> all_contacts(const Simulation& all, const LookedFor& what = {}) {
  std::vector<Contact> contacts;
  const int count = static_cast<int>(all.bodies.size());
  const auto has_box = [&](int b) { return all.bodies[b].half_sides != Vec3::Zero(); };
  const auto is_solid = [&](int b) {
    return (has_box(b) && what.boxes) || (all.bodies[b].radius > 0 && what.balls);
  };
  const auto ball = [&](int b) { return Ball{b, all.bodies[b].x, all.bodies[b].radius}; };
  const auto box = [&](int b) {
    const RigidBody& body = all.bodies[b];
    return Box{b, body.x, what.axes_unturned ? Mat3(Mat3::Identity()) : body.q.toRotationMatrix(),
               body.half_sides};
  };
  const auto add = [&](const std::optional<Contact>& contact) {
    if (contact) contacts.push_back(*contact);
  };
  bool is_first = true;
  for (int p = 0; p < count && what.planes; ++p) {
    if (all.bodies[p].normal == Vec3::Zero() || (what.first_plane_only && !is_first)) continue;
    is_first = false;
    const Plane plane{p, all.bodies[p].x, all.bodies[p].normal, all.bodies[p].offset};
    for (int b = 0; b < count; ++b) {
      if (!is_solid(b) || all.bodies[b].mass == 0) continue;
      if (has_box(b))
        plane_box(plane, box(b), contacts);
      else
        add(plane_ball(plane, ball(b)));
    }
  }
  for (int i = 0; i < count; ++i)
    for (int j = i + 1; j < count; ++j) {
      if (!is_solid(i) || !is_solid(j) || all.bodies[i].mass + all.bodies[j].mass == 0) continue;
      if (has_box(i) && has_box(j))
        box_box(box(i), box(j), contacts);
      else if (has_box(i))
        add(box_ball(box(i), ball(j)));
      else if (has_box(j))
        add(box_ball(box(j), ball(i)));
      else
        add(ball_ball(ball(i), ball(j)));
    }
  return contacts;
}

/// Two planes, and balls and boxes between them, some static, that overlap a little.
Simulation heap(Random& random, int count) {
  Simulation all;
  all.k = 1e3;
  all.mu = 0.4;
  all.max_sweeps = 5;
  all.bodies = {{.normal = Vec3::UnitZ(), .offset = -0.8}};
  for (int b = 0; b < count; ++b) {
    RigidBody body = b % 7 == 6 ? random_static_body(random) : random_rigid_body(random);
    if (b % 2)
      body.half_sides = random.vector(0.2, 0.4);
    else
      body.radius = random.uniform(0.2, 0.4);
    all.bodies.push_back(body);
  }
  for (const double x : {5.0, 5.1})
    all.bodies.push_back({.x = Vec3(x, 0, 0), .radius = 0.2});          // static, and in each other
  all.bodies.push_back({.x = Vec3(0.1, 0.1, 0.1), .mass = 1});          // without a shape
  all.bodies.push_back({.normal = Vec3(0.6, 0, 0.8), .offset = -0.9});  // i of its contacts, as the last body
  return all;
}

/// Returns a sentence about two bodies of a heap with which the step is wrong, too; empty if `got` is right. For a
/// mistake that is not among the known ones.
std::string wrong_pair(const Simulation& got, const Simulation& right, const Simulation& all, double h,
                       const Tolerance& tolerance) {
  if (got.bodies.size() != right.bodies.size() || are_alike(got, right, tolerance.value)) return "";
  const auto kind = [](const RigidBody& body) {
    const std::string shape = body.normal != Vec3::Zero()       ? "plane"
                              : body.half_sides != Vec3::Zero() ? "box"
                              : body.radius > 0                 ? "ball"
                                                                : "body without a shape";
    return (body.mass == 0 ? "a static " : "a ") + shape;
  };
  for (std::size_t i = 0; i < all.bodies.size(); ++i)
    for (std::size_t j = i + 1; j < all.bodies.size(); ++j) {
      Simulation two = all;
      two.bodies = {all.bodies[i], all.bodies[j]};
      Simulation stepped = two, expected = two;
      step_pairs(stepped, h);
      step_impacts(expected, all_contacts(two), h);
      if (stepped.bodies.size() != 2 || !are_alike(stepped, expected, tolerance.value))
        return " Two bodies are enough for a wrong result: body 0 " + kind(all.bodies[i]) + ", body 1 " +
               kind(all.bodies[j]) + ".";
    }
  return " With any two of these bodies alone the result is right. The pairs of sweep_and_prune are numbers of "
         "bounds, and not of bodies: planes have no bounds.";
}

EXERCISE_TEST(StepPairs, FindsWhatAllPairsHave) {
  Random random;
  const double h = 0.01;
  const Tolerance close{1e-9, "roundings of 5 sweeps over some 200 rows, of impulses up to 1000"};
  for (int n = 0; n < 10 && !::testing::Test::HasFailure(); ++n) {
    const Simulation all = heap(random, 20);
    const auto by = [&](const std::vector<Contact>& contacts) {
      Simulation stepped = all;
      step_impacts(stepped, contacts, h);
      return stepped;
    };
    Simulation moved = all, got = all, moved_first = all;
    step_free(moved, h);
    for (std::size_t b = 0; b < all.bodies.size(); ++b) {
      moved_first.bodies[b].x = moved.bodies[b].x;
      moved_first.bodies[b].q = moved.bodies[b].q;
    }
    try {
      step_pairs(got, h);
    } catch (const std::invalid_argument& refused) {
      expect_true(
          "a heap of static and other bodies makes a step", "Eq. (8.1)-(8.12)", false,
          std::string("It says: ") + refused.what() +
              ". Does a static box or ball have a contact with a plane, or with another static body? Two "
              "static bodies have no contacts.");
      return;
    }
    const Simulation right = by(all_contacts(all));
    std::vector<Contact> planes_last = all_contacts(all);
    std::stable_partition(planes_last.begin(), planes_last.end(), [&](const Contact& contact) {
      return all.bodies[static_cast<std::size_t>(contact.i)].normal == Vec3::Zero();
    });
    expect_same_bodies(
        "of a heap after a step of 0.01 s", "Eq. (8.1)-(8.12)", got, right, close,
        {{by({}), "There are no contacts at all."},
         {by(all_contacts(all, {.planes = false})), "The contacts of planes are missing."},
         {by(all_contacts(all, {.first_plane_only = true})),
          "Only the first plane has contacts: there are two."},
         {by(planes_last), "The contacts of planes come last: put them first, plane by plane."},
         {by(all_contacts(all, {.boxes = false})), "The contacts of boxes are missing."},
         {by(all_contacts(all, {.balls = false})), "The contacts of balls are missing."},
         {by(all_contacts(all, {.axes_unturned = true})),
          "The boxes are not rotated: their axes are the columns of the rotation matrix of q."},
         {by(all_contacts(moved_first)),
          "These contacts were found after the move. Gaps and points belong to t_n, as W belongs "
          "to t_n - h/2."}},
        "First the contacts where the bodies are; then the step of chapter 07." +
            wrong_pair(got, right, all, h, close));
  }
}

/// A box on a box on a floor: four corners carry each.
EXERCISE_TEST(StepPairs, StacksBoxes) {
  const double mass = 2, side = 0.5;
  Simulation all;
  all.k = 1e4;
  all.mu = 0.5;
  all.max_sweeps = 200;
  all.bodies = {{.normal = Vec3::UnitZ()}};
  for (int b = 0; b < 2; ++b)
    all.bodies.push_back({.x = Vec3(0, 0, side * (2 * b + 1)),
                          .mass = mass,
                          .principal = Vec3::Constant(mass * side * side * 2 / 3),
                          .half_sides = Vec3::Constant(side)});
  for (int n = 0; n < 600; ++n) step_pairs(all, 1.0 / 60);
  const double quarter = mass * 9.81 / (4 * all.k), lower = all.bodies[1].x.z(), upper = all.bodies[2].x.z();
  expect_near(
      "gap below the lower of two boxes after 600 steps [m]", "Eq. (3.13)", lower - side, -2 * quarter,
      {1e-3 * quarter, "what 200 sweeps leave in a step of what four corners share"},
      {{-2 * 4 * quarter, "One corner carries the whole weight, but a box on a plane has four contacts."}},
      "Two boxes weigh on four corners: a gap of -2 m g/(4 k).");
  expect_near("gap between the two [m]", "Eq. (3.13)", upper - lower - 2 * side, -quarter,
              {1e-3 * quarter, "what 200 sweeps leave in a step of what four corners share"},
              {{-4 * quarter, "One corner carries the whole weight, but four corners are contacts."}},
              "The upper box weighs on four corners: a gap of -m g/(4 k).");
}

EXERCISE_TEST(StepPairs, ReturnsTheReportOfTheStepOfImpacts) {
  Random random;
  Simulation start = heap(random, 20);
  const SolveReport got = step_pairs(start, 0.01);
  expect_true("5 entries in the history of the report of a step with 5 sweeps", "Eq. (4.9)",
              got.history.size() == 5, "Return what step_impacts returns.");
}

EXERCISE_TEST(StepPairs, RejectsAStepThatIsNotPositive) {
  Random random;
  Simulation all = heap(random, 8);
  for (const double h : {0.0, -0.1, std::nan("")})
    expect_rejects(
        "h = " + show(h), "h", [&] { step_pairs(all, h); }, "The step of chapter 07 refuses this.",
        [&] { return state_of(all); });
}

EXERCISE_TEST(StepPairs, IsTheSameInAnyUnits) {
  Random random;
  const Simulation all = heap(random, 8);
  expect_same_in_any_units_nans_aside("Eq. (8.1)-(8.12)", step_pairs, units::by_field, all, 0.01 * units::s);
}

}  // namespace
