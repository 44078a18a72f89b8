// Queries of a world, and of its last step.
#include <algorithm>
#include <limits>

#include "common/require.hpp"
#include "engine/support/require_index.hpp"

namespace spook {

template <int Dof>
std::size_t World<Dof>::index(int body) const {
  return require_index("body", body, bodies_.size());
}

template <int Dof>
std::size_t World<Dof>::first_row(int contact) const {
  return constraints_.normal_row(require_index("contact", contact, contacts_.size()));
}

template <int Dof>
double World<Dof>::lambda(int contact) const {
  return rows()[first_row(contact)].lambda;
}

template <int Dof>
Vec3 World<Dof>::impulse(int contact) const {
  Vec3 impulse = Vec3::Zero();
  const std::size_t first = first_row(contact);
  for (std::size_t row = first; row < first + constraints_.rows_per_contact; ++row)
    impulse += rows()[row].lambda * rows()[row].Gj.template head<3>();
  return impulse;
}

template <int Dof>
Vec3 World<Dof>::contact_force(int contact) const {
  return impulse(contact) / h_;
}

template <int Dof>
StepReport World<Dof>::report() const {
  return {.pairs = pairs_,
          .contacts = static_cast<int>(contacts_.size()),
          .impacts = static_cast<int>(impacts_.size()),
          .rows = static_cast<int>(rows().size()),
          .iterations = static_cast<int>(solved_.history.size()),
          .residual = settings_.stepper                 ? (solved_.history.empty() ? 0 : solved_.history.back())
                      : rows().empty()                  ? 0
                      : settings_.integrator_order == 4 ? solved_.history.back()
                      : settings_.soft_steps
                          ? residual_on_cones(constraints_.friction, rows(), bodies_.motion.W)
                      : settings_.solver.friction == FrictionModel::cone
                          ? residual_on_cones(constraints_.friction, rows(), V_)
                          : residual(rows(), V_),
          .trouble = solved_.trouble};
}

template <int Dof>
double World<Dof>::velocity_lag(double h) const {
  require_positive("h", h);
  return settings_.integrator_order == 4 ? 0 : h / parts_ / 2;
}

/// Returns the stop rule, with a lower bound of the tolerance. A row's residual, Eq. (4.6), is a sum of four rounded
/// terms; under gravity the largest are at least |gravity| h. A sweep with a smaller change has converged.
template <int Dof>
StopRule World<Dof>::stop_rule(double h) const {
  require_positive("h", h);
  using Limits = std::numeric_limits<double>;
  const double four_roundings = (2 * Limits::epsilon() * settings_.gravity).stableNorm() * h;
  StopRule stop = settings_.solver_limits;
  stop.tolerance = std::max(stop.tolerance, std::min(four_roundings, Limits::max()));
  return stop;
}

}  // namespace spook
