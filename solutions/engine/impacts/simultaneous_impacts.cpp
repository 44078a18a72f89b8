#include "engine/impacts/simultaneous_impacts.hpp"

#include <algorithm>
#include <cmath>

#include "09_better_friction/better_friction.hpp"
#include "11_direct/direct.hpp"

namespace spook {

static constexpr double impact_softness = 1e-12;  // Σ, of S_kk
static constexpr StopRule of_factors{.max_sweeps = 100}, of_cones{.max_sweeps = 1000, .tolerance = 1e-12};

namespace {

/// The rows of the joints, then those of the contacts, as if no other body existed.
template <int Dof>
struct ImpactProblem {
  std::vector<int> bodies;  ///< their indices in the world
  Motion<Dof> motion;
  std::vector<Row<Dof>> rows;
  std::vector<FrictionContact> friction;
  std::vector<Twist<Dof>> V;

  ImpactProblem(const std::vector<Contact>& contacts, const std::vector<ImpactLaw>& laws,
                const std::vector<Row<Dof>>& joints, const Motion<Dof>& world) {
    for (const Contact& contact : contacts) bodies.insert(bodies.end(), {contact.i, contact.j});
    for (const Row<Dof>& row : joints) bodies.insert(bodies.end(), {row.i, row.j});
    std::sort(bodies.begin(), bodies.end());
    bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
    for (const int body : bodies) {
      motion.inverse_mass.push_back(world.inverse_mass[body]);
      motion.W.push_back(world.W[body] + world.Wf[body] / 2);  // Eq. (7.1)
    }
    motion.Wf.assign(bodies.size(), Twist<Dof>::Zero());
    V = motion.Wf;

    for (Row<Dof> row : joints) {
      row.i = number(row.i);
      row.j = number(row.j);
      rows.push_back(row);
      soften(rows.back());
    }
    const bool has_friction =
        std::any_of(laws.begin(), laws.end(), [](const ImpactLaw& law) { return law.friction > 0; });
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      Contact contact = contacts[c];
      contact.i = number(contact.i);
      contact.j = number(contact.j);
      if (has_friction) friction.push_back({.normal = rows.size(), .mu = laws[c].friction});
      const ContactJacobian G = contact_jacobian(contact);
      // B = -(1 + e) u_n, and -u_t for friction.
      add({.i = contact.i,
           .j = contact.j,
           .Gi = G.Gi.template head<Dof>(),
           .Gj = G.Gj.template head<Dof>(),
           .gap = 0,
           .spook = {.a = 0, .b = 1 + laws[c].restitution, .Sigma = 0}});
      if (!has_friction) continue;
      for (const Constraint<Dof>& along :
           friction_constraints<Dof>(contact, tangents(contact.n), 0, {.a = 0, .b = 1, .Sigma = 0}))
        add(along);
    }
  }

  int number(int body) const {
    return static_cast<int>(std::lower_bound(bodies.begin(), bodies.end(), body) - bodies.begin());
  }

  void add(const Constraint<Dof>& constraint) {
    rows.push_back(make_row(constraint, motion));
    soften(rows.back());
  }

  static void soften(Row<Dof>& row) {
    const double more = std::max(0.0, impact_softness * row.diagonal - row.Sigma);
    row.Sigma += more;
    row.diagonal += more;
  }
};

/// Returns Σ λ G v over the rows [J].
template <int Dof>
double power(const std::vector<Row<Dof>>& rows, const std::vector<double>& lambda,
             const std::vector<Twist<Dof>>& v) {
  double sum = 0;
  for (std::size_t k = 0; k < rows.size(); ++k)
    sum += lambda[k] * (rows[k].Gi.dot(v[rows[k].i]) + rows[k].Gj.dot(v[rows[k].j]));
  return sum;
}

template <int Dof>
std::vector<double> impulses(const std::vector<Row<Dof>>& rows) {
  std::vector<double> lambda;
  for (const Row<Dof>& row : rows) lambda.push_back(row.lambda);
  return lambda;
}

/// Impulses of all rows, and the changes of velocities by them.
template <int Dof>
struct ImpactImpulses {
  std::vector<double> lambda;
  std::vector<Twist<Dof>> V;
};

/// Returns the energy that impulses add to velocities W [J].
template <int Dof>
double energy_added(const ImpactProblem<Dof>& problem, const ImpactImpulses<Dof>& of) {
  std::vector<Twist<Dof>> middle = problem.motion.W;
  for (std::size_t b = 0; b < middle.size(); ++b) middle[b] += of.V[b] / 2;
  return power(problem.rows, of.lambda, middle);
}

/// Returns `from` + κ (`to` - `from`) with the largest κ in [0, 1] that adds no energy, or no more than `from` does.
template <int Dof>
ImpactImpulses<Dof> towards(const ImpactProblem<Dof>& problem, const ImpactImpulses<Dof>& from,
                            const ImpactImpulses<Dof>& to) {
  ImpactImpulses<Dof> more = to;
  std::vector<Twist<Dof>> start = problem.motion.W;
  for (std::size_t k = 0; k < more.lambda.size(); ++k) more.lambda[k] -= from.lambda[k];
  for (std::size_t b = 0; b < start.size(); ++b) {
    more.V[b] -= from.V[b];
    start[b] += from.V[b];
  }
  // The energy added is E + b κ + ½ c κ².
  const double E = std::min(0.0, energy_added(problem, from));
  const double b = power(problem.rows, more.lambda, start), c = power(problem.rows, more.lambda, more.V);
  const double root = std::sqrt(std::max(0.0, b * b - 2 * c * E));
  // Neither form divides by 0 or subtracts equals: c > 0 where b <= 0, since E <= 0 and E + b + c/2 > 0.
  const double kappa = E + b + c / 2 <= 0 ? 1 : b > 0 ? -2 * E / (b + root) : (root - b) / c;
  ImpactImpulses<Dof> result = from;
  for (std::size_t k = 0; k < result.lambda.size(); ++k) result.lambda[k] += kappa * more.lambda[k];
  for (std::size_t body = 0; body < result.V.size(); ++body) result.V[body] += kappa * more.V[body];
  return result;
}

/// Returns the impact without restitution and friction: what closes stops, and what opens goes on opening. It is a
/// projection, and so adds no energy.
template <int Dof>
ImpactImpulses<Dof> plastic(const ImpactProblem<Dof>& problem) {
  std::vector<Row<Dof>> rows = problem.rows;
  for (Row<Dof>& row : rows) {
    row.lambda = 0;
    row.B = -row.Gi.dot(problem.motion.W[row.i]) - row.Gj.dot(problem.motion.W[row.j]);
  }
  std::vector<Twist<Dof>> V(problem.V.size(), Twist<Dof>::Zero());
  Factors factors;
  direct_solve(rows, V, of_factors, factors);
  return {impulses(rows), V};
}

/// Returns the impact with restitution and friction, or as much of it, beyond `without` friction, as adds no energy.
template <int Dof>
ImpactImpulses<Dof> with_friction(ImpactProblem<Dof>& problem, const ImpactImpulses<Dof>& without) {
  double fastest = 0;
  for (const Row<Dof>& row : problem.rows) fastest = std::max(fastest, std::abs(row.B));
  cone_solve(problem.friction, problem.rows, problem.V,
             {.max_sweeps = of_cones.max_sweeps, .tolerance = of_cones.tolerance * fastest});
  return towards(problem, without, {impulses(problem.rows), problem.V});
}

}  // namespace

template <int Dof>
void resolve_together(const std::vector<Contact>& contacts, const std::vector<ImpactLaw>& laws,
                      const std::vector<Row<Dof>>& joints, Motion<Dof>& motion) {
  ImpactProblem<Dof> problem(contacts, laws, joints, motion);
  Factors factors;
  direct_solve(problem.rows, problem.V, of_factors, factors);  // friction rows have bounds of 0
  ImpactImpulses<Dof> found{impulses(problem.rows), problem.V};
  // Joints do not bounce. Where contacts do, and act on the same bodies, Eq. (7.18) could add energy.
  ImpactImpulses<Dof> least = found;
  if (!joints.empty() && energy_added(problem, found) > 0) {
    least = plastic(problem);
    found = towards(problem, least, found);
  }
  if (!problem.friction.empty()) found = with_friction(problem, least);
  for (std::size_t b = 0; b < problem.bodies.size(); ++b) motion.W[problem.bodies[b]] += found.V[b];
}

template void resolve_together<3>(const std::vector<Contact>&, const std::vector<ImpactLaw>&,
                                  const std::vector<Row<3>>&, Motion<3>&);
template void resolve_together<6>(const std::vector<Contact>&, const std::vector<ImpactLaw>&,
                                  const std::vector<Row<6>>&, Motion<6>&);

}  // namespace spook
