#include "scenes/solver_between.hpp"

#include <algorithm>
#include <stdexcept>

#include "engine/constraints/joint_rows.hpp"

namespace spook {

bool has_mechanisms(const std::vector<Joint>& joints) {
  return std::any_of(joints.begin(), joints.end(),
                     [](const Joint& joint) { return joint.is_guided() || joint.kind == JointKind::rope; });
}

/// Returns a row with the numbers of a rigid body, or with those of a point mass, which are its first three.
template <int Dof>
static Row<Dof> row_of(const Row<6>& row) {
  return {.i = row.i,
          .j = row.j,
          .Gi = row.Gi.head<Dof>(),
          .Gj = row.Gj.head<Dof>(),
          .MinvGi = row.MinvGi.head<Dof>(),
          .MinvGj = row.MinvGj.head<Dof>(),
          .B = row.B,
          .Sigma = row.Sigma,
          .diagonal = row.diagonal,
          .lo = row.lo,
          .hi = row.hi,
          .lambda = row.lambda};
}

template <int Dof>
static void copy_motion(const Motion<6>& from, Motion<Dof>& to) {
  for (std::size_t b = 0; b < from.W.size(); ++b) {
    to.W[b] = from.W[b].head<Dof>();
    to.Wf[b] = from.Wf[b].head<Dof>();
    to.inverse_mass[b].linear = from.inverse_mass[b].linear;
    if constexpr (Dof == 6) to.inverse_mass[b].angular = from.inverse_mass[b].angular;
  }
}

/// Throws std::invalid_argument if a student's step_rows has left out rows, or lists rows that there are not.
static void require_whole(const StepRows& half, std::size_t contact_rows) {
  const auto is_outside = [&](const FrictionContact& contact) {
    return contact.normal + 2 >= half.rows.size();
  };
  if (half.rows.size() >= contact_rows && half.motion.W.size() == half.motion.inverse_mass.size() &&
      half.motion.W.size() == half.motion.Wf.size() &&
      std::none_of(half.friction.begin(), half.friction.end(), is_outside))
    return;
  throw std::invalid_argument(
      "exercise 9.9 step_rows returns too few rows, or lists rows that do not exist: see ./course check 9.9");
}

/// Keeps chapter 05's bounds of friction rows for the box alone. Two passes begin without friction, and cones have no
/// bounds.
template <int Dof>
void SolverBetween<Dof>::set_friction_bounds(ConstraintSet<Dof>& constraints) const {
  if (solver_.friction == FrictionModel::box) {
    constraints.friction.clear();
    return;
  }
  const double bound = solver_.friction == FrictionModel::cone ? infinity : 0;
  for (const FrictionContact& contact : constraints.friction)
    for (const std::size_t k : {contact.normal + 1, contact.normal + 2}) {
      constraints.rows[k].lo = -bound;
      constraints.rows[k].hi = bound;
    }
}

template <int Dof>
SolveReport SolverBetween<Dof>::step(const World<Dof>& world, const std::vector<Contact>& contacts, double h,
                                     Simulation& simulation, Bodies<Dof>& bodies) {
  StepRows half = step_rows(simulation, contacts, h);
  const std::size_t contact_rows = (simulation.mu > 0 ? 3 : 1) * contacts.size();
  require_whole(half, contact_rows);
  copy_motion(half.motion, bodies.motion);
  ConstraintSet<Dof> constraints{.rows_per_contact = simulation.mu > 0 ? 3U : 1U};
  std::vector<Row<Dof>>& rows = constraints.rows;
  if (has_mechanisms(world.joints())) add_joint_rows(world.joints(), h, bodies, rows);
  for (FrictionContact& contact : half.friction) contact.normal += rows.size();
  constraints.friction = std::move(half.friction);
  for (const Row<6>& row : half.rows) rows.push_back(row_of<Dof>(row));
  constraints.first_contact_row = rows.size() - contact_rows;
  set_friction_bounds(constraints);

  std::vector<Twist<Dof>> V(bodies.size(), Twist<Dof>::Zero());
  if (warm_start_) {
    const std::vector<double> impulses = last_.impulses(constraints, contacts, h);
    if (!impulses.empty()) warm_start(impulses, rows, V);
  }
  SolverResult result = solver_.solve({.constraints = constraints,
                                       .V = V,
                                       .joints = world.joints(),
                                       .contacts = contacts,
                                       .bodies = bodies,
                                       .last = last_,
                                       .gravity = simulation.gravity,
                                       .h = h,
                                       .stop = world.stop_rule(h)});
  if (warm_start_ || solver_.wants_last) last_.remember(constraints, contacts, h);
  std::vector<Twist<6>> changes(V.size(), Twist<6>::Zero());
  for (std::size_t b = 0; b < V.size(); ++b) changes[b].template head<Dof>() = V[b];
  finish_step(simulation, changes, h);
  return std::move(result.report);
}

template class SolverBetween<3>;
template class SolverBetween<6>;

}  // namespace spook
