// Wrong: stores G where M⁻¹Gᵀ belongs, though the diagonal is right.
// Killed by: MakeRow.DividesTheJacobianByTheMasses
// Says: This is G itself
#include "04_gauss_seidel/gauss_seidel.hpp"

namespace spook {

template <int Dof>
Row<Dof> make_row(const Constraint<Dof>& c, const Motion<Dof>& motion) {
  const Twist<Dof> MinvGi = motion.inverse_mass[c.i].times(c.Gi);
  const Twist<Dof> MinvGj = motion.inverse_mass[c.j].times(c.Gj);

  const double GW = c.Gi.dot(motion.W[c.i]) + c.Gj.dot(motion.W[c.j]);
  const double GWf = c.Gi.dot(motion.Wf[c.i]) + c.Gj.dot(motion.Wf[c.j]);

  return {.i = c.i,
          .j = c.j,
          .Gi = c.Gi,
          .Gj = c.Gj,
          .MinvGi = c.Gi,
          .MinvGj = c.Gj,
          .B = -c.spook.a * c.gap - c.spook.b * GW - GWf,  // Eq. (4.4)
          .Sigma = c.spook.Sigma,
          .diagonal = c.Gi.dot(MinvGi) + c.Gj.dot(MinvGj) + c.spook.Sigma,  // Eq. (4.3)
          .lo = c.lo,
          .hi = c.hi,
          .lambda = 0};
}

template Row<3> make_row<3>(const Constraint<3>&, const Motion<3>&);
template Row<6> make_row<6>(const Constraint<6>&, const Motion<6>&);

}  // namespace spook
