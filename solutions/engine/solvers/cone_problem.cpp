#include "engine/solvers/cone_problem.hpp"

#include <algorithm>

#include "09_better_friction/cone_rows.hpp"
#include "engine/solvers/anderson.hpp"
#include "engine/solvers/solver_result.hpp"

namespace spook {

template <int Dof>
ConeProblem<Dof>::ConeProblem(std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V,
                              const std::vector<FrictionContact>& friction,
                              const std::vector<InverseMass<Dof>>& inverse_mass,
                              ContactVelocitySystem<Dof>& system)
    : rows_(rows),
      V_(V),
      friction_(friction),
      inverse_mass_(inverse_mass),
      system_(system),
      rhs_norm_(spook::rhs_norm(rows)) {
  system_.begin(rows, inverse_mass);
  auto contact = friction.begin();
  for (std::size_t k = 0; k < rows.size(); k += static_cast<std::size_t>(blocks_.back().count)) {
    const bool rubs = contact != friction.end() && contact->normal == k;
    blocks_.push_back({.row = k, .count = rubs ? 3 : 1});
    if (!rubs) continue;
    blocks_.back().mu = contact++->mu;
    blocks_.back().s = stiffest_direction(rows[k + 1], rows[k + 2]);
  }
}

template <int Dof>
double ConeProblem<Dof>::row_residual(std::size_t k) const {
  const Row<Dof>& row = rows_[k];
  return row.B - row.Gi.dot(V_[row.i]) - row.Gj.dot(V_[row.j]) - row.Sigma * row.lambda;
}

template <int Dof>
double ConeProblem<Dof>::residual() const {
  return residual_on_cones(friction_, rows_, V_);
}

template <int Dof>
bool ConeProblem<Dof>::is_solved(double residual, double tolerance) const {
  return residual <= std::max(tolerance, roundings(rows_));
}

template <int Dof>
std::vector<double> ConeProblem<Dof>::impulses() const {
  std::vector<double> all;
  all.reserve(rows_.size());
  for (const Row<Dof>& row : rows_) all.push_back(row.lambda);
  return all;
}

template <int Dof>
void ConeProblem<Dof>::set_impulses(const std::vector<double>& lambda) {
  std::fill(V_.begin(), V_.end(), Twist<Dof>::Zero());
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    rows_[k].lambda = lambda[k];
    apply_impulse(rows_[k], lambda[k], V_);
  }
}

template <int Dof>
void ConeProblem<Dof>::sweep(int count) {
  for (int n = 0; n < count; ++n) sweep_on_cones(friction_, rows_, V_);
  sweeps_ += count;
}

template <int Dof>
void ConeProblem<Dof>::accelerated_sweeps(int most, double tolerance) {
  const StopRule stop{.max_sweeps = most, .tolerance = tolerance};
  sweeps_ += std::ssize(anderson_solve(friction_, rows_, V_, inverse_mass_, stop).history);
}

template <int Dof>
void ConeProblem<Dof>::project(std::vector<double>& lambda) const {
  for (const ContactBlock& block : blocks_) {
    double* of = &lambda[block.row];
    of[0] = std::clamp(of[0], rows_[block.row].lo, rows_[block.row].hi);
    if (block.count == 1) continue;
    const Vec2 inside = onto_disc({of[1], of[2]}, block.mu * of[0]);
    of[1] = inside[0], of[2] = inside[1];
  }
}

template <int Dof>
void ConeProblem<Dof>::factorise() {
  system_.begin_matrix();
  for (const ContactBlock& block : blocks_) system_.add(&rows_[block.row], block.count, block.K);
  system_.factorise();
}

template <int Dof>
bool ConeProblem<Dof>::solve(std::vector<double>& step) {
  system_.begin_right();
  for (const ContactBlock& block : blocks_) system_.add_right(&rows_[block.row], block.count, block.k);
  if (!system_.solve()) return false;
  step.resize(rows_.size());
  for (const ContactBlock& block : blocks_) {
    Vec3 Gv = Vec3::Zero();
    for (int n = 0; n < block.count; ++n) Gv[n] = system_.gather(rows_[block.row + n]);
    const Vec3 change = block.k - block.K * Gv;
    std::copy_n(change.data(), block.count, step.begin() + static_cast<std::ptrdiff_t>(block.row));
  }
  return true;
}

template class ConeProblem<3>;
template class ConeProblem<6>;

}  // namespace spook
