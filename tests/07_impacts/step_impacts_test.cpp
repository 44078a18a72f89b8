// The step with impacts: their place in it, a ball's velocity after a bounce, and conservation laws.
#include "contract.hpp"
#include "exercise_test.hpp"
#include "stages.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(StepImpacts, "7.9 step_impacts");

/// Returns bodies with contacts that bounce and rub. Two of them have a joint, too.
Crowd bouncing_crowd(Random& random) {
  Crowd made = crowd(random, 12, 8);
  made.contacts.push_back(random_contact(random, 0, 1));
  made.all.bodies[0].v = made.all.bodies[1].v + 3 * made.contacts.back().n;  // they approach
  made.all.joints = {{0, 1, random.vector(0.3), random.vector(0.3)}};
  made.all.joints[0].k = random.uniform(100, 200);
  made.all.mu = 0.3;
  made.all.viscosity = 1e3;
  made.all.restitution = 0.5;
  return made;
}

/// Impacts on the velocities as they are; what may be wrong about them is in the law, and in the time of W.
Simulation after_impacts(Simulation all, const std::vector<Contact>& contacts, double h, const ImpactLaw& law,
                         bool kicked = false) {
  Motion<6> motion = motion_of(all, h);
  if (kicked)
    for (std::size_t b = 0; b < motion.W.size(); ++b) motion.W[b] += motion.Wf[b];
  resolve_impacts(contacts, law, motion);
  for (std::size_t b = 0; b < motion.W.size(); ++b) {
    if (kicked) motion.W[b] -= motion.Wf[b];
    all.bodies[b].v = motion.W[b].head<3>();
    all.bodies[b].omega = motion.W[b].tail<3>();
  }
  return all;
}

ImpactLaw law_of(const Simulation& all, double h) {
  return {.restitution = all.restitution, .friction = all.mu, .threshold = all.gravity.norm() * h};
}

/// Rows of the velocities before the impacts, and both changes added.
Simulation rows_of_old_velocities(const Simulation& all, const std::vector<Contact>& contacts, double h) {
  const Motion<6> motion = motion_of(all, h);
  std::vector<Row<6>> rows;
  for (const Constraint<6>& constraint : joint_constraints(all, h, {}))
    rows.push_back(make_row(constraint, motion));
  for (const Constraint<6>& constraint : contact_constraints(all, contacts, h, {}))
    rows.push_back(make_row(constraint, motion));
  const std::vector<Twist<6>> V = solved(all, rows, {});
  Simulation late = after_impacts(all, contacts, h, law_of(all, h));
  for (std::size_t b = 0; b < V.size(); ++b) add_twist(late.bodies[b], V[b]);
  step_free(late, h);
  return late;
}

EXERCISE_TEST(StepImpacts, HasItsStagesInOrder) {
  Random random;
  const double h = 0.02;
  for (int n = 0; n < 10 && !::testing::Test::HasFailure(); ++n) {
    auto [all, contacts] = bouncing_crowd(random);
    if (n % 2 == 1) all.restitution = 1;
    if (n % 3 == 2) open_every_third(contacts);
    std::vector<Contact> closed, unjoined;
    for (const Contact& contact : contacts) {
      if (contact.gap <= 0) closed.push_back(contact);
      if (joints_between(all, contact.i, contact.j) == 0) unjoined.push_back(contact);
    }
    const auto step_after = [all = all, h, touching = contacts](const ImpactLaw& law, bool kicked = false) {
      return assembled(after_impacts(all, touching, h, law, kicked), touching, h);
    };
    const ImpactLaw law = law_of(all, h);
    ImpactLaw smooth = law, eager = law, vertical = law;
    smooth.friction = 0, eager.threshold = 1e-9, vertical.threshold = std::abs(all.gravity.z()) * h;
    const Simulation bounced = after_impacts(all, contacts, h, law);
    std::vector<Contact> still_closing;
    for (const Contact& contact : contacts) {
      const auto [Gi, Gj] = contact_jacobian(contact);
      if (Gi.dot(twist_of(bounced.bodies[contact.i])) + Gj.dot(twist_of(bounced.bodies[contact.j])) <= 0)
        still_closing.push_back(contact);
    }
    const std::string too_small =
        "The threshold is too small: ImpactLaw's default, or a component of gravity. It is |gravity| h, Eq. "
        "(7.10).";
    const Simulation without = assembled(all, contacts, h);
    Simulation got = all, no_spin = after_impacts(all, contacts, h, law), late = no_spin;
    step_impacts(got, contacts, h);
    for (std::size_t b = 0; b < all.bodies.size(); ++b) {
      no_spin.bodies[b].omega = all.bodies[b].omega;
      if (all.bodies[b].mass != 0) late.bodies[b].v += h / 2 * all.gravity;
    }
    expect_same_bodies(
        "after a step of 0.02 s with impacts", "Eq. (7.1)-(7.10)", got, step_after(law),
        {1e-10, "roundings of some passes and 5 sweeps, of impulses up to 100"},
        {{without,
          "Nothing bounces. Does the step copy motion.W back to the bodies, before it makes the rows?"},
         {after_impacts(without, contacts, h, law),
          "The impacts come last. Resolve them before you make the rows, since rows stop every approach."},
         {rows_of_old_velocities(all, contacts, h),
          "The rows use the velocities before the impacts, so they stop bodies that have bounced already."},
         {step_after(law, true),
          "The velocities are kicked before the impacts, which add W_f/2 themselves, Eq. (7.1)."},
         {assembled(no_spin, contacts, h),
          "The impacts change no ω. Copy both halves of motion.W to the bodies, v and ω."},
         {assembled(late, contacts, h),
          "The bodies have got W + W_f/2. That is for Eq. (7.1) only: W stays at t_n - h/2."},
         {assembled(bounced, {}, h),
          "After the impacts no contact has its rows. All contacts of the list have them, those that bounced, "
          "too."},
         {assembled(after_impacts(all, closed, h, law), contacts, h),
          "The impacts of contacts with a gap above 0 are missing. resolve_impacts takes all contacts, "
          "whatever their gap."},
         {assembled(after_impacts(all, unjoined, h, law), contacts, h),
          "Impacts between bodies that have a joint are missing. An impact ignores joints."},
         {assembled(bounced, still_closing, h),
          "The contacts that part after the impacts are missing. Other rows may still close them: hand on "
          "all."},
         {step_after(smooth), "The impacts have no friction: use the simulation's mu."},
         {step_after(eager), too_small},
         {step_after(vertical), too_small}},
        "First the impacts, on W at t_n - h/2; then the step of chapter 06, with the velocities that they "
        "leave.");
  }
}

/// A ball that falls on a floor at 3 m/s, half a step before they touch.
double speed_after_bounce(double restitution, double speed, double h) {
  Simulation all;
  all.restitution = restitution;
  all.bodies = {{.normal = Vec3::UnitZ()},
                {.x = Vec3(0, 0, 0.5), .v = Vec3(0, 0, -speed), .mass = 2, .principal = Vec3::Constant(0.2)}};
  const Contact touching{
      .i = 0, .j = 1, .n = Vec3::UnitZ(), .gap = 0, .r_i = Vec3::Zero(), .r_j = Vec3(0, 0, -0.5)};
  step_impacts(all, {touching}, h);
  return all.bodies[1].v.z();
}

// u = W + W_f/2 turns into -e u, and the kick takes g h.
EXERCISE_TEST(StepImpacts, BouncesWithTheSpeedOfTheTimeOfContact) {
  const double h = 0.01, e = 0.6, g = 9.81;
  expect_near("v of a ball half a step after a bounce [m/s]", "Eq. (7.1), (7.2)", speed_after_bounce(e, 3, h),
              e * (3 + g * h / 2) - g * h / 2, roundings(32, 3),
              {{e * 3 - g * h, "This is e times the speed half a step before: u is W + W_f/2."},
               {e * (3 + g * h) - g * h, "This is e times the speed half a step after: u is W + W_f/2."},
               {speed_after_bounce(0, 3, h), "It stops. Rows alone make no bounce."}},
              "At the contact u is W + W_f/2. It turns into -e u, and the step kicks by W_f.");
}

// A ball that rests is kicked by g h in each step, which is no impact.
EXERCISE_TEST(StepImpacts, LetsRestingBallsRest) {
  const double h = 0.01, slow = 0.4 * 9.81 * h;
  expect_near("v of a ball that comes at 0.4 g h [m/s]", "Eq. (7.10)", speed_after_bounce(0.6, slow, h), 0,
              {0.5 * slow, "the rows stop it, except for what k and d leave in a step"},
              {{0.6 * (slow + 9.81 * h / 2) - 9.81 * h / 2, "It bounces: the threshold is |gravity| h."}},
              "Below the threshold |gravity| h an approach is left to the rows.");
}

EXERCISE_TEST(StepImpacts, WithoutRestitutionIsTheStepOfJoints) {
  Random random;
  auto [all, contacts] = bouncing_crowd(random);
  all.restitution = 0;
  Simulation got = all, inelastic = all;
  step_impacts(got, contacts, 0.02);
  step_joints(inelastic, contacts, 0.02);
  expect_same_bodies("after a step with restitution 0", "Eq. (4.4)", got, inelastic, roundings(200, 20), {},
                     "With restitution 0 there is no stage of impacts: rows stop what approaches.");
}

EXERCISE_TEST(StepImpacts, KeepsMomentumAndTheEnergyOfElasticBalls) {
  Simulation all;
  all.gravity.setZero();
  all.restitution = 1;
  for (int b = 0; b < 2; ++b)
    all.bodies.push_back({.x = Vec3(b, 0, 0),
                          .v = Vec3(b ? -1 : 3, 0, 0),
                          .mass = 1.0 + b,
                          .principal = Vec3::Constant(0.1),
                          .radius = 0.5});
  const Simulation before = all;
  Simulation without = all;
  const Contact touching{
      .i = 0, .j = 1, .n = Vec3::UnitX(), .gap = 0, .r_i = Vec3(0.5, 0, 0), .r_j = Vec3(-0.5, 0, 0)};
  step_impacts(all, {touching}, 0.01);
  step_joints(without, {touching}, 0.01);
  const auto energy = [](const Simulation& now) {
    double sum = 0;
    for (const RigidBody& body : now.bodies) sum += body.mass * body.v.squaredNorm() / 2;
    return sum;
  };
  expect_near("energy of two balls after an elastic impact [J]", "Eq. (7.6)", energy(all), energy(before),
              roundings(32, 5),
              {{energy(without),
                "Nothing bounces. Without gravity the threshold is 0, and every approach is an impact."}},
              "With e = 1 no energy is lost, and rows have nothing to do afterwards.");
  expect_near_vector<Twist<6>>("momentum after it [kg m/s, kg m²/s]", "Eq. (7.9)", momenta(all, before),
                               momenta(before, before), roundings(32, 5));
  expect_near("v of the lighter ball, which came at 3 m/s [m/s]", "Eq. (7.2)", all.bodies[0].v.x(),
              3 - 2 * 4 * 2.0 / 3, roundings(32, 5), {{3, "Nothing bounces."}},
              "It changes by 2 u m_j/(m_i + m_j), with u = 4 m/s.");
}

EXERCISE_TEST(StepImpacts, ReturnsTheReportOfTheSolveAfterTheImpacts) {
  Random random;
  const auto [all, contacts] = bouncing_crowd(random);
  const double h = 0.02;
  expect_report(
      "Eq. (4.9)", all, [&, touching = contacts](Simulation& now) { return step_impacts(now, touching, h); },
      [&, touching = contacts](const Simulation& now) {
        return solve_of(after_impacts(now, touching, h, law_of(now, h)), touching, h);
      },
      {1e-10, "roundings of some passes and 5 sweeps, of impulses up to 100"});
}

EXERCISE_TEST(StepImpacts, RejectsWhatMakesNoSense) {
  Random random;
  const auto [start, contacts] = bouncing_crowd(random);
  const auto rejects = [&, touching = contacts](const std::string& what, const std::string& name,
                                                Simulation all, double h) {
    expect_rejects(
        what, name, [&] { step_impacts(all, touching, h); },
        name == "h" ? "Check h before the impacts, since they change velocities."
                    : "resolve_impacts refuses this: call it for any restitution but 0.",
        [&] { return state_of(all); });
  };
  for (const double h : {0.0, -0.1, std::nan("")}) rejects("h = " + show(h), "h", start, h);
  Simulation wild = start, rough = start;
  rough.mu = -1;
  for (const double e : {1.5, -0.5, std::nan("")}) {
    wild.restitution = e;
    rejects("restitution = " + show(e), "restitution", wild, 0.1);
  }
  rejects("mu = -1", "friction", rough, 0.1);
}

EXERCISE_TEST(StepImpacts, IsTheSameInAnyUnits) {
  Random random;
  const auto [all, contacts] = bouncing_crowd(random);
  expect_same_in_any_units_nans_aside("Eq. (7.1)-(7.10)", step_impacts, units::by_field, all, contacts,
                                      0.02 * units::s);
}

}  // namespace
