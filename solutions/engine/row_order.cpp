#include "engine/row_order.hpp"

#include "10_convergence/convergence.hpp"

namespace spook {

template <int Dof>
static std::vector<double> heights(const std::vector<Joint>& joints, const std::vector<Contact>& contacts,
                                   int rows_per_contact, const Bodies<Dof>& bodies, const Vec3& up) {
  std::vector<double> all;
  for (const Joint& joint : joints) {
    const Attachment i = attachment(joint.i, joint.p_i, bodies), j = attachment(joint.j, joint.p_j, bodies);
    all.insert(all.end(), static_cast<std::size_t>(joint.rows()), up.dot(i.x + i.r + j.x + j.r) / 2);
  }
  for (const Contact& contact : contacts)
    all.insert(all.end(), static_cast<std::size_t>(rows_per_contact),
               up.dot(bodies.x[static_cast<std::size_t>(contact.j)] + contact.r_j));
  return all;
}

template <int Dof>
std::vector<int> row_order(RowOrder order, const std::vector<Joint>& joints,
                           const std::vector<Contact>& contacts, int rows_per_contact,
                           const Bodies<Dof>& bodies, const Vec3& gravity, std::mt19937_64& random) {
  const Vec3 up = order == RowOrder::down ? gravity : Vec3(-gravity);
  const std::vector<double> all = heights(joints, contacts, rows_per_contact, bodies, up);
  if (order == RowOrder::random) return random_order(static_cast<int>(all.size()), random);
  return order_along(all);
}

template <int Dof>
SolveReport solve_in_order(const std::vector<int>& order, std::vector<Row<Dof>>& rows,
                           std::vector<Twist<Dof>>& V, const StopRule& stop) {
  SolveReport report;
  while (!report.converged && std::ssize(report.history) < stop.max_sweeps) {
    report.history.push_back(sweep_in_order(order, rows, V));
    report.converged = report.history.back() <= stop.tolerance;
  }
  return report;
}

template std::vector<int> row_order<3>(RowOrder, const std::vector<Joint>&, const std::vector<Contact>&, int,
                                       const Bodies<3>&, const Vec3&, std::mt19937_64&);
template std::vector<int> row_order<6>(RowOrder, const std::vector<Joint>&, const std::vector<Contact>&, int,
                                       const Bodies<6>&, const Vec3&, std::mt19937_64&);
template SolveReport solve_in_order<3>(const std::vector<int>&, std::vector<Row<3>>&, std::vector<Twist<3>>&,
                                       const StopRule&);
template SolveReport solve_in_order<6>(const std::vector<int>&, std::vector<Row<6>>&, std::vector<Twist<6>>&,
                                       const StopRule&);

}  // namespace spook
