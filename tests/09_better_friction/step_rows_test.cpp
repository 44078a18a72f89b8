// Half a step: impacts, rows, and the places of contacts with friction, for any solver that follows.
#include "contract.hpp"
#include "exercise_test.hpp"
#include "stages.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(StepRows, "9.9 step_rows");

/// Returns bodies with contacts that bounce and rub, and with joints of both kinds.
Crowd whole_crowd(Random& random) {
  Crowd made = crowd(random, 12, 20);
  made.all.mu = 0.4;
  made.all.viscosity = 1e3;
  made.all.restitution = 0.5;
  for (int n = 0; n < 6; ++n) {
    PointJoint joint{n, n + 1, random.vector(0.3), random.vector(0.3)};
    joint.length = n % 2 ? random.uniform(0.5, 1) : 0;
    joint.k = random.uniform(100, 200);
    made.all.joints.push_back(joint);
  }
  made.contacts.push_back(random_contact(random, 0, 1));  // of two bodies that have a joint
  made.all.bodies[0].v = made.all.bodies[1].v + 3 * made.contacts.back().n;
  return made;
}

ImpactLaw impact_law_of(const Simulation& all, double h) {
  return {.restitution = all.restitution, .friction = all.mu, .threshold = all.gravity.norm() * h};
}

Simulation with_impacts(Simulation all, const std::vector<Contact>& contacts, double h, double threshold = -1) {
  Motion<6> motion = motion_of(all, h);
  ImpactLaw law = impact_law_of(all, h);
  if (threshold >= 0) law.threshold = threshold;
  resolve_impacts(contacts, law, motion);
  for (std::size_t b = 0; b < motion.W.size(); ++b) {
    all.bodies[b].v = motion.W[b].head<3>();
    all.bodies[b].omega = motion.W[b].tail<3>();
  }
  return all;
}

/// The rest of the step with the sweeps of chapter 04.
Simulation swept(Simulation all, StepRows step, double h) {
  std::vector<Twist<6>> V(all.bodies.size(), Twist<6>::Zero());
  solve(step.rows, V, {.max_sweeps = all.max_sweeps, .tolerance = all.tolerance});
  finish_step(all, V, h);
  return all;
}

/// Rows of the velocities before the impacts.
Simulation rows_before_impacts(const Simulation& all, const std::vector<Contact>& contacts, double h) {
  const Motion<6> motion = motion_of(all, h);
  StepRows step{.motion = motion, .rows = {}, .friction = {}};
  for (const Constraint<6>& constraint : joint_constraints(all, h, {}))
    step.rows.push_back(make_row(constraint, motion));
  for (const Constraint<6>& constraint : contact_constraints(all, contacts, h, {}))
    step.rows.push_back(make_row(constraint, motion));
  return swept(with_impacts(all, contacts, h), step, h);
}

const Tolerance of_half_steps = {1e-10, "roundings of some passes and 5 sweeps, of impulses up to 100"};

bool are_near(double a, double b) {
  return a == b || std::abs(a - b) <= 1e-10 * (1 + std::abs(b));
}

// Rows are compared one by one, without a solver that might hide a difference.
EXERCISE_TEST(StepRows, HasTheRowsOfTheStepOfJoints) {
  Random random;
  const double h = 0.02;
  auto [start, contacts] = whole_crowd(random);
  open_every_third(contacts);
  start.restitution = 0;
  Simulation smooth = start, weightless = start, at_rest = start, idle = start;
  smooth.mu = 0;
  weightless.gravity.setZero();
  for (RigidBody& body : at_rest.bodies) body.v = body.omega = Vec3::Zero();
  idle.max_sweeps = 0, idle.tolerance = -1;
  const auto open = std::count_if(contacts.begin(), contacts.end(), [](const Contact& c) { return c.gap > 0; });
  for (const auto& [what, all] : {std::pair<std::string, Simulation>("with friction", start),
                                  {"with mu = 0", smooth},
                                  {"without gravity", weightless},
                                  {"at rest", at_rest},
                                  {"with max_sweeps = 0 and a tolerance of -1", idle}}) {
    Simulation half = all;
    StepRows step;
    try {
      step = step_rows(half, contacts, h);
    } catch (const std::invalid_argument& refused) {
      expect_true("bodies " + what + " are accepted", "Eq. (4.4)", false,
                  std::string("It says: ") + refused.what() +
                      ". Do not look at max_sweeps and tolerance here: they are for the solver that follows.");
      continue;
    }
    std::vector<Constraint<6>> expected = joint_constraints(all, h, {});
    const std::size_t of_joints = expected.size(), of_a_contact = all.mu == 0 ? 1 : 3;
    for (const Constraint<6>& constraint : contact_constraints(all, contacts, h, {}))
      expected.push_back(constraint);
    expect_near(
        "rows of bodies " + what, "Eq. (4.4)", static_cast<double>(step.rows.size()),
        static_cast<double>(expected.size()), {0, "a count"},
        {{static_cast<double>(of_joints + of_a_contact),
          "Only the first contact has its rows. Where mu is 0 go on with the next one: `continue`, not "
          "`break`."},
         {static_cast<double>(expected.size() - of_joints + 3 * all.joints.size()),
          "Here every joint is a ball joint. If its length is above 0, it is a distance."},
         {static_cast<double>(expected.size() - of_a_contact * static_cast<std::size_t>(open)),
          "The contacts with a gap above 0 are missing. They may close within the step."},
         {static_cast<double>(of_joints + contacts.size()),
          "There are no friction rows. They act on bodies at rest and without weight, too."}},
        "The rows of the joints, then one of each contact, followed by two of friction unless mu is 0.");
    if (step.rows.size() != expected.size()) continue;
    const Motion<6> motion = motion_of(all, h), bounced = motion_of(with_impacts(all, contacts, h), h);
    for (std::size_t k = 0; k < expected.size() && !::testing::Test::HasFailure(); ++k) {
      const Row<6>& got = step.rows[k];
      const Row<6> right = make_row(expected[k], motion);
      const std::string of = " of row " + std::to_string(k) + " of bodies " + what;
      expect_true("the two bodies" + of, "Eq. (4.4)", got.i == right.i && got.j == right.j,
                  "Joints first, then contacts, each in the order of its list.");
      expect_true(
          "the Jacobian" + of, "Eq. (4.4)", (got.Gi - right.Gi).norm() + (got.Gj - right.Gj).norm() <= 1e-10,
          "The constraints are those of step_joints: of each contact its n, then t1 and t2 of tangents(n).");
      expect_near(
          "B" + of + " [m/s]", "Eq. (4.4)", got.B, right.B, {1e-9, "roundings of gaps times a"},
          {{make_row(expected[k], bounced).B,
            "This is B after impacts with e = 0. With restitution 0 there are no impacts: the rows stop the "
            "bodies."}},
          "B is that of make_row. A joint has its own k and d, and a contact those of the simulation.");
      expect_true("Σ and the diagonal" + of, "Eq. (4.3)",
                  are_near(got.Sigma, right.Sigma) && are_near(got.diagonal, right.diagonal),
                  "Σ depends on k and d. Each joint has its own, and contacts and friction have theirs.");
      expect_true(
          "the bounds" + of + ": from " + show(right.lo) + " to " + show(right.hi) + " N s, and not from " +
              show(got.lo) + " to " + show(got.hi) + " N s",
          "Eq. (5.7)", are_near(got.lo, right.lo) && are_near(got.hi, right.hi),
          "Friction has the bounds of Eq. (5.7), and 0 is one, too. N counts all contacts of the two bodies.");
    }
  }
}

EXERCISE_TEST(StepRows, SweptIsTheStepOfImpacts) {
  Random random;
  const double h = 0.02;
  for (int n = 0; n < 5 && !::testing::Test::HasFailure(); ++n) {
    auto [all, contacts] = whole_crowd(random);
    if (n % 2 == 1) open_every_third(contacts);
    if (n == 2) all.mu = 0;
    std::vector<Contact> closed, unjoined;
    for (const Contact& contact : contacts) {
      if (contact.gap <= 0) closed.push_back(contact);
      if (joints_between(all, contact.i, contact.j) == 0) unjoined.push_back(contact);
    }
    const Simulation bounced = with_impacts(all, contacts, h);
    Simulation half = all, expected = all;
    const StepRows step = step_rows(half, contacts, h);
    step_impacts(expected, contacts, h);
    expect_same_bodies(
        "after step_rows, before the solver", "Eq. (7.9)", half, bounced, of_half_steps,
        {{with_impacts(all, closed, h),
          "The impacts of contacts with a gap above 0 are missing. resolve_impacts takes all contacts, "
          "whatever their gap."},
         {with_impacts(all, contacts, h, std::abs(all.gravity.z()) * h),
          "The threshold is from a component of gravity. It is |gravity| h, Eq. (7.10)."},
         {with_impacts(all, unjoined, h),
          "Impacts between bodies that have a joint are missing. An impact ignores joints."},
         {all, "Nothing has bounced: resolve the impacts, and copy motion.W back to the bodies."},
         {swept(bounced, step, h), "The bodies have moved already: finish_step does that."}},
        "step_rows changes velocities, by the impacts, and nothing else.");
    expect_same_bodies(
        "after step_rows, sweeps and finish_step", "Eq. (6.6), (5.8)", swept(half, step, h), expected,
        of_half_steps,
        {{rows_before_impacts(all, contacts, h),
          "The rows use the velocities before the impacts, so they stop bodies that have bounced already."},
         {assembled(bounced, contacts, h, {.joints_last = true}),
          "The rows of the joints come last. Put them first."},
         {assembled(bounced, contacts, h, {.without_joints = true}), "The rows of the joints are missing."},
         {assembled(bounced, contacts, h, {.without_friction = true}), "The friction rows are missing."},
         {assembled(bounced, {}, h), "The rows of the contacts are missing."}},
        "Impacts first; then the rows of joints and contacts as in chapter 06.");
    for (std::size_t b = 0; b < step.motion.W.size(); ++b)
      expect_near_vector<Twist<6>>("W of body " + std::to_string(b) + " in the motion [m/s, rad/s]",
                                   "Eq. (4.4)", step.motion.W[b], twist_of(half.bodies[b]), roundings(4, 10),
                                   {}, "The motion is that of the rows: after the impacts.");
  }
}

EXERCISE_TEST(StepRows, ListsTheContactsThatHaveFriction) {
  Random random;
  auto [all, contacts] = whole_crowd(random);
  open_every_third(contacts);
  Simulation half = all;
  const StepRows step = step_rows(half, contacts, 0.02);
  expect_true("as many entries in the list as contacts", "Eq. (9.1)", step.friction.size() == contacts.size(),
              "With friction each contact has an entry, with a gap above 0 or not: it has its three rows.");
  const std::size_t joint_rows = joint_constraints(all, 0.02, {}).size();
  for (std::size_t c = 0; c < std::min(step.friction.size(), contacts.size()); ++c) {
    const auto place = static_cast<double>(step.friction[c].normal), number = static_cast<double>(c);
    expect_near(
        "index of the normal row of contact " + std::to_string(c), "Eq. (9.1)", place,
        static_cast<double>(joint_rows + 3 * c), {0, "it is a whole number"},
        {{c == 0 ? HUGE_VAL : number,
          "This is the number of the contact. Return the index of its normal row in `rows`."},
         {3 * number, "The rows of the joints come before those of the contacts."},
         {static_cast<double>(joint_rows + 3 * c + 1), "This is the row of t1. The normal row is before it."}});
    expect_near("μ of contact " + std::to_string(c), "Eq. (9.3)", step.friction[c].mu, all.mu,
                {0, "it is the simulation's mu"});
  }
  Simulation smooth = all;
  smooth.mu = 0;
  expect_true("no entry without friction", "Eq. (9.1)", step_rows(smooth, contacts, 0.02).friction.empty(),
              "With mu = 0 a contact has one row, and the next two are those of other contacts.");
}

/// A point mass slides at 45° to the tangents. On the cone its deceleration is μ g in every direction; on the box of
/// chapter 05 it would be √2 μ g.
EXERCISE_TEST(StepRows, LetsTheConeBrakeEquallyInEveryDirection) {
  const double h = 0.01, mass = 2, speed = 3;
  const int steps = 20;
  for (const bool two_passes : {false, true}) {
    Simulation all;
    all.mu = 0.5;
    all.k = 1e5;
    const Vec3 along = two_passes ? Vec3(1, 0, 0) : Vec3(Vec3(1, 1, 0).normalized());
    all.bodies = {{.normal = Vec3::UnitZ()},
                  {.x = Vec3(0, 0, -mass * 9.81 / all.k), .v = speed * along, .mass = mass}};
    for (int n = 0; n < steps; ++n) {
      const Contact contact{.i = 0,
                            .j = 1,
                            .n = Vec3::UnitZ(),
                            .gap = all.bodies[1].x.z(),
                            .r_i = Vec3::Zero(),
                            .r_j = Vec3::Zero()};
      StepRows step = step_rows(all, {contact}, h);
      std::vector<Twist<6>> V(all.bodies.size(), Twist<6>::Zero());
      const StopRule stop{.max_sweeps = 50, .tolerance = 0};
      if (two_passes)
        two_pass_solve(step.friction, step.rows, V, stop);
      else
        cone_solve(step.friction, step.rows, V, stop);
      finish_step(all, V, h);
    }
    const double exact = speed - 0.5 * 9.81 * h * steps;
    expect_near(
        "speed along the first direction after 20 steps on " +
            std::string(two_passes ? "bounds of two passes" : "the cone") + " [m/s]",
        "Eq. (9.1), (9.3)", all.bodies[1].v.dot(along), exact,
        {1e-10, "roundings of 20 steps; the regularisation 1/(h c) leaves a creep of 1e-10 m/s at most"},
        {{speed, "There is no friction: is the contact in the list, with its μ?"},
         {speed - std::sqrt(2.0) * 0.5 * 9.81 * h * steps, "This is the box of chapter 05."}},
        "The list says where the normal row is, and μ.");
  }
}

EXERCISE_TEST(StepRows, RejectsAStepThatIsNotPositive) {
  Random random;
  Crowd crowd = whole_crowd(random);
  Simulation& all = crowd.all;
  const std::vector<Contact>& contacts = crowd.contacts;
  for (const double h : {0.0, -0.1, std::nan("")})
    expect_rejects(
        "h = " + show(h), "h", [&, touching = contacts] { step_rows(all, touching, h); },
        "Check h before the impacts, since they change velocities.", [&] { return state_of(all); });
  Simulation rough = all, wild = all;
  rough.mu = -1;
  for (const double e : {-0.5, 1.5, std::nan("")}) {
    wild.restitution = e;
    expect_rejects(
        "restitution = " + show(e), "restitution",
        [&, touching = contacts] { step_rows(wild, touching, 0.02); },
        "resolve_impacts refuses this: call it for any restitution but 0.", [&] { return state_of(wild); });
  }
  expect_rejects(
      "mu = -1", "friction", [&, touching = contacts] { step_rows(rough, touching, 0.02); },
      "resolve_impacts refuses this: call it before you change anything.", [&] { return state_of(rough); });
}

EXERCISE_TEST(StepRows, IsTheSameInAnyUnits) {
  Random random;
  const auto [all, contacts] = whole_crowd(random);
  expect_same_in_any_units_nans_aside("Eq. (6.6), (5.8)", step_rows, units::by_field, all, contacts,
                                      0.02 * units::s);
}

}  // namespace
