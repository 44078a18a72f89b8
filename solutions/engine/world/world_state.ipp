// The part of a world that steps change, for engine/support/state_stream.hpp.

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

inline void state_of(StateStream& s, Impact& impact) {
  s(impact.i, impact.j, impact.speed);
}

inline void state_of(StateStream& s, FrictionContact& contact) {
  s(contact.normal, contact.mu);
}

inline void state_of(StateStream& s, SolveReport& report) {
  s(report.history, report.converged, report.trouble);
}

/// Returns a hash of what steps do not change: masses, shapes, kinds and points of joints, and gravity, friction,
/// viscosity, k, d and integrator_order. Motors, springs, materials and forces are left out, since a program may set
/// them between steps.
template <int Dof>
std::size_t hash_of_build(const World<Dof>& world) {
  std::string text;
  StateStream s(&text);
  const auto add = [&s](auto... values) { s(values...); };
  const Bodies<Dof>& bodies = world.bodies();
  const std::vector<Shape> shapes = world.shapes().by_body(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    add(bodies.is_fixed(i), bodies.mass[i], shapes[i].index());
    if constexpr (Dof == 6) add(bodies.orientations.principal[i]);
    match(shapes[i], [&](const auto& shape) { std::apply(add, shape.numbers()); });
  }
  for (const Plane& plane : world.shapes().planes) add(plane.body, plane.n, plane.offset);
  for (const Joint& joint : world.joints())
    add(joint.kind, joint.i, joint.j, joint.p_i, joint.p_j, joint.length, joint.axis, joint.rest);
  const Settings<Dof>& settings = world.settings();
  add(settings.gravity, settings.friction, settings.viscosity, settings.k, settings.d,
      settings.integrator_order);
  return hash_of(text);
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
  s.require_same_hash("masses, shapes, joints and settings", hash_of_build(*this));
  Motion<Dof>& motion = bodies_.motion;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    s(bodies_.x[i], motion.W[i], motion.Wf[i], motion.inverse_mass[i]);
    if constexpr (Dof == 6) s(bodies_.orientations.q[i]);
  }
  for (Joint& joint : joints_) s(joint.k, joint.k_turn, joint.angle, joint.recovered, joint.taken_by_limit);
  double stiffness = materials_.stiffness();
  s(stiffness);
  materials_.set_stiffness(stiffness);
  s(contacts_, constraints_.rows, constraints_.first_contact_row, constraints_.resistance_rows,
    constraints_.rows_per_contact, constraints_.friction);
  s(V_, forces_, torques_, solved_, last_impulses_);
  s(steps_, time_, h_, half_step_back_, parts_, calm_steps_, parts_per_second_, gap_step_);
  s(largest_load_, work_of_drives_, force_of_drives_);
  s(pairs_, impacts_, row_updates_);
  settings_.solver.state(s);
}

}  // namespace spook
