// The Jacobian of a contact: its blocks, G W for velocities, and Gᵀ λ for impulses.
#include "03_single_contact/single_contact.hpp"
#include "bodies.hpp"
#include "exercise_test.hpp"
#include "relative_scales.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(ContactJacobian, "3.2 contact_jacobian");

EXERCISE_TEST(ContactJacobian, TurnsABodyAboutItsContactPoint) {
  // Body j is pushed up at a point 2 m to the right (+x) of its centre: it turns about -y. Body i is pushed down at a
  // point 1 m further along +y than its own centre: it turns about -x.
  const Vec3 n(0, 0, 1), down(0, 0, -1), zero(0, 0, 0);
  const ContactJacobian G = contact_jacobian({0, 1, n, 0, Vec3(0, 1, 1), Vec3(2, 0, -1)});
  expect_near_vector(
      "Gj for n = (0, 0, 1), r_i = (0, 1, 1), r_j = (2, 0, -1)", "Eq. (3.3)", G.Gj, twist(n, Vec3(0, -2, 0)),
      roundings(4, 2),
      {{twist(n, Vec3(0, 2, 0)), "This is n × r_j. The torque of a push n at r is r × n."},
       {twist(n, zero), "The angular block is missing: a push beside the centre also turns the body."},
       {twist(-n, Vec3(0, 2, 0)), "The sign: n points from i to j, so j is pushed along +n."},
       {twist(Vec3(0, -2, 0), n), "The linear part comes first, then the angular one."},
       {twist(n, Vec3(1, 0, 0)), "This used r_i for body j. Each body has its own lever arm."},
       {twist(n, Vec3(2, 0, -1)), "The angular block is a cross product, r_j × n."},
       {twist(zero, zero), "Body 1 has no block. Each body has one, whatever its number."}},
      "Gj = (n, r_j × n).");
  expect_near_vector(
      "Gi for n = (0, 0, 1), r_i = (0, 1, 1), r_j = (2, 0, -1)", "Eq. (3.3)", G.Gi, twist(down, Vec3(-1, 0, 0)),
      roundings(4, 2),
      {{twist(n, Vec3(1, 0, 0)), "The sign: body i is pushed along -n."},
       {twist(down, Vec3(1, 0, 0)), "The sign of the angular block: both parts of Gi have a minus."},
       {twist(down, zero), "The angular block is missing: a push beside the centre also turns the body."},
       {twist(Vec3(-1, 0, 0), down), "The linear part comes first, then the angular one."},
       {twist(down, Vec3(0, 2, 0)), "This used r_j for body i. Each body has its own lever arm."},
       {twist(zero, zero), "Body 0 has no block. Each body has one, whatever its number."}},
      "Gi = (-n, -r_i × n).");
}

EXERCISE_TEST(ContactJacobian, IsIndependentOfBodyNumbers) {
  Random random;
  Contact contact = RandomPair(random).contact;
  const ContactJacobian G = contact_jacobian(contact);
  for (const auto& [i, j] : {std::pair(1, 0), std::pair(7, 3), std::pair(3, 7)}) {
    contact.i = i, contact.j = j;
    const ContactJacobian same = contact_jacobian(contact);
    const std::string clue = "n points from i to j, also where i > j: G of j has +n, and G of i has -n.";
    const std::string pair = " for bodies i = " + std::to_string(i) + " and j = " + std::to_string(j);
    expect_near_vector("Gi" + pair, "Eq. (3.3)", same.Gi, G.Gi,
                       {0, "the order of body numbers does not matter"}, {}, clue);
    expect_near_vector("Gj" + pair, "Eq. (3.3)", same.Gj, G.Gj,
                       {0, "the order of body numbers does not matter"}, {}, clue);
  }
}

EXERCISE_TEST(ContactJacobian, HasFourBlocks) {
  Random random;
  Contact contact = RandomPair(random).contact;
  const Vec3 n = contact.n, r_i = contact.r_i, r_j = contact.r_j;
  for (const double gap : {-0.01, 0.0, 0.01}) {  // which G does not use
    contact.gap = gap;
    const ContactJacobian G = contact_jacobian(contact);
    expect_near_vector(
        "Gj", "Eq. (3.3)", G.Gj, twist(n, r_j.cross(n)), roundings(8, 2),
        {{twist(n, n.cross(r_j)), "The angular block is n × r_j. The torque of a push n at r is r × n."},
         {twist(n, Vec3::Zero()),
          "The angular block is missing: a push beside the centre also turns the body."},
         {twist(n, r_i.cross(n)), "This used r_i for body j. Each body has its own lever arm."},
         {twist(-n, -r_j.cross(n)), "The sign: n points from i to j, so j is pushed along +n, and i along -n."},
         {twist(n, -r_j.cross(n)), "The sign of the angular block: it goes with n, as r_j × n."},
         {twist(r_j.cross(n), n), "The linear part comes first, then the angular one."},
         {twist(n, r_j), "The angular block is a cross product, r_j × n."},
         {twist(Vec3::Zero(), Vec3::Zero()), "All are 0 for the gap " + show(gap) +
                                                 " m. G does not depend on the gap: an open contact has a G, "
                                                 "too."}},
        "Gj = (n, r_j × n).");
    expect_near_vector(
        "Gi", "Eq. (3.3)", G.Gi, twist(-n, -r_i.cross(n)), roundings(8, 2),
        {{twist(-n, r_i.cross(n)), "The sign of the angular block: both parts of Gi have a minus."},
         {twist(-n, Vec3::Zero()),
          "The angular block is missing: a push beside the centre also turns the body."},
         {twist(-n, -r_j.cross(n)), "This used r_j for body i. Each body has its own lever arm."},
         {twist(n, r_i.cross(n)),
          "The sign: body i is pushed along -n, both in its linear and its angular part."},
         {twist(n, -r_i.cross(n)), "The sign of the linear block: body i is pushed along -n."},
         {twist(-r_i.cross(n), -n), "The linear part comes first, then the angular one."}},
        "Gi = (-n, -r_i × n).");
    if (::testing::Test::HasFailure()) return;
  }
}

// Eq. (3.1) a time t later: points fixed on their bodies, n fixed in the world.
double gap_after(double t, const RandomPair& pair, const Twist<6>& Wi, const Twist<6>& Wj) {
  const auto point = [t](const Vec3& r, const Twist<6>& W) -> Vec3 {
    const Vec3 v = W.head<3>(), omega = W.tail<3>();
    return t * v + Eigen::AngleAxisd(t * omega.norm(), omega.normalized()) * r;
  };
  return pair.contact.n.dot(point(pair.contact.r_j, Wj) - point(pair.contact.r_i, Wi));
}

EXERCISE_TEST(ContactJacobian, TimesVelocityIsTheRateOfTheGap) {
  Random random;
  const RandomPair pair(random);
  const ContactJacobian G = contact_jacobian(pair.contact);
  const double dt = 1e-5;
  for (int trial = 0; trial < 20 && !::testing::Test::HasFailure(); ++trial) {
    const Twist<6> Wi = random.twist(), Wj = random.twist();
    const double rate = (gap_after(dt, pair, Wi, Wj) - gap_after(-dt, pair, Wi, Wj)) / (2 * dt);
    const double got = G.Gi.dot(Wi) + G.Gj.dot(Wj);
    expect_near(
        "G W against the gap of two moving bodies, differentiated numerically [m/s]", "Eq. (3.2), (3.3)", got,
        rate, {1e-8, "dt²/6 |ω|³|r| of two bodies < 3e-10, and 16 roundings of 4 m over dt"},
        {{-rate, "This is the rate at which the gap closes: i and j are exchanged, or n has the wrong sign."}},
        "Write down the velocities of the two contact points, v + ω × r, then their difference along n.");
  }
}

EXERCISE_TEST(ContactJacobian, PushesBothBodiesAlike) {
  Random random;
  const RandomPair pair(random);
  const ContactJacobian G = contact_jacobian(pair.contact);
  expect_near_vector("sum of the linear blocks", "Eq. (3.3)", Vec3(G.Gi.head<3>() + G.Gj.head<3>()),
                     Vec3::Zero(), roundings(4), {},
                     "Action equals reaction: the impulses n λ and -n λ add up to zero.");
}

EXERCISE_TEST(ContactJacobian, GivesNoAngularMomentum) {
  Random random;
  const RandomPair pair(random);
  const Vec3 x_i = random.vector(), x_j = x_i + pair.contact.r_i - pair.contact.r_j;  // the points coincide
  const ContactJacobian G = contact_jacobian(pair.contact);
  const auto about_origin = [](const Vec3& x, const Twist<6>& P) -> Vec3 {
    return x.cross(P.head<3>()) + P.tail<3>();
  };
  expect_near_vector(
      "angular momentum about the origin that an impulse of 1 N s adds, when the contact points meet",
      "Eq. (3.3), (3.12)", Vec3(about_origin(x_i, G.Gi) + about_origin(x_j, G.Gj)), Vec3::Zero(),
      roundings(32, 4), {},
      "Two opposite pushes at one point have no torque. Look at r × n of both bodies, and at the signs.");
}

EXERCISE_TEST(ContactJacobian, DropsNothingSmall) {
  for (const double part : relative_scales) {
    const ContactJacobian G = contact_jacobian({0, 1, Vec3::UnitZ(), 0, Vec3(0, part, 1), Vec3(part, 0, 1)});
    expect_near_vector("angular part of Gj, for r_j that is nearly along n", "Eq. (3.3)", Vec3(G.Gj.tail<3>()),
                       Vec3(0, -part, 0), roundings(4, part), {{Vec3::Zero(), small_is_dropped}},
                       small_is_dropped);
    expect_near_vector("angular part of Gi, for r_i that is nearly along n", "Eq. (3.3)", Vec3(G.Gi.tail<3>()),
                       Vec3(-part, 0, 0), roundings(4, part), {{Vec3::Zero(), small_is_dropped}},
                       small_is_dropped);
    if (::testing::Test::HasFailure()) return;
  }
}

}  // namespace
