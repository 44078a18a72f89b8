#pragma once
// The units of the types that chapters share: see units.hpp.
#include "09_better_friction/better_friction.hpp"
#include "units.hpp"

namespace spook::testing {

inline void each_number(Visitor& visitor, SpookParameters& spook, ByField) {
  using namespace units;
  visitor.number(spook.a, 1 / s);
  visitor.number(spook.b, pure);
  visitor.number(spook.Sigma, 1 / kg);
}

inline void each_number(Visitor& visitor, Contact& contact, ByField) {
  using namespace units;
  visitor.count(contact.i), visitor.count(contact.j);
  each_number(visitor, contact.n, pure);
  visitor.number(contact.gap, m);
  each_number(visitor, contact.r_i, m), each_number(visitor, contact.r_j, m);
}

inline void each_number(Visitor& visitor, ContactJacobian& G, ByField) {
  each_number(visitor, G.Gi, units::jacobian), each_number(visitor, G.Gj, units::jacobian);
}

inline void each_number(Visitor& visitor, InverseMass<3>& inverse, ByField) {
  visitor.number(inverse.linear, 1 / units::kg);
}
inline void each_number(Visitor& visitor, InverseMass<6>& inverse, ByField) {
  using namespace units;
  visitor.number(inverse.linear, 1 / kg);
  each_number(visitor, inverse.angular, 1 / (kg * m * m));
}

template <int Dof>
void each_number(Visitor& visitor, Motion<Dof>& motion, ByField) {
  visitor.fixed(true);
  each_number(visitor, motion.inverse_mass, units::by_field);
  each_number(visitor, motion.Wf, units::velocity);
  visitor.fixed(false);
  each_number(visitor, motion.W, units::velocity);
}

template <int Dof>
void each_number(Visitor& visitor, Constraint<Dof>& c, ByField) {
  using namespace units;
  visitor.count(c.i), visitor.count(c.j);
  each_number(visitor, c.Gi, jacobian), each_number(visitor, c.Gj, jacobian);
  visitor.number(c.gap, m);
  each_number(visitor, c.spook, by_field);
  visitor.bound(c.lo, N * s), visitor.bound(c.hi, N * s);
}

template <int Dof>
void each_number(Visitor& visitor, Row<Dof>& row, ByField) {
  using namespace units;
  visitor.fixed(true);
  visitor.count(row.i), visitor.count(row.j);
  each_number(visitor, row.Gi, jacobian), each_number(visitor, row.Gj, jacobian);
  each_number(visitor, row.MinvGi, responses), each_number(visitor, row.MinvGj, responses);
  visitor.number(row.B, m / s);
  visitor.number(row.Sigma, 1 / kg), visitor.number(row.diagonal, 1 / kg);
  visitor.fixed(false);
  visitor.bound(row.lo, N * s), visitor.bound(row.hi, N * s), visitor.number(row.lambda, N * s);
}

inline void each_number(Visitor& visitor, StopRule& stop, ByField) {
  visitor.count(stop.max_sweeps);
  visitor.number(stop.tolerance, units::m / units::s);
}

inline void each_number(Visitor& visitor, SolveReport& report, ByField) {
  each_number(visitor, report.history, units::m / units::s);
  visitor.count(report.converged), visitor.count(report.trouble.empty());
}

inline void each_number(Visitor& visitor, Tangents& t, ByField) {
  each_number(visitor, t.t1, units::pure), each_number(visitor, t.t2, units::pure);
}

inline void each_number(Visitor& visitor, FrictionContact& contact, ByField) {
  visitor.count(static_cast<long long>(contact.normal));
  visitor.bound(contact.mu, units::pure);
}

inline void each_number(Visitor& visitor, StepRows& step, ByField) {
  each_number(visitor, step.motion, units::by_field), each_number(visitor, step.rows, units::by_field);
  each_number(visitor, step.friction, units::by_field);
}

}  // namespace spook::testing
