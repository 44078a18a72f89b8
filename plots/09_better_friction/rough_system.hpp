#pragma once
// Rows of bodies with friction, and the friction models under comparison.
#include <cmath>
#include <string>
#include <vector>

#include "09_better_friction/better_friction.hpp"

namespace spook::plots {

constexpr double g = 9.81;

enum class Model { box, sliding_box, two_pass, cone };

inline std::string name(Model model) {
  switch (model) {
    case Model::box:
      return "box";
    case Model::sliding_box:
      return "sliding tangents";
    case Model::two_pass:
      return "two passes";
    case Model::cone:
      return "cone";
  }
  return "";
}

template <int Dof>
struct RoughSystem {
  Motion<Dof> motion;
  std::vector<FrictionContact> contacts;
  std::vector<spook::Row<Dof>> rows;
  std::vector<Twist<Dof>> V;

  Twist<Dof> velocity(std::size_t body) const { return motion.W[body] + motion.Wf[body] + V[body]; }

  /// The largest norm of a body's velocity [m/s, rad/s].
  double speed() const {
    double largest = 0;
    for (std::size_t k = 0; k < V.size(); ++k) largest = std::max(largest, velocity(k).norm());
    return largest;
  }
};

template <int Dof>
int add_body(RoughSystem<Dof>& s, const InverseMass<Dof>& inverse_mass, const Twist<Dof>& W,
             const Twist<Dof>& Wf) {
  s.motion.inverse_mass.push_back(inverse_mass);
  s.motion.W.push_back(W);
  s.motion.Wf.push_back(Wf);
  s.V.push_back(Twist<Dof>::Zero());
  return static_cast<int>(s.V.size()) - 1;
}

/// Adds a normal row and two friction rows with bounds of ±`bound`; a = 0, b = 1, Σ = Γ = 0.
template <int Dof>
void add_contact(RoughSystem<Dof>& s, const Contact& contact, const Tangents& t, double mu, double bound) {
  const SpookParameters rigid{.a = 0, .b = 1, .Sigma = 0};
  const ContactJacobian G = contact_jacobian(contact);
  s.contacts.push_back({.normal = s.rows.size(), .mu = mu});
  s.rows.push_back(make_row<Dof>({.i = contact.i,
                                  .j = contact.j,
                                  .Gi = G.Gi.template head<Dof>(),
                                  .Gj = G.Gj.template head<Dof>(),
                                  .gap = 0,
                                  .spook = rigid},
                                 s.motion));
  for (const Constraint<Dof>& row : friction_constraints<Dof>(contact, t, bound, rigid))
    s.rows.push_back(make_row(row, s.motion));
}

template <int Dof>
SolveReport solve_by(Model model, RoughSystem<Dof>& s, const StopRule& stop) {
  if (model == Model::two_pass) return two_pass_solve(s.contacts, s.rows, s.V, stop);
  if (model == Model::cone) return cone_solve(s.contacts, s.rows, s.V, stop);
  return solve(s.rows, s.V, stop);
}

}  // namespace spook::plots
