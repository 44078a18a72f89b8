#pragma once
// Off-diagonal entry of the Schur complement.
#include "04_gauss_seidel/gauss_seidel.hpp"

namespace spook {

/// The entry S_kl without Σ, Eq. (11.1): the velocity along row k that a unit impulse of row l causes [1/kg].
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
