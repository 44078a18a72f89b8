#include "scenes/plain_engine.hpp"

#include <algorithm>
#include <stdexcept>

#include "09_better_friction/better_friction.hpp"
#include "scenes/solver_between.hpp"

namespace spook {

namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("the plain engine (--engine plain or mine) cannot run a scene with " + what +
                              ": leave out --engine");
}

template <int Dof>
bool has_boxes(const World<Dof>& world) {
  for (const Solid& solid : world.shapes().solids)
    if (std::holds_alternative<Cuboid>(solid.shape)) return true;
  return false;
}

bool turns_otherwise(const World<3>&) {
  return false;
}
bool turns_otherwise(const World<6>& world) {
  return world.settings().rotation.update != RotationUpdate::splitting;
}

/// Returns true if all bodies are point masses, without joints or contacts.
template <int Dof>
bool is_free(const World<Dof>& world) {
  return Dof == 3 && world.joints().empty() && !world.shapes().may_touch();
}

template <int Dof>
void refuse_what_no_step_has(const World<Dof>& world) {
  const Settings<Dof>& settings = world.settings();
  if (settings.wrench) refuse("a wrench");
  if (settings.force && !is_free(world)) refuse("a force field on bodies that touch, turn or have joints");
  if (settings.integrator_order == 4 && !is_free(world))
    refuse("--integrator-order 4 and bodies other than free point masses");
  if (turns_otherwise(world)) refuse("a rotation update other than splitting");
  if (world.materials().any()) refuse("materials of single bodies");
  if (!world.shapes().exclusions.lists().empty()) refuse("excluded contacts");
  if (world.has_kinematic_bodies()) refuse("static bodies that have a velocity");
}

/// Refuses shapes whose contacts step_pairs does not find.
void refuse_what_pairs_lack(const Shapes& shapes) {
  if (!shapes.corners.empty()) refuse("corners beside boxes");
  for (const Solid& solid : shapes.solids)
    if (std::holds_alternative<Capsule>(solid.shape)) refuse("capsules beside boxes");
}

/// Tells whether there can be one contact at most: of two balls, or of a ball and a plane.
bool has_one_contact(const Shapes& shapes) {
  const auto is_ball = [](const Solid& solid) { return std::holds_alternative<Sphere>(solid.shape); };
  return shapes.planes.size() + shapes.solids.size() == 2 && shapes.corners.empty() &&
         std::all_of(shapes.solids.begin(), shapes.solids.end(), is_ball);
}

enum class Step { leapfrog, composed, free, touching, contacts, friction, joints, impacts, pairs, rows };

/// Returns the first step with all features that the world needs. Contacts between boxes need chapter 08.
template <int Dof>
Step first_step_for(const World<Dof>& world, bool plain_solver) {
  const Settings<Dof>& settings = world.settings();
  const Shapes& shapes = world.shapes();
  refuse_what_no_step_has(world);
  if (is_free(world)) return settings.integrator_order == 4 ? Step::composed : Step::leapfrog;
  if (has_mechanisms(world.joints()) || (plain_solver && (shapes.may_touch() || !world.joints().empty())))
    return Step::rows;
  if (shapes.may_touch() && has_boxes(world)) {
    refuse_what_pairs_lack(shapes);
    return Step::pairs;
  }
  if (shapes.may_touch() && settings.impacts && settings.impacts->restitution > 0) return Step::impacts;
  if (!world.joints().empty()) return Step::joints;
  if (!shapes.may_touch()) return Step::free;
  if (settings.friction > 0) return Step::friction;
  return has_one_contact(shapes) ? Step::touching : Step::contacts;
}

RigidBody copy_of(const Bodies<3>& bodies, std::size_t b) {
  return {.x = bodies.x[b], .v = bodies.motion.W[b], .mass = bodies.mass[b]};
}
RigidBody copy_of(const Bodies<6>& bodies, std::size_t b) {
  const Twist<6>& W = bodies.motion.W[b];
  RigidBody body{.x = bodies.x[b],
                 .v = W.head<3>(),
                 .q = bodies.orientations.q[b],
                 .omega = W.tail<3>(),
                 .mass = bodies.mass[b]};
  if (!bodies.is_fixed(b)) body.principal = bodies.orientations.principal[b];
  return body;
}

void copy_shapes(const Shapes& shapes, std::vector<RigidBody>& bodies) {
  for (const Plane& plane : shapes.planes) {
    bodies[static_cast<std::size_t>(plane.body)].normal = plane.n;
    bodies[static_cast<std::size_t>(plane.body)].offset = plane.offset;
  }
  for (const Solid& solid : shapes.solids) {
    RigidBody& body = bodies[static_cast<std::size_t>(solid.body)];
    if (const Sphere* sphere = std::get_if<Sphere>(&solid.shape)) body.radius = sphere->radius;
    if (const Cuboid* box = std::get_if<Cuboid>(&solid.shape)) body.half_sides = box->half_sides;
  }
}

/// Copies the world into plain data. An unset stiffness is the engine's default. Beside a joint of chapter 13, joints
/// are left out.
template <int Dof>
Simulation copy_of(const World<Dof>& world) {
  const Settings<Dof>& settings = world.settings();
  const Bodies<Dof>& bodies = world.bodies();
  Simulation simulation{.bodies = {},
                        .gravity = settings.gravity,
                        .d = settings.d.value_or(relaxation_of_contacts),
                        .mu = settings.friction,
                        .viscosity = settings.viscosity,
                        .restitution = settings.impacts.value_or(ImpactLaw{}).restitution,
                        .max_sweeps = settings.solver_limits.max_sweeps,
                        .tolerance = settings.solver_limits.tolerance};
  for (std::size_t b = 0; b < bodies.size(); ++b) simulation.bodies.push_back(copy_of(bodies, b));
  copy_shapes(world.shapes(), simulation.bodies);
  simulation.k = settings.k.value_or(world.contact_stiffness());
  if (has_mechanisms(world.joints())) return simulation;
  for (const Joint& joint : world.joints())
    simulation.joints.push_back({.i = joint.i,
                                 .j = joint.j,
                                 .p_i = joint.p_i,
                                 .p_j = joint.p_j,
                                 .length = joint.length.value_or(0),
                                 .k = *joint.k,
                                 .d = *joint.d});
  return simulation;
}

template <int Dof>
void copy_back(const Simulation& simulation, Bodies<Dof>& bodies) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const RigidBody& body = simulation.bodies[b];
    bodies.x[b] = body.x;
    bodies.motion.W[b].template head<3>() = body.v;
    if constexpr (Dof == 6) {
      bodies.motion.W[b].template tail<3>() = body.omega;
      bodies.orientations.q[b] = body.q;
    }
  }
}

/// Step of chapter 01, for point masses.
void step_points(const World<3>& world, double h, Bodies<3>& bodies) {
  const Settings<3>& settings = world.settings();
  Particles particles{.x = bodies.x, .v = bodies.motion.W, .inverse_mass = {}};
  for (const InverseMass<3>& inverse : bodies.motion.inverse_mass)
    particles.inverse_mass.push_back(inverse.linear);
  const ForceField force = [&](std::size_t i, const std::vector<Vec3>& x) -> Vec3 {
    const Vec3 weight = bodies.mass[i] * settings.gravity;
    return settings.force ? Vec3(weight + settings.force(i, x)) : weight;
  };
  if (settings.integrator_order == 4)
    composed_step(particles, force, h, 2);
  else
    leapfrog_step(particles, force, h);
  bodies.x = particles.x;
  bodies.motion.W = particles.v;
}

/// Report of a step without sweeps.
SolveReport solved_exactly() {
  return {.history = {}, .converged = true};
}

SolveReport step_by(Step step, Simulation& simulation, const std::vector<Contact>& contacts, double h) {
  if (step == Step::touching && contacts.empty()) step = Step::free;
  switch (step) {
    case Step::touching:
      step_touching(simulation, contacts.front(), h);
      return solved_exactly();
    case Step::contacts:
      return step_contacts(simulation, contacts, h);
    case Step::friction:
      return step_friction(simulation, contacts, h);
    case Step::joints:
      return step_joints(simulation, contacts, h);
    case Step::impacts:
      return step_impacts(simulation, contacts, h);
    case Step::pairs:
      return step_pairs(simulation, h);
    default:
      step_free(simulation, h);
      return solved_exactly();
  }
}

}  // namespace

template <int Dof>
std::string plain_step_of(const World<Dof>& world, const Method& method) {
  constexpr const char* names[] = {
      "1.4 leapfrog_step", "1.5 composed_step", "2.7 step_free",    "3.5 step_touching", "4.7 step_contacts",
      "5.7 step_friction", "6.5 step_joints",   "7.9 step_impacts", "8.12 step_pairs",   "9.9 step_rows"};
  return names[static_cast<std::size_t>(first_step_for(world, method.plain_solver))];
}

template <int Dof>
Stepper<Dof> plain_stepper(const Method& method) {
  return [finder = ContactFinder(), contacts = std::vector<Contact>(), plain_solver = method.plain_solver,
          between = SolverBetween<Dof>(method)](const World<Dof>& world, double h,
                                                Bodies<Dof>& bodies) mutable -> SolveReport {
    const Step step = first_step_for(world, plain_solver);
    if constexpr (Dof == 3)
      if (is_free(world)) {
        step_points(world, h, bodies);
        return solved_exactly();
      }
    // In step_pairs alone the bodies find their contacts; for other steps the engine does.
    if (step != Step::pairs && world.shapes().may_touch()) finder.find(world.shapes(), bodies, 0, contacts);
    Simulation simulation = copy_of(world);
    SolveReport report = step == Step::rows ? between.step(world, contacts, h, simulation, bodies)
                                            : step_by(step, simulation, contacts, h);
    copy_back(simulation, bodies);
    return report;
  };
}

template Stepper<3> plain_stepper<3>(const Method&);
template Stepper<6> plain_stepper<6>(const Method&);
template std::string plain_step_of<3>(const World<3>&, const Method&);
template std::string plain_step_of<6>(const World<6>&, const Method&);

}  // namespace spook
