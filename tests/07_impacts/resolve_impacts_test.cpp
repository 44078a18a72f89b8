// The stage of impacts: the impacts that it resolves, their order, its end, and its report.
#include <algorithm>

#include "balls.hpp"
#include "collisions.hpp"
#include "exercise_test.hpp"
#include "regions.hpp"
#include "relative_scales.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(ResolveImpacts, "7.8 resolve_impacts");

EXERCISE_TEST(ResolveImpacts, TakesTheMassesOfBoth) {
  // 1/m_i + 1/m_j = 1/2 + 1/6: J = (1+e) 1.5 kg · 4 m/s = 10.5 N s.
  Motion<3> motion = row_of_balls({3, -1}, {2, 6});
  resolve_impacts(contacts_of_row(2), {.restitution = 0.75, .friction = 0.25}, motion);
  const auto after = [](double J) { return numbers({3 - J / 2, -1 + J / 6}); };
  expect_near_vector(
      "velocities of balls of 2 and 6 kg, 3 and -1 m/s before, e = 0.75, μ = 0.25 [m/s]", "Eq. (7.3), (7.9)",
      speeds(motion), after(10.5), roundings(32, 4),
      {{after(0), "Nothing has happened: u·n = -1 - 3 = -4 m/s is an approach."},
       {after(6), "This is for e = 0: the restitution of the law is not used."},
       {after(7.5),
        "This is for e = 0.25, which is μ. impact_impulse takes the restitution first, then the friction."},
       {after(14), "This is for the mass of i alone, 2 kg, in K: K = (1/m_i + 1/m_j) 1 for point masses."},
       {after(42), "This is for the mass of j alone, 6 kg, in K: K = (1/m_i + 1/m_j) 1 for point masses."},
       {after(7), "This is for 2/m_i in K: K = (1/m_i + 1/m_j) 1 for point masses."},
       {after(21),
        "The impulse has been applied twice, or K has 2/m_j: K = (1/m_i + 1/m_j) 1 for point masses."},
       {after(-10.5), "The impulse has the wrong sign, or u has: u is the velocity of j relative to i."},
       {numbers({3, 0.75}), "Only ball j has changed: i gets -J."},
       {numbers({-2.25, -1}), "Only ball i has changed: j gets J."}},
      "J = (1+e) 4 m/s / (1/m_i + 1/m_j) = 10.5 N s: 10.5/2 m/s less, and 10.5/6 m/s more.");
  Motion<3> plastic = row_of_balls({3, -1}, {2, 6});
  resolve_impacts(contacts_of_row(2), {.restitution = 0, .friction = 0.25}, plastic);
  expect_near_vector(
      "velocities of the same balls, e = 0 [m/s]", "Eq. (7.2), (7.9)", speeds(plastic), after(6),
      roundings(32, 4),
      {{after(0),
        "Nothing has happened. With e = 0 an impact ends the approach, too. Only step_impacts has "
        "no stage of impacts for a restitution of 0."}},
      "J = 4 m/s / (1/m_i + 1/m_j) = 6 N s, after which both balls are at rest.");
}

// u = (-3, 0, -1.5) m/s, u·n = -3 m/s, u_t = (-1, -1, 0.5) m/s, and 1/(1/m_i + 1/m_j) = 1.5 kg. The arms are long.
EXERCISE_TEST(ResolveImpacts, LetsPointMassesMeetAtAnyAngle) {
  const Vec3 n = Vec3(2, -1, 2) / 3, slip(-1, -1, 0.5), t = slip / 1.5;
  for (const double mu : {0.0, 0.25, 0.5}) {
    Motion<3> motion = row_of_balls({3, 0}, {2, 6});
    motion.W[1] = Vec3(0, 0, -1.5);
    resolve_impacts({contact_along(0, 1, n)}, {.restitution = 0.5, .friction = mu}, motion);
    const auto after = [&](const Vec3& J) {
      return (Eigen::VectorXd(6) << Vec3(3, 0, 0) - J / 2, Vec3(0, 0, -1.5) + J / 6).finished();
    };
    const Vec3 smooth = 6.75 * n, slides = smooth - 6.75 * mu * t, sticks = smooth - 1.5 * slip;
    expect_near_vector(
        "velocities of points of 2 and 6 kg that meet at an angle, n = (2, -1, 2)/3, e = 0.5, μ = " + show(mu) +
            " [m/s]",
        "Eq. (7.1), (7.3), (7.5)", Eigen::VectorXd((Eigen::VectorXd(6) << motion.W[0], motion.W[1]).finished()),
        after(mu < 1.0 / 3 ? slides : sticks), roundings(64, 10),
        {{after(smooth), "The friction of the law is not used."},
         {after(slides), "It slides, though it can stick: |J_t| = J_n/3 for Eq. (7.3)."},
         {after(sticks), "It sticks, though |J_t| = J_n/3 for Eq. (7.3) is more than μ J_n."}},
        "Between point masses K = (1/m_i + 1/m_j) 1 in all directions. A point does not turn, so u has no ω × "
        "r "
        "for any r_i and r_j.");
  }
}

EXERCISE_TEST(ResolveImpacts, EqualMassesExchangeTheirVelocities) {
  Motion<3> motion = row_of_balls({3, 1}, {2, 2});
  const ImpactReport report = resolve_impacts(contacts_of_row(2), {.restitution = 1}, motion);
  expect_near_vector(
      "velocities of two balls of 2 kg, 3 and 1 m/s before, e = 1 [m/s]", "Eq. (7.13)", speeds(motion),
      numbers({1, 3}), roundings(32, 4),
      {{numbers({3, 1}), "Nothing has happened: u·n = 1 - 3 = -2 m/s is an approach."},
       {numbers({2, 2}), "They stick: restitution is missing."},
       {numbers({3, 3}), "Only the ball in front has changed."},
       {numbers({-1, 5}),
        "J is twice what it should be: it has been applied twice, or K has the mass of one ball only."}},
      "They exchange their velocities: (1 + e) m/2 · 2 m/s = 4 N s over 2 kg.");
  expect_near("what the impact adds to the energy, e = 1 [J]", "Eq. (7.6)", report.energy, 0, roundings(64, 10),
              {{-8, "This is J·u. The other part, ½ J·K J, is missing: impact_work has both."},
               {16, "This has the velocity after the impact, or -u. Eq. (7.6) has u of before."}},
              "A central impact with e = 1 keeps the energy.");
}

EXERCISE_TEST(ResolveImpacts, CradleGivesTheSpeedToTheLastBall) {
  const std::string single =
      "The first impact causes the second, whose contact was tested before. Repeat the pass over all contacts "
      "until one finds no impact.";
  const std::vector<Contact> forwards = contacts_of_row(3);
  const std::vector<Contact> backwards(forwards.rbegin(), forwards.rend());
  const std::vector<Contact> exchanged{contact_along(2, 1, -Vec3::UnitX()),
                                       contact_along(1, 0, -Vec3::UnitX())};
  for (const auto& [name, contacts] :
       {std::pair("from the first ball on", forwards), std::pair("from the last ball on", backwards),
        std::pair("from the last ball on, i and j exchanged", exchanged)}) {
    Motion<3> motion = row_of_balls({2, 0, 0});
    resolve_impacts(contacts, {.restitution = 1, .threshold = 1e-9}, motion);
    expect_near_vector(
        "velocities in a cradle of three, 2, 0 and 0 before, contacts listed " + std::string(name),
        "Eq. (7.13)", speeds(motion), numbers({0, 0, 2}), roundings(64, 2),
        {{numbers({0, 2, 0}), single},
         {numbers({2, 0, 0}), "Nothing has happened: u·n = -2 m/s is an approach."},
         {numbers({-2.0 / 3, 4.0 / 3, 4.0 / 3}),
          "This resolves both contacts together. Pair by pair only the last ball leaves."}},
        "Ball by ball they exchange their velocities: only the last one leaves.");
  }
}

EXERCISE_TEST(ResolveImpacts, TakesAnyNumberOfContacts) {
  const int balls = 300;
  std::vector<double> v(balls, 0.0), after = v;
  v.front() = after.back() = 1;
  Motion<3> motion = row_of_balls(v);
  const ImpactReport report =
      resolve_impacts(contacts_of_row(balls), {.restitution = 1, .threshold = 1e-9}, motion);
  const std::string clue = "Resolve every contact in the list.";
  expect_near(
      "impacts in a cradle of 300", "Eq. (7.13)", report.impacts, balls - 1, {0, "a count"},
      {{100,
        "This is one impact in each of 100 passes. Each contact must see what the impact before it did: "
        "read motion.W anew for each."}},
      report.impacts < balls - 1 ? clue : "This is too many: does the count begin at 0 in every call?");
  expect_near_vector("velocities in a cradle of 300, 1 m/s of the first before [m/s]", "Eq. (7.13)",
                     speeds(motion), numbers(after), roundings(64 * balls), {}, clue);
}

EXERCISE_TEST(ResolveImpacts, CradleSortsAnyVelocities) {
  Random random;
  for (int trial = 0; trial < 50 && !::testing::Test::HasFailure(); ++trial) {
    std::vector<double> v;
    for (int k = 0; k < 5; ++k) v.push_back(random.uniform(-1, 1));
    std::vector<Contact> contacts = contacts_of_row(5);
    for (std::size_t k = contacts.size() - 1; k > 0; --k)
      std::swap(contacts[k], contacts[static_cast<std::size_t>(random.integer(0, static_cast<int>(k)))]);
    Motion<3> motion = row_of_balls(v);
    given() = "given velocities " + show(numbers(v)) + " m/s";
    resolve_impacts(contacts, {.restitution = 1, .threshold = 1e-9}, motion);
    std::sort(v.begin(), v.end());
    expect_near_vector("velocities of five equal balls, e = 1, contacts in any order [m/s]", "Eq. (7.13)",
                       speeds(motion), numbers(v), {1e-8, "the threshold of 1e-9 m/s, and 10 pairs"}, {},
                       "Pairs that approach exchange their velocities, until the fastest is the last and none "
                       "approaches any more.");
  }
}

EXERCISE_TEST(ResolveImpacts, SeesWhatTheImpactBeforeDid) {
  Motion<3> motion = row_of_balls({1, 0, -1});
  resolve_impacts(contacts_of_row(3), {.restitution = 1, .threshold = 1e-9}, motion);
  expect_near_vector(
      "velocities of three equal balls, (1, 0, -1) before, e = 1 [m/s]", "Eq. (7.1), (7.13)", speeds(motion),
      numbers({-1, 0, 1}), roundings(64),
      {{numbers({0, 0, 0}),
        "Both impacts were computed with the velocities from before the pass, and all energy is gone. Apply "
        "each immediately, so that the next uses the new velocities."},
       {numbers({0, -1, 1}), "This is one pass: the middle ball now flies at the first one again."},
       {numbers({1, 0, -1}), "Nothing has happened."}},
      "The middle ball is hit by the first, then hits the third, then the first again.");
}

void expect_bounce(double v, double threshold, double expected, const std::string& clue) {
  Motion<3> motion = row_of_balls({0, v}, {1, 1});
  motion.inverse_mass[0].linear = 0;
  resolve_impacts(contacts_of_row(2), {.restitution = 0.5, .threshold = threshold}, motion);
  expect_near(
      "velocity after meeting a fixed wall at u·n = " + show(v) + " m/s, threshold " + show(threshold) +
          " m/s, e = 0.5 [m/s]",
      "Eq. (7.10)", motion.W[1].x(), expected, roundings(16),
      {{-v / 2, "This has been resolved. " + clue},
       {v, "This has been left alone. " + clue},
       {0.5 * (-v - threshold), "The threshold decides whether it is an impact. It is not subtracted."}},
      clue);
}

EXERCISE_TEST(ResolveImpacts, LeavesASlowApproachAlone) {
  expect_bounce(-0.25, 0.5, -0.25,
                "It is slower than the threshold: that is a resting contact, left to the rows.");
  expect_bounce(-0.5, 0.5, -0.5, "It is as fast as the threshold: an impact is faster, u·n < -threshold.");
  expect_bounce(-0.75, 0.5, 0.375, "It is faster than the threshold: an impact.");
  expect_bounce(0.75, 0.5, 0.75, "It separates: u·n > 0 is not an impact at any speed.");
  expect_bounce(-0.25, 0, 0.125, "Without a threshold every approach is an impact.");
}

// The impact of the first pair makes the approach of the second, which is listed before it and is seen in pass two.
EXERCISE_TEST(ResolveImpacts, TakesANaNForNoImpact) {
  Motion<3> motion = row_of_balls({std::nan(""), 1}, {1, 1});
  const ImpactReport report = resolve_impacts(contacts_of_row(2), {.restitution = 0.5}, motion);
  expect_near(
      "impacts of a ball whose velocity is NaN", "Eq. (7.10)", report.impacts, 0, {0, "a number"}, {},
      "Every comparison with NaN is false (NUMBERS.md). Test if the approach is faster than the threshold, not "
      "if it is slower.");
  expect_near("velocity of the ball beside it [m/s]", "Eq. (7.10)", speeds(motion)[1], 1, {0, "exact"});
}

EXERCISE_TEST(ResolveImpacts, LeavesASlowApproachAloneInEveryPass) {
  Motion<3> motion = row_of_balls({1, 0, 0.75});
  const std::vector<Contact> contacts{contact_along(1, 2, Vec3::UnitX()), contact_along(0, 1, Vec3::UnitX())};
  resolve_impacts(contacts, {.restitution = 1, .threshold = 0.5}, motion);
  expect_near_vector("velocities of three equal balls, (1, 0, 0.75) before, e = 1, threshold 0.5 m/s [m/s]",
                     "Eq. (7.10)", speeds(motion), numbers({0, 1, 0.75}), roundings(32),
                     {{numbers({0, 0.75, 1}),
                       "The second pair has been resolved, too: it approaches at 0.25 m/s. The threshold is "
                       "for every pass, not "
                       "for the first alone."},
                      {numbers({1, 0, 0.75}), "Nothing has happened: the first pair approaches at 1 m/s."}},
                     "The first two exchange their velocities; then ball 1 comes up to ball 2 at 0.25 m/s, "
                     "less than the threshold.");
}

EXERCISE_TEST(ResolveImpacts, ResolvesEveryContactListedWhateverItsGap) {
  for (const double gap : {-0.01, 0.0, 0.01}) {
    Motion<3> motion = row_of_balls({3, 1});
    std::vector<Contact> contacts = contacts_of_row(2);
    contacts[0].gap = gap;
    resolve_impacts(contacts, {.restitution = 1}, motion);
    expect_near_vector(
        "velocities of two equal balls, 3 and 1 m/s before, e = 1, gap = " + show(gap) + " m [m/s]",
        "Eq. (7.10)", speeds(motion), numbers({1, 3}), roundings(32, 4),
        {{numbers({3, 1}),
          gap > 0 ? "An open contact has been left out. The list also contains bodies that are about to meet. "
                    "Only u·n decides."
                  : "Nothing has happened: u·n = -2 m/s is an approach."}},
        "Only u·n decides if it is an impact: Eq. (7.10) does not contain the gap.");
  }
}

EXERCISE_TEST(ResolveImpacts, MeasuresTheApproachAtTheTimeOfTheContact) {
  Motion<3> motion = row_of_balls({0, -0.375});
  motion.inverse_mass[0].linear = 0;
  motion.Wf[1] = Vec3(-0.5, 0, 0);
  resolve_impacts(contacts_of_row(2), {.restitution = 0.5, .threshold = 0.5}, motion);
  // u = -0.375 - 0.25 = -0.625, and u' = 0.3125 = W' - 0.25.
  expect_near("W of a ball of W = -0.375, W_f = -0.5 m/s that meets a wall, threshold 0.5 m/s, e = 0.5 [m/s]",
              "Eq. (7.1), (7.10)", motion.W[1].x(), 0.5625, roundings(16),
              {{-0.375, "This has been left alone: the approach is measured at W + W_f/2, too."},
               {0.1875, "This is for u = G W, half a step too early: W_f/2 is missing."},
               {0.4375 + 0.5, "This is for u = G (W + W_f), half a step too late."},
               {0.3125,
                "This is u', the velocity at the time of the contact. W' is half a step behind: add the change "
                "to W."}},
              "u = W + W_f/2 = -0.625 m/s; W gains what u gains, (1+e) 0.625 m/s.");
}

EXERCISE_TEST(ResolveImpacts, LooksAtTheApproachNotAtTheSlip) {
  Motion<3> motion = row_of_balls({0, -0.25});
  motion.W[1].y() = 10;
  resolve_impacts(contacts_of_row(2), {.restitution = 1, .friction = 1, .threshold = 0.5}, motion);
  expect_near_vector("velocity of a ball that slips at 10 m/s and approaches at 0.25, threshold 0.5 m/s [m/s]",
                     "Eq. (7.10)", motion.W[1], Vec3(-0.25, 10, 0), {0, "exact"}, {},
                     "The threshold is on the approach, -u·n, not on |u|.");
}

EXERCISE_TEST(ResolveImpacts, TurnsASphereByFriction) {
  // It sticks, as 2/7 · 1 m/s is less than μ (1+e) · 2 m/s, and then rolls.
  const double m = 3, R = 0.5;
  Motion<6> motion{.inverse_mass = {{}, {.linear = 1 / m, .angular = Mat3::Identity() / (0.4 * m * R * R)}},
                   .W = {Twist<6>::Zero(), (Twist<6>() << 1, 0, -2, 0, 0, 0).finished()},
                   .Wf = {Twist<6>::Zero(), Twist<6>::Zero()}};
  const Contact contact{
      .i = 0, .j = 1, .n = Vec3::UnitZ(), .gap = 0, .r_i = Vec3(3, 4, 0), .r_j = Vec3(0, 0, -R)};
  resolve_impacts({contact}, {.restitution = 0.5, .friction = 0.5}, motion);
  const Twist<6> rolls = (Twist<6>() << 5.0 / 7, 0, 1, 0, 5.0 / 7 / R, 0).finished();
  expect_near_vector(
      "velocity of a solid sphere after it came down at 2 m/s, and 1 m/s along the floor, e = μ = 0.5",
      "Eq. (7.3), (7.9)", motion.W[1], rolls, roundings(64, 4),
      {{(Twist<6>() << 1, 0, 1, 0, 0, 0).finished(), "There was no friction: use the law's."},
       {(Twist<6>() << 0, 0, 1, 0, 2.5 / R, 0).finished(),
        "Your K is that of a point mass: the part of the rotation is missing."},
       {(Twist<6>() << 5.0 / 7, 0, 0, 0, 5.0 / 7 / R, 0).finished(),
        "There was no restitution: use the law's."},
       {(Twist<6>() << 1, 0, -2, 0, 0, 0).finished(), "Nothing has happened."}},
      "It sticks and rolls on at 5/7 of its speed, as any solid sphere does.");
}

EXERCISE_TEST(ResolveImpacts, TakesTheVelocityOfThePointNotOfTheCentre) {
  Motion<6> motion{.inverse_mass = {{}, {.linear = 1, .angular = Mat3::Identity()}},
                   .W = {Twist<6>::Zero(), (Twist<6>() << 0, 0, 0, 0, 2, 0).finished()},
                   .Wf = {Twist<6>::Zero(), Twist<6>::Zero()}};
  // ω × r = (0, 2, 0) × (1, 0, 0) = (0, 0, -2) m/s.
  const Contact contact{
      .i = 0, .j = 1, .n = Vec3::UnitZ(), .gap = 0, .r_i = Vec3::Zero(), .r_j = Vec3(1, 0, 0)};
  const ImpactReport report = resolve_impacts({contact}, {.restitution = 1}, motion);
  // n·Kn = 1 + 1, J = 2 n: v_z = 2 and ω_y = 2 - 2.
  expect_near("impacts of a body whose centre is at rest and whose end turns into the floor at 2 m/s",
              "Eq. (7.1)", report.impacts, 1, {0, "a count"},
              {{0, "The point of a body moves at v + ω × r, not at v."}});
  expect_near_vector("velocity of that body afterwards, e = 1", "Eq. (7.1), (7.9)", motion.W[1],
                     (Twist<6>() << 0, 0, 2, 0, 0, 0).finished(), roundings(64, 4));
}

EXERCISE_TEST(ResolveImpacts, LeavesNoApproachAboveTheThreshold) {
  Random random;
  for (int trial = 0; trial < 20 && !::testing::Test::HasFailure(); ++trial) {
    Boxes boxes(random, 5);
    std::vector<Contact> contacts;
    for (int k = 0; k < 4; ++k) contacts.push_back(boxes.contact(random, k, k + 1));
    const ImpactLaw law{
        .restitution = random.uniform(0, 1), .friction = 0.5, .threshold = 0.01, .max_passes = 100000};
    const ImpactReport report = resolve_impacts(contacts, law, boxes.motion);
    expect_true("five boxes in a chain have no more impacts before 100,000 passes", "Eq. (7.10)",
                report.passes < 100000);
    for (const Contact& contact : contacts)
      expect_at_least("u·n of a contact afterwards [m/s]", "Eq. (7.1), (7.10)",
                      boxes.velocity(contact, 0.5).dot(contact.n), -0.01 - 1e-13,
                      "the threshold, and roundings",
                      "It still approaches: go over the contacts until a pass finds none.");
    const ImpactReport again = resolve_impacts(contacts, law, boxes.motion);
    expect_near(
        "impacts of a second call", "Eq. (7.10)", again.impacts, 0, {0, "a count"}, {},
        "The first call went on until a pass found none, so there is nothing left to do. Does the count "
        "begin at 0?");
    expect_near("passes of a second call", "Eq. (7.10)", again.passes, 1, {0, "a count"}, {},
                "The last pass, which finds none, counts as well.");
  }
}

EXERCISE_TEST(ResolveImpacts, CountsImpactsAndPasses) {
  const std::vector<Contact> forwards = contacts_of_row(3);
  const std::vector<Contact> backwards(forwards.rbegin(), forwards.rend());
  const ImpactLaw law{.restitution = 1, .threshold = 1e-9};
  Motion<3> motion = row_of_balls({1, 0, 0}), other = motion, quiet = row_of_balls({0, 1, 2});
  const ImpactReport once = resolve_impacts(forwards, law, motion),
                     twice = resolve_impacts(backwards, law, other);
  const ImpactReport none = resolve_impacts(forwards, law, quiet);
  expect_near("impacts in a cradle of three", "Eq. (7.13)", once.impacts, 2, {0, "a count"},
              {{1, "This counts passes, or only one impact a pass."}}, "One of each pair.");
  expect_near("passes, contacts listed from the first ball on", "Eq. (7.10)", once.passes, 2, {0, "a count"},
              {{1, "The last pass, which finds none, counts as well."},
               {100, "Stop when a pass finds none. max_passes = 100 is a limit, not a number to reach."}},
              "One that resolves both, and one that finds none.");
  expect_near("impacts, contacts listed from the last ball on", "Eq. (7.13)", twice.impacts, 2, {0, "a count"});
  expect_near("passes, contacts listed from the last ball on", "Eq. (7.10)", twice.passes, 3, {0, "a count"},
              {{2, "The last pass, which finds none, counts as well."}},
              "One for each impact, and one that finds none.");
  Motion<3> closing = row_of_balls({2, 1, 0});  // the first two meet twice
  expect_near("impacts of three balls at 2, 1 and 0 m/s, the faster ones behind", "Eq. (7.13)",
              resolve_impacts(forwards, law, closing).impacts, 3, {0, "a count"},
              {{2, "The contact with two impacts was counted once. Count impacts, not contacts."}},
              "The first two balls meet again when the second has met the third.");
  expect_near("impacts of balls that separate", "Eq. (7.10)", none.impacts, 0, {0, "a count"});
  expect_near("passes over balls that separate", "Eq. (7.10)", none.passes, 1, {0, "a count"},
              {{0, "The pass that finds none counts as well."}});
}

EXERCISE_TEST(ResolveImpacts, StopsAtMaxPasses) {
  const std::vector<Contact> forwards = contacts_of_row(4);
  const std::vector<Contact> backwards(forwards.rbegin(), forwards.rend());
  for (const int passes : {1, 2}) {
    Motion<3> motion = row_of_balls({1, 0, 0, 0});
    const ImpactReport report =
        resolve_impacts(backwards, {.restitution = 1, .threshold = 1e-9, .max_passes = passes}, motion);
    const std::string text = "a cradle of four, contacts listed from the last ball on, max_passes = ";
    expect_near("passes over " + text + show(passes), "Eq. (7.10)", report.passes, passes, {0, "a count"}, {},
                "It goes on until a pass finds none, but not after max_passes.");
    expect_near_vector(
        "velocities in " + text + show(passes) + " [m/s]", "Eq. (7.13)", speeds(motion),
        passes == 1 ? numbers({0, 1, 0, 0}) : numbers({0, 0, 1, 0}), roundings(64),
        {{numbers({0, 0, 0, 1}),
          report.passes == passes
              ? "One of these passes went from the first ball on. Every pass must take the contacts in the "
                "order of the list."
              : "It went on after max_passes."}},
        "In this order each pass has one exchange.");
  }
}

EXERCISE_TEST(ResolveImpacts, ReportsTheEnergyOfAllImpacts) {
  Random random;
  for (int trial = 0; trial < 30 && !::testing::Test::HasFailure(); ++trial) {  // of one pass, or of several
    Boxes boxes(random, 4);
    std::vector<Contact> contacts;
    for (int k = 0; k < 3; ++k) contacts.push_back(boxes.contact(random, k, k + 1));
    const double before = boxes.kinetic_energy(0.5), early = boxes.kinetic_energy(0);
    const ImpactLaw law{.restitution = 0.3, .friction = 0.5, .threshold = 0.01};
    const ImpactReport report = resolve_impacts(contacts, law, boxes.motion);
    const double change = boxes.kinetic_energy(0.5) - before;
    expect_near(
        "energy that all impacts of four boxes add [J]", "Eq. (7.1), (7.6)", report.energy, change,
        roundings(5000, before),
        {{-change, "The sign: return the energy added, which is negative when energy is lost."},
         {boxes.kinetic_energy(0) - early,
          "This uses W, the velocities half a step before the contact. Use the u of Eq. (7.1)."},
         {0, "Add up impact_work over all impacts."}},
        "The sum of impact_work over all impacts, in every pass, each with its own u before and its own J.");
  }
}

EXERCISE_TEST(ResolveImpacts, OfNothingDoesNothing) {
  Motion<3> motion = row_of_balls({1, 0});
  const ImpactReport report = resolve_impacts({}, {.restitution = 1}, motion);
  expect_near("impacts without contacts", "Eq. (7.10)", report.impacts, 0, {0, "a count"});
  expect_near("energy that they add [J]", "Eq. (7.10)", report.energy, 0, {0, "exact"});
  expect_near("passes over no contacts", "Eq. (7.10)", report.passes, 0, {0, "a count"},
              {{1, "Without contacts the number of passes is 0."}}, "No contacts, no pass.");
  expect_near_vector("velocities without contacts [m/s]", "Eq. (7.10)", speeds(motion), numbers({1, 0}),
                     {0, "exact"});
}

void expect_law_rejected(const std::string& what, const std::string& parameter, const ImpactLaw& law) {
  for (const bool empty : {false, true}) {
    Motion<3> motion = row_of_balls({1, 0});
    expect_rejects(
        what + (empty ? ", without contacts" : ""), parameter,
        [&] { resolve_impacts(empty ? std::vector<Contact>() : contacts_of_row(2), law, motion); },
        "See common/require.hpp. Check the law first: one that makes no sense is refused even if there are no "
        "contacts.");
    expect_near_vector("velocities after a law was refused [m/s]", "", speeds(motion), numbers({1, 0}),
                       {0, "exact"}, {}, "Check before anything changes.");
  }
}

EXERCISE_TEST(ResolveImpacts, RejectsALawThatMakesNoSense) {
  Motion<3> motion = row_of_balls({1, 0});
  for (const double e : {0.0, 1.0})
    resolve_impacts(contacts_of_row(2), {.restitution = e, .friction = 0, .threshold = 1e-9, .max_passes = 1},
                    motion);
  for (const double e : {-0.1, -1e-300, 1 + 1e-15, 2.0, std::nan(""), HUGE_VAL})
    expect_law_rejected("restitution = " + show(e), "restitution", {.restitution = e});
  for (const double bad : {-0.1, -1e-300, std::nan(""), HUGE_VAL}) {
    expect_law_rejected("friction = " + show(bad), "friction", {.friction = bad});
    expect_law_rejected("threshold = " + show(bad), "threshold", {.threshold = bad});
  }
  for (const int passes : {0, -3})
    expect_law_rejected("max_passes = " + std::to_string(passes), "max_passes", {.max_passes = passes});
}

enum class Forgets { nothing, kick_of_i, kick_of_j };

// One pass as in the header. It may use another part of W_f in u, the reverse order, or the velocities before
// the pass.
std::vector<Twist<6>> one_pass(const Boxes& boxes, std::vector<Contact> contacts, const ImpactLaw& law,
                               double part, bool backwards, bool frozen, Forgets what = Forgets::nothing) {
  if (backwards) std::reverse(contacts.begin(), contacts.end());
  Boxes now = boxes;
  for (const Contact& contact : contacts) {
    Boxes seen = frozen ? boxes : now;
    if (what == Forgets::kick_of_i) seen.motion.Wf[contact.i].setZero();
    if (what == Forgets::kick_of_j) seen.motion.Wf[contact.j].setZero();
    const Vec3 u = seen.velocity(contact, part);
    if (u.dot(contact.n) >= -law.threshold) continue;
    const Mat3 K = now.K(contact);
    apply_impact(contact, impact_impulse(K, u, contact.n, law.restitution, law.friction), now.motion);
  }
  return now.motion.W;
}

Eigen::VectorXd joined(const std::vector<Twist<6>>& W) {
  Eigen::VectorXd result(static_cast<Eigen::Index>(6 * W.size()));
  for (std::size_t k = 0; k < W.size(); ++k) result.segment<6>(static_cast<Eigen::Index>(6 * k)) = W[k];
  return result;
}

EXERCISE_TEST(ResolveImpacts, IsPairByPairInOrder) {
  Random random;
  Boxes boxes(random, 4);
  std::vector<Contact> contacts;
  for (const auto& [i, j] :
       {std::pair(0, 1), std::pair(2, 1), std::pair(3, 0), std::pair(1, 3), std::pair(0, 2)})
    contacts.push_back(boxes.contact(random, i, j));
  const ImpactLaw law{.restitution = 0.6, .friction = 0.4, .threshold = 0.01, .max_passes = 1};
  Boxes resolved = boxes;
  resolve_impacts(contacts, law, resolved.motion);
  const auto pass = [&](double part, bool backwards, bool frozen) {
    return joined(one_pass(boxes, contacts, law, part, backwards, frozen));
  };
  ImpactLaw smooth = law, dead = law, swapped = law;
  smooth.friction = 0;
  dead.restitution = 0;
  std::swap(swapped.restitution, swapped.friction);
  const Eigen::VectorXd expected = pass(0.5, false, false);
  expect_near_vector(
      "velocities of four boxes after one pass over five contacts", "Eq. (7.1), (7.9)",
      joined(resolved.motion.W), expected, roundings(20000, expected.norm()),
      {{pass(0, false, false),
        "This is for u = G W, half a step too early: half of what the forces add, W_f/2, is missing."},
       {pass(1, false, false), "This is for u = G (W + W_f), half a step too late: add W_f/2."},
       {joined(one_pass(boxes, contacts, law, 0.5, false, false, Forgets::kick_of_i)),
        "Half of what the forces add is missing for body i: W_f/2 belongs to both."},
       {joined(one_pass(boxes, contacts, law, 0.5, false, false, Forgets::kick_of_j)),
        "Half of what the forces add is missing for body j: W_f/2 belongs to both."},
       {pass(0.5, false, true),
        "All impacts were computed with the velocities from before the pass: apply each immediately, so that "
        "the next uses the new velocities."},
       {pass(0.5, true, false), "The contacts were taken in reverse order."},
       {joined(one_pass(boxes, contacts, smooth, 0.5, false, false)), "The friction of the law is not used."},
       {joined(one_pass(boxes, contacts, dead, 0.5, false, false)), "The restitution of the law is not used."},
       {joined(one_pass(boxes, contacts, swapped, 0.5, false, false)),
        "e and μ are exchanged: impact_impulse takes the restitution first, then the friction."},
       {joined(boxes.motion.W), "Nothing has happened, although all five pairs approach."}},
      "For each contact in order: compute u, K and the impulse, and apply it immediately.");
  for (std::size_t k = 0; k < 4; ++k)
    expect_near_vector("W_f, which belongs to the forces", "Eq. (7.1)", resolved.motion.Wf[k],
                       boxes.motion.Wf[k], {0, "exact"}, {},
                       "u is at the time of the contact; W itself stays half a step behind.");
}

// Two boxes may touch at many points. Each point is a contact of its own.
EXERCISE_TEST(ResolveImpacts, TakesEveryContactOfAPair) {
  Random random;
  const ImpactLaw law{.restitution = 0.6, .friction = 0.4, .threshold = 0.01, .max_passes = 1};
  const std::string second = "the second contact of a pair approaches after the first one's impact",
                    turned = "so does one that names the pair the other way round";
  Regions regions({second, turned}, 5);
  while (regions.lack_draws()) {
    const Boxes boxes(random, 3);
    std::vector<Contact> contacts;
    for (const auto& [i, j] : {std::pair(0, 1), {0, 1}, {1, 2}, {1, 0}})
      contacts.push_back(boxes.contact(random, i, j));
    const auto pass = [&](const std::vector<Contact>& of) {
      return joined(one_pass(boxes, of, law, 0.5, false, false));
    };
    const Eigen::VectorXd expected = pass(contacts), one_a_pair = pass({contacts[0], contacts[2]}),
                          one_as_named = pass({contacts[0], contacts[2], contacts[3]});
    regions.draw({{second, expected != one_as_named}, {turned, one_as_named != one_a_pair}});
    Boxes resolved = boxes;
    resolve_impacts(contacts, law, resolved.motion);
    const std::string left_out =
        "The second contact of a pair has been left out, or delayed to the next pass. Each pass must resolve "
        "every contact in the list, with the velocities that the earlier ones left.";
    expect_near_vector("velocities of three boxes after one pass over four contacts, three of them of one pair",
                       "Eq. (7.1), (7.10)", joined(resolved.motion.W), expected,
                       roundings(20000, expected.norm()), {{one_a_pair, left_out}, {one_as_named, left_out}},
                       "For each contact in order.");
  }
}

// A roller with inverse mass 0 moves up to a ball, and turns below it.
EXERCISE_TEST(ResolveImpacts, DropsNothingSmall) {
  const ImpactLaw law{.restitution = 0.5, .friction = 0.5, .threshold = 0, .max_passes = 1};
  for (const double part : relative_scales)
    for (const Vec3& leaning : lopsided(part)) {
      // A ball of 1 kg against a wall that is nearly across an axis, fast or slow.
      const Vec3 n = leaning.normalized();
      for (const double speed : {1.0, 1e-12, 1e-100}) {
        Motion<3> ball{.inverse_mass = {{}, {.linear = 1}},
                       .W = {Vec3::Zero(), -2 * speed * n},
                       .Wf = {Vec3::Zero(), Vec3::Zero()}};
        resolve_impacts({{.i = 0, .j = 1, .n = n, .gap = 0, .r_i = Vec3::Zero(), .r_j = Vec3::Zero()}}, law,
                        ball);
        expect_each_near<Vec3>(
            "velocity of a ball that came straight at " + show(2 * speed) + " m/s, e = 0.5 [m/s]",
            "Eq. (7.2), (7.10)", ball.W[1], speed * n, 32);
      }
      // A body that is hit nearly at the end of its axis, and comes nearly along it.
      const Vec3 along = leaning.cwiseEqual(1).cast<double>(), r = -0.5 * leaning;
      const InverseMass<6> free{.linear = 0.5, .angular = 2 * Mat3::Identity()};
      Motion<6> body{.inverse_mass = {{}, free},
                     .W = {Twist<6>::Zero(), (Twist<6>() << -leaning, Vec3::Zero()).finished()},
                     .Wf = {Twist<6>::Zero(), Twist<6>::Zero()}};
      const Contact contact{.i = 0, .j = 1, .n = along, .gap = 0, .r_i = Vec3::Zero(), .r_j = r};
      Motion<6> expected = body;
      const Mat3 K = collision_matrix({}, Vec3::Zero(), free, r);
      apply_impact(contact, impact_impulse(K, -leaning, along, 0.5, 0.5), expected);
      resolve_impacts({contact}, law, body);
      expect_near_vector<Twist<6>>("v and ω of a body that comes along " + show(Eigen::MatrixXd(-leaning)) +
                                       " m/s and is hit at " + show(Eigen::MatrixXd(r)) + " m",
                                   "Eq. (7.3), (7.9)", body.W[1], expected.W[1], roundings(64), {},
                                   small_is_dropped);
      // And both move, one of them slowly; and both spin, slowly.
      for (const bool j_is_fast : {true, false}) {
        const Vec3 r_i = 0.4 * along, slow = part * Vec3(0.3, -0.2, 0.1), spin = part * Vec3(0.2, 0.3, -0.5);
        const Vec3 v_i = j_is_fast ? slow : leaning, v_j = j_is_fast ? Vec3(-leaning) : slow;
        const Twist<6> W_i = (Twist<6>() << v_i, spin).finished(),
                       W_j = (Twist<6>() << v_j, -2 * spin).finished();
        Motion<6> both{
            .inverse_mass = {free, free}, .W = {W_i, W_j}, .Wf = {Twist<6>::Zero(), Twist<6>::Zero()}};
        const Contact between{.i = 0, .j = 1, .n = along, .gap = 0, .r_i = r_i, .r_j = r};
        Motion<6> after = both;
        const Vec3 u = v_j - 2 * spin.cross(r) - v_i - spin.cross(r_i);
        apply_impact(between, impact_impulse(collision_matrix(free, r_i, free, r), u, along, 0.5, 0.5), after);
        resolve_impacts({between}, law, both);
        for (const std::size_t b : {0U, 1U})
          expect_near_vector<Twist<6>>(
              "v and ω of a body, where one is " + show(part) + " times as fast as the other",
              "Eq. (7.1), (7.9)", both.W[b], after.W[b], roundings(64), {}, small_is_dropped);
      }
      if (::testing::Test::HasFailure()) return;
    }
}

EXERCISE_TEST(ResolveImpacts, IncludesTheVelocityOfAKinematicBody) {
  const Vec3 up = Vec3::UnitZ(), zero = Vec3::Zero(), lift(0, 0, 1), spin(0, 8, 0);
  const ImpactLaw law{.restitution = 0.5, .friction = 0.2};
  for (const bool roller_is_i : {true, false}) {
    Motion<6> motion;
    motion.inverse_mass = {{}, {.linear = 0.5, .angular = 10 * Mat3::Identity()}};
    motion.W = {(Twist<6>() << lift, spin).finished(), Twist<6>::Zero()};
    motion.Wf = {Twist<6>::Zero(), Twist<6>::Zero()};
    Contact contact{.i = 0, .j = 1, .n = up, .gap = 0, .r_i = 0.25 * up, .r_j = -0.1 * up};
    if (!roller_is_i) contact = {.i = 1, .j = 0, .n = -up, .gap = 0, .r_i = -0.1 * up, .r_j = 0.25 * up};
    const Motion<6> before = motion;
    // The point of the roller goes up at 1 m/s, and at ω × r = 2 m/s along x.
    const Vec3 u = (roller_is_i ? -1 : 1) * (lift + spin.cross(0.25 * up));
    const Mat3 K = collision_matrix(motion.inverse_mass[1], -0.1 * up, {}, zero);
    const Vec3 J = impact_impulse(K, u, contact.n, law.restitution, law.friction);
    const ImpactReport report = resolve_impacts<6>({contact}, law, motion);
    const std::string as = roller_is_i ? ", which is i" : ", which is j";
    expect_near(
        "impacts of a ball at rest with a roller" + as + ", that comes at 1 m/s", "Eq. (7.1), (7.10)",
        report.impacts, 1, {0, "a count"},
        {{0,
          "The velocity of the body with inverse mass 0 has been left out. It counts, although no impulse "
          "changes it."}});
    if (::testing::Test::HasFailure()) return;
    expect_near_vector(
        "velocity of the ball after it [m/s]", "Eq. (7.1), (7.9)", Vec3(motion.W[1].head<3>()),
        Vec3((roller_is_i ? 0.5 : -0.5) * J), roundings(64, 5),
        {{Vec3(0, 0, 1.5), "It goes straight up. The velocity at the contact includes the roller's ω × r."}},
        "1.5 m/s up, and friction takes it along with the turning roller.");
    expect_near_vector("velocity of the roller", "Eq. (7.9)", motion.W[0], before.W[0],
                       {0, "nothing moves it"});
    expect_near("energy that was added [J]", "Eq. (7.6)", report.energy, impact_work(K, u, J),
                roundings(64, 5));
  }
}

}  // namespace
