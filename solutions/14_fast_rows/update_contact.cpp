#include "14_fast_rows/fast_rows.hpp"

namespace spook {

template <int Dof>
double update_contact(const FrictionContact& contact, std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V) {
  Row<Dof>* const of = &rows[contact.normal];
  const Twist<Dof>&Vi = V[of->i], &Vj = V[of->j];
  Mat3 S;
  Vec3 before, r;
  for (int k = 0; k < 3; ++k) {
    const Row<Dof>& row = of[k];
    for (int l = 0; l < k; ++l)  // Eq. (14.1)
      S(k, l) = S(l, k) = row.Gi.dot(of[l].MinvGi) + row.Gj.dot(of[l].MinvGj);
    S(k, k) = row.diagonal;
    before[k] = row.lambda;
    r[k] = row.B - row.Gi.dot(Vi) - row.Gj.dot(Vj) - row.Sigma * row.lambda;
  }
  const Vec3 after = solve_on_cone(S, r + S * before, contact.mu), change = after - before;  // Eq. (14.2)
  for (int k = 0; k < 3; ++k) {
    of[k].lambda = after[k];
    apply_impulse(of[k], change[k], V);
  }
  return (S * change).norm();
}

template double update_contact<3>(const FrictionContact&, std::vector<Row<3>>&, std::vector<Twist<3>>&);
template double update_contact<6>(const FrictionContact&, std::vector<Row<6>>&, std::vector<Twist<6>>&);

}  // namespace spook
