// The solve of a step: what it begins with, which friction, which solver.
#include "engine/stiff_links.hpp"
#include "engine/world.hpp"

namespace spook {

template <int Dof>
void World<Dof>::solve_rows(double h) {
  V_.assign(bodies_.size(), Twist<Dof>::Zero());
  if (settings_.warm_start) {
    const std::vector<double> impulses = start_.impulses(rows_.size(), first_contact_row_, contacts_, h);
    if (!impulses.empty()) spook::warm_start(impulses, rows_, V_);  // Eq. (10.2)
  }
  const Outcome outcome = settings_.geometric_stiffness ? solve_with_stiff_links(h) : solve_by_friction_model();
  iterations_ = static_cast<int>(outcome.report.history.size());
  row_updates_ += outcome.updates(rows_.size());
  trouble_ = outcome.report.trouble;
  if (settings_.warm_start || settings_.geometric_stiffness)
    start_.remember(rows_, first_contact_row_, contacts_, h);
}

template <int Dof>
Outcome World<Dof>::solve_by_friction_model() {
  if (rubbing_.empty() || settings_.friction_model == FrictionModel::box) return solve_by(rows_, V_);
  if (settings_.friction_model == FrictionModel::cone) return cone_solve(rubbing_, rows_, V_, settings_.stop);
  // Two passes, as chapter 09's, with any solver: so far the friction rows have bounds of 0.
  Outcome first = solve_by(rows_, V_);
  limit_friction(rubbing_, rows_);  // Eq. (9.1)
  return in_turn(std::move(first), solve_by(rows_, V_), rows_.size());
}

template <int Dof>
Outcome World<Dof>::solve_by(std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V) {
  if (settings_.order == RowOrder::given) return settings_.solver(rows, V, settings_.stop);
  const std::vector<int> order =
      row_order(settings_.order, joints_, contacts_, rows_per_contact(settings_.friction), bodies_,
                settings_.gravity, random_);
  return solve_in_order(order, rows, V, settings_.stop);
}

template <int Dof>
Outcome World<Dof>::solve_with_stiff_links(double h) {
  if constexpr (Dof == 3) {
    const std::vector<bool> stiff = free_of_contacts(rows_, first_contact_row_, bodies_.size());
    std::vector<Row<3>> links, others;
    for (std::size_t k = 0; k < rows_.size(); ++k) (stiff[k] ? links : others).push_back(rows_[k]);

    // The stiff links first: the others do not feel them, and V of their bodies is theirs alone.
    const std::vector<Stiffness> springs =
        link_stiffness(joints_, start_.impulses(first_contact_row_, first_contact_row_, {}, h), bodies_, h);
    std::vector<Stiffness> felt;
    std::vector<bool> moved(bodies_.size(), false);
    for (const Row<3>& row : links) moved[row.i] = moved[row.j] = true;
    for (const Stiffness& spring : springs)
      if (moved[spring.i] && moved[spring.j]) felt.push_back(spring);
    Outcome outcome{SolveReport{.history = {}, .converged = true}};
    if (!links.empty()) {
      if (stiff_solve(links, bodies_.motion, felt, h, V_, *stiff_factors_)) {
        outcome.row_updates = 0;
      } else {
        outcome = settings_.solver(links, V_, settings_.stop);
        outcome.row_updates = outcome.updates(links.size());
        outcome.report.trouble = "the stiff links could not be factorised";
      }
    }
    if (!others.empty()) {
      std::vector<Twist<3>> V(V_.size(), Twist<3>::Zero());
      for (const Row<3>& row : others) apply_impulse(row, row.lambda, V);
      outcome = in_turn(std::move(outcome), settings_.solver(others, V, settings_.stop), others.size());
      for (const Row<3>& row : others) {
        if (!row.MinvGi.isZero(0)) V_[row.i] = V[row.i];
        if (!row.MinvGj.isZero(0)) V_[row.j] = V[row.j];
      }
    }
    std::size_t link = 0, other = 0;
    for (std::size_t k = 0; k < rows_.size(); ++k)
      rows_[k].lambda = stiff[k] ? links[link++].lambda : others[other++].lambda;
    return outcome;
  }
  return solve_by_friction_model();
}

template class World<3>;
template class World<6>;

}  // namespace spook
