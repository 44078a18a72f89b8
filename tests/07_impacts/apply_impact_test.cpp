// The effect of an impulse at a contact on the two bodies.
#include "collisions.hpp"
#include "exercise_test.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(ApplyImpact, "7.7 apply_impact");

Twist<6> change(const InverseMass<6>& body, const Vec3& r, const Vec3& J) {
  return (Twist<6>() << body.linear * J, body.angular * r.cross(J)).finished();
}

void expect_change(const std::string& name, const Twist<6>& got, const InverseMass<6>& body, const Vec3& r,
                   const Vec3& other_r, const Vec3& J, const Twist<6>& before) {
  const Twist<6> expected = change(body, r, J);
  const Mat3 inertia = body.angular.inverse();
  const Twist<6> linear = (Twist<6>() << body.linear * J, Vec3::Zero()).finished();
  const Twist<6> angular = expected - linear;
  expect_near_vector(
      "velocity change of body " + name + ", linear and then angular", "Eq. (7.9)", got, expected,
      roundings(64, before.norm() + expected.norm()),
      {{-expected, "The sign: J acts on j, and -J on i."},
       {Twist<6>::Zero(), "This body has not moved. By Newton's third law an impulse acts on both."},
       {linear, "The rotation is missing: off the centre an impulse also turns the body, by I⁻¹ (r×J)."},
       {linear - angular, "The sign of the torque: r×J, not J×r."},
       {change(body, other_r, J), "This uses the other body's lever arm: r_i belongs to i, and r_j to j."},
       {(Twist<6>() << J, r.cross(J)).finished(), "The masses are missing: motion.inverse_mass[i].times(...)."},
       {(Twist<6>() << J / body.linear, inertia * r.cross(J)).finished(),
        "InverseMass holds 1/m and I⁻¹ already: multiply by them."},
       {expected - before, "Keep the velocity before: add, do not assign."}},
      "M⁻¹ (J, r×J): J/m, and I⁻¹ (r×J).");
}

EXERCISE_TEST(ApplyImpact, MovesBothBodies) {
  Random random;
  Boxes bodies(random, 3);
  for (const auto& [i, j] : {std::pair(0, 1), std::pair(2, 0)}) {
    const Contact contact = bodies.contact(random, i, j);
    const Vec3 J = random.vector(2);
    const std::vector<Twist<6>> before = bodies.motion.W;
    apply_impact(contact, J, bodies.motion);
    const Motion<6>& motion = bodies.motion;
    expect_change("j", motion.W[j] - before[j], motion.inverse_mass[j], contact.r_j, contact.r_i, J, before[j]);
    expect_change("i", motion.W[i] - before[i], motion.inverse_mass[i], contact.r_i, contact.r_j, -J,
                  before[i]);
  }
}

EXERCISE_TEST(ApplyImpact, CountsLinearAndAngularApart) {
  Random random;
  for (const bool linear : {false, true}) {
    Boxes bodies(random, 2);
    for (InverseMass<6>& body : bodies.motion.inverse_mass)  // each can only move, or only turn
      body =
          linear ? InverseMass<6>{.linear = body.linear} : InverseMass<6>{.linear = 0, .angular = body.angular};
    const Contact contact = bodies.contact(random, 0, 1);
    const Vec3 J = random.vector(2);
    const std::vector<Twist<6>> before = bodies.motion.W;
    apply_impact(contact, J, bodies.motion);
    for (const int b : {0, 1}) {
      const Twist<6> right =
          change(bodies.motion.inverse_mass[b], b ? contact.r_j : contact.r_i, b ? J : Vec3(-J));
      expect_near_vector("velocity change of a body that can only " + std::string(linear ? "shift" : "turn"),
                         "Eq. (7.9)", Twist<6>(bodies.motion.W[b] - before[b]), right,
                         roundings(64, before[b].norm() + right.norm()), {},
                         "1/m and I⁻¹ are independent: where one of them is zero, the other still counts.");
    }
  }
}

EXERCISE_TEST(ApplyImpact, ChangesTheVelocityOfTheContactByKJ) {
  Random random;
  for (int trial = 0; trial < 100 && !::testing::Test::HasFailure(); ++trial) {
    Boxes pair(random, 2);
    Contact contact = pair.contact(random, 0, 1);
    contact.gap = random.uniform(-0.1, 0.1);  // which moves no arm
    const Vec3 J = random.vector(2), u = pair.velocity(contact, 0);
    apply_impact(contact, J, pair.motion);
    const Mat3 K = pair.K(contact);
    const Vec3 KJ = K * J, gained = pair.velocity(contact, 0) - u;
    expect_near_vector("change of u by an impulse between two boxes [m/s]", "Eq. (3.8), (7.9)", gained, KJ,
                       roundings(500, u.norm() + K.norm() * J.norm()),
                       {{-KJ, "The sign: J acts on j, and -J on i."}},
                       "The change is K J, by the definition of "
                       "K.");
  }
}

EXERCISE_TEST(ApplyImpact, KeepsMomentumAndAngularMomentum) {
  Random random;
  for (int trial = 0; trial < 100 && !::testing::Test::HasFailure(); ++trial) {
    Boxes pair(random, 2);
    const Contact contact = pair.contact(random, 0, 1);
    const std::vector<Twist<6>> before = pair.motion.W;
    apply_impact(contact, random.vector(2), pair.motion);
    const Vec3 point = random.vector(3);  // where the contact is; both arms end there
    const Vec3 centres[2] = {point - contact.r_i, point - contact.r_j};
    Vec3 momentum = Vec3::Zero(), angular = Vec3::Zero();
    double size = 0;
    for (std::size_t k = 0; k < 2; ++k) {
      const Twist<6> gained = pair.motion.W[k] - before[k];
      const Vec3 p = pair.boxes[k].mass * gained.head<3>(), L = pair.boxes[k].inertia * gained.tail<3>();
      momentum += p;
      angular += centres[k].cross(p) + L;
      const Mat3& I = pair.boxes[k].inertia;
      size += (pair.boxes[k].mass * (1 + centres[k].norm()) + I.norm()) * (before[k].norm() + gained.norm());
    }
    expect_near_vector("momentum that an impulse gives the two bodies in all [kg m/s]", "Eq. (7.9)", momentum,
                       Vec3::Zero(), roundings(64, size), {},
                       "What one body gains the other must lose: +J on j and -J on i, each over its own mass.");
    expect_near_vector("angular momentum about the origin that it gives them in all [kg m²/s]", "Eq. (7.9)",
                       angular, Vec3::Zero(), roundings(64, size), {},
                       "Both arms end at the same point, so r_i×(-J) and r_j×J, with what the centres' motion "
                       "adds, cancel: each body turns by its own arm.");
  }
}

EXERCISE_TEST(ApplyImpact, LeavesFixedBodiesAndAllOthersAlone) {
  Random random;
  Boxes bodies(random, 4);
  bodies.motion.inverse_mass[0] = {};
  bodies.motion.W[0].setZero();
  const Motion<6> before = bodies.motion;
  apply_impact(bodies.contact(random, 0, 2), Vec3(1, -2, 3), bodies.motion);
  const Motion<6>& after = bodies.motion;
  expect_near_vector("velocity of a static body, with inverse masses of 0", "Eq. (7.9)", after.W[0],
                     Twist<6>::Zero(), {0, "exact"}, {},
                     "Multiply by the inverse mass, and never divide by a mass.");
  for (const std::size_t k : {1U, 3U})
    expect_near_vector("velocity of a body that the contact does not touch", "Eq. (7.9)", after.W[k],
                       before.W[k], {0, "exact"});
  for (std::size_t k = 0; k < 4; ++k)
    expect_near_vector("W_f, which belongs to the forces", "Eq. (7.9)", after.Wf[k], before.Wf[k], {0, "exact"},
                       {}, "An impact changes the velocities W.");
  expect_true("the free body has moved", "Eq. (7.9)", (after.W[2] - before.W[2]).norm() > 0.1);
}

EXERCISE_TEST(ApplyImpact, TakesPointMasses) {
  Motion<3> motion{.inverse_mass = {{.linear = 0.5}, {.linear = 0.25}},
                   .W = {Vec3(1, 0, 0), Vec3(-1, 0, 2)},
                   .Wf = {Vec3::Zero(), Vec3::Zero()}};
  // The lever arms are those of a contact of spheres. They have no effect on a point mass.
  const Contact contact{
      .i = 0, .j = 1, .n = Vec3(1, 0, 0), .gap = 0, .r_i = Vec3(0.5, 0, 0), .r_j = Vec3(-0.5, 0, 0)};
  apply_impact(contact, Vec3(4, 0, 2), motion);
  expect_near_vector(
      "velocity of i, 2 kg, after (4, 0, 2) N s [m/s]", "Eq. (7.9)", motion.W[0], Vec3(-1, 0, -1),
      roundings(8, 4),
      {{Vec3(3, 0, 1), "The sign: J acts on j, and -J on i."},
       {Vec3(1, 0, 0), "This body has not moved."},
       {Vec3(-1, 0, 0), "This uses only J's component along n. A point mass has friction, too: use all of J."},
       {Vec3(-3, 0, -2), "The mass is missing: J/m."}});
  expect_near_vector(
      "velocity of j, 4 kg, after (4, 0, 2) N s [m/s]", "Eq. (7.9)", motion.W[1], Vec3(0, 0, 2.5),
      roundings(8, 4),
      {{Vec3(-2, 0, 1.5), "The sign: J acts on j, and -J on i."},
       {Vec3(-1, 0, 2), "This body has not moved."},
       {Vec3(0, 0, 2), "This uses only J's component along n. A point mass has friction, too: use all of J."},
       {Vec3(3, 0, 4), "The mass is missing: J/m."}});
}

}  // namespace
