// Wrong: adds to V instead of assigning it.
// Killed by: SaddleSolve.ForgetsWhatWasThere
// Says: nothing is added to what it held
#include "11_direct/direct.hpp"

namespace spook {

template <int Dof>
bool saddle_solve(std::vector<Row<Dof>>& rows, const std::vector<InverseMass<Dof>>& inverse_mass,
                  std::vector<Twist<Dof>>& V, Factors& factors) {
  const int bodies = static_cast<int>(inverse_mass.size());
  if (!factorise(saddle_matrix(rows, inverse_mass), factors)) return false;
  Vector right = Vector::Zero(Dof * bodies + static_cast<int>(rows.size()));
  for (std::size_t k = 0; k < rows.size(); ++k) right[Dof * bodies + k] = rows[k].B;
  const Vector unknowns = factors.ldlt.solve(right);
  for (int body = 0; body < bodies; ++body) V[body] += unknowns.segment<Dof>(Dof * body);
  for (std::size_t k = 0; k < rows.size(); ++k) rows[k].lambda = -unknowns[Dof * bodies + k];
  return true;
}

template bool saddle_solve<3>(std::vector<Row<3>>&, const std::vector<InverseMass<3>>&, std::vector<Twist<3>>&,
                              Factors&);
template bool saddle_solve<6>(std::vector<Row<6>>&, const std::vector<InverseMass<6>>&, std::vector<Twist<6>>&,
                              Factors&);

}  // namespace spook
