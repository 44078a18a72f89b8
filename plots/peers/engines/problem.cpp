#include "peers/engines/problem.hpp"

#include <stdexcept>

namespace spook::peers {

namespace {

/// Returns the box with these corners.
Vec3 box_of(const std::vector<Vec3>& corners) {
  const Vec3 half_sides = corners.front().cwiseAbs();
  bool box = corners.size() == 8;
  for (const Vec3& corner : corners) box = box && corner.cwiseAbs().isApprox(half_sides);
  if (!box) throw std::invalid_argument("corners that are not those of a box are for no other engine");
  return half_sides;
}

template <int Dof>
ProblemBody body_of(const Bodies<Dof>& bodies, std::size_t i) {
  ProblemBody body{.moves = !bodies.is_fixed(i), .x = bodies.x[i]};
  if (!body.moves) return body;
  body.v = bodies.motion.W[i].template head<3>();
  body.mass = bodies.mass[i];
  if constexpr (Dof == 6) {
    body.q = bodies.orientations.q[i];
    body.omega = bodies.motion.W[i].template tail<3>();
    body.principal = bodies.orientations.principal[i];
  } else {
    body.principal = solid_sphere_moments(body.mass, 0.1);
  }
  return body;
}

template <int Dof>
Problem problem_in(const World<Dof>& world) {
  const Settings<Dof>& settings = world.settings();
  if (settings.force || settings.wrench)
    throw std::invalid_argument("a force that is a formula is for no other engine");
  Problem problem{.gravity = settings.gravity, .friction = settings.friction};
  if (settings.impacts) {
    problem.restitution = settings.impacts->restitution;
    problem.threshold = settings.impacts->threshold;
  }
  for (std::size_t i = 0; i < world.bodies().size(); ++i) problem.bodies.push_back(body_of(world.bodies(), i));
  problem.planes = world.shapes().planes;
  for (const Solid& solid : world.shapes().solids) {
    ProblemBody& body = problem.bodies[world.index(solid.body)];
    match(
        solid.shape, [&](const Sphere& sphere) { body.radius = sphere.radius; },
        [&](const Cuboid& box) { body.half_sides = box.half_sides; },
        [](const Capsule&) { throw std::invalid_argument("no case of the peers has a capsule"); });
  }
  for (const Corners& corners : world.shapes().corners)
    problem.bodies[world.index(corners.body)].half_sides = box_of(corners.points);
  problem.joints = world.joints();
  return problem;
}

}  // namespace

Problem problem_of(const Scene& scene) {
  return scene.points() ? problem_in(*scene.points()) : problem_in(*scene.rigid_bodies());
}

Problem problem_of(const World<6>& world) {
  return problem_in(world);
}

}  // namespace spook::peers
