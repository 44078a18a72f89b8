// Projected Gauss-Seidel in a given order of rows: chapter 10.
//
//   up, down      by height, against gravity or along gravity                          Eq. (10.3)   notes, "gravity"
//   random        a new order in every solve                                           Eq. (10.4)   notes, "randomize"
//   interleaved   rows of two halves alternate, so updates wait less for each other    Eq. (14.13)
//
// The height of a joint is that of the middle of its two points; the height of a contact is that of its point on body
// j, and a row that resists rolling has that of body j. All rows of a joint or contact are consecutive. A history entry
// is the result of a sweep. Keeps the generator of random orders.
#include <random>
#include <sstream>

#include "10_convergence/convergence.hpp"
#include "engine/solvers/registry.hpp"

namespace spook {

template <int Dof>
static std::vector<double> heights(const SolverInput<Dof>& s, const Vec3& up) {
  std::vector<double> all;
  for (const Joint& joint : s.joints) {
    const Attachment i = attachment(joint.i, joint.p_i, s.bodies), j = attachment(joint.j, joint.p_j, s.bodies);
    all.insert(all.end(), static_cast<std::size_t>(joint.rows()), up.dot(i.x + i.r + j.x + j.r) / 2);
  }
  for (std::size_t k = s.constraints.joint_rows(); k < s.constraints.first_contact_row; ++k)
    all.push_back(up.dot(s.bodies.x[static_cast<std::size_t>(s.rows()[k].j)]));
  for (const Contact& contact : s.contacts)
    all.insert(all.end(), s.constraints.rows_per_contact,
               up.dot(s.bodies.x[static_cast<std::size_t>(contact.j)] + contact.r_j));
  return all;
}

template <int Dof>
static std::vector<int> order_of(RowOrder order, const SolverInput<Dof>& s, std::mt19937_64& random) {
  if (order == RowOrder::random) return random_order(static_cast<int>(s.rows().size()), random);
  if (order == RowOrder::interleaved) return interleaved_order(s.rows().size());
  return order_along(heights(s, order == RowOrder::down ? s.gravity : Vec3(-s.gravity)));
}

template <int Dof>
struct OrderedSweeps {
  RowOrder order;
  std::mt19937_64 random;

  SolverResult operator()(const SolverInput<Dof>& s) {
    return solve_in_order(order_of(order, s, random), s.rows(), s.V, s.stop);
  }

  void state(StateStream& s) {
    std::stringstream text;
    text << random;
    std::string numbers = text.str();
    s(numbers);
    std::istringstream(numbers) >> random;
  }
};

template <int Dof>
Solver<Dof> ordered_gauss_seidel(RowOrder order, std::uint64_t seed) {
  if (order == RowOrder::given) return gauss_seidel<Dof>();
  return {.solve = OrderedSweeps<Dof>{order, std::mt19937_64(seed)},
          .state_of_solve = state_of_method<Dof, OrderedSweeps<Dof>>};
}

template Solver<3> ordered_gauss_seidel<3>(RowOrder, std::uint64_t);
template Solver<6> ordered_gauss_seidel<6>(RowOrder, std::uint64_t);
}  // namespace spook
