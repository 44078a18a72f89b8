#include "07_impacts/impacts.hpp"
#include "common/require.hpp"

namespace spook {

/// The velocity of a point of a body at x_n, W being half a step behind.
template <int Dof>
static Vec3 velocity_at(const Motion<Dof>& motion, int body, const Vec3& r) {
  const Twist<Dof> W = motion.W[body] + motion.Wf[body] / 2;  // Eq. (7.1)
  if constexpr (Dof == 3)
    return W;
  else
    return W.template head<3>() + W.template tail<3>().cross(r);
}

template <int Dof>
static Mat3 collision_matrix_of(const Contact& contact, const Motion<Dof>& motion) {
  const InverseMass<Dof>&i = motion.inverse_mass[contact.i], &j = motion.inverse_mass[contact.j];
  if constexpr (Dof == 3)
    return (i.linear + j.linear) * Mat3::Identity();
  else
    return collision_matrix(i, contact.r_i, j, contact.r_j);
}

static void require_sound(const ImpactLaw& law) {
  if (!(law.restitution >= 0 && law.restitution <= 1)) reject("restitution", law.restitution, "from 0 to 1");
  require_not_negative("friction", law.friction);
  require_not_negative("threshold", law.threshold);
  if (law.max_passes < 1) reject("max_passes", law.max_passes, "at least 1");
}

template <int Dof>
ImpactReport resolve_impacts(const std::vector<Contact>& contacts, const ImpactLaw& law, Motion<Dof>& motion) {
  require_sound(law);
  ImpactReport report;
  bool quiet = contacts.empty();
  while (!quiet && report.passes < law.max_passes) {
    quiet = true;
    ++report.passes;
    for (const Contact& contact : contacts) {
      const Vec3 u = velocity_at(motion, contact.j, contact.r_j) - velocity_at(motion, contact.i, contact.r_i);
      if (!(u.dot(contact.n) < -law.threshold)) continue;  // Eq. (7.10)
      const Mat3 K = collision_matrix_of(contact, motion);
      const Vec3 J = impact_impulse(K, u, contact.n, law.restitution, law.friction);
      apply_impact(contact, J, motion);
      report.energy += impact_work(K, u, J);
      ++report.impacts;
      quiet = false;
    }
  }
  return report;
}

template ImpactReport resolve_impacts<3>(const std::vector<Contact>&, const ImpactLaw&, Motion<3>&);
template ImpactReport resolve_impacts<6>(const std::vector<Contact>&, const ImpactLaw&, Motion<6>&);

}  // namespace spook
