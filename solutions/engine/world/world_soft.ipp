// Soft steps, the method of today's game engines: SoftSteps of engine/constraints/soft_rows.hpp.
//
//   once        find contacts, and build their rows
//   a substep   integrate velocities   W <- W + W_f
//               warm start             W <- W + M⁻¹ Gᵀ λ, with λ of the last substep            Eq. (10.2)
//               soft sweep             closes gaps                                            Eq. (10.16)
//               integrate positions    x <- x + h v, and each gap g <- g + h G W                   Eq. (10.19)
//               relaxing sweep         without gap and softness, from this λ                  Eq. (10.15)
//   once        restitution            of what approached fast, and pressed
//
// W takes the place of the sweeps' V, so that B has no velocities. A substep is a part of the step: World::parts().
#include <algorithm>
#include <cmath>

#include "engine/constraints/stripes.hpp"
#include "engine/support/larger.hpp"
#include "engine/support/parallel_for.hpp"

namespace spook {

template <int Dof>
void World<Dof>::step_softly(double h) {
  const double h_part = h / parts_;
  solved_.history.clear();
  solved_.converged = true;
  clock_.run(Stage::contacts, [&] { find_contacts_on_the_way(h); });
  clock_.run(Stage::forces, [&] { evaluate_forces(h_part); });
  if (h_ > 0 && h_part != h_) shift_to_step(h_part);
  clock_.run(Stage::rows, [&] { build_soft_contacts(h_part); });
  note_approaches(h);
  for (int part = 0; part < parts_; ++part) {
    if (part > 0) {
      require_directions(steps_, time_ + h_part);
      clock_.run(Stage::forces, [&] { evaluate_forces(h_part); });
    }
    integrate_velocities();
    clock_.run(Stage::rows, [&] { build_soft_joints(h_part); });
    clock_.run(Stage::solve, [&] { sweep_soft_rows(h_part); });
    clock_.run(Stage::integrate, [&] { integrate_positions(h_part); });
    clock_.run(Stage::solve, [&] { sweep_rigid_rows(h_part); });
    if constexpr (Dof == 6) part_limits_from_motors(h_part);
    force_of_drives_ = force_of_drives(h_part);
    add_work_of_soft_drives(h_part);
    end_step(h_part);
  }
  clock_.run(Stage::rows, [&] {
    soft_contacts_.return_rows(h_part, constraints_);
    last_impulses_.remember(constraints_, contacts_, h_part, settings_.threads);
  });
  if (!approaches_.empty()) clock_.run(Stage::impacts, [&] { restitute(); });
}

/// Finds the contacts of a whole step: those that bodies can close in it, up to a tenth of the smallest shape's size.
template <int Dof>
void World<Dof>::find_contacts_on_the_way(double h) {
  contacts_.clear();
  if (!shapes_.may_touch()) return;
  if (!kinematic_.empty()) update_kinematic_velocities(h / parts_);
  double fastest = 0;  // of the points of all bodies
  for (const Twist<Dof>& W : bodies_.motion.W) fastest = std::max(fastest, W.template head<3>().norm());
  if constexpr (Dof == 6)
    for (const Solid& solid : shapes_.solids) {
      const Twist<Dof>& W = bodies_.motion.W[solid.body];
      fastest =
          std::max(fastest, W.template head<3>().norm() + W.template tail<3>().norm() * reach_of(solid.shape));
    }
  const double way = h * (2 * fastest + h * settings_.gravity.norm());
  const double size = std::isfinite(shapes_.smallest) ? shapes_.smallest : 0;
  const double margin = settings_.contact_margin.value_or(std::min(way, 0.1 * size) + 1e-9 * size);
  pairs_ = finder_.find(shapes_, bodies_, margin, contacts_, settings_.threads);
}

/// Builds the rows of contacts, and gives all rows their impulses of the last step.
template <int Dof>
void World<Dof>::build_soft_contacts(double h) {
  set_default_stiffness(h);
  constraints_.first_contact_row = next_joint_row_;
  constraints_.resistance_rows = 0;
  const Friction friction{.c = settings_.viscosity,
                          .gravity = settings_.gravity,
                          .model = FrictionModel::cone,
                          .sliding_tangents = settings_.sliding_tangents};
  set_contact_rows(contacts_, h, materials_, friction, bodies_.motion, settings_.threads, constraints_);
  soft_gaps_.assign(constraints_.first_contact_row, {});
  std::vector<Row<Dof>>& rows = constraints_.rows;
  const std::vector<double> impulses = last_impulses_.impulses(constraints_, contacts_, h, settings_.threads);
  for (std::size_t k = 0; k < constraints_.first_contact_row; ++k)
    rows[k].lambda = impulses.empty() ? 0 : impulses[k];
  soft_contacts_.assign(contacts_, constraints_, impulses, stripes_of_contacts(), settings_.threads);
}

/// Returns stripes if there are enough contacts for two threads.
template <int Dof>
Stripes World<Dof>::stripes_of_contacts() const {
  if (shares_of(2, contacts_.size()) == 1) return {};
  std::vector<std::pair<int, int>> ends;
  ends.reserve(contacts_.size());
  for (const Contact& contact : contacts_) ends.emplace_back(contact.i, contact.j);
  return divide_into_stripes(ends, bodies_, settings_.threads);
}

template <int Dof>
void World<Dof>::integrate_velocities() {
  std::vector<Twist<Dof>>& W = bodies_.motion.W;
  if (!joints_.empty() || !kinematic_.empty()) V_ = W;
  for_each_body([&](std::size_t i) { W[i] += bodies_.motion.Wf[i]; });
}

/// Builds the rows of joints where they are now, with their λ of the last substep. They are built without velocities,
/// so that B is -a g, or the speed of a motor.
template <int Dof>
void World<Dof>::build_soft_joints(double h) {
  if (joints_.empty()) return;
  Motion<Dof>& motion = bodies_.motion;
  at_rest_.assign(bodies_.size(), Twist<Dof>::Zero());
  motion.Wf = at_rest_;  // W contains Wf already
  motion.W.swap(at_rest_);
  soft_joints_.clear();
  add_joint_rows(joints_, h, bodies_, soft_joints_);
  motion.W.swap(at_rest_);
  for (std::size_t n = 0; n < joints_.size(); ++n)
    soften_joint(joints_[n], h, &soft_joints_[joint_rows_[n]], &soft_gaps_[joint_rows_[n]]);
  for (std::size_t k = 0; k < constraints_.first_contact_row; ++k) {
    Row<Dof>& row = constraints_.rows[k];
    const double lambda = row.lambda;
    row = soft_joints_[k];
    row.lambda = std::clamp(lambda, row.lo, row.hi);
  }
}

template <int Dof>
void World<Dof>::sweep_soft_rows(double h) {
  const SoftSteps& soft = *settings_.soft_steps;
  std::vector<Twist<Dof>>& W = bodies_.motion.W;
  for (std::size_t k = 0; k < constraints_.first_contact_row; ++k) {
    Row<Dof>& row = constraints_.rows[k];
    make_soft(soft_gaps_[k], soft.joints, soft.closing_speed, h, row);
    if (row.lambda != 0) apply_impulse(row, row.lambda, W);
  }
  soft_contacts_.warm_start(W);
  sweep_all_rows([&] { return soft_contacts_.sweep_soft(soft.contacts, soft.closing_speed, h, W); });
}

template <int Dof>
void World<Dof>::sweep_rigid_rows(double h) {
  for (std::size_t k = 0; k < constraints_.first_contact_row; ++k)
    make_rigid(soft_gaps_[k], h, constraints_.rows[k]);
  sweep_all_rows([&] { return soft_contacts_.sweep_rigid(h, bodies_.motion.W); });
}

/// Updates joints, then all friction, then all normal rows, by Eq. (4.7), (9.6) and (10.21). Normal rows come last,
/// because they carry the weight. If friction came after each normal row, large pyramids would fall.
template <int Dof>
template <class Normals>
void World<Dof>::sweep_all_rows(const Normals& sweep_normals) {
  if (rows().empty()) return;
  std::vector<Twist<Dof>>& W = bodies_.motion.W;
  double largest = 0;
  for (std::size_t k = 0; k < constraints_.first_contact_row; ++k) {
    Row<Dof>& row = constraints_.rows[k];
    largest = larger(largest, row.diagonal * std::abs(update_row(row, W)));
  }
  largest = larger(largest, soft_contacts_.sweep_friction(W));
  largest = larger(largest, sweep_normals());
  solved_.history.push_back(largest);
  solved_.converged = largest <= settings_.solver_limits.tolerance;
  row_updates_ += std::ssize(rows());
}

/// Moves bodies, and each gap as far as their points move along its row: Eq. (10.19).
template <int Dof>
void World<Dof>::integrate_positions(double h) {
  std::vector<Twist<Dof>>& W = bodies_.motion.W;
  for (std::size_t k = 0; k < constraints_.first_contact_row; ++k) {
    if (soft_gaps_[k].kind != SoftKind::limits) continue;
    const Row<Dof>& row = constraints_.rows[k];
    soft_gaps_[k].gap += h * (row.Gi.dot(W[row.i]) + row.Gj.dot(W[row.j]));
  }
  soft_contacts_.move_gaps(h, W);
  for_each_body([&](std::size_t i) {
    if (bodies_.is_fixed(i)) return;
    bodies_.x[i] = drift(bodies_.x[i], Vec3(W[i].template head<3>()), h);
    if constexpr (Dof == 6) W[i].template tail<3>() = turned(i, W[i].template tail<3>(), h);
  });
  move_kinematic(h);
}

/// The work of λ at the mean of a substep's two velocities. V_ holds the first one.
template <int Dof>
void World<Dof>::add_work_of_soft_drives(double h) {
  if (joints_.empty() && kinematic_.empty()) return;
  soft_contacts_.return_rows(h, constraints_);
  for (std::size_t i = 0; i < V_.size(); ++i) V_[i] -= bodies_.motion.W[i] + bodies_.motion.Wf[i];
  add_work_of_drives(V_);
}

/// Notes at which speed each contact with restitution approaches, as far as that makes an impact.
template <int Dof>
void World<Dof>::note_approaches(double h) {
  approaches_.clear();
  if (!settings_.impacts && !materials_.bounce()) return;
  const double threshold = settings_.impacts.value_or(ImpactLaw{}).threshold + settings_.gravity.norm() * h;
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const std::size_t k = first_row(static_cast<int>(c));
    const Row<Dof>& row = rows()[k];
    const double speed = row.Gi.dot(bodies_.motion.W[row.i]) + row.Gj.dot(bodies_.motion.W[row.j]);
    if (speed < -threshold) approaches_.push_back({.contact = c, .speed = speed});
  }
}

/// Newton's law for contacts that approached and pressed: u' = -e u, Eq. (7.2). Their λ stays that of the last substep.
template <int Dof>
void World<Dof>::restitute() {
  for (const auto& [c, speed] : approaches_) {
    const std::size_t k = first_row(static_cast<int>(c));
    if (!soft_contacts_.pressed(c)) continue;
    Row<Dof> impact = constraints_.rows[k];
    impact.lambda = 0;
    impact.Sigma = 0;
    impact.diagonal = rigid_diagonal(impact);
    impact.B = -materials_.of(contacts_[c].i, contacts_[c].j).restitution * speed;
    if (update_row(impact, bodies_.motion.W) > 0) impacts_.push_back({contacts_[c].i, contacts_[c].j, -speed});
  }
}

}  // namespace spook
