// A step of order four: engine/composed.hpp.
#include "engine/world.hpp"

namespace spook {

template <int Dof>
void World<Dof>::step_composed(double h) {
  rows_.clear();
  solved_ = {.history = std::move(solved_.history), .converged = true};
  solved_.history.clear();
  impulses_.assign(bodies_.size(), Vec3::Zero());
  held_.begin_step(bodies_);
  double before = 0;
  for (const double share : parts_of_order_four()) {
    const double part = share * h;
    clock_.run(Stage::forces, [&] { kick_all((before + part) / 2); });
    clock_.run(Stage::rows, [&] { held_.begin(joints_, bodies_, rows_, solved_); });
    clock_.run(Stage::solve, [&] {
      held_.drift(joints_, part, settings_.stop, settings_.rotation, rows_, bodies_, solved_);
    });
    before = part;
  }
  clock_.run(Stage::forces, [&] { kick_all(before / 2); });
  clock_.run(Stage::rows, [&] { held_.begin(joints_, bodies_, rows_, solved_); });
  clock_.run(Stage::solve, [&] { held_.stop(rows_, bodies_); });
  for (std::size_t i = 0; i < bodies_.size(); ++i) forces_[i] = impulses_[i] / h;
  row_updates_ += static_cast<std::int64_t>(solved_.history.size() * rows_.size());
  end_step(h);
}

/// v += h M⁻¹ f with the forces where the bodies are; and the inertia of what turns, which rows want to know.
template <int Dof>
void World<Dof>::kick_all(double h) {
  forces_.resize(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (bodies_.is_fixed(i)) continue;
    const Vec3 f = force(i);
    Twist<Dof>& W = bodies_.motion.W[i];
    W.template head<3>() = kick(W.template head<3>(), f, bodies_.motion.inverse_mass[i].linear, h);
    impulses_[i] += h * f;
    if constexpr (Dof == 6)
      if (!joints_.empty()) bodies_.motion.inverse_mass[i].angular = bodies_.orientations.inverse_inertia(i);
  }
}

template class World<3>;
template class World<6>;

}  // namespace spook
