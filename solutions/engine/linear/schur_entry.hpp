#pragma once
// Off-diagonal entry of the Schur complement.
#include "04_gauss_seidel/gauss_seidel.hpp"

namespace spook {

/// S_kl without Σ: the velocity along one row that an impulse of 1 along the other makes [1/kg], Eq. (11.1).
template <int Dof>
double schur_entry(const Row<Dof>& k, const Row<Dof>& l) {
  double sum = 0;
  if (k.i == l.i) sum += k.MinvGi.dot(l.Gi);
  if (k.i == l.j) sum += k.MinvGi.dot(l.Gj);
  if (k.j == l.i) sum += k.MinvGj.dot(l.Gi);
  if (k.j == l.j) sum += k.MinvGj.dot(l.Gj);
  return sum;
}

}  // namespace spook
