#include "methods/small_steps.hpp"

namespace spook::plots {

Solver<3> xpbd() {
  return {.solve = [](const SolverInput<3>& s) {
    for (spook::Row<3>& row : s.rows()) {
      const auto& W = s.bodies.motion.W;
      row.B -= (row.Gi.dot(W[row.i]) + row.Gj.dot(W[row.j])) / 4;
    }
    return SolverResult(solve(s.rows(), s.V, s.stop));
  }};
}

Positions::Positions(const Chain& chain) : chain_(chain), z_(chain.mass.size() + 1, 0), v_(z_.size(), 0) {
  for (std::size_t b = 1; b < z_.size(); ++b)
    z_[b] = (chain.hangs ? -Chain::link : Chain::link) * static_cast<double>(b);
}

void Positions::step(double h) {
  const double alpha = 1 / (Chain::k * h * h), down = chain_.hangs ? 1 : -1;
  const std::vector<double> before = z_;
  for (std::size_t b = 1; b < z_.size(); ++b) z_[b] += h * (v_[b] - h * Chain::g);
  for (std::size_t b = 1; b < z_.size(); ++b) {
    const double gap = down * (z_[b - 1] - z_[b]) - Chain::link;
    if (!chain_.hangs && gap >= 0) continue;
    const double last = b == 1 ? 0 : 1 / chain_.mass[b - 2], here = 1 / chain_.mass[b - 1];
    const double lambda = -gap / (last + here + alpha);
    z_[b - 1] += down * last * lambda;
    z_[b] -= down * here * lambda;
  }
  for (std::size_t b = 1; b < z_.size(); ++b) v_[b] = (z_[b] - before[b]) / h;
}

Relaxed::Relaxed(const Chain& chain)
    : joints_(chain.hangs ? chain.mass.size() : 0),
      world_(chain.world({.solver = {.solve =
                                         [this](const SolverInput<3>& s) {
                                           const auto last = impulses_.impulses(s.constraints, s.contacts, s.h);
                                           if (!last.empty()) warm_start(last, s.rows(), s.V);
                                           return SolverResult(solve(s.rows(), s.V, s.stop));
                                         }},
                          .solver_limits = {.max_sweeps = 1}})) {}

void Relaxed::step(double h) {
  world_.step(h);
  const auto& W = world_.bodies().motion.W;
  std::vector<spook::Row<3>> rows = world_.rows();
  for (spook::Row<3>& row : rows) {
    row.B = -row.Gi.dot(W[row.i]) - row.Gj.dot(W[row.j]);
    row.diagonal -= row.Sigma;
    row.Sigma = 0;
  }
  std::vector<Twist<3>> V(W.size(), Vec3::Zero());
  sweep(rows, V);
  impulses_.remember<3>({.rows = std::move(rows), .first_contact_row = joints_}, world_.contacts(), h);
  for (int body = 1; body < static_cast<int>(V.size()); ++body)
    world_.place(body, world_.x(body), world_.v(body) + V[static_cast<std::size_t>(body)]);
}

}  // namespace spook::plots
