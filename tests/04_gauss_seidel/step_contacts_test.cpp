// The step of many contacts: its stages in order, conservation laws, and the depth of a column at rest.
#include "contract.hpp"
#include "exercise_test.hpp"
#include "stages.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(StepContacts, "4.7 step_contacts");

const Tolerance of_many_contacts = {1e-10, "roundings of 5 sweeps over some 150 rows, of impulses up to 100"};

EXERCISE_TEST(StepContacts, HasItsStagesInOrder) {
  Random random;
  auto [all, contacts] = crowd(random, 30, many);
  open_every_third(contacts);
  const double h = 0.1;
  Simulation got = all;
  step_contacts(got, contacts, h);
  const std::vector<Contact> first(contacts.begin(), contacts.end() - 1);
  const std::vector<Contact> backwards(contacts.rbegin(), contacts.rend());
  std::vector<Contact> by_depth = contacts;
  std::stable_sort(by_depth.begin(), by_depth.end(),
                   [](const Contact& a, const Contact& b) { return a.gap < b.gap; });
  std::vector<Mistake> mistakes = mistakes_of(all, contacts, h, mistakes_in_order());
  mistakes.push_back(
      {assembled(all, by_depth, h), "The rows are in order of their depth. Take the order of the contacts."});
  mistakes.push_back({assembled(all, contacts, h, {.max_sweeps = 1}),
                      "This made one sweep only: pass max_sweeps to solve, and solve all contacts together."});
  mistakes.push_back({assembled(all, contacts, h, {.max_sweeps = 50}),
                      "The number of sweeps is simulation.max_sweeps, here 5."});
  mistakes.push_back({assembled(all, first, h), "The last contact is missing."});
  mistakes.push_back({assembled(all, contacts, h, {.overlapping_only = true}),
                      "The contacts with a gap above 0 are missing. They may close within the step."});
  mistakes.push_back({assembled(all, backwards, h),
                      "The rows are in reverse order. Take the order of the "
                      "contacts."});
  const Simulation right = assembled(all, contacts, h);
  expect_same_bodies(
      "after a step of 0.1 s with 100 contacts and more", "Eq. (4.4), (4.7)", got, right, of_many_contacts,
      mistakes,
      "First rows from W and W_f, then one solve of all, then W + V, then the step of chapter 02." +
          wrong_part(got, right, all, contacts, h, step_contacts, of_many_contacts));
}

EXERCISE_TEST(StepContacts, KeepsMomentum) {
  Random random;
  auto [all, contacts] = crowd(random, 4, 12);
  all.gravity.setZero();
  for (Contact& contact : contacts)  // one point of both
    contact.r_j = all.bodies[contact.i].x + contact.r_i - all.bodies[contact.j].x;
  Simulation got = all;
  step_contacts(got, contacts, 0.1);
  expect_near_vector<Twist<6>>("momentum and angular momentum of four bodies with contacts [kg m/s, kg m²/s]",
                               "Eq. (4.5)", momenta(got, all), momenta(all, all), roundings(2000, 20), {},
                               "Each row gives i the opposite of what j gets. Is V added to all bodies?");
  double change = 0;  // of any body: by chance all contacts of one may part
  for (std::size_t b = 0; b < all.bodies.size(); ++b)
    change = std::max(change, (twist_of(got.bodies[b]) - twist_of(all.bodies[b])).norm());
  expect_at_least("largest change of a body's velocities by the contacts [m/s, rad/s]", "Eq. (4.7)", change,
                  0.01, "they overlap by 1 cm and more, which needs some cm/s", "Nothing has pushed.");
}

EXERCISE_TEST(StepContacts, WithoutContactsIsTheStepOfBodiesThatAreFree) {
  Random random;
  const Simulation all = crowd(random, 10, 0).all;
  Simulation got = all, free = all;
  step_contacts(got, {}, 0.1);
  step_free(free, 0.1);
  expect_same_bodies("after a step without contacts", "Eq. (2.11)", got, free, roundings(8, 10), {},
                     "Without rows V is zero, and nothing else happens than in step_free.");
}

/// Five balls on each other and on a floor, found before each step.
EXERCISE_TEST(StepContacts, PressesAColumnByItsWeight) {
  const int balls = 5;
  const double radius = 0.5, mass = 2, g = 9.81, h = 1.0 / 60;
  Simulation all;
  all.k = 1e4;
  all.max_sweeps = 500;
  all.bodies.push_back({.normal = Vec3::UnitZ()});
  for (int b = 0; b < balls; ++b)
    all.bodies.push_back({.x = Vec3(0, 0, radius + 2 * radius * b),
                          .mass = mass,
                          .principal = Vec3::Constant(0.2),
                          .radius = radius});
  const auto gap = [&](int below) {
    const double reach = below == 0 ? radius : 2 * radius;
    return all.bodies[below + 1].x.z() - all.bodies[below].x.z() - reach;
  };
  for (int n = 0; n < 1000; ++n) {
    std::vector<Contact> contacts;
    for (int below = 0; below < balls; ++below)
      if (gap(below) <= 0)
        contacts.push_back({.i = below,
                            .j = below + 1,
                            .n = Vec3::UnitZ(),
                            .gap = gap(below),
                            .r_i = below == 0 ? Vec3::Zero() : Vec3(0, 0, radius),
                            .r_j = Vec3(0, 0, -radius)});
    step_contacts(all, contacts, h);
  }
  for (int below = 0; below < balls; ++below) {
    const double load = (balls - below) * mass * g;
    expect_near("gap below ball " + std::to_string(below + 1) + " of 5 after 1000 steps [m]",
                "Eq. (3.13), (4.1)", gap(below), -load / all.k,
                {1e-9, "what 500 sweeps leave of the rates of Eq. (4.11), and of the motion"},
                {{-mass * g / all.k, "It carries only one ball. Do the rows share one V?"}},
                "At rest each contact carries the weight above it, with a gap of minus this weight over k.");
  }
}

EXERCISE_TEST(StepContacts, ReturnsTheReportOfItsSolve) {
  Random random;
  const auto [all, contacts] = crowd(random, 10, 20);
  const double h = 0.1;
  expect_report(
      "Eq. (4.9)", all, [&, touching = contacts](Simulation& now) { return step_contacts(now, touching, h); },
      [&, touching = contacts](const Simulation& now) { return solve_of(now, touching, h); }, of_many_contacts);
}

EXERCISE_TEST(StepContacts, RejectsWhatMakesNoSense) {
  Random random;
  const auto [start, contacts] = crowd(random, 5, 5);
  const auto rejects = [&, touching = contacts](const std::string& what, const std::string& name,
                                                Simulation all, double h) {
    expect_rejects(
        what, name, [&] { step_contacts(all, touching, h); },
        "spook_parameters and solve refuse this: hand them all numbers of the simulation, the tolerance too, "
        "before "
        "you change anything.",
        [&] { return state_of(all); });
  };
  for (const double h : {0.0, -0.1, std::nan("")}) rejects("h = " + show(h), "h", start, h);
  Simulation soft = start, wild = start, idle = start, loose = start;
  soft.k = 0, wild.d = -1, idle.max_sweeps = 0, loose.tolerance = -1;
  rejects("k = 0", "k", soft, 0.1);
  rejects("d = -1", "d", wild, 0.1);
  rejects("max_sweeps = 0", "max_sweeps", idle, 0.1);
  rejects("tolerance = -1", "tolerance", loose, 0.1);
  expect_rejects(
      "max_sweeps = 0, without a contact", "max_sweeps", [&] { step_contacts(idle, {}, 0.1); },
      "solve refuses this, rows or not: call it even if there are no rows.", [&] { return state_of(idle); });
}

EXERCISE_TEST(StepContacts, IsTheSameInAnyUnits) {
  Random random;
  const auto [all, contacts] = crowd(random, 5, 5);
  expect_same_in_any_units("Eq. (4.4), (4.7)", step_contacts, units::by_field, all, contacts, 0.1 * units::s);
}

}  // namespace
