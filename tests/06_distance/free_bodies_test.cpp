// Free chains of rigid bodies: momentum and angular momentum over many steps.
#include "exercise_test.hpp"
#include "systems.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(DistanceConstraint, "6.1 distance_constraint");
EXERCISE(BallJointConstraints, "6.2 ball_joint_constraints");

/// Four boxes without gravity. A point of each is connected with a point of the next, at the distance `apart`
/// [m].
struct Chain {
  static constexpr std::size_t bodies = 4;
  std::vector<Rigid> boxes = {};
  std::vector<Vec3> on_i = {}, on_j = {};  // the points, in the coordinates of the bodies
  double apart = 0;

  /// Hangs the next box on the last one.
  void add(const Rigid& box, const Vec3& last_point, const Vec3& next_point, const Vec3& direction) {
    boxes.push_back(box);
    if (boxes.size() == 1) return;
    const Rigid& last = boxes[boxes.size() - 2];
    on_i.push_back(last_point);
    on_j.push_back(next_point);
    boxes.back().x = last.x + last.q * last_point + apart * direction - box.q * next_point;
  }

  Attachment end_i(std::size_t k) const {
    return {.body = static_cast<int>(k), .x = boxes[k].x, .r = boxes[k].q * on_i[k]};
  }
  Attachment end_j(std::size_t k) const {
    return {.body = static_cast<int>(k + 1), .x = boxes[k + 1].x, .r = boxes[k + 1].q * on_j[k]};
  }
  Vec3 apart_now(std::size_t k) const {
    const Attachment i = end_i(k), j = end_j(k);
    return j.x + j.r - i.x - i.r;
  }

  Vec3 momentum() const {
    Vec3 sum = Vec3::Zero();
    for (const Rigid& box : boxes) sum += box.momentum();
    return sum;
  }
  Vec3 angular_momentum() const {
    Vec3 sum = Vec3::Zero();
    for (const Rigid& box : boxes) sum += box.angular_momentum();
    return sum;
  }
  /// The size of the terms of both sums: 8 kg in total, about 3 m from the origin, at about 3 m/s.
  static constexpr double size = 72;

  void step_with_distances(double h) {
    const SpookParameters spook = spook_parameters(h, 1e8, 3);
    std::vector<Constraint<6>> constraints;
    for (std::size_t k = 0; k + 1 < bodies; ++k)
      constraints.push_back(distance_constraint<6>(end_i(k), end_j(k), apart, spook));
    step(boxes, constraints, false, h, {.max_sweeps = 100, .tolerance = 1e-12});
  }

  /// Returns the torque impulse of the joints, whose points are not quite together [kg m²/s].
  Vec3 step_with_joints(double h) {
    const SpookParameters spook = spook_parameters(h, 1e8, 3);
    std::vector<Constraint<6>> constraints;
    std::vector<Vec3> gaps;
    for (std::size_t k = 0; k + 1 < bodies; ++k) {
      for (const Constraint<6>& row : ball_joint_constraints<6>(end_i(k), end_j(k), spook))
        constraints.push_back(row);
      gaps.push_back(apart_now(k));
    }
    const std::vector<double> lambda =
        step(boxes, constraints, false, h, {.max_sweeps = 300, .tolerance = 1e-12});
    Vec3 torque = Vec3::Zero();
    for (std::size_t k = 0; k + 1 < bodies; ++k)
      torque += gaps[k].cross(Vec3(lambda[3 * k], lambda[3 * k + 1], lambda[3 * k + 2]));
    return torque;
  }
};

Chain random_chain(Random& random, double apart) {
  Chain chain{.apart = apart};
  for (std::size_t k = 0; k < Chain::bodies; ++k) {
    Rigid box = random_box(random);
    box.v = random.vector();
    box.omega = random.vector(2);
    const Vec3 last_point = random.vector(0.6), next_point = random.vector(0.6);
    chain.add(box, last_point, next_point, random.unit_vector());
  }
  return chain;
}

/// Boxes of 0.4 × 0.6 × 1 m, joined at their corners and thrown as one rigid body: no gap changes at first.
Chain thrown_in_one_piece() {
  const Vec3 corner(0.2, 0.3, 0.5), v(0.3, -0.2, 0.5), omega(1, -0.5, 2);
  Chain chain;
  for (int k = 0; k < 4; ++k)
    chain.add({.inverse_mass = 1,
               .principal = Vec3(1.36, 1.16, 0.52) / 12,
               .x = Vec3(1, 0, 0),
               .q = Quat(Eigen::AngleAxisd(0.7 * k, Vec3(1, 2, 2) / 3))},
              corner, -corner, Vec3::Zero());
  for (Rigid& box : chain.boxes) {
    box.v = v + omega.cross(box.x);
    box.omega = omega;
  }
  return chain;
}

Tolerance after_steps(int steps) {
  return roundings(20.0 * steps, Chain::size);
}

EXERCISE_TEST(DistanceConstraint, KeepsMomentumAndAngularMomentum) {
  Random random;
  Chain chain = random_chain(random, 0.8);
  const Vec3 P = chain.momentum(), L = chain.angular_momentum();
  const int steps = 500;
  for (int n = 0; n < steps; ++n) chain.step_with_distances(0.01);
  expect_near_vector("momentum of four boxes on three rods, after 500 steps [kg m/s]", "Eq. (6.3)",
                     chain.momentum(), P, after_steps(steps), {}, "Action equals reaction: n on j, -n on i.");
  expect_near_vector(
      "angular momentum of four boxes on three rods, after 500 steps [kg m²/s]", "Eq. (6.3)",
      chain.angular_momentum(), L, after_steps(steps), {},
      "The pulls at both ends of a rod lie on one line, so they have no torque. Look at r × n of "
      "both bodies, and at the direction n: from point to point.");
}

EXERCISE_TEST(BallJointConstraints, KeepsMomentum) {
  Random random;
  Chain chain = random_chain(random, 0);
  const Vec3 P = chain.momentum();
  const int steps = 500;
  for (int n = 0; n < steps; ++n) chain.step_with_joints(0.01);
  expect_near_vector("momentum of four boxes with three ball joints, after 500 steps [kg m/s]", "Eq. (6.6)",
                     chain.momentum(), P, after_steps(steps), {}, "Action equals reaction: e on j, -e on i.");
}

EXERCISE_TEST(BallJointConstraints, KeepsAngularMomentumButForTheGaps) {
  Random random;
  Chain chain = random_chain(random, 0);
  Vec3 L = chain.angular_momentum();
  const int steps = 500;
  for (int n = 0; n < steps; ++n) L += chain.step_with_joints(0.01);
  expect_near_vector(
      "angular momentum of four boxes with three ball joints, after 500 steps [kg m²/s]", "Eq. (6.5), (6.6)",
      chain.angular_momentum(), L, after_steps(steps), {},
      "In a step a joint adds only (p_j - p_i) × J. Look at r × e of both bodies, and at the signs.");
}

EXERCISE_TEST(BallJointConstraints, LosesAngularMomentumWithOrderTwo) {
  const auto lost = [](double h) {
    Chain chain = thrown_in_one_piece();
    const Vec3 before = chain.angular_momentum();
    const int steps = static_cast<int>(std::lround(1 / h));
    for (int n = 0; n < steps; ++n) chain.step_with_joints(h);
    return (chain.angular_momentum() - before).norm();
  };
  expect_order("angular momentum that four boxes with three ball joints gain in 1 s [kg m²/s]", "Eq. (6.5)",
               lost, 0.01, 3, 2, 0.2,
               "The gaps are of order h², and so is the torque of two opposite pulls at a gap.");
}

}  // namespace
