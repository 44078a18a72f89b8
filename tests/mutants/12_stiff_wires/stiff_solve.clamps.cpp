// Wrong: keeps λ within the bounds.
// Killed by: StiffSolve.KnowsNoBounds
// Says: It is clamped
#include <algorithm>

#include "12_stiff_wires/stiff_wires.hpp"

namespace spook {

bool stiff_solve(std::vector<Row<3>>& rows, const Motion<3>& motion, const std::vector<Stiffness>& stiffness,
                 double h, std::vector<Twist<3>>& V, Factors& factors) {
  if (!factorise(stiffened_matrix(rows, motion.inverse_mass, stiffness, h), factors)) return false;

  // M̃ V - Gᵀλ = -h² K W_f,  G V + Σ λ = B                                                          Eq. (12.6)
  const int bodies = static_cast<int>(motion.inverse_mass.size());
  Vector right = Vector::Zero(3 * bodies + static_cast<int>(rows.size()));
  for (const auto& [i, j, K] : stiffness) {
    const Vec3 push = h * h * K * (motion.Wf[j] - motion.Wf[i]);
    right.segment<3>(3 * i) += push;
    right.segment<3>(3 * j) -= push;
  }
  for (int body = 0; body < bodies; ++body)
    if (motion.inverse_mass[body].linear == 0) right.segment<3>(3 * body).setZero();
  for (std::size_t k = 0; k < rows.size(); ++k) right[3 * bodies + k] = rows[k].B;

  const Vector unknowns = factors.ldlt.solve(right);
  for (int body = 0; body < bodies; ++body) V[body] = unknowns.segment<3>(3 * body);
  for (std::size_t k = 0; k < rows.size(); ++k)
    rows[k].lambda = std::clamp(-unknowns[3 * bodies + k], rows[k].lo, rows[k].hi);
  return true;
}

}  // namespace spook
