#include "engine/diagnostics/energy_balance.hpp"

#include <algorithm>

#include "engine/bodies/conserved_quantities.hpp"

namespace spook {

static constexpr double share_too_much = 0.1;  // of the energy in the scene
static constexpr double unseen = 1e-8;         // a motion in a step, of the largest size, or in radians

/// Tells whether a joint, beside its motor and spring, may take energy by intent: where a limit or a rope stops bodies.
static bool may_stop(const Joint& joint) {
  return joint.limits || joint.kind == JointKind::rope;
}

static bool is_driven(const Joint& joint) {
  return joint.motor || joint.spring;
}

/// Returns the energy that closed contacts may give [J]: ½ k gap². Contacts without a k of their own leave no speed,
/// but they lift what lies on them out of an overlap, by at most the sum of all forces, `load` [N]. 0 with soft steps.
template <int Dof>
static double energy_of_contacts(const World<Dof>& world, double load) {
  if (world.settings().soft_steps) return 0;
  double energy = 0;
  for (const Contact& contact : world.contacts()) {
    if (contact.gap >= 0) continue;
    const double k = world.materials().of(contact.i, contact.j).k, stored = k * contact.gap * contact.gap / 2;
    const bool is_spring = world.settings().k || k < world.contact_stiffness();
    energy += is_spring ? stored : std::min(stored, -contact.gap * load);
  }
  return energy;
}

/// Returns the energy of a motion by 1e-8 of `size` [m] and by 1e-8 rad in a step of `h` [s]. Recovery leaves speeds of
/// a tenth of that: engine/world/world_recovery.ipp.
template <int Dof>
static double energy_unseen(const Bodies<Dof>& bodies, double size, double h) {
  const double turn = unseen / h, speed = turn * size;
  double energy = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies.is_fixed(i)) continue;
    energy += bodies.mass[i] * speed * speed / 2;
    if constexpr (Dof == 6) energy += bodies.orientations.principal[i].maxCoeff() * turn * turn / 2;
  }
  return energy;
}

template <int Dof>
void EnergyBalance<Dof>::start(const World<Dof>& world, bool velocities_are_given) {
  *this = {};
  if (velocities_are_given) settling_ = steps_to_settle;
  T_ = started_ = most_ = spook::kinetic_energy(world.bodies());
  may_dissipate_ = world.settings().impacts || world.materials().bounce() ||
                   std::any_of(world.joints().begin(), world.joints().end(), may_stop);
  for (const Joint& joint : world.joints()) {
    const JointGap gap = gap_of(joint, world.bodies());
    gaps_.push_back(gap.apart.squaredNorm());
    gaps_.push_back(joint.is_guided() ? gap.turned.squaredNorm() : 0);
  }
  note(world);
}

template <int Dof>
void EnergyBalance<Dof>::note(const World<Dof>& world) {
  W_before_ = world.bodies().motion.W;
  x_before_ = world.bodies().x;
}

/// Returns ½ k gap² of all joints [J] with the squares of their gaps at the start. A default k is known after the first
/// step only.
template <int Dof>
static double energy_of_joints(const World<Dof>& world, const std::vector<double>& gaps) {
  double energy = 0;
  for (std::size_t n = 0; n < world.joints().size() && 2 * n + 1 < gaps.size(); ++n) {
    const Joint& joint = world.joints()[n];
    energy += *joint.k * gaps[2 * n] / 2;
    if (joint.is_guided()) energy += *joint.k_turn * gaps[2 * n + 1] / 2;
  }
  return energy;
}

/// Returns the energy that joints with a k of their own store [J]: ½ k gap². Others give nothing back.
template <int Dof>
static double energy_stored(const World<Dof>& world) {
  double energy = 0;
  for (const Joint& joint : world.joints()) {
    if (joint.has_default_k) continue;
    const JointGap gap = gap_of(joint, world.bodies());
    energy += *joint.k * gap.apart.squaredNorm() / 2;
    if (joint.is_guided() && !joint.has_default_k_turn) energy += *joint.k_turn * gap.turned.squaredNorm() / 2;
  }
  return energy;
}

/// Tells whether something else than a joint may have taken energy in the last part of the step.
template <int Dof>
static bool stops(const World<Dof>& world) {
  if (!world.contacts().empty() || world.report().impacts > 0) return true;
  for (int n = 0; n < static_cast<int>(world.joints().size()); ++n) {
    const Joint& joint = world.joints()[static_cast<std::size_t>(n)];
    const bool is_rope = joint.kind == JointKind::rope;
    if ((is_rope || joint.limits) && world.joint_lambda(n, is_rope ? 0 : joint.holding_rows()) != 0)
      return true;
  }
  return false;
}

template <int Dof>
void EnergyBalance<Dof>::settle(const World<Dof>& world) {
  if (std::any_of(world.joints().begin(), world.joints().end(), is_driven)) given_ += std::max(0.0, gained());
  --settling_;
  const auto has_default_k = [](const Joint& joint) { return joint.has_default_k; };
  const bool only_joints_took = !world.joints().empty() && !stopped_;
  if (settling_ == 0 && only_joints_took &&
      std::all_of(world.joints().begin(), world.joints().end(), has_default_k))
    contradicted_ = std::max(0.0, lost());
}

template <int Dof>
void EnergyBalance<Dof>::add_step(const World<Dof>& world, double h, double largest_size) {
  const Bodies<Dof>& bodies = world.bodies();
  // Velocities are older than positions by the lag, so that the work between two of them is along x - lag v.
  const double lag = world.velocity_lag(h), lag_before = first_ ? lag : lag_;
  lag_ = lag;
  double load = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies.is_fixed(i)) continue;
    const Vec3 v_before = W_before_[i].template head<3>(), v = bodies.motion.W[i].template head<3>();
    const Vec3& force = world.forces()[i];
    given_ += force.dot(bodies.x[i] - x_before_[i] - lag * v + lag_before * v_before);
    if constexpr (Dof == 6)
      if (!world.torques().empty())
        given_ += h / 2 * world.torques()[i].dot((W_before_[i] + bodies.motion.W[i]).template tail<3>());
    load += force.norm();
  }
  given_ += world.work_of_drives();
  // The contacts and rows of a stepper are its own.
  const bool own = world.settings().stepper != nullptr, touches = own && world.shapes().may_touch();
  had_rows_ = had_rows_ || !world.rows().empty() || touches || (own && !world.joints().empty());
  // So is the work of its motors and springs, which may have either sign.
  const bool drives = own && std::any_of(world.joints().begin(), world.joints().end(), is_driven);
  may_bring_in_ = may_bring_in_ || drives;
  may_dissipate_ = may_dissipate_ || !world.contacts().empty() || touches || drives;
  T_ = spook::kinetic_energy(bodies);
  if (first_) springs_ = energy_of_contacts(world, load) + energy_of_joints(world, gaps_);
  first_ = false;
  stored_ = energy_stored(world);
  stopped_ = stopped_ || touches || drives || stops(world);
  if (settling_ > 0) settle(world);
  most_ = std::max(most_, T_);
  too_much_ = share_too_much *
              std::max({most_, load * largest_size, energy_unseen(bodies, largest_size, h / world.parts())});
  note(world);
}

template class EnergyBalance<3>;
template class EnergyBalance<6>;

}  // namespace spook
