// Newton's method on what an update leaves: rows of a contact inside Coulomb's cone, or rows within their bounds.
//
//   of a contact   Δλ = k - K G v, with a block K of 3 x 3, by whether it is open, sticks or slides: engine/solvers/contact_newton.hpp
//   of bodies      (M + Gᵀ K G) v = Gᵀ k, v what Δλ adds to V: engine/linear/contact_velocity_system.hpp                  as Eq. (11.15)
//
// K is not symmetric: what presses more rubs more. Where the law leaves it open which of many contacts bears how much,
// Δλ would be anything, so Σ is taken for larger by a part of S_kk, a thousandth of what is left of that asked for: it
// goes to 0 with the residual, and the method stays faster than linear. After each step, projected, come a few sweeps;
// where they do not bring less than before, a quarter of the step is tried, and a sixteenth. Where that is in vain
// sweeps take over, accelerated ones (engine/solvers/anderson.cpp) in the end: no merit function is
// guaranteed.
//
// One entry of its history is the residual after a factorisation, or what a sweep returned after them. Begins with the
// impulses of the last step. Keeps nothing.
//
//   P. Alart, A. Curnier, A mixed formulation for frictional contact problems prone to Newton like solution methods,
//   Comput. Methods Appl. Mech. Eng. 92 (1991).
#include <algorithm>

#include "09_better_friction/cone_rows.hpp"
#include "engine/linear/contact_velocity_system.hpp"
#include "engine/solvers/contact_newton.hpp"
#include "engine/solvers/islands.hpp"
#include "engine/solvers/registry.hpp"
#include "engine/solvers/solve_directly.hpp"
#include "engine/solvers/solver_result.hpp"

namespace spook {

namespace {

template <int Dof>
class Newton {
 public:
  Newton(const SolverInput<Dof>& s, bool on_cones)
      : s_(s), on_cones_(on_cones), bodies_(s.rows, s.bodies.motion.inverse_mass) {
    auto contact = s.rubbing.begin();
    for (std::size_t k = 0; k < s.rows.size(); k += static_cast<std::size_t>(parts_.back().count)) {
      const bool rubs = on_cones && contact != s.rubbing.end() && contact->normal == k;
      parts_.push_back({.row = k, .count = rubs ? 3 : 1});
      if (!rubs) continue;
      parts_.back().mu = contact++->mu;
      parts_.back().s = stiffest_direction(s.rows[k + 1], s.rows[k + 2]);
    }
  }

  /// Factorisations until `tolerance`, or none helps.
  SolveReport solve(double tolerance) {
    constexpr int most_in_vain = 3;
    constexpr double enough = 1e-6;  // of what was asked for, where it gets no further
    SolveReport report;
    const double asked = rhs_norm(s_.rows);
    double left = after_sweeps(2);
    if (left <= tolerance) return {.history = {left}, .converged = true};
    for (int in_vain = 0; in_vain < most_in_vain && std::ssize(report.history) < s_.stop.max_sweeps;) {
      const std::vector<double> before = impulses();
      if (!find_step(1e-3 * std::min(1.0, left / asked))) break;
      double found = infinity;
      for (double share = 1; share > 0.05 && !(found < left); share /= 4) found = go(before, share, tolerance);
      in_vain = found < left ? 0 : in_vain + 1;
      if (in_vain > 0) {
        start_from(before, s_.rows, s_.V);
        found = after_sweeps(10 * in_vain);
      }
      report.history.push_back(left = found);
      report.converged = left <= (in_vain > 0 ? std::max(tolerance, enough * asked) : tolerance);
      if (report.converged) break;
    }
    return report;
  }

  std::int64_t updates() const { return sweeps_ * std::ssize(s_.rows); }

 private:
  double lacking(std::size_t k) const {  // Eq. (4.6)
    const Row<Dof>& row = s_.rows[k];
    return row.B - row.Gi.dot(s_.V[row.i]) - row.Gj.dot(s_.V[row.j]) - row.Sigma * row.lambda;
  }
  double after_sweeps(int count) {
    for (int n = 0; n < count; ++n)
      on_cones_ ? sweep_on_cones(s_.rubbing, s_.rows, s_.V) : sweep(s_.rows, s_.V);
    sweeps_ += count;
    return left();
  }
  double left() const {
    return on_cones_ ? residual_on_cones(s_.rubbing, s_.rows, s_.V) : residual(s_.rows, s_.V);
  }

  /// Where it ends a part of the way, allowed, and after sweeps: what is left then [m/s].
  double go(const std::vector<double>& from, double share, double tolerance) {
    for (std::size_t k = 0; k < from.size(); ++k) s_.rows[k].lambda = from[k] + share * step_[k];
    for (const ContactBlock& part : parts_) {
      Row<Dof>* rows = &s_.rows[part.row];
      rows[0].lambda = std::clamp(rows[0].lambda, rows[0].lo, rows[0].hi);
      if (part.count == 1) continue;
      const Vec2 inside = onto_disc({rows[1].lambda, rows[2].lambda}, part.mu * rows[0].lambda);
      rows[1].lambda = inside[0], rows[2].lambda = inside[1];
    }
    std::fill(s_.V.begin(), s_.V.end(), Twist<Dof>::Zero());
    for (const Row<Dof>& row : s_.rows) apply_impulse(row, row.lambda, s_.V);
    const double here = left();
    return here <= tolerance ? here : after_sweeps(5);
  }

  bool find_step(double softer) {
    bodies_.begin();
    for (ContactBlock& part : parts_) {
      Vec3 r = Vec3::Zero();
      for (int n = 0; n < part.count; ++n) r[n] = lacking(part.row + n);
      linearise(&s_.rows[part.row], r, softer, part);
      bodies_.add(&s_.rows[part.row], part.count, part.K, part.k);
    }
    if (!bodies_.solve()) return false;
    step_.resize(s_.rows.size());
    for (const ContactBlock& part : parts_) {
      Vec3 Gv = Vec3::Zero();
      for (int n = 0; n < part.count; ++n) Gv[n] = bodies_.gather(s_.rows[part.row + n]);
      const Vec3 change = part.k - part.K * Gv;
      std::copy_n(change.data(), part.count, step_.begin() + static_cast<std::ptrdiff_t>(part.row));
    }
    return true;
  }

  std::vector<double> impulses() const {
    std::vector<double> all;
    for (const Row<Dof>& row : s_.rows) all.push_back(row.lambda);
    return all;
  }

  const SolverInput<Dof>& s_;
  bool on_cones_;
  ContactVelocitySystem<Dof> bodies_;
  std::vector<ContactBlock> parts_;
  std::vector<double> step_;  // Δλ of each row
  int sweeps_ = 0;
};

}  // namespace

template <int Dof>
Solver<Dof> newton(FrictionModel model) {
  const bool on_cones = model == FrictionModel::cone;
  auto solve = [on_cones, sweeps = anderson<Dof>(model)](const SolverInput<Dof>& s) {
    start_from(s.last.impulses(s.rows.size(), s.first_contact_row, s.contacts, s.h), s.rows, s.V);
    const auto soft = [](const Row<Dof>& row) { return row.Sigma > 0; };
    const auto moves = [](const Row<Dof>& row) { return moves_i(row) || moves_j(row); };
    if (!std::all_of(s.rows.begin(), s.rows.end(), soft) || !std::any_of(s.rows.begin(), s.rows.end(), moves))
      return sweeps.solve(s);
    Newton<Dof> method(s, on_cones);
    SolverResult outcome = method.solve(std::max(s.stop.tolerance, 1e-13 * rhs_norm(s.rows)));
    outcome.row_updates = method.updates();
    if (outcome.report.converged) return outcome;
    return append(std::move(outcome), sweeps.solve(s), s.rows.size());
  };
  return {.solve = std::move(solve),
          .friction = on_cones ? FrictionModel::cone : FrictionModel::box,
          .wants_last = true};
}

template Solver<3> newton<3>(FrictionModel);
template Solver<6> newton<6>(FrictionModel);

}  // namespace spook
