// Steps of order four, engine/integration/rattle.hpp, and their restrictions.
#include "common/require.hpp"

namespace spook {

template <int Dof>
void World<Dof>::step_composed(double h) {
  if (!wrench_checked_) require_wrench_of_positions();
  wrench_checked_ = true;
  constraints_.rows.clear();
  solved_ = {.history = std::move(solved_.history), .converged = true};
  solved_.history.clear();
  force_impulses_.assign(bodies_.size(), Vec3::Zero());
  torque_impulses_.assign(settings_.wrench ? bodies_.size() : 0, Vec3::Zero());
  RattleJoints<Dof>& held = *rattle_joints_;
  held.begin_step(bodies_);
  double before = 0, now = time_;
  for (const double share : parts_of_order_four()) {
    const double part = share * h;
    clock_.run(Stage::forces, [&] { kick_all((before + part) / 2, now); });
    require_directions(steps_, now);
    clock_.run(Stage::rows, [&] { held.begin(joints_, bodies_, constraints_.rows, solved_); });
    clock_.run(Stage::solve, [&] {
      held.drift(joints_, part, settings_.solver_limits, settings_.rotation, constraints_.rows, bodies_,
                 solved_);
    });
    now += part;
    before = part;
  }
  clock_.run(Stage::forces, [&] { kick_all(before / 2, now); });
  require_directions(steps_, now);
  clock_.run(Stage::rows, [&] { held.begin(joints_, bodies_, constraints_.rows, solved_); });
  clock_.run(Stage::solve, [&] { held.stop(constraints_.rows, bodies_); });
  constraints_.first_contact_row = rows().size();
  constraints_.resistance_rows = 0;
  forces_.resize(bodies_.size());
  torques_.resize(torque_impulses_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) forces_[i] = force_impulses_[i] / h;
  for (std::size_t i = 0; i < torque_impulses_.size(); ++i) torques_[i] = torque_impulses_[i] / h;
  row_updates_ += static_cast<std::int64_t>(solved_.history.size() * rows().size());
  end_step(h);
}

/// Adds h M⁻¹ f to W, with forces at the current positions and `time`; updates the inertia of rigid bodies for the
/// rows.
template <int Dof>
void World<Dof>::kick_all(double h, double time) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (bodies_.is_fixed(i)) continue;
    Vec3 f = force(i);
    Twist<Dof>& W = bodies_.motion.W[i];
    if constexpr (Dof == 6)
      if (!joints_.empty()) bodies_.motion.inverse_mass[i].angular = bodies_.orientations.inverse_inertia(i);
    if (settings_.wrench) {
      const Twist<Dof> wrench = settings_.wrench(i, bodies_, time);
      f += wrench.template head<3>();
      if constexpr (Dof == 6) {
        const Vec3 spin = h * wrench.template tail<3>();
        W.template tail<3>() += bodies_.orientations.inverse_inertia(i) * spin;
        torque_impulses_[i] += spin;
      }
    }
    W.template head<3>() = kick(W.template head<3>(), f, bodies_.motion.inverse_mass[i].linear, h);
    force_impulses_[i] += h * f;
  }
}

static const std::string refused = "integrator_order must be 2 with ", reason = ", but is 4: ";

/// Throws std::invalid_argument for features that steps of order four do not support.
template <int Dof>
void World<Dof>::require_for_order_four() const {
  if (settings_.integrator_order == 2) return;
  if (settings_.integrator_order != 4) reject("integrator_order", settings_.integrator_order, "2 or 4");
  if (settings_.d) require_no_relaxation(*settings_.d);
  if constexpr (Dof == 6)
    if (settings_.rotation.update != RotationUpdate::splitting)
      throw std::invalid_argument(refused + "another rotation than splitting" + reason +
                                  "the others are not symmetric in time");
  if (shapes_.may_touch())
    throw std::invalid_argument(
        refused + "bodies that may touch" + reason +
        "a contact that opens or closes is not smooth, and friction and impacts are irreversible");
}

template <int Dof>
void World<Dof>::require_for_order_four(const Joint& joint) const {
  if (settings_.integrator_order == 2) return;
  require_no_relaxation(*joint.d);
  if (joint.kind == JointKind::rope)
    throw std::invalid_argument(refused + "a rope" + reason + "a rope that becomes taut is not smooth");
  if (joint.spring)
    throw std::invalid_argument(refused + "a spring" + reason +
                                "its joints are rigid: use wrench for a spring");
  if (joint.limits)
    throw std::invalid_argument(refused + "a limit" + reason +
                                "a row of one side that begins to push is not smooth");
  if (joint.motor)
    throw std::invalid_argument(refused + "a motor" + reason + "it sees a velocity, and has bounds");
}

template <int Dof>
void World<Dof>::require_no_relaxation(double d) const {
  if (settings_.integrator_order == 4 && d > 0)
    reject("d", d, "0 with integrator_order 4, since relaxation dissipates energy");
}

/// Throws std::invalid_argument for a wrench that depends on velocities.
template <int Dof>
void World<Dof>::require_wrench_of_positions() const {
  if (!settings_.wrench) return;
  Bodies<Dof> faster = bodies_;
  for (Twist<Dof>& W : faster.motion.W) W += Twist<Dof>::Ones();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (bodies_.is_fixed(i)) continue;
    const Twist<Dof> now = settings_.wrench(i, bodies_, time_), then = settings_.wrench(i, faster, time_);
    if (now.allFinite() && then.allFinite() && now != then)
      throw std::invalid_argument(refused + "a wrench that sees velocities" + reason +
                                  "what brakes forwards speeds up backwards");
  }
}

}  // namespace spook
