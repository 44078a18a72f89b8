#include "08_pairs/pairs.hpp"

namespace spook {

static bool has_box(const RigidBody& body) {
  return body.half_sides != Vec3::Zero();
}

static Ball ball(const Simulation& simulation, int body) {
  const RigidBody& round = simulation.bodies[body];
  return {.body = body, .x = round.x, .radius = round.radius};
}

static Box box(const Simulation& simulation, int body) {
  const RigidBody& square = simulation.bodies[body];
  return {.body = body, .x = square.x, .axes = square.q.toRotationMatrix(), .half_sides = square.half_sides};
}

static void add(const std::optional<Contact>& found, std::vector<Contact>& contacts) {
  if (found) contacts.push_back(*found);
}

static void add_contacts_of_planes(const Simulation& simulation, const std::vector<int>& solids,
                                   std::vector<Contact>& contacts) {
  for (int p = 0; p < std::ssize(simulation.bodies); ++p) {
    const RigidBody& body = simulation.bodies[p];
    if (body.normal == Vec3::Zero()) continue;
    const Plane plane{.body = p, .x = body.x, .n = body.normal, .offset = body.offset};
    for (const int solid : solids) {
      if (simulation.bodies[solid].mass == 0) continue;
      if (has_box(simulation.bodies[solid]))
        plane_box(plane, box(simulation, solid), contacts);
      else
        add(plane_ball(plane, ball(simulation, solid)), contacts);
    }
  }
}

/// Narrow phase for two bodies that may touch.
static void add_contacts_of_pair(const Simulation& simulation, int i, int j, std::vector<Contact>& contacts) {
  const RigidBody &a = simulation.bodies[i], &b = simulation.bodies[j];
  if (a.mass == 0 && b.mass == 0) return;
  if (has_box(a) && has_box(b))
    box_box(box(simulation, i), box(simulation, j), contacts);
  else if (has_box(a))
    add(box_ball(box(simulation, i), ball(simulation, j)), contacts);
  else if (has_box(b))
    add(box_ball(box(simulation, j), ball(simulation, i)), contacts);
  else
    add(ball_ball(ball(simulation, i), ball(simulation, j)), contacts);
}

SolveReport step_pairs(Simulation& simulation, double h) {
  std::vector<int> solids;
  std::vector<Bounds> around;
  for (int b = 0; b < std::ssize(simulation.bodies); ++b) {
    const RigidBody& body = simulation.bodies[b];
    if (!has_box(body) && body.radius == 0) continue;
    const Vec3 reach = Vec3::Constant(body.radius);
    solids.push_back(b);
    around.push_back(has_box(body) ? bounds(box(simulation, b)) : Bounds{body.x - reach, body.x + reach});
  }

  std::vector<Contact> contacts;
  add_contacts_of_planes(simulation, solids, contacts);
  for (const auto& [i, j] : sweep_and_prune(around))
    add_contacts_of_pair(simulation, solids[i], solids[j], contacts);
  return step_impacts(simulation, contacts, h);
}

}  // namespace spook
