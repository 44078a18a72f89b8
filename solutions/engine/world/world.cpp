#include "engine/world/world.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/require.hpp"
#include "engine/constraints/contact_resistance.hpp"
#include "engine/support/parallel_for.hpp"

namespace spook {

/// Tells whether positions and velocities of all dynamic bodies are finite.
template <int Dof>
static bool are_dynamic_finite(const Bodies<Dof>& bodies) {
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (!bodies.is_fixed(i) && !std::isfinite(bodies.x[i].sum() + bodies.motion.W[i].sum())) return false;
  return true;
}

template <int Dof>
void World<Dof>::step(double h) {
  require_positive("h", h);
  require_directions(steps_ + 1, time_ + h);
  ++steps_;
  try {
    take_step(h);
  } catch (const SimulationDiverged&) {
    throw;
  } catch (...) {
    // Bodies that are not finite are no error of the caller.
    if (!are_dynamic_finite(bodies_)) require_finite_bodies();
    --steps_;                    // a step that a velocity function or a check ends does not count
    forget_contacts_and_rows();  // one may be of this step, and the other of the last
    throw;
  }
}

template <int Dof>
void World<Dof>::take_step(double h) {
  if (settings_.stepper) return step_elsewhere(h);
  impacts_.clear();
  work_of_drives_ = 0;
  if (settings_.integrator_order == 4) return step_composed(h);
  const bool divides = may_divide_steps();
  divide_steps(h, divides);
  if (settings_.soft_steps) return step_softly(h);
  if (!divides && parts_ == 1) return step_part(h);
  if (divides) remember_state();
  SolveReport unsolved{.history = {}, .converged = true};
  for (int part = 0; part < parts_; ++part) {
    step_part(h / parts_);
    if (!solved_.converged) unsolved = solved_;
    if (divides && divide_more(h)) {
      go_back();
      unsolved.converged = true;
      part = -1;
    }
  }
  if (!unsolved.converged) solved_ = std::move(unsolved);
}

template <int Dof>
void World<Dof>::step_part(double h) {
  solved_ = {.history = {}, .converged = true};
  require_directions(steps_, time_ + h);
  if (shapes_.may_touch()) clock_.run(Stage::contacts, [&] { find_contacts(h); });
  clock_.run(Stage::forces, [&] { evaluate_forces(h); });
  if (h_ > 0 && h != h_) shift_to_step(h);
  if (!contacts_.empty() || !joints_.empty()) set_default_stiffness(h);
  if ((settings_.impacts || materials_.bounce()) && !contacts_.empty())
    clock_.run(Stage::impacts, [&] { resolve_impacts(h); });
  if (contacts_.empty() && joints_.empty()) {
    constraints_.clear();
    last_impulses_.forget();  // it has the impulses of the last step alone
  } else {
    clock_.run(Stage::rows, [&] { build_rows(h); });
  }
  if (!rows().empty()) clock_.run(Stage::solve, [&] { solve_rows(h); });
  if (!rows().empty() && !settings_.k) clock_.run(Stage::solve, [&] { solve_again(h); });
  if (!rows().empty()) {
    if (recovered_.empty()) add_work_of_drives(V_);  // else solve_again() has added it
    if constexpr (Dof == 6) part_limits_from_motors(h);
  }
  force_of_drives_ = joints_.empty() ? 0 : force_of_drives(h);
  clock_.run(Stage::integrate, [&] { integrate(h); });
}

template <int Dof>
void World<Dof>::step_elsewhere(double h) {
  evaluate_forces(h);
  set_default_stiffness(h);
  solved_ = settings_.stepper(*this, h, bodies_);
  end_step(h);
}

template <int Dof>
void World<Dof>::require_directions(std::int64_t step, double time) const {
  for (const Joint& joint : joints_) {
    if (!joint.length) continue;
    const double apart = distance(joint, bodies_);
    if ((apart > 0 || joint.kind == JointKind::rope) && std::isfinite(apart)) continue;
    const std::string where = apart == 0 ? "distance 0" : "an infinite distance";
    throw SimulationDiverged(step, time, joint.j, "is at " + where + " of the body that it is joined to");
  }
}

template <int Dof>
void World<Dof>::find_contacts(double h) {
  pairs_ = finder_.find(shapes_, bodies_, margin(h), contacts_, settings_.threads);
}

template <int Dof>
double World<Dof>::margin(double h) const {
  if (settings_.contact_margin) return *settings_.contact_margin;
  const double size = shapes_.smallest;
  if (!std::isfinite(size)) return 0;
  return std::min(settings_.gravity.norm() * h * h, 1e-2 * size) + 1e-9 * size;
}

template <int Dof>
Vec3 World<Dof>::force(std::size_t i) const {
  const Vec3 weight = bodies_.mass[i] * settings_.gravity;
  if (!settings_.force) return weight;
  return weight + settings_.force(i, bodies_.x);
}

template <int Dof>
void World<Dof>::evaluate_forces(double h) {
  forces_.resize(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) forces_[i] = force(i);
  torques_.assign(Dof == 6 && settings_.wrench ? bodies_.size() : 0, Vec3::Zero());
  if (settings_.wrench) add_wrenches();
  if (!kinematic_.empty()) update_kinematic_velocities(h);
  if (!contacts_.empty() || !joints_.empty() || settings_.soft_steps) prepare_motion(h);
}

/// Moves W of free bodies from half of the last step before x_n to half of this step, Eq. (1.5). W of a body on which a
/// row acts does not change, since load and constraint forces cancel.
template <int Dof>
void World<Dof>::shift_to_step(double h) {
  std::vector<bool> is_held(bodies_.size(), false);
  for (const Row<Dof>& row : rows())
    if (row.lambda != 0) is_held[row.i] = is_held[row.j] = true;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (bodies_.is_fixed(i) || is_held[i]) continue;
    Twist<Dof>& W = bodies_.motion.W[i];
    const double inverse_mass = bodies_.motion.inverse_mass[i].linear;
    W.template head<3>() = half_step_start(W.template head<3>(), forces_[i], inverse_mass, h - h_);
    if constexpr (Dof == 6) W.template tail<3>() += turned_by_torques(i, W.template tail<3>(), (h_ - h) / 2);
  }
}

template <int Dof>
void World<Dof>::add_wrenches() {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (bodies_.is_fixed(i)) continue;
    const Twist<Dof> wrench = settings_.wrench(i, bodies_, time_);
    forces_[i] += wrench.template head<3>();
    if constexpr (Dof == 6) torques_[i] = wrench.template tail<3>();
  }
}

/// Returns the change of ω in a step by torques, including the gyroscopic torque if the rotation rule treats it as a
/// torque.
template <int Dof>
Vec3 World<Dof>::turned_by_torques(std::size_t i, const Vec3& omega, double h) const {
  Vec3 change = Vec3::Zero();
  if constexpr (Dof == 6) {
    change = gyroscopic_change(settings_.rotation, bodies_.orientations, i, omega, h);
    if (settings_.wrench && !bodies_.is_fixed(i))
      change += h * bodies_.orientations.inverse_inertia(i) * torques_[i];
  }
  return change;
}

/// Returns W_f = h M⁻¹ f of a body, the kick that it would get at rest, with the gyroscopic torque of its present ω.
template <int Dof>
Twist<Dof> World<Dof>::change_by_forces(std::size_t i, double h) const {
  Twist<Dof> Wf = Twist<Dof>::Zero();
  Wf.template head<3>() = kick(Vec3::Zero(), forces_[i], bodies_.motion.inverse_mass[i].linear, h);
  if constexpr (Dof == 6)
    if (!bodies_.is_fixed(i))
      Wf.template tail<3>() = turned_by_torques(i, bodies_.motion.W[i].template tail<3>(), h);
  return Wf;
}

/// Calls work(i) for each body, on the threads of the world.
template <int Dof>
template <class Work>
void World<Dof>::for_each_body(const Work& work) {
  parallel_for(settings_.threads, bodies_.size(), [&](std::size_t, std::size_t i, std::size_t end) {
    for (; i < end; ++i) work(i);
  });
}

/// Computes the input of rows and impacts in addition to W: W_f and, for rigid bodies, the inertia.
template <int Dof>
void World<Dof>::prepare_motion(double h) {
  Motion<Dof>& motion = bodies_.motion;
  for_each_body([&](std::size_t i) {
    motion.Wf[i] = change_by_forces(i, h);
    if constexpr (Dof == 6)
      if (!bodies_.is_fixed(i)) motion.inverse_mass[i].angular = bodies_.orientations.inverse_inertia(i);
  });
}

/// Sets the default k. Bodies and forces may change in each step; the load that k follows never decreases.
template <int Dof>
void World<Dof>::set_default_stiffness(double h) {
  if (settings_.k) return;
  double mass = 0, load = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (bodies_.is_fixed(i)) continue;
    mass += bodies_.mass[i];
    load += forces_[i].norm();
  }
  load = std::max(largest_load_, load + force_of_drives_);
  const double of_joints = joint_stiffness(mass, h);
  const double k = spook::contact_stiffness(load, shapes_.smallest, of_joints);
  const char* too_short = "so long that the default k, 2e6/h² of the mass, is finite, or k given";
  if (!std::isfinite(k) && !contacts_.empty()) {
    if (shapes_.smallest == 0)
      reject("size of a body", 0, "positive for the default k of contacts, or k given");
    if (load == 0) reject("h", h, too_short);
    reject("sum of all forces", load, "so small that the default k of contacts is finite, or k given");
  }
  largest_load_ = load;
  materials_.set_stiffness(k);
  if (joints_.empty()) return;
  double arm = 0;  // squared [m²]
  if constexpr (Dof == 6) {
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      if (!bodies_.is_fixed(i))
        arm = std::max(arm, bodies_.orientations.principal[i].maxCoeff() / bodies_.mass[i]);
    for (const Joint& joint : joints_) arm = std::max({arm, joint.p_i.squaredNorm(), joint.p_j.squaredNorm()});
  }
  for (Joint& joint : joints_) {
    if ((joint.has_default_k || joint.has_default_k_turn) && !std::isfinite(of_joints))
      reject("h", h, too_short);
    if (joint.has_default_k) joint.k = of_joints;
    if (joint.has_default_k_turn) joint.k_turn = arm * of_joints;
  }
}

/// Overwrites the contact rows of the last step, since those of a large pile take many megabytes.
template <int Dof>
void World<Dof>::build_rows(double h) {
  constraints_.first_contact_row = constraints_.resistance_rows = 0;
  if (!joints_.empty() || materials_.resist()) {
    constraints_.rows.clear();
    add_joint_rows(joints_, h, bodies_, constraints_.rows, least_relaxation(h));
    const std::size_t of_joints = rows().size();
    if constexpr (Dof == 6)
      if (materials_.resist())
        add_resistance_rows(contacts_, h, materials_, last_impulses_, bodies_.motion, constraints_.rows);
    constraints_.first_contact_row = rows().size();
    constraints_.resistance_rows = rows().size() - of_joints;
  }
  const Friction friction{.c = settings_.viscosity,
                          .gravity = settings_.gravity,
                          .model = settings_.solver.friction,
                          .sliding_tangents = settings_.sliding_tangents};
  set_contact_rows(contacts_, h, materials_, friction, bodies_.motion, settings_.threads, constraints_);
}

template <int Dof>
void World<Dof>::solve_rows(double h) {
  V_.assign(bodies_.size(), Twist<Dof>::Zero());
  if (settings_.warm_start) warm_start_rows(h);
  SolverResult outcome = settings_.solver.solve(solver_input(V_, h, stop_rule(h)));
  row_updates_ += outcome.updates(rows().size());
  solved_ = std::move(outcome.report);
  // The law of impacts and resistance to rolling need the forces of contacts.
  const bool needs_forces = settings_.impacts || materials_.bounce() || materials_.resist();
  if (settings_.warm_start || settings_.solver.wants_last || needs_forces)
    last_impulses_.remember(constraints_, contacts_, h, settings_.threads);
}

template <int Dof>
SolverInput<Dof> World<Dof>::solver_input(std::vector<Twist<Dof>>& V, double h, const StopRule& stop) {
  return {.constraints = constraints_,
          .V = V,
          .joints = joints_,
          .contacts = contacts_,
          .bodies = bodies_,
          .last = last_impulses_,
          .gravity = settings_.gravity,
          .h = h,
          .stop = stop,
          .threads = settings_.threads};
}

template <int Dof>
void World<Dof>::warm_start_rows(double h) {
  const std::vector<double> impulses = last_impulses_.impulses(constraints_, contacts_, h, settings_.threads);
  if (!impulses.empty()) warm_start(impulses, constraints_.rows, V_);  // Eq. (10.2)
}

template <int Dof>
void World<Dof>::integrate(double h) {
  for_each_body([&](std::size_t i) {
    if (bodies_.is_fixed(i)) return;
    Twist<Dof>& W = bodies_.motion.W[i];
    if (rows().empty()) {
      W += change_by_forces(i, h);
    } else {
      W += bodies_.motion.Wf[i];
      W += V_[i];
    }
    bodies_.x[i] = drift(bodies_.x[i], W.template head<3>(), h);
    if constexpr (Dof == 6) W.template tail<3>() = turned(i, W.template tail<3>(), h);
    if (!recovered_.empty()) W.template head<3>() += recovered_[i].template head<3>();
  });
  recovered_.clear();
  move_kinematic(h);
  end_step(h);
}

template <int Dof>
void World<Dof>::end_step(double h) {
  time_ += h;
  h_ = h;
  gap_step_ = std::max(h, 0.7 * gap_step_);
  require_finite_bodies();
  count_turns();
}

/// Updates the angles of hinges from step to step, since a quaternion determines an angle within one turn only: Eq.
/// (13.9).
template <int Dof>
void World<Dof>::count_turns() {
  if constexpr (Dof == 6)
    for (const std::size_t hinge : hinges_)
      joints_[hinge].angle = free_coordinate(joints_[hinge], bodies_).value;
}

template <int Dof>
void World<Dof>::require_finite_bodies() const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    // The sum is not finite if one number is not.
    double sum = bodies_.x[i].sum() + bodies_.motion.W[i].sum();
    if constexpr (Dof == 6) sum += bodies_.orientations.q[i].coeffs().sum();
    if (!std::isfinite(sum)) throw SimulationDiverged(steps_, time_, static_cast<int>(i));
  }
}

}  // namespace spook

#include "engine/world/world_arguments.ipp"
#include "engine/world/world_changes.ipp"
#include "engine/world/world_drives.ipp"
#include "engine/world/world_impacts.ipp"
#include "engine/world/world_joints.ipp"
#include "engine/world/world_kinematic.ipp"
#include "engine/world/world_order_four.ipp"
#include "engine/world/world_parts.ipp"
#include "engine/world/world_queries.ipp"
#include "engine/world/world_recovery.ipp"
#include "engine/world/world_setup.ipp"
#include "engine/world/world_soft.ipp"
#include "engine/world/world_start.ipp"
#include "engine/world/world_state.ipp"

// All members are defined above, since a class may be instantiated only once in a program.
template class spook::World<3>;
template class spook::World<6>;
