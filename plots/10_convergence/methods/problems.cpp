#include "methods/problems.hpp"

#include "engine/world/world.hpp"

namespace spook::plots {

namespace {

constexpr double h = 1.0 / 60, mu = 0.5, link = 0.1;

/// Returns the rows of the world's next step. `solver` solves the steps before, and the answer.
template <int Dof>
Problem<Dof> next_step(Settings<Dof> settings, const std::function<void(World<Dof>&)>& fill, double time,
                       const Solver<Dof>& solver) {
  auto problem = std::make_shared<Problem<Dof>>();
  settings.solver = {.solve =
                         [=, inner = solver](const SolverInput<Dof>& s) {
                           problem->rows = s.rows();
                           for (spook::Row<Dof>& row : problem->rows) row.lambda = 0;
                           problem->friction = s.constraints.friction;
                           problem->bodies = s.bodies;
                           SolverResult result = inner.solve(s);
                           problem->answer = s.V;
                           return result;
                         },
                     .friction = solver.friction,
                     .wants_last = true};
  settings.solver_limits.tolerance = 1e-15;  // limited by round-off, since errors are measured from this answer
  World<Dof> world(settings);
  fill(world);
  while (world.time() < time || world.rows().empty()) world.step(h);
  return *problem;
}

void add_box(World<6>& world, const Vec3& x, double mass, const Vec3& half, const Vec3& v = Vec3::Zero(),
             const Quat& q = Quat::Identity(), const Vec3& omega = Vec3::Zero()) {
  world.add({.x = x,
             .v = v,
             .mass = mass,
             .q = q,
             .omega = omega,
             .principal = solid_box_moments(mass, half),
             .half_sides = half});
}

Solver<6> exact(FrictionModel model) {
  return model == FrictionModel::cone ? newton<6>(model) : direct<6>();
}

}  // namespace

Problem<3> stack(double top) {
  const auto fill = [=](World<3>& world) {
    world.add_plane(Vec3::UnitZ(), 0);
    for (int n = 0; n < 10; ++n)
      world.add({.x = Vec3(0, 0, (n + 0.5) * link), .mass = n == 9 ? top : 1, .radius = link / 2});
  };
  return next_step<3>({.k = top > 1 ? 1e8 : 1e6}, fill, h, direct<3>());
}

Problem<3> wire() {
  const auto fill = [](World<3>& world) {
    world.add_fixed(Vec3::Zero());
    for (int n = 1; n <= 20; ++n) {
      world.add({.x = Vec3(0, 0, -n * link), .mass = n == 20 ? 1000.0 : 1});
      world.add_joint({.i = n - 1, .j = n, .length = link});
    }
  };
  return next_step<3>({.k = 1e8, .d = 3}, fill, h, direct<3>());
}

Problem<6> tower(FrictionModel model) {
  const auto fill = [](World<6>& world) {
    world.add_plane(Vec3::UnitZ(), 0);
    for (int n = 0; n < 20; ++n) add_box(world, Vec3(0, 0, n + 0.5), 1, Vec3::Constant(0.5));
  };
  return next_step<6>({.k = 1e6, .friction = mu}, fill, h, exact(model));
}

Problem<6> wall(FrictionModel model) {
  const auto fill = [](World<6>& world) {
    const int columns = 5;
    world.add_plane(Vec3::UnitZ(), 0);
    for (int course = 0; course < 11; ++course)
      for (int at = course % 2 == 0 ? 0 : -1; at < 2 * columns; at += 2) {
        const int from = std::max(at, 0), to = std::min(at + 2, 2 * columns);
        const double part = (to - from) / 2.0;
        add_box(world, Vec3(1.001 * (from + to) / 2.0, 0, course + 0.5), part, Vec3(part, 0.5, 0.5));
      }
  };
  return next_step<6>({.k = 1e6, .friction = mu}, fill, h, exact(model));
}

Problem<6> block() {
  const auto fill = [](World<6>& world) {
    world.add_plane(Vec3::UnitZ(), 0);
    add_box(world, Vec3(0, 0, 0.25), 1, Vec3(0.5, 0.3, 0.25), Vec3(2, 1, 0), Quat::Identity(), Vec3(0, 0, 3));
  };
  return next_step<6>({.k = 1e6, .friction = mu}, fill, 0.1, exact(FrictionModel::cone));
}

/// Cubes with initial orientations from a quasi-random sequence.
Problem<6> pile() {
  const auto fill = [](World<6>& world) {
    world.add_plane(Vec3::UnitZ(), 0);
    for (const Vec3& inwards : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)})
      world.add_plane(inwards, -2);
    for (int n = 0; n < 60; ++n) {
      const auto odd = [n](double rate) { return std::sin(rate * (n + 1)); };
      const Vec3 place(n % 16 % 4 - 1.5, n % 16 / 4 - 1.5, n / 16 + 0.6);
      const Quat q(odd(12.9), odd(78.2), odd(37.7), odd(93.9));
      add_box(world, place + 0.1 * Vec3(odd(3.1), odd(5.7), 0), 1, Vec3::Constant(0.28), Vec3::Zero(),
              q.normalized());
    }
  };
  return next_step<6>({.k = 1e6, .friction = mu}, fill, 2, direct<6>());
}

}  // namespace spook::plots
