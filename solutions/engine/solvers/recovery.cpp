#include "engine/solvers/recovery.hpp"

#include <algorithm>

#include "engine/solvers/islands.hpp"

namespace spook {

static constexpr double recovery_softness = 1e-3;  // of S_kk, in place of Σ

/// Returns G (W + W_f + V) of Eq. (7.17) [m/s], or without V where there is none.
template <int Dof>
static double opening_speed(const Row<Dof>& row, const Motion<Dof>& motion, const std::vector<Twist<Dof>>* V) {
  const auto after = [&](int body) -> Twist<Dof> {
    const Twist<Dof> free = motion.W[body] + motion.Wf[body];
    return V ? Twist<Dof>(free + (*V)[body]) : free;
  };
  return row.Gi.dot(after(row.i)) + row.Gj.dot(after(row.j));
}

/// Makes the row one that stops what closes it, and no more.
template <int Dof>
static void forget_gap(Row<Dof>& row, const Motion<Dof>& motion) {
  row.diagonal -= row.Sigma;
  row.Sigma = std::min(row.Sigma, recovery_softness * row.diagonal);
  row.diagonal += row.Sigma;
  row.B = -opening_speed<Dof>(row, motion, nullptr);
}

/// Tells whether a limit's gap g is negative: B is -a g - G (W + W_f), since b = 1, Eq. (13.11).
template <int Dof>
static bool is_beyond(const Row<Dof>& limit, const Motion<Dof>& motion) {
  return limit.B + opening_speed<Dof>(limit, motion, nullptr) > 0;
}

template <int Dof>
bool prepare_second_solve(const SolverInput<Dof>& s, double ignored,
                          const std::function<bool(const Contact&)>& may_throw, const JointRecovery& joints,
                          FirstSolve& first) {
  const Motion<Dof>& motion = s.bodies.motion;
  std::vector<Row<Dof>>& rows = s.rows();
  std::vector<bool> recovers(rows.size(), false), is_limit = recovers, holds = recovers;
  std::vector<std::optional<LimitedMotor>> motor_of(rows.size());  // of limits
  bool any = false;
  for (const std::size_t k : joints.holding) holds[k] = recovers[k] = any = true;
  for (const RigidLimit& limit : joints.limits) {
    const Row<Dof>& row = rows[limit.row];
    is_limit[limit.row] = true;
    motor_of[limit.row] = limit.motor;
    // A stiffer motor takes the impulse of the limit.
    const bool pushes = row.lambda > 0 || (limit.motor && is_beyond(row, motion));
    recovers[limit.row] = pushes && opening_speed(row, motion, &s.V) > limit.ignored;
    any = any || recovers[limit.row];
  }
  for (std::size_t c = 0; c < s.contacts.size(); ++c) {
    const std::size_t k = s.constraints.normal_row(c);
    const Row<Dof>& row = rows[k];
    if (!(row.lambda > 0) || !(opening_speed(row, motion, &s.V) > ignored)) continue;
    recovers[k] = !may_throw || !may_throw(s.contacts[c]);
    any = any || recovers[k];
  }
  if (!any) return false;

  first.rows.clear();
  first.changed.clear();
  for (const Row<Dof>& row : rows)
    first.rows.push_back({row.B, row.Sigma, row.diagonal, row.lo, row.hi, row.lambda});
  for (std::vector<int>& island : islands(rows, s.bodies.size())) {
    if (std::none_of(island.begin(), island.end(), [&](int k) { return recovers[k]; })) continue;
    for (const int k : island) {
      const bool returns = is_limit[k] && is_beyond(rows[k], motion);
      if (holds[k] || returns) forget_gap(rows[k], motion);
      if (returns && motor_of[k]) {
        Row<Dof>& motor = rows[motor_of[k]->row];
        motor.B = motor_of[k]->speed - opening_speed<Dof>(motor, motion, nullptr);  // Eq. (13.12)
      }
      const auto c = s.constraints.contact_of_normal_row(static_cast<std::size_t>(k));
      if (!c) continue;
      const Contact& contact = s.contacts[*c];
      if (contact.gap <= 0 && !(may_throw && may_throw(contact))) forget_gap(rows[k], motion);
    }
    const auto has_changed = [&](int k) { return rows[k].B != first.rows[static_cast<std::size_t>(k)].B; };
    if (std::any_of(island.begin(), island.end(), has_changed)) first.changed.push_back(std::move(island));
  }
  return true;
}

template <int Dof>
void limit_energy(const SolverInput<Dof>& s, std::size_t joint_rows,
                  const std::vector<std::vector<int>>& changed,
                  const std::function<bool(const Contact&)>& may_throw) {
  const Motion<Dof>& motion = s.bodies.motion;
  const std::vector<Row<Dof>>& rows = s.rows();
  const auto is_spring_or_joint = [&](int k) {
    if (k < static_cast<int>(joint_rows)) return true;
    const auto c = s.constraints.contact_of_normal_row(static_cast<std::size_t>(k));
    return c && may_throw && may_throw(s.contacts[*c]);
  };
  for (const std::vector<int>& island : changed) {
    if (std::any_of(island.begin(), island.end(), is_spring_or_joint)) continue;
    // κ V adds the energy b κ + ½ c κ².
    double b = 0, c = 0;
    for (const int k : island) {
      const Row<Dof>& row = rows[k];
      b += row.lambda * opening_speed<Dof>(row, motion, nullptr);
      c += row.lambda * (row.Gi.dot(s.V[row.i]) + row.Gj.dot(s.V[row.j]));
    }
    if (b + c / 2 <= 0) continue;
    const double kappa = b < 0 ? std::min(1.0, -2 * b / c) : 0;
    std::vector<int> bodies;
    for (const int k : island) {
      if (moves_i(rows[k])) bodies.push_back(rows[k].i);
      if (moves_j(rows[k])) bodies.push_back(rows[k].j);
    }
    std::sort(bodies.begin(), bodies.end());
    bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
    for (const int body : bodies) s.V[body] *= kappa;
    for (const int k : island) s.rows()[static_cast<std::size_t>(k)].lambda *= kappa;
  }
}

template <int Dof>
void restore(const std::vector<RowState>& before, std::vector<Row<Dof>>& rows) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const RowState& was = before[k];
    Row<Dof>& row = rows[k];
    row.B = was.B;
    row.Sigma = was.Sigma;
    row.diagonal = was.diagonal;
    row.lo = was.lo;
    row.hi = was.hi;
    row.lambda = was.lambda;
  }
}

template bool prepare_second_solve(const SolverInput<3>&, double, const std::function<bool(const Contact&)>&,
                                   const JointRecovery&, FirstSolve&);
template bool prepare_second_solve(const SolverInput<6>&, double, const std::function<bool(const Contact&)>&,
                                   const JointRecovery&, FirstSolve&);
template void limit_energy(const SolverInput<3>&, std::size_t, const std::vector<std::vector<int>>&,
                           const std::function<bool(const Contact&)>&);
template void limit_energy(const SolverInput<6>&, std::size_t, const std::vector<std::vector<int>>&,
                           const std::function<bool(const Contact&)>&);
template void restore(const std::vector<RowState>&, std::vector<Row<3>>&);
template void restore(const std::vector<RowState>&, std::vector<Row<6>>&);

}  // namespace spook
