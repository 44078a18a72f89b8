// Stiff links: chapter 12, geometric stiffness in the mass matrix, Eq. (12.3)-(12.6); not in the notes.
//
//   links    rows of joints on islands without a contact or rope: solved without bounds, Eq. (12.6)
//   others   all other rows: solved by the inner solver, whose input omits the links
//
// K is that of the tension of the last step, Eq. (12.4). Links and others share no dynamic body. The links take one
// factorisation, which is not in the history. Caches the pattern of the factors.
#include "12_stiff_wires/stiff_wires.hpp"

#include <algorithm>
#include <stdexcept>

#include "engine/solvers/islands.hpp"
#include "engine/solvers/registry.hpp"

namespace spook {

namespace {

/// Returns the stiffness of each joint that was under tension in the last step; none for a newer joint.
std::vector<Stiffness> link_stiffness(const SolverInput<3>& s) {
  const std::vector<double> impulses = s.last.joint_impulses(s.constraints.first_contact_row, s.h);
  std::vector<Stiffness> all;
  std::size_t row = 0;
  for (const Joint& joint : s.joints) {
    const std::size_t first = row;
    row += static_cast<std::size_t>(joint.rows());
    if (row > impulses.size()) break;
    if (!joint.length) continue;  // a ball joint has no length
    const Vec3 along =
        s.bodies.x[static_cast<std::size_t>(joint.j)] - s.bodies.x[static_cast<std::size_t>(joint.i)];
    const double length = along.norm(), pull = -impulses[first] / s.h,
                 tension = joint.kind == JointKind::rope ? -pull : pull;
    if (tension > 0)
      all.push_back({.i = joint.i, .j = joint.j, .K = geometric_stiffness(along / length, length, tension)});
  }
  return all;
}

/// Marks the rows of islands that have rows without bounds only, those of joints other than ropes.
std::vector<bool> free_of_contacts(const SolverInput<3>& s) {
  std::vector<bool> free(s.rows().size(), true);
  for (const std::vector<int>& island : islands(s.rows(), s.V.size())) {
    const auto is_bounded = [&](int k) { return s.rows()[k].lo > -infinity; };
    if (std::none_of(island.begin(), island.end(), is_bounded)) continue;
    for (const int k : island) free[static_cast<std::size_t>(k)] = false;
  }
  return free;
}

/// Some rows of a system as a separate system. All rows of a joint, or of a contact, are in the same part.
struct SubSystem {
  std::vector<std::size_t> from;  ///< indices of the rows in the whole system
  ConstraintSet<3> constraints;
  std::vector<Twist<3>> V;
  std::vector<Joint> joints;
  std::vector<Contact> contacts;
  WarmStartCache none;  ///< empty: impulses of the last step have other indices

  /// Selects the rows for which `wanted` is `value`; the contacts if `value` is false.
  SubSystem(const SolverInput<3>& s, const std::vector<bool>& wanted, bool value)
      : V(s.V.size(), Twist<3>::Zero()), contacts(value ? std::vector<Contact>{} : s.contacts) {
    std::vector<Row<3>>& rows = constraints.rows;
    for (std::size_t k = 0; k < s.rows().size(); ++k) {
      if (wanted[k] != value) continue;
      from.push_back(k);
      rows.push_back(s.rows()[k]);
      apply_impulse(rows.back(), rows.back().lambda, V);
    }
    const auto of_contacts = std::lower_bound(from.begin(), from.end(), s.constraints.first_contact_row);
    constraints.first_contact_row = static_cast<std::size_t>(of_contacts - from.begin());
    constraints.rows_per_contact = s.constraints.rows_per_contact;
    std::size_t row = 0;
    for (const Joint& joint : s.joints) {
      if (wanted[row] == value) joints.push_back(joint);
      row += static_cast<std::size_t>(joint.rows());
    }
    if (!value) constraints.friction = s.constraints.friction;
    for (FrictionContact& contact : constraints.friction)
      contact.normal -= s.rows().size() - rows.size();  // all contacts are here, after the joints
  }

  SolverInput<3> system(const SolverInput<3>& s) {
    return {.constraints = constraints,
            .V = V,
            .joints = joints,
            .contacts = contacts,
            .bodies = s.bodies,
            .last = none,
            .gravity = s.gravity,
            .h = s.h,
            .stop = s.stop,
            .threads = s.threads};
  }

  void write_back(const SolverInput<3>& s) const {
    const std::vector<Row<3>>& rows = constraints.rows;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      s.rows()[from[k]].lambda = rows[k].lambda;
      if (moves_i(rows[k])) s.V[rows[k].i] = V[rows[k].i];
      if (moves_j(rows[k])) s.V[rows[k].j] = V[rows[k].j];
    }
  }
};

class GeometricStiffness {
 public:
  explicit GeometricStiffness(Solver<3> inner) : inner_(std::move(inner)) {}

  SolverResult operator()(const SolverInput<3>& s) {
    const bool has_ropes = std::any_of(s.joints.begin(), s.joints.end(),
                                       [](const Joint& joint) { return joint.kind == JointKind::rope; });
    if (s.constraints.first_contact_row == s.rows().size() && !has_ropes) return solve_links(s, s);
    const std::vector<bool> free = free_of_contacts(s);
    if (std::find(free.begin(), free.end(), true) == free.end()) return inner_.solve(s);
    SubSystem links(s, free, true), others(s, free, false);
    const SolverResult first = solve_links(s, links.system(s));
    const SolverResult both = append(first, inner_.solve(others.system(s)), others.constraints.rows.size());
    links.write_back(s);
    others.write_back(s);
    return both;
  }

  void state(StateStream& s) { inner_.state(s); }

 private:
  SolverResult solve_links(const SolverInput<3>& whole, const SolverInput<3>& links) {
    std::vector<bool> moved(links.V.size(), false);
    for (const Row<3>& row : links.rows()) moved[row.i] = moved[row.j] = true;
    std::vector<Stiffness> felt;
    for (const Stiffness& spring : link_stiffness(whole))
      if (moved[spring.i] && moved[spring.j]) felt.push_back(spring);
    if (stiff_solve(links.rows(), links.bodies.motion, felt, links.h, links.V, *factors_)) {
      SolverResult result{SolveReport{.history = {}, .converged = true}};
      result.row_updates = 0;
      return result;
    }
    SolverResult result = inner_.solve(links);
    result.row_updates = result.updates(links.rows().size());
    result.report.trouble = "the stiff links could not be factorised";
    return result;
  }

  Solver<3> inner_;
  ScratchCache<Factors> factors_;
};

}  // namespace

template <int Dof>
Solver<Dof> geometric_stiffness(Solver<Dof> inner) {
  if constexpr (Dof == 3) {
    if (!inner.solve)
      throw std::invalid_argument("the solver of geometric_stiffness must be one of solvers(), but is null");
    const FrictionModel friction = inner.friction;
    return {.solve = GeometricStiffness(std::move(inner)),
            .friction = friction,
            .wants_last = true,
            .state_of_solve = state_of_method<3, GeometricStiffness>};
  }
  throw std::invalid_argument(
      "solver must not be geometric_stiffness for rigid bodies: it is for links of point masses");
}

template Solver<3> geometric_stiffness<3>(Solver<3>);
template Solver<6> geometric_stiffness<6>(Solver<6>);

}  // namespace spook
