// What one step's rows cost to solve by methods that people ask about, beside the engine's own.
//
// A step of each scene, solved from λ = 0, h = 1/60, k = 1e6 (1e8 of what is heavy), d = 3:
//
//   stack   10 spheres of 1 kg, one on the other            tower   20 cubes, μ = 0.5
//   heavy   the same, the top one of 1000 kg                wall    a wall of 60 bricks, μ = 0.5
//   wire    20 links, 1000 kg at their end                  pile    60 cubes that have fallen into a box, μ = 0.5
//   block   a block that slides and spins on four contacts
//
// Friction is chapter 05's box, or chapter 09's cone. The error is that of all velocities, weighed by mass,
// √((V - V*)ᵀ M (V - V*) / V*ᵀ M V*), with V* solved to roundings. The cost is in multiply-adds, over those of a sweep, that is
// 4 Dof + 1 for each row:
//
//   sweeps      one each; mixed sweeps (anderson) 1.75, an iteration of conjugate gradients five: by what they go through
//   factors     c (c + 3)/2 for each column of L with c entries; twice that where the matrix is not symmetric
//   and what goes with them: the matrix 3 Dof² a row, or 4 Dof² for the coupled one, solves, residuals, sweeps
#include <cmath>

#include "engine/islands.hpp"
#include "engine/on_bodies.hpp"
#include "engine/world.hpp"
#include "machinery/experiment.hpp"
#include "methods/methods.hpp"

namespace spook::plots {
namespace {

constexpr double h = 1.0 / 60, mu = 0.5, link = 0.1;

/// The rows of a step, as a solver is handed them.
template <int Dof>
struct Problem {
  std::vector<spook::Row<Dof>> rows;
  std::vector<Rubbing> rubbing;
  Bodies<Dof> bodies;
  std::vector<Twist<Dof>> answer;  ///< velocities that are exact

  struct Solved {
    Outcome outcome;
    std::vector<spook::Row<Dof>> rows;
    std::vector<Twist<Dof>> V;
  };
  Solved solve(const Solver<Dof>& solver, const StopRule& stop) const {
    Solved all{SolveReport{}, rows, std::vector<Twist<Dof>>(bodies.size(), Twist<Dof>::Zero())};
    const StartImpulses none;
    all.outcome = solver.solve({.rows = all.rows,
                                .V = all.V,
                                .rubbing = rubbing,
                                .joints = {},
                                .contacts = {},
                                .first_contact_row = rows.size(),
                                .bodies = bodies,
                                .last = none,
                                .gravity = Vec3::Zero(),
                                .h = h,
                                .stop = stop});
    return all;
  }
  double energy(const std::vector<Twist<Dof>>& V) const {
    double sum = 0;
    for (std::size_t b = 0; b < V.size(); ++b)
      if (bodies.motion.inverse_mass[b].linear > 0)
        sum += V[b].dot(mass_of(bodies.motion.inverse_mass[b]) * V[b]);
    return sum;
  }
  double error(std::vector<Twist<Dof>> V) const {
    for (std::size_t b = 0; b < V.size(); ++b) V[b] -= answer[b];
    return std::sqrt(energy(V) / energy(answer));
  }
};

/// Of the world's next step, with `solver` for what comes before, and to find the answer.
template <int Dof>
Problem<Dof> next_step(Settings<Dof> settings, const std::function<void(World<Dof>&)>& fill, double time,
                       const Solver<Dof>& solver) {
  auto problem = std::make_shared<Problem<Dof>>();
  settings.solver = {.solve =
                         [=, inner = solver](const System<Dof>& s) {
                           problem->rows = s.rows;
                           for (spook::Row<Dof>& row : problem->rows) row.lambda = 0;
                           problem->rubbing = s.rubbing;
                           problem->bodies = s.bodies;
                           Outcome outcome = inner.solve(s);
                           problem->answer = s.V;
                           return outcome;
                         },
                     .friction = solver.friction,
                     .wants_last = true};
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

Solver<6> exact(FrictionModel model) {
  return model == FrictionModel::cone ? newton<6>(model) : direct<6>();
}

Problem<6> tower(FrictionModel model) {
  const auto fill = [](World<6>& world) {
    world.add_plane(Vec3::UnitZ(), 0);
    for (int n = 0; n < 20; ++n) add_box(world, Vec3(0, 0, n + 0.5), 1, Vec3::Constant(0.5));
  };
  return next_step<6>({.friction = mu}, fill, h, exact(model));
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
  return next_step<6>({.friction = mu}, fill, h, exact(model));
}

Problem<6> block(FrictionModel model) {
  const auto fill = [](World<6>& world) {
    world.add_plane(Vec3::UnitZ(), 0);
    add_box(world, Vec3(0, 0, 0.25), 1, Vec3(0.5, 0.3, 0.25), Vec3(2, 1, 0), Quat::Identity(), Vec3(0, 0, 3));
  };
  return next_step<6>({.friction = mu}, fill, 0.1, exact(model));
}

/// Cubes that begin turned any way, by a sequence without a pattern.
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
  return next_step<6>({.friction = mu}, fill, 2, direct<6>());
}

/// What factors on bodies cost, in row updates.
template <int Dof>
struct FactorCost {
  double factor, solve;

  explicit FactorCost(const Problem<Dof>& problem) {
    Factors factors;
    if (wants_bodies(problem.rows)) {
      OnBodies<Dof> on(problem.rows, problem.bodies.motion.inverse_mass);
      factorise(on.matrix(problem.rows, Vector::Ones(std::ssize(problem.rows))), factors);
    } else {
      factorise(schur_complement(problem.rows), factors);
    }
    factor = factor_work(factors) / update_work<Dof>;
    solve = solve_work(factors) / update_work<Dof>;
  }
};

/// A solver, how often it may go on, and what that costs, in row updates.
template <int Dof>
struct Method {
  std::string name;
  Solver<Dof> solver;
  std::function<double(const Outcome&, double rows)> cost;
  int most;
};

template <int Dof>
std::vector<Method<Dof>> methods(const Problem<Dof>& problem, FrictionModel model, bool quick) {
  const bool on_cones = model == FrictionModel::cone;
  const auto each = [](double cost) {
    return [cost](const Outcome& outcome, double rows) {
      return cost * rows * static_cast<double>(outcome.report.history.size());
    };
  };
  const auto counted = [](const Outcome& outcome, double) { return static_cast<double>(outcome.row_updates); };
  const FactorCost<Dof> work(problem);
  // Of each: the matrix, three solves with what they want of the rows, four sweeps, and two to look at the energy.
  const auto factors = [work](const Outcome& outcome, double rows) {
    const double matrix = rows * 3 * Dof * Dof / update_work<Dof>;
    return static_cast<double>(outcome.report.history.size()) *
           (work.factor + matrix + 3 * (work.solve + rows) + 6 * rows);
  };
  // Of each: the matrix, a solve, and for five sweeps one and a half to set impulses, and to look at what is left.
  const auto coupled = [work](const Outcome& outcome, double rows) {
    const double matrix = rows * (4 * Dof * Dof + 6 * Dof) / update_work<Dof>;
    return static_cast<double>(outcome.report.history.size()) *
               (2 * work.factor + matrix + 2 * work.solve + rows) +
           1.3 * static_cast<double>(outcome.row_updates);
  };
  const int most = quick ? 512 : 4096;
  std::vector<Method<Dof>> all = {
      {"sweeps", on_cones ? cone<Dof>() : gauss_seidel<Dof>(), each(1), most},
      {"anderson", anderson<Dof>(model), each(1.75), most / 2},
  };
  if (!on_cones) {
    all.push_back({"conjugate", conjugate_gradients<Dof>(), each(5), most / 4});
    all.push_back({"direct", direct<Dof>(), factors, 1});
    all.push_back({"avbd", avbd<Dof>(), counted, most / 4});
  }
  all.push_back({"newton", newton<Dof>(model), coupled, 32});
  all.push_back({"admm", admm<Dof>(model), counted, most / 4});
  return all;
}

template <int Dof>
std::vector<Row> rows_of(const std::string& scene, FrictionModel model, const Problem<Dof>& problem,
                         const Method<Dof>& method) {
  std::vector<Row> rows;
  const auto count = static_cast<double>(problem.rows.size());
  for (int n = 1; n <= method.most; n *= 2) {
    const bool whole = method.name == "direct";
    const auto solved = problem.solve(method.solver, {.max_sweeps = whole ? 50 : n, .tolerance = 1e-15});
    const double cost = method.cost(solved.outcome, count) / count;
    rows.push_back({scene, name_of(model), method.name, double(solved.outcome.report.history.size()), cost,
                    problem.error(solved.V)});
    if (solved.outcome.report.converged) break;
  }
  return rows;
}

template <int Dof>
void add(Experiment& e, const std::string& scene, FrictionModel model, const Problem<Dof>& problem, Size size) {
  for (const Method<Dof>& method : methods(problem, model, size == Size::quick))
    e.points.push_back({scene + " " + name_of(model) + " " + method.name,
                        [=] { return rows_of(scene, model, problem, method); }});
}

void check(const Table&, Claims&) {}

Experiment experiment(Size size) {
  Experiment e;
  e.columns = {"scene", "friction", "method", "count", "cost [sweeps]", "error"};
  add(e, "stack", FrictionModel::box, stack(1), size);
  add(e, "heavy", FrictionModel::box, stack(1000), size);
  add(e, "wire", FrictionModel::box, wire(), size);
  for (const FrictionModel model : {FrictionModel::box, FrictionModel::cone}) {
    add(e, "tower", model, tower(model), size);
    add(e, "wall", model, wall(model), size);
    add(e, "block", model, block(model), size);
  }
  add(e, "pile", FrictionModel::box, pile(), size);
  e.check = check;
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
