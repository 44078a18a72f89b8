// Start of a world: velocities half a step behind positions, as leapfrog needs.
#include <algorithm>

#include "11_direct/direct.hpp"
#include "common/require.hpp"

namespace spook {

/// Notes that the velocities now are half a step back. Throws std::invalid_argument for an invalid h, for a second
/// start, and after a step.
template <int Dof>
void World<Dof>::note_start(const char* how, double h) {
  require_positive("h", h);
  if (half_step_back_ || steps_ > 0)
    throw std::invalid_argument(
        std::string(how) +
        " may be called once, before the first step; steps so far: " + std::to_string(steps_));
  half_step_back_ = true;
}

template <int Dof>
void World<Dof>::start_half_step_back(double h) {
  note_start("start_half_step_back", h);
  if (settings_.integrator_order == 4) return;
  divide_steps(h, may_divide_steps());
  h /= parts_;
  evaluate_forces(h);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Twist<Dof>& W = bodies_.motion.W[i];
    const double inverse_mass = bodies_.motion.inverse_mass[i].linear;
    W.template head<3>() = half_step_start(W.template head<3>(), forces_[i], inverse_mass, h);  // Eq. (1.5)
    if constexpr (Dof == 6) W.template tail<3>() += turned_by_torques(i, W.template tail<3>(), -h / 2);
  }
}

/// Returns the rate of G W of the joints' rows due to the change of G [m/s²], by differences over a thousandth of a
/// step.
template <int Dof>
static std::vector<double> turning_rows(const std::vector<Joint>& joints, double h,
                                        const RotationRule<Dof>& rotation, const Bodies<Dof>& bodies) {
  const double dt = 1e-3 * h;
  const auto after = [&](double time) {
    Bodies<Dof> moved = bodies;
    for (std::size_t i = 0; i < moved.size(); ++i) {
      if (moved.is_fixed(i)) continue;
      moved.x[i] += time * moved.motion.W[i].template head<3>();
      if constexpr (Dof == 6) {
        Vec3 omega = moved.motion.W[i].template tail<3>();
        rotate(rotation, moved.orientations, i, omega, time);
      }
    }
    std::vector<Row<Dof>> rows;
    add_joint_rows(joints, h, moved, rows);
    std::vector<double> speeds;
    for (const Row<Dof>& row : rows)
      speeds.push_back(row.Gi.dot(bodies.motion.W[row.i]) + row.Gj.dot(bodies.motion.W[row.j]));
    return speeds;
  };
  std::vector<double> rates = after(dt);
  const std::vector<double> before = after(-dt);
  for (std::size_t k = 0; k < rates.size(); ++k) rates[k] = (rates[k] - before[k]) / (2 * dt);
  return rates;
}

/// Marks the rows of springs and motors among so many rows.
static std::vector<bool> rows_of_drives(const std::vector<Joint>& joints, std::size_t rows) {
  std::vector<bool> drives(rows, false);
  std::size_t end = 0;
  for (const Joint& joint : joints) {
    if (joint.spring) drives[end + static_cast<std::size_t>(joint.spring_row())] = true;
    end += static_cast<std::size_t>(joint.rows());
    if (joint.motor) drives[end - 1] = true;
  }
  return drives;
}

/// Erases the contacts whose rows separate: they have no force. Returns whether there are any.
template <int Dof>
bool World<Dof>::erase_separating_contacts() {
  const std::vector<Twist<Dof>>& W = bodies_.motion.W;
  std::size_t c = 0;
  return std::erase_if(contacts_, [&](const Contact&) {
           const Row<Dof>& row = rows()[constraints_.normal_row(c++)];
           return row.Gi.dot(W[row.i]) + row.Gj.dot(W[row.j]) > 0;
         }) > 0;
}

template <int Dof>
void World<Dof>::start_consistently(double h) {
  note_start("start_consistently", h);
  if (settings_.integrator_order == 4) return;
  if (shapes_.may_touch()) find_contacts(h);
  evaluate_forces(h);
  prepare_motion(h);
  set_default_stiffness(h);
  build_rows(h);
  if (erase_separating_contacts()) build_rows(h);
  const std::vector<double> turning = turning_rows(joints_, h, settings_.rotation, bodies_);
  const Motion<Dof>& motion = bodies_.motion;
  const std::vector<bool> drives = rows_of_drives(joints_, rows().size());
  for (std::size_t k = 0; k < rows().size(); ++k) {
    Row<Dof>& row = constraints_.rows[k];
    const auto along = [&](const std::vector<Twist<Dof>>& of) {
      return row.Gi.dot(of[row.i]) + row.Gj.dot(of[row.j]);
    };
    if (!drives[k]) row.B = -along(motion.Wf);  // motors and springs act at a speed of their own
    if (k < turning.size()) row.B -= h * turning[k];
    if (constraints_.is_friction(k))
      row.B -= along(motion.W);  // friction opposes slip
    else if (row.lo == 0 && along(motion.W) > 0)
      row.hi = 0;  // a limit that its joint leaves has no force
  }
  V_.assign(bodies_.size(), Twist<Dof>::Zero());
  if (constraints_.friction.empty()) {
    Factors factors;
    direct_solve(constraints_.rows, V_, StopRule{}, factors);
  } else {
    newton<Dof>(FrictionModel::cone).solve(solver_input(V_, h, StopRule{}));
  }
  h_ = h;
  const bool divides = may_divide_steps();
  if (divides) parts_per_second_ = parts_needed_now(h) / h;  // by these forces
  divide_steps(h, divides);
  h_ = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) bodies_.motion.W[i] -= (motion.Wf[i] + V_[i]) / (2 * parts_);
  forget_the_last_step();
}

/// Returns half of the change of velocity by the joints in the last step: their forces at the time of the position are
/// not known before the next step. Returns nothing if a contact acts on the body, since its impulse may have stopped
/// the body; shift_to_step assumes that loads and contact forces then cancel.
template <int Dof>
std::optional<Twist<Dof>> World<Dof>::half_change_by_joints(std::size_t i) const {
  if (settings_.soft_steps || V_.size() != bodies_.size()) return Twist<Dof>(Twist<Dof>::Zero());
  const auto acts = [&](const Row<Dof>& row) {
    return row.lambda != 0 && (row.i == static_cast<int>(i) || row.j == static_cast<int>(i));
  };
  const auto first = static_cast<std::ptrdiff_t>(std::min(constraints_.first_contact_row, rows().size()));
  const auto contacts = rows().begin() + first;
  if (std::any_of(contacts, rows().end(), acts)) return {};
  const bool joined = std::any_of(rows().begin(), contacts, acts);
  return joined ? Twist<Dof>(V_[i] / 2) : Twist<Dof>(Twist<Dof>::Zero());
}

template <int Dof>
Vec3 World<Dof>::synchronized_velocity(int body, double h) const {
  require_not_negative("h", h);
  const std::size_t i = index(body);
  const auto by_joints = half_change_by_joints(i);
  if (settings_.integrator_order == 4 || !by_joints) return v(body);
  Vec3 now = force(i);
  if (settings_.wrench && !bodies_.is_fixed(i)) now += settings_.wrench(i, bodies_, time_).template head<3>();
  return half_step_start(v(body), now, bodies_.motion.inverse_mass[i].linear, -h / parts_) +
         by_joints->template head<3>();
}

// `if constexpr`, though `requires` says the same: clang before 16 compiles this for point masses, too.
template <int Dof>
Vec3 World<Dof>::synchronized_angular_velocity(int body, double h) const requires(Dof == 6) {
  require_not_negative("h", h);
  const std::size_t i = index(body);
  const Vec3 omega = bodies_.motion.W[i].template tail<3>();
  if constexpr (Dof == 6) {
    const auto by_joints = half_change_by_joints(i);
    if (settings_.integrator_order == 4 || !by_joints) return omega;
    const double lag = h / parts_ / 2;
    Vec3 now = omega + gyroscopic_change(settings_.rotation, bodies_.orientations, i, omega, lag);
    if (settings_.wrench && !bodies_.is_fixed(i)) {
      const Vec3 torque = settings_.wrench(i, bodies_, time_).template tail<3>();
      now += lag * bodies_.orientations.inverse_inertia(i) * torque;
    }
    return now + by_joints->template tail<3>();
  }
  return omega;
}

}  // namespace spook
