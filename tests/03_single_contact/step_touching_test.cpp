// The step of two bodies that touch: each of its stages, conservation laws, and the depth of a ball at rest.
#include "contract.hpp"
#include "exercise_test.hpp"
#include "quantities.hpp"
#include "simulations.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(StepTouching, "3.5 step_touching");

/// Two bodies that press on each other, and a third without a contact.
struct TwoTouch {
  Simulation all;
  Contact contact;
};

TwoTouch two_touch(Random& random) {
  TwoTouch two;
  two.all.gravity = random.vector(5, 10);
  two.all.k = 1e3;
  for (int b = 0; b < 3; ++b) two.all.bodies.push_back(random_rigid_body(random));
  two.contact = {
      2, 0, random.unit_vector(), random.uniform(-0.02, -0.01), random.vector(0.5), random.vector(0.5)};
  two.all.bodies[0].v = two.all.bodies[2].v - 3 * two.contact.n;  // they approach
  return two;
}

/// The step with its stages in any order, and with switches for parts that may be forgotten.
struct StagesOfTouch {
  bool kicks_before = false, moves_before = false, pushes_after = false;
  double W_f_i = 1, W_f_j = 1, on_i = 1, on_j = 1;
  bool turns = true, turns_in_K = true;
  bool masses_of_i = false, masses_of_j = false;  ///< one body's inverse mass matrix for both, outside K
  bool exchanged_in_K = false;                    ///< each lever arm with the other body's inverse mass matrix
  bool axes_unturned = false;                     ///< inertias as if q were (1, 0, 0, 0), outside K
};

Simulation touched(Simulation all, const Contact& contact, double h, const StagesOfTouch& stages = {}) {
  if (stages.moves_before) step_free(all, h);
  if (stages.kicks_before)
    for (RigidBody& body : all.bodies)
      if (body.mass > 0) body.v += h * all.gravity;
  RigidBody &i = all.bodies[contact.i], &j = all.bodies[contact.j];
  const InverseMass<6> Mi = inverse_mass_of(i), Mj = inverse_mass_of(j);
  const auto [Gi, Gj] = contact_jacobian(contact);
  const double GW = Gi.dot(twist_of(i)) + Gj.dot(twist_of(j));
  const double GWf = stages.W_f_i * Gi.dot(force_twist_of(i, all.gravity, h)) +
                     stages.W_f_j * Gj.dot(force_twist_of(j, all.gravity, h));
  const InverseMass<6>&of_i = stages.exchanged_in_K ? Mj : Mi, &of_j = stages.exchanged_in_K ? Mi : Mj;
  const double nKn =
      stages.turns_in_K ? Gi.dot(of_i.times(Gi)) + Gj.dot(of_j.times(Gj)) : Mi.linear + Mj.linear;
  const double lambda = contact_impulse(spook_parameters(h, all.k, all.d), nKn, contact.gap, GW, GWf);
  const auto inverse = [&](RigidBody body) {
    if (stages.axes_unturned) body.q = Quat::Identity();
    return inverse_mass_of(body);
  };
  Twist<6> Vi = stages.on_i * lambda * inverse(stages.masses_of_j ? j : i).times(Gi),
           Vj = stages.on_j * lambda * inverse(stages.masses_of_i ? i : j).times(Gj);
  if (!stages.turns) Vi.tail<3>().setZero(), Vj.tail<3>().setZero();
  if (stages.pushes_after) step_free(all, h);
  add_twist(i, Vi);
  add_twist(j, Vj);
  if (!stages.moves_before && !stages.pushes_after) step_free(all, h);
  return all;
}

const Tolerance of_the_stages = {1e-11,
                                 "roundings of the products in G W, some 100 in all, of impulses up to 100"};

EXERCISE_TEST(StepTouching, HasItsStagesInOrder) {
  Random random;
  const int none = -1;
  for (const auto& [held, is_open] :
       {std::pair(none, false), std::pair(2, false), std::pair(0, false), std::pair(none, true)}) {
    auto [all, contact] = two_touch(random);
    if (is_open) contact.gap = 0.02;  // it closes within the step
    const bool on_static = held != none;
    all.bodies[2].omega = 3 * contact.r_i.cross(contact.n);
    if (on_static) {
      RigidBody& floor = all.bodies[held];
      floor.mass = 0;
      floor.v = floor.omega = Vec3::Zero();
      all.bodies[2 - held].v = (held == 2 ? -3 : 3) * contact.n;
    }
    const double h = 0.1, b = spook_parameters(h, all.k, all.d).b;
    Simulation got = all, free = all, left_alone = touched(all, contact, h);
    step_touching(got, contact, h);
    step_free(free, h);
    left_alone.bodies[1] = all.bodies[1];
    expect_same_bodies(
        std::string("after a step of 0.1 s in which two of three ") +
            (is_open ? "come together, with a gap of 0.02 m at first" : "touch") +
            (on_static ? std::string(", of which ") + (held == 2 ? "i" : "j") + " is static" : ""),
        "Eq. (3.10), (3.11)", got, touched(all, contact, h), of_the_stages,
        {{free,
          is_open
              ? "The contact does nothing while its gap is above 0. It closes within this step, so it pushes."
              : "The contact does nothing: is λ added to the velocities of both bodies, before they move?"},
         {touched(all, contact, h, {.moves_before = true}),
          "The bodies move before the contact is solved: use the gap and the velocities before the move."},
         {touched(all, contact, h, {.kicks_before = true}),
          "Gravity counts twice: the bodies are kicked before λ is computed, and step_free kicks them again."},
         {touched(all, contact, h, {.W_f_i = 1 + b, .W_f_j = 1 + b}),
          "λ counts gravity twice: G W is of t_n - h/2, before the kick of this step, which G W_f adds."},
         {touched(all, contact, h, {.W_f_i = 0, .W_f_j = 0}),
          on_static ? "Either W_f is missing, or the static body has one, too. No force moves that."
                    : "W_f is missing: the contact does not know what the forces of this step will add."},
         {touched(all, contact, h, {.W_f_i = 0}), "W_f of body i is missing: G W_f has a part of each body."},
         {touched(all, contact, h, {.W_f_j = 0}), "W_f of body j is missing: G W_f has a part of each body."},
         {touched(all, contact, h, {.pushes_after = true}),
          "The impulse comes when the bodies have moved: add it to the velocities before step_free."},
         {touched(all, contact, h, {.turns_in_K = false}),
          "n·Kn has the masses only. K of chapter 03 has a part by which the bodies turn, too: "
          "collision_matrix."},
         {touched(all, contact, h, {.exchanged_in_K = true}),
          "In K the two bodies are exchanged. Each lever arm goes with the inverse mass of its own body."},
         {touched(all, contact, h, {.turns = false}),
          on_static ? "The impulse does not turn the body: V has an angular part, I⁻¹ (r × J)."
                    : "The impulse turns neither body: V has an angular part, I⁻¹ (r × J)."},
         {touched(all, contact, h, {.axes_unturned = true}),
          "The inertias are those along the bodies' own axes. inverse_mass_of has them in the world."},
         {touched(all, contact, h, {.masses_of_i = true}),
          "The inverse mass matrix of body i acts on both bodies. Each has its own."},
         {touched(all, contact, h, {.masses_of_j = true}),
          "The inverse mass matrix of body j acts on both bodies. Each has its own."},
         {left_alone, "Body 1, which touches nothing, has not moved: step_free moves all bodies."},
         {touched(all, contact, h, {.on_i = 0}),
          "Body i gets no impulse. Its impulse is the opposite of body j's."},
         {touched(all, contact, h, {.on_j = 0}), "Body j gets no impulse."},
         {touched(all, contact, h, {.on_i = -1, .on_j = -1}),
          "Both impulses have the wrong sign: G has a minus on i already."}},
        "First λ, from velocities of t_n - h/2; then W + M⁻¹ Gᵀ λ; then the step of chapter 02.");
  }
}

EXERCISE_TEST(StepTouching, KeepsMomentum) {
  Random random;
  auto [all, contact] = two_touch(random);
  all.gravity.setZero();
  RigidBody &i = all.bodies[contact.i], &j = all.bodies[contact.j];
  j.x = i.x + contact.r_i - contact.r_j;  // one point of both
  const Vec3 u = j.v + j.omega.cross(contact.r_j) - i.v - i.omega.cross(contact.r_i);
  j.v -= (3 + contact.n.dot(u)) * contact.n;  // there they approach at 3 m/s
  const auto momenta = [&](const Simulation& now, const Simulation& places) {
    Twist<6> sum = Twist<6>::Zero();
    for (std::size_t b = 0; b < now.bodies.size(); ++b) {
      const RigidBody& body = now.bodies[b];
      const Vec3 p = body.mass * body.v, L = world_inertia(body.q, body.principal) * body.omega;
      sum += twist(p, places.bodies[b].x.cross(p) + L);
    }
    return sum;
  };
  Simulation got = all;
  step_touching(got, contact, 0.1);
  expect_near_vector<Twist<6>>(
      "momentum and angular momentum of three bodies, two of which push each other [kg m/s, kg m²/s]",
      "Eq. (3.3)", momenta(got, all), momenta(all, all), roundings(200, 20), {},
      "The impulses on i and j are opposite and act at one point of space, so their sum is zero.");
  expect_at_least("change of body j's v by the contact [m/s]", "Eq. (3.11)",
                  (got.bodies[contact.j].v - all.bodies[contact.j].v).norm(), 0.1, "they approach at 3 m/s",
                  "Nothing has pushed.");
}

EXERCISE_TEST(StepTouching, LetsGoWhatMovesApart) {
  Random random;
  auto [all, contact] = two_touch(random);
  all.bodies[contact.j].v = all.bodies[contact.i].v + 100 * contact.n;
  Simulation got = all, free = all;
  step_touching(got, contact, 0.1);
  step_free(free, 0.1);
  expect_same_bodies(
      "after a step in which two bodies separate at 100 m/s", "Eq. (3.11)", got, free, roundings(8, 100),
      {{all, "The bodies have not moved. With λ = 0 there is no impulse, but step_free all the same."}},
      "A contact may push, never pull: here contact_impulse returns 0.");
}

/// A ball of 0.5 m on a floor, its contact found before each step.
EXERCISE_TEST(StepTouching, RestsAtTheDepthOfItsWeight) {
  const double radius = 0.5, mass = 2, g = 9.81;
  for (const double d : {1.0, 3.0}) {
    Simulation all;
    all.k = 1e4;
    all.d = d;
    all.bodies = {{.normal = Vec3::UnitZ()},
                  {.x = Vec3(0, 0, radius), .mass = mass, .principal = Vec3::Constant(0.2), .radius = radius}};
    for (int n = 0; n < 1000; ++n) {
      const double gap = all.bodies[1].x.z() - radius;
      const Contact contact{
          .i = 0, .j = 1, .n = Vec3::UnitZ(), .gap = gap, .r_i = Vec3::Zero(), .r_j = Vec3(0, 0, -radius)};
      if (gap <= 0)
        step_touching(all, contact, 1.0 / 60);
      else
        step_free(all, 1.0 / 60);
    }
    const double gap = all.bodies[1].x.z() - radius, depth = mass * g / all.k;
    expect_near("gap of a ball after 1000 steps on a floor, d = " + show(d) + " [m]", "Eq. (3.13)", gap, -depth,
                {1e-12, "roundings of x, and what remains of the motion, which halves at least in d + 1 steps"},
                {{0, "It rests without any depth, so nothing determines how large the impulse is."}},
                "At rest the contact carries h m g in each step, at a gap of -m g/k.");
  }
}

EXERCISE_TEST(StepTouching, RejectsWhatMakesNoSense) {
  Random random;
  TwoTouch two = two_touch(random);
  Simulation& all = two.all;
  const auto rejects = [&](const std::string& what, const std::string& name, double h) {
    expect_rejects(
        what, name, [&, c = two.contact] { step_touching(all, c, h); },
        "spook_parameters refuses this: call it before you change anything.", [&] { return state_of(all); });
  };
  for (const double h : {0.0, -0.1, std::nan("")}) rejects("h = " + show(h), "h", h);
  all.k = 0;
  rejects("k = 0", "k", 0.1);
  all.k = 1e3;
  all.d = -1;
  rejects("d = -1", "d", 0.1);
}

EXERCISE_TEST(StepTouching, IsTheSameInAnyUnits) {
  Random random;
  const auto [all, contact] = two_touch(random);
  expect_same_in_any_units("Eq. (3.10), (3.11)", step_touching, units::nothing, all, contact, 0.1 * units::s);
}

}  // namespace
