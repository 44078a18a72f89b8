#include "engine/constraints/step_parts.hpp"

#include <algorithm>
#include <cmath>

namespace spook {

static constexpr double turn_of_body = 1, turn_of_arm = 0.12;  // in a part [rad]

namespace {

/// Stiffness that loads give a body, by its mass and moments of inertia [1/s²].
struct Swing {
  double linear = 0;
  Vec3 angular = Vec3::Zero();  ///< about its principal axes
};

/// One end of a joint.
template <int Dof>
struct End {
  std::size_t body;
  Vec3 p;  ///< in the body's axes
  Vec3 r = Vec3::Zero(), v = Vec3::Zero();
};

template <int Dof>
End<Dof> end_of(int body, const Vec3& p, const Bodies<Dof>& bodies) {
  End<Dof> end{.body = static_cast<std::size_t>(body), .p = p};
  end.v = bodies.motion.W[end.body].template head<3>();
  if constexpr (Dof == 6) {
    end.r = bodies.orientations.q[end.body] * p;
    end.v += bodies.motion.W[end.body].template tail<3>().cross(end.r);
  }
  return end;
}

/// Returns how many parts the body's own rotation needs.
double parts_to_turn(const End<6>& end, bool held_by_axes, const Bodies<6>& bodies, double h) {
  const Vec3 omega = bodies.motion.W[end.body].tail<3>();
  const double arm = end.r.norm();
  if (bodies.is_fixed(end.body) || (arm == 0 && !held_by_axes)) return 0;
  const double whole = omega.norm() * h / turn_of_body;
  return arm > 0 ? std::max(whole, omega.cross(end.r).norm() / arm * h / turn_of_arm) : whole;
}

/// Returns how many parts a hinge's motor needs at its speed.
double parts_to_drive(const Joint& joint, double h) {
  if (joint.kind != JointKind::hinge) return 0;
  const bool has_arm = !joint.p_i.isZero(0) || !joint.p_j.isZero(0);
  return std::abs(joint.motor->speed) * h / (has_arm ? turn_of_arm : turn_of_body);
}

/// Adds what the force of a joint makes of a lever: Eq. (12.3) with an arm in place of a link.
void add_load(const End<6>& end, double force, const Bodies<6>& bodies, Swing& swing) {
  const double arm = end.p.norm();
  if (arm == 0 || bodies.is_fixed(end.body)) return;
  const Vec3 across = Vec3::Ones() - (end.p / arm).cwiseAbs2();
  swing.angular += force * arm * across.cwiseQuotient(bodies.orientations.principal[end.body]);
}

}  // namespace

template <int Dof>
double parts_needed(const std::vector<Joint>& joints, const Bodies<Dof>& bodies, double h,
                    const std::function<double(int joint)>& force_of) {
  double parts = 1;
  std::vector<Swing> swings(bodies.size());
  for (int n = 0; n < std::ssize(joints); ++n) {
    const Joint& joint = joints[static_cast<std::size_t>(n)];
    if (!joint.has_default_k) continue;
    const double force = force_of(n);
    const End<Dof> i = end_of(joint.i, joint.p_i, bodies), j = end_of(joint.j, joint.p_j, bodies);
    const Vec3 apart = bodies.x[j.body] + j.r - bodies.x[i.body] - i.r;
    // A slack rope counts if it becomes taut within the step.
    if (joint.kind == JointKind::rope && force == 0 && (apart + h * (j.v - i.v)).norm() < *joint.length)
      continue;
    if (joint.length) {
      const double across = apart.cross(j.v - i.v).norm() / apart.squaredNorm();
      if (std::isfinite(across)) parts = std::max(parts, across * h / turn_of_arm);
      for (const std::size_t body : {i.body, j.body})
        swings[body].linear += force / *joint.length * bodies.motion.inverse_mass[body].linear;
    }
    if constexpr (Dof == 6) {
      if (joint.motor) parts = std::max(parts, parts_to_drive(joint, h));
      for (const End<6>& end : {i, j}) {
        parts = std::max(parts, parts_to_turn(end, joint.is_guided(), bodies, h));
        add_load(end, force, bodies, swings[end.body]);
      }
    }
  }
  for (const Swing& swing : swings)
    parts = std::max(parts, h * std::sqrt(std::max(swing.linear, swing.angular.maxCoeff())));
  return parts;
}

template double parts_needed<3>(const std::vector<Joint>&, const Bodies<3>&, double,
                                const std::function<double(int)>&);
template double parts_needed<6>(const std::vector<Joint>&, const Bodies<6>&, double,
                                const std::function<double(int)>&);

}  // namespace spook
