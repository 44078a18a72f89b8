// The representative mass, which stands for the load on a contact: closed forms, and sliding blocks.
#include "exercise_test.hpp"
#include "relative_scales.hpp"
#include "sliding.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(RepresentativeMass, "5.3 representative_mass");

const std::string sum = "This adds the masses. Add the inverse masses: the lighter body decides.";

EXERCISE_TEST(RepresentativeMass, IsTheReducedMassOfTwoBodies) {
  expect_near("m of one contact between 3 kg and 6 kg [kg]", "Eq. (5.6)",
              representative_mass(1.0 / 3, 1.0 / 6, 1), 2, roundings(16, 2),
              {{9, sum},
               {0.5, "This is 1/m_i + 1/m_j, an inverse mass. Return its reciprocal."},
               {4.5, "This is the mean of the masses. m is 1/(1/m_i + 1/m_j)."},
               {4, "This is twice the reduced mass. m is 1/(1/m_i + 1/m_j)."},
               {3,
                "This is the mass of the lighter body alone. An impulse moves both, so m is less than either "
                "mass."},
               {6, "This is the mass of body j alone. An impulse moves both, so m is less than either mass."},
               {1.0 / 9, "This took the inverse masses for masses. The arguments are 1/m already."}},
              "m = 1/(1/m_i + 1/m_j) for one contact.");
}

EXERCISE_TEST(RepresentativeMass, TreatsAHeavyBodyAsDynamic) {
  for (const double part : relative_scales)
    for (const bool i_is_light : {false, true})
      expect_near("m of one contact between 1 kg and " + show(1 / part) + " kg, less 1 kg [kg]", "Eq. (5.6)",
                  (i_is_light ? representative_mass(1, part, 1) : representative_mass(part, 1, 1)) - 1,
                  -part / (1 + part), roundings(4),
                  {{0, "The heavy body counts as static. Only a body with inverse mass 0 is static."}},
                  small_is_dropped);
}

EXERCISE_TEST(RepresentativeMass, IsSharedByTheContacts) {
  expect_near("m of each of 5 contacts between 3 kg and 6 kg [kg]", "Eq. (5.6)",
              representative_mass(1.0 / 3, 1.0 / 6, 5), 0.4, roundings(16),
              {{2, "This is the mass of all five. Each contact has its share, a fifth."},
               {0.08, "This has been shared twice: divide by N once."},
               {10, "This has been multiplied by N. With more contacts each one has less."},
               {0, "1/N in integers is 0: let a double take part in the division."},
               {9.0 / 5, sum}},
              "Each of N contacts stands for m/N.");
  Random random;
  const double inverse_i = random.uniform(0.1, 2), inverse_j = random.uniform(0.1, 2);
  const double whole = representative_mass(inverse_i, inverse_j, 1);
  std::vector<int> numbers = {1000, 100'000, 2'000'000'000};
  for (int contacts = 1; contacts <= 100; ++contacts) numbers.push_back(contacts);
  for (const int contacts : numbers)
    expect_near("N m over m of a single contact, N = " + std::to_string(contacts), "Eq. (5.6)",
                contacts * representative_mass(inverse_i, inverse_j, contacts) / whole, 1, roundings(16), {},
                "All contacts together stand for the same mass as a single one.");
}

EXERCISE_TEST(RepresentativeMass, BesideAStaticBodyIsTheMassOfTheOther) {
  const std::string rule =
      "A static body has the inverse mass 0 and adds nothing to 1/m_i + 1/m_j. Add, then divide by the sum. Do "
      "not compute the mass of a static body: it is infinite.";
  for (const int contacts : {1, 4}) {
    const std::string text = "m of each of " + std::to_string(contacts) + " between a fixed body and 3 kg";
    const double m = 3.0 / contacts;
    expect_near(text + ", i fixed [kg]", "Eq. (5.6)", representative_mass(0, 1.0 / 3, contacts), m,
                roundings(16, 3), {{0, "The fixed body's mass is infinite, not 0."}}, rule);
    expect_near(text + ", j fixed [kg]", "Eq. (5.6)", representative_mass(1.0 / 3, 0, contacts), m,
                roundings(16, 3), {{0, "The fixed body's mass is infinite, not 0."}}, rule);
  }
}

EXERCISE_TEST(RepresentativeMass, IsLessThanEitherAndTheSameFromBothSides) {
  Random random;
  for (int trial = 0; trial < 100 && !::testing::Test::HasFailure(); ++trial) {
    const double m_i = random.log_uniform(1e-3, 1e3), m_j = random.log_uniform(1e-3, 1e3);
    const double m = representative_mass(1 / m_i, 1 / m_j, 1), lighter = std::min(m_i, m_j);
    given() = "m_i = " + show(m_i) + " kg, m_j = " + show(m_j) + " kg";
    expect_near("m with i and j exchanged [kg]", "Eq. (5.6)", representative_mass(1 / m_j, 1 / m_i, 1), m,
                roundings(16, m), {}, "Friction acts on both alike: neither body comes first.");
    expect_at_most("m [kg]", "Eq. (5.6)", m, lighter * (1 + 1e-15), "the lighter mass, and its roundings",
                   "An impulse moves both bodies, so m is less than either mass.");
    expect_at_least("m [kg]", "Eq. (5.6)", m, lighter / 2 * (1 - 1e-15),
                    "half the lighter mass, less roundings",
                    "For two equal masses m is half of one. A heavier second body makes m larger.");
  }
}

constexpr double mu = 0.5, g = 9.81, h = 0.01;

EXERCISE_TEST(RepresentativeMass, BrakesABlockAlikeOnAnyNumberOfContacts) {
  for (const int contacts : {1, 2, 4, 7}) {
    const double m = 3, share = representative_mass(0, 1 / m, contacts);
    Random random;
    const Tangents t = random_tangents(random);
    Block block{.m = m, .h = h, .constraints = {}};
    for (int k = 0; k < contacts; ++k)
      block.add(friction_constraints<3>(contact_between(0, 1, t), t, friction_bound(mu, share, g, h),
                                        friction_parameters(h, infinity)));
    block.v = 2 * t.t1;
    block.step();
    expect_near("deceleration of a sliding block on " + std::to_string(contacts) + " contacts [m/s²]",
                "Eq. (5.6), (5.7)", (2 - block.v.dot(t.t1)) / h, mu * g, roundings(64, 2 / h),
                {{contacts * mu * g,
                  "This is N times too much: each contact has the friction of all. Divide the mass "
                  "by N."},
                 {mu * g / contacts, "This is N times too little: the mass has been divided by N twice."}},
                "All N together decelerate it by μ g, as a single contact would.");
  }
}

// Equal blocks on a floor, one on the other, and the friction between them; body 0 is the floor.
struct Tower {
  static constexpr double m = 2;
  Tangents t;
  Motion<3> motion;
  std::vector<Constraint<3>> constraints;

  Tower(int blocks, double coefficient, double g_n, const Tangents& tangents) : t(tangents) {
    const double between = representative_mass(1 / m, 1 / m, 1), below = representative_mass(0, 1 / m, 1);
    for (int k = 0; k <= blocks; ++k) {
      motion.inverse_mass.push_back({.linear = k == 0 ? 0 : 1 / m});
      motion.W.push_back(Vec3::Zero());
      motion.Wf.push_back(Vec3::Zero());
      if (k == 0) continue;
      const double bound = friction_bound(coefficient, k == 1 ? below : between, g_n, h);
      for (const auto& row :
           friction_constraints<3>(contact_between(k - 1, k, t), t, bound, friction_parameters(h, infinity)))
        constraints.push_back(row);
    }
  }
};

// Each block is faster than the one below, so every contact slides at its bound. By Coulomb's law each block
// decelerates by μ g, as each contact carries the blocks above.
EXERCISE_TEST(RepresentativeMass, IsIndependentOfTheLoadAbove) {
  const int blocks = 5;
  Random random;
  Tower tower(blocks, mu, g, random_tangents(random));
  for (int k = 1; k <= blocks; ++k) tower.motion.W[static_cast<std::size_t>(k)] = k * tower.t.t1;
  const std::vector<Twist<3>> V = solved(tower.constraints, tower.motion);
  for (int k = 1; k <= blocks; ++k) {
    const double half = -mu * g / 2;
    expect_near(
        "acceleration of block " + std::to_string(k) + " of 5, each sliding on the one below [m/s²]",
        "Eq. (5.6), (5.15)", V[static_cast<std::size_t>(k)].dot(tower.t.t1) / h,
        k == 1 || k == blocks ? half : 0, roundings(64, blocks / h),
        {{-mu * g,
          "This is Coulomb's law, by the load above. The friction box uses the two bodies only: between equal "
          "ones m is half of one mass."},
         {4 * half, "Between two equal bodies m is half of one, not the sum."}},
        "Between equal blocks m is m/2 everywhere, so the friction from below and from above cancel. On the "
        "floor it is m, so half remains for the lowest block.");
  }
}

// The contact above the lowest block must hold the n - 1 blocks on it, and has half of what one on the floor has: it
// slides first. By Coulomb's law the tower holds wherever a single block does.
EXERCISE_TEST(RepresentativeMass, HoldsATowerOnASlopeLessThanABlock) {
  Random random;
  const double theta = 0.1, pull = h * g * std::sin(theta);
  for (const int blocks : {3, 5}) {
    const Tangents t = random_tangents(random);
    for (const double above : {1e-9, -1e-9}) {
      const double needed = 2 * (blocks - 1) * std::tan(theta);
      Tower tower(blocks, needed * (1 + above), g * std::cos(theta), t);
      for (int k = 1; k <= blocks; ++k) tower.motion.Wf[static_cast<std::size_t>(k)] = pull * t.t1;
      const std::vector<Twist<3>> V = solved(tower.constraints, tower.motion);
      for (int k = 1; k <= blocks; ++k)
        expect_near("speed of block " + std::to_string(k) + " of " + std::to_string(blocks) +
                        " after a step on a slope, μ = 2 (n - 1) tan θ times 1 " + (above > 0 ? "+" : "-") +
                        " 1e-9 [m/s]",
                    "Eq. (5.6), (5.15)", pull + V[static_cast<std::size_t>(k)].dot(t.t1),
                    above < 0 && k > 1 ? 1e-9 * pull : 0,
                    {1e-12, "the solver's tolerance, 1e-14 m/s, times n²"},
                    {{0, "It sticks. Between equal bodies m is half of one mass, for any load above."}},
                    "Between equal blocks m is half of one mass, but the contact holds all blocks above.");
    }
  }
}

EXERCISE_TEST(RepresentativeMass, RejectsWhatIsNoInverseMass) {
  representative_mass(1, 1, 1);
  const std::string clue = "See require_not_negative in require.hpp. 0 is allowed: that body is fixed.";
  for (const double wrong : {-1.0, std::nan(""), HUGE_VAL}) {
    expect_rejects(
        "inverse_mass_i = " + show(wrong), "inverse_mass_i", [&] { representative_mass(wrong, 1, 1); }, clue);
    expect_rejects(
        "inverse_mass_j = " + show(wrong), "inverse_mass_j", [&] { representative_mass(1, wrong, 1); }, clue);
  }
}

EXERCISE_TEST(RepresentativeMass, RejectsTwoFixedBodies) {
  representative_mass(1, 1, 1);
  expect_rejects(
      "both inverse masses 0", "inverse_mass_j", [] { representative_mass(0, 0, 1); },
      "Two static bodies have no reduced mass: 1/0 would make a friction without bound. See reject in "
      "require.hpp.");
}

EXERCISE_TEST(RepresentativeMass, RejectsLessThanOneContact) {
  representative_mass(1, 1, 1);
  for (const int contacts : {0, -3})
    expect_rejects(
        "contacts = " + std::to_string(contacts), "contacts", [&] { representative_mass(1, 1, contacts); },
        "See reject in require.hpp. A count has no helper of its own.");
  for (const bool first : {true, false})
    expect_rejects(
        "contacts = 0 of a body on a fixed one", "contacts",
        [&] { representative_mass(first ? 0 : 1, first ? 1 : 0, 0); },
        "Check the number of contacts also for a static body.");
}

}  // namespace
