#include "engine/constraints/joint_rows.hpp"

#include <algorithm>
#include <cmath>

#include "engine/constraints/joint_recovery.hpp"
#include "engine/constraints/parameter_cache.hpp"

namespace spook {

/// Adds the rows of Eq. (6.6), with both lever arms to one point between the two: Eq. (6.15). So there is one force and
/// no torque, and gaps are measured in a frame that rotates with the joint.
template <int Dof>
static std::array<Constraint<Dof>, 3> ball_joint_at_one_point(Attachment i, Attachment j,
                                                              const SpookParameters& spook,
                                                              const Motion<Dof>& motion) {
  std::array<Constraint<Dof>, 3> rows = ball_joint_constraints<Dof>(i, j, spook);
  if constexpr (Dof == 6) {
    const Vec3 apart = (j.x + j.r) - (i.x + i.r);
    const double of_i = motion.inverse_mass[i.body].linear, of_j = motion.inverse_mass[j.body].linear;
    i.r += of_j / (of_i + of_j) * apart;
    j.r -= of_i / (of_i + of_j) * apart;
    const std::array<Constraint<6>, 3> shared = ball_joint_constraints<6>(i, j, spook);
    for (std::size_t axis = 0; axis < rows.size(); ++axis) {
      rows[axis].Gi = shared[axis].Gi;
      rows[axis].Gj = shared[axis].Gj;
    }
  }
  return rows;
}

/// Returns a row that holds a coordinate at zero.
static Constraint<6> holding(const Coordinate& c, const SpookParameters& spook) {
  return {.i = c.i,
          .j = c.j,
          .Gi = c.Gi,
          .Gj = c.Gj,
          .gap = c.value,
          .spook = spook,
          .lo = -infinity,
          .hi = infinity};
}

/// Returns an upper bound of a row's motion in a step [m or rad].
template <int Dof>
static double reach(const Constraint<Dof>& row, double h, const Motion<Dof>& motion) {
  const auto rate = [&](const std::vector<Twist<Dof>>& of) {
    return std::abs(row.Gi.dot(of[row.i]) + row.Gj.dot(of[row.j]));
  };
  return 2 * h * (rate(motion.W) + rate(motion.Wf));
}

/// Returns the largest speed with which a limit returns its coordinate into the range [rad/s or m/s]. A hinge without a
/// k of its own turns back slowly. In a step its bodies move straight, and the gap that a large turn leaves between
/// them would become a speed.
static double largest_return(const Joint& joint) {
  return joint.kind == JointKind::hinge && joint.has_default_k_turn ? 0.5 : infinity;
}

static void add_limit_row(const Joint& joint, const Coordinate& free, double h, const Motion<6>& motion,
                          std::vector<Row<6>>& rows) {
  const double k = joint.stiffness(joint.holding_rows());
  const SpookParameters spook = spook_parameters(h, k, *joint.limit_d);
  Constraint<6> limit = limit_constraint(free, *joint.limits, spook, h);
  limit.gap = std::max(limit.gap, -largest_return(joint) / spook.a);
  if (limit.gap > reach<6>(limit, h, motion)) limit.hi = 0;
  rows.push_back(make_row(limit, motion));
}

/// Adds the row of a rope, a limit of the distance: Eq. (13.10), (13.11). λ/h is its tension.
template <int Dof>
static void add_rope_row(const Joint& joint, double h, const Bodies<Dof>& bodies, std::vector<Row<Dof>>& rows) {
  const Attachment i = attachment(joint.i, joint.p_i, bodies), j = attachment(joint.j, joint.p_j, bodies);
  const Vec3 apart = (j.x + j.r) - (i.x + i.r);
  const double distance = apart.norm();
  const Vec3 inwards = distance > 0 ? Vec3(-apart / distance) : Vec3::Zero();  // points that coincide are slack
  const ContactJacobian G =
      contact_jacobian({.i = i.body, .j = j.body, .n = inwards, .gap = 0, .r_i = i.r, .r_j = j.r});
  Constraint<Dof> rope{.i = i.body,
                       .j = j.body,
                       .Gi = G.Gi.template head<Dof>(),
                       .Gj = G.Gj.template head<Dof>(),
                       .gap = *joint.length - distance,
                       .spook = spook_parameters(h, *joint.k, *joint.limit_d),
                       .lo = 0,
                       .hi = infinity};
  if (rope.gap > 0) rope.spook.a = 1 / h;
  rope.spook.b = 1;
  if (rope.gap > reach<Dof>(rope, h, bodies.motion)) rope.hi = 0;
  rows.push_back(make_row(rope, bodies.motion));
}

/// Returns the row of a spring and its damper; the formulas are in joint_rows.hpp.
static Row<6> spring_row(const Coordinate& free, const Spring& spring, double h, const Motion<6>& motion) {
  const auto mobility = [&](int body, const Twist<6>& G) { return G.dot(motion.inverse_mass[body].times(G)); };
  const double m = 1 / (mobility(free.i, free.Gi) + mobility(free.j, free.Gj));
  const double hhk = h * h * spring.stiffness, hc = h * spring.damping;
  const double held = std::min(hhk / 4, m), braked = std::min(hc / 2, m);
  const double P = hhk - 3 * held + hc - braked, Q = held - braked;
  return make_row<6>({.i = free.i,
                      .j = free.j,
                      .Gi = free.Gi,
                      .Gj = free.Gj,
                      .gap = free.value - spring.rest,
                      .spook = {.a = h * spring.stiffness / P, .b = 1 - Q / P, .Sigma = 1 / P},
                      .lo = -infinity,
                      .hi = infinity},
                     motion);
}

/// Returns the speed nearest to a motor's own that the limits allow: within the limits, the remaining distance in a
/// step of `h`; beyond a limit, `beyond` of its gap.
template <class Beyond>
static double nearest_speed(const Joint& joint, double value, double h, const Beyond& beyond) {
  const auto allowed = [&](double gap) { return gap > 0 ? gap / h : beyond(gap); };
  const double least = -allowed(value - joint.limits->lower), most = allowed(joint.limits->upper - value);
  return std::min(std::max(joint.motor->speed, least), most);
}

/// Returns the speed that a motor aims at. Beyond a limit it is the speed of return of the limit's own row: Eq.
/// (13.17).
static double speed_within(const Joint& joint, double value, double h) {
  const double a = spook_parameters(h, 1, *joint.limit_d).a, largest = largest_return(joint);
  return nearest_speed(joint, value, h, [&](double gap) { return std::max(a * gap, -largest); });
}

double speed_without_return(const Joint& joint, double value, double h) {
  return nearest_speed(joint, value, h, [](double) { return 0.0; });
}

/// Adds the holding rows of a hinge, slider or weld, then the rows of its limits, its spring and its motor.
static void add_guided_rows(const Joint& joint, double h, double d, const Bodies<6>& bodies,
                            std::vector<Row<6>>& rows) {
  const Motion<6>& motion = bodies.motion;
  const SpookParameters spook = spook_parameters(h, *joint.k, d),
                        spook_turn = spook_parameters(h, *joint.k_turn, d);
  const JointFrames at = frames(joint, bodies);
  if (joint.kind == JointKind::slider) {
    for (int axis = 0; axis < 2; ++axis)
      rows.push_back(make_row(holding(shift_along(at.i, at.j, axis), spook), motion));
  } else {
    for (const Constraint<6>& row : ball_joint_at_one_point<6>(at.i.at, at.j.at, spook, motion))
      rows.push_back(make_row(row, motion));
  }
  const std::array<Coordinate, 3> turned = turned_apart(at.i, at.j);
  const std::size_t held = joint.kind == JointKind::hinge ? 2 : 3;
  for (std::size_t axis = 0; axis < held; ++axis)
    rows.push_back(make_row(holding(turned[axis], spook_turn), motion));
  if (!joint.limits && !joint.spring && !joint.motor) return;
  const Coordinate free = free_coordinate(joint, bodies);
  if (joint.limits) add_limit_row(joint, free, h, motion, rows);
  if (joint.spring) rows.push_back(spring_row(free, *joint.spring, h, motion));
  if (!joint.motor) return;
  Motor motor = *joint.motor;
  if (joint.limits) motor.speed = speed_within(joint, free.value, h);
  rows.push_back(motor_row(free, motor, h, motion));
}

bool limits_motor(const Joint& joint, double value, double h) {
  return joint.motor && joint.limits && speed_within(joint, value, h) != joint.motor->speed;
}

double impulse_of_limit(const Joint& joint, const Row<6>& motor_row, double speed, const Bodies<6>& bodies,
                        double h) {
  const Motor& motor = *joint.motor;
  if (!std::isfinite(motor.strength) || !limits_motor(joint, free_coordinate(joint, bodies).value, h)) return 0;
  const double own = h * motor.viscosity * (motor.speed - speed);
  return motor_row.lambda - std::clamp(own, motor_row.lo, motor_row.hi);
}

template <int Dof>
void add_joint_rows(const std::vector<Joint>& joints, double h, const Bodies<Dof>& bodies,
                    std::vector<Row<Dof>>& rows, double least_d) {
  ParameterCache spook_of(h);
  for (const Joint& joint : joints) {
    const double least = joint.recovered ? std::max(least_d, closing_relaxation) : least_d;
    const double d = joint.has_default_k ? std::max(*joint.d, least) : *joint.d;
    if constexpr (Dof == 6)
      if (joint.is_guided()) {
        add_guided_rows(joint, h, d, bodies, rows);
        continue;
      }
    if (joint.kind == JointKind::rope) {
      add_rope_row(joint, h, bodies, rows);
      continue;
    }
    const SpookParameters& spook = spook_of(*joint.k, d);
    // (World::step has checked that every distance has a direction.)
    const Attachment i = attachment(joint.i, joint.p_i, bodies), j = attachment(joint.j, joint.p_j, bodies);
    if (joint.length) {
      rows.push_back(make_row(distance_constraint<Dof>(i, j, *joint.length, spook), bodies.motion));
    } else {
      for (const Constraint<Dof>& row : ball_joint_at_one_point<Dof>(i, j, spook, bodies.motion))
        rows.push_back(make_row(row, bodies.motion));
    }
  }
}

template void add_joint_rows<3>(const std::vector<Joint>&, double, const Bodies<3>&, std::vector<Row<3>>&,
                                double);
template void add_joint_rows<6>(const std::vector<Joint>&, double, const Bodies<6>&, std::vector<Row<6>>&,
                                double);

}  // namespace spook
