// What steps change in a world, for engine/support/state_stream.hpp.

namespace spook {

inline void state_of(StateStream& s, InverseMass<3>& inverse) {
  s(inverse.linear);
}
inline void state_of(StateStream& s, InverseMass<6>& inverse) {
  s(inverse.linear, inverse.angular);
}

template <int Dof>
void state_of(StateStream& s, Row<Dof>& row) {
  s(row.i, row.j, row.Gi, row.Gj, row.MinvGi, row.MinvGj);
  s(row.B, row.Sigma, row.diagonal, row.lo, row.hi, row.lambda);
}

inline void state_of(StateStream& s, Contact& contact) {
  s(contact.i, contact.j, contact.n, contact.gap, contact.r_i, contact.r_j);
}

inline void state_of(StateStream& s, FrictionContact& contact) {
  s(contact.normal, contact.mu);
}

inline void state_of(StateStream& s, SolveReport& report) {
  s(report.history, report.converged, report.trouble);
}

/// Caches are left out, and rows of soft steps that a step builds before it reads them. The arrays of bodies keep their
/// places in memory, since others may look at them.
template <int Dof>
void World<Dof>::state(StateStream& s) {
  if (settings_.stepper)
    throw std::invalid_argument("a world with a stepper has a state that only the stepper knows");
  s.require_same("degrees of freedom of a body", Dof);
  s.require_same("number of bodies", bodies_.size());
  s.require_same("number of joints", joints_.size());
  Motion<Dof>& motion = bodies_.motion;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    s(bodies_.x[i], motion.W[i], motion.Wf[i], motion.inverse_mass[i]);
    if constexpr (Dof == 6) s(bodies_.orientations.q[i]);
  }
  for (Joint& joint : joints_) s(joint.k, joint.k_turn, joint.angle);
  double stiffness = materials_.stiffness();
  s(stiffness);
  materials_.set_stiffness(stiffness);
  s(contacts_, rows_, first_contact_row_, rubbing_, V_, forces_, torques_, solved_, start_);
  s(steps_, time_, h_, half_step_back_, parts_, calm_steps_, largest_load_, work_of_drives_);
  s(pairs_, impacts_, row_updates_);
  settings_.solver.state(s);
}

}  // namespace spook
