// The cost to solve the rows of one step, by other published methods and by the engine's own.
//
// A step of each scene, solved from λ = 0, h = 1/60, k = 1e6 (1e8 of what is heavy), d = 3:
//
//   stack   10 spheres of 1 kg, one on the other            tower   20 cubes, μ = 0.5
//   heavy   the same, the top one of 1000 kg                wall    a wall of 60 bricks, μ = 0.5
//   wire    20 links, 1000 kg at their end                  pile    60 cubes that have fallen into a box, μ = 0.5
//   block   a block that slides and spins on four contacts
//
// Friction is chapter 05's box, or chapter 09's cone. The error is that of all velocities, weighted by mass,
// √((V - V*)ᵀ M (V - V*) / V*ᵀ M V*), with V* solved to round-off. The cost is in multiply-adds, over those of a sweep,
// that is 4 Dof + 1 for each row:
//
//   sweeps      one each; mixed sweeps (anderson) 1.75, an iteration of conjugate gradients five, by their operations
//   factors     c (c + 3)/2 for each column of L with c entries; twice that if the matrix is not symmetric
//   others      Dof² for each block of the matrix to which a row contributes; solves, residuals, sweeps
#include <cmath>

#include "engine/solvers/factor_cost.hpp"
#include "engine/solvers/islands.hpp"
#include "machinery/experiment.hpp"
#include "methods/methods.hpp"
#include "methods/problems.hpp"

namespace spook::plots {
namespace {

/// The cost of factors, over bodies or over rows, and of the blocks of a matrix over bodies, in row updates.
template <int Dof>
struct FactorCost {
  double factor, solve, blocks = 0, coupled_blocks = 0;

  FactorCost(const Problem<Dof>& problem, bool on_bodies) {
    Factors factors;
    if (on_bodies) {
      VelocitySystem<Dof> on(problem.rows, problem.bodies.motion.inverse_mass);
      factorise(on.matrix(problem.rows, Vector::Ones(std::ssize(problem.rows))), factors);
    } else {
      factorise(schur_complement(problem.rows), factors);
    }
    factor = factor_work(factors) / update_work<Dof>;
    solve = solve_work(factors) / update_work<Dof>;
    const double each = Dof * Dof / update_work<Dof>;
    for (const spook::Row<Dof>& row : problem.rows) {
      const bool both = moves_i(row) && moves_j(row);
      blocks += (both ? 3 : 1) * each;
      coupled_blocks += (both ? 4 : 1) * each;
    }
  }
};

/// A solver, its iteration counts, and the cost of an iteration in row updates.
template <int Dof>
struct Method {
  std::string name;
  Solver<Dof> solver;
  int most;
  std::function<double(const SolverResult&, double rows, int most)> cost;
};

template <int Dof>
std::vector<Method<Dof>> methods(const Problem<Dof>& problem, FrictionModel model, Size size) {
  const bool on_cones = model == FrictionModel::cone;
  const auto each = [](double cost) {
    return [cost](const SolverResult& outcome, double rows, int) {
      return cost * rows * static_cast<double>(outcome.report.history.size());
    };
  };
  const auto counted = [](const SolverResult& outcome, double, int) {
    return static_cast<double>(outcome.row_updates);
  };
  const FactorCost<Dof> work(problem, wants_bodies(problem.rows)), of_bodies(problem, true);
  // For each factorisation: the matrix, three solves and their passes over the rows, four sweeps, and two passes for
  // the energy.
  const auto factors = [work](const SolverResult& outcome, double rows, int) {
    return static_cast<double>(outcome.report.history.size()) *
           (work.factor + work.blocks + 3 * (work.solve + rows) + 6 * rows);
  };
  // For each factorisation: the matrix, a solve and its passes over the rows; and for ten sweeps three more to set
  // impulses and to compute residuals.
  const auto coupled = [of_bodies](const SolverResult& outcome, double rows, int most) {
    const auto times = std::min(static_cast<double>(outcome.report.history.size()), double(most));
    return times * (2 * of_bodies.factor + of_bodies.coupled_blocks + 2 * of_bodies.solve + rows) +
           1.3 * static_cast<double>(outcome.row_updates);
  };
  const int most = size == Size::quick ? 1024 : 4096, few = 1024;
  std::vector<Method<Dof>> all = {
      {"sweeps", on_cones ? cone_gauss_seidel<Dof>() : gauss_seidel<Dof>(), most, each(1)},
      {"mixed sweeps", anderson<Dof>(model), most / 2, each(1.75)},
  };
  if (!on_cones) {
    all.push_back({"conjugate gradients", conjugate_gradients<Dof>(), most / 4, each(5)});
    all.push_back({"direct", direct<Dof>(), 1, factors});
    all.push_back({"block descent", avbd<Dof>(), few, counted});
  }
  all.push_back({"Newton", newton<Dof>(model), 16, coupled});
  all.push_back({"splitting", admm<Dof>(model), few, counted});
  return all;
}

template <int Dof>
std::vector<Row> rows_of(const std::string& scene, FrictionModel model, const Problem<Dof>& problem,
                         const Method<Dof>& method, Size size) {
  std::vector<Row> rows;
  const auto count = static_cast<double>(problem.rows.size());
  const auto next = [&](int n) { return std::max(n + 1, size == Size::quick && n >= 16 ? 2 * n : n * 5 / 4); };
  for (int n = 1; n <= method.most; n = next(n)) {
    const bool whole = method.name == "direct";
    const auto solved = problem.solve(method.solver, {.max_sweeps = whole ? 50 : n, .tolerance = 1e-15});
    const double cost = method.cost(solved.result, count, n) / count;
    rows.push_back({scene, name_of(model), method.name, double(solved.result.report.history.size()), cost,
                    problem.error(solved.V)});
    if (solved.result.report.converged) break;
  }
  return rows;
}

template <int Dof>
void add(Experiment& e, const std::string& scene, FrictionModel model, const Problem<Dof>& problem, Size size) {
  for (const Method<Dof>& method : methods(problem, model, size))
    e.points.push_back({scene + " " + name_of(model) + " " + method.name,
                        [=] { return rows_of(scene, model, problem, method, size); }});
}

/// Returns the least cost for an error of at most `goal`; infinity if no error was as small.
double cost_to(const Table& table, const std::string& scene, const std::string& friction,
               const std::string& method, double goal) {
  const Table some = table.where("scene", scene).where("friction", friction).where("method", method);
  const auto costs = some.numbers("cost [sweeps]"), errors = some.numbers("error");
  double least = infinity;
  for (std::size_t k = 0; k < errors.size(); ++k)
    if (errors[k] <= goal) least = std::min(least, costs[k]);
  return least;
}

double least_error(const Table& table, const std::string& scene, const std::string& method) {
  const auto errors = table.where("scene", scene).where("method", method).numbers("error");
  return *std::min_element(errors.begin(), errors.end());
}

void check(const Table& table, Claims& claims) {
  const double tight = 1e-6;
  const auto cost = [&](const std::string& scene, const std::string& friction, const std::string& method,
                        double goal = 1e-6) { return cost_to(table, scene, friction, method, goal); };
  const auto cheapest = [&](const std::string& scene, const std::string& friction,
                            const std::vector<std::string>& methods) {
    double least = infinity;
    for (const std::string& method : methods) least = std::min(least, cost(scene, friction, method, tight));
    return least;
  };
  const std::vector<std::string> on_cones = {"sweeps", "mixed sweeps", "splitting"};
  claims.at_least(
      "on cones Newton's method solves the tower to 1e-6 for at most an eighth of the cost of any other method",
      cheapest("tower", "cone", on_cones) / cost("tower", "cone", "Newton"), 8);
  claims.at_most("Newton's method solves the wall to 1e-9 for the cost of at most 300 sweeps",
                 cost("wall", "cone", "Newton", 1e-9), 300);
  claims.at_least("no other method solves the wall to 1e-6 for the cost of 1000 sweeps",
                  cheapest("wall", "cone", on_cones), 1000);
  claims.between("for a block on four contacts Newton's method costs 0.67 to 1.5 times as much as mixed sweeps",
                 cost("block", "cone", "Newton") / cost("block", "cone", "mixed sweeps"), 0.67, 1.5);

  const std::vector<std::string> others = {"sweeps",        "mixed sweeps", "conjugate gradients",
                                           "block descent", "Newton",       "splitting"};
  double without_friction = infinity;
  for (const char* scene : {"stack", "heavy", "wire"})
    without_friction =
        std::min(without_friction, cheapest(scene, "box", others) / cost(scene, "box", "direct"));
  claims.at_least("without friction no method reaches 1e-6 for less than the cost of one factorisation",
                  without_friction, 1);
  claims.at_least("for a wall with the friction box the direct solver costs more than Newton's method",
                  cost("wall", "box", "direct") / cost("wall", "box", "Newton"), 1);
  claims.at_least("for a pile of cubes only the direct solver reaches 1e-6 for the cost of 1000 sweeps",
                  cheapest("pile", "box", others), 1000);

  double dearer = infinity, dearest = 0, split = infinity;
  for (const char* scene : {"heavy", "wire"}) {
    const double descent = cost(scene, "box", "block descent");
    dearest = std::max(dearest, descent);
    dearer = std::min(dearer, descent / cost(scene, "box", "mixed sweeps"));
    split = std::min(split, least_error(table, scene, "splitting"));
  }
  claims.at_most(
      "at loads of 1000:1, where sweeps fail, block descent (AVBD) reaches 1e-6 for the cost of at most 3000 "
      "sweeps",
      dearest, 3000);
  claims.at_least("that is more than 10 times the cost of mixed sweeps", dearer, 10);
  claims.at_least("operator splitting (ADMM) leaves at least a third of the error at such loads", split, 0.33);
  claims.between(
      "operator splitting solves a wall on cones to 1e-3 for 0.67 to 1.5 times the cost of Newton's method",
      cost("wall", "cone", "splitting", 1e-3) / cost("wall", "cone", "Newton", 1e-3), 0.67, 1.5);
}

Experiment experiment(Size size) {
  Experiment e;
  e.columns = {"scene", "friction", "method", "count", "cost [sweeps]", "error"};
  add(e, "stack", FrictionModel::box, stack(1), size);
  add(e, "heavy", FrictionModel::box, stack(1000), size);
  add(e, "wire", FrictionModel::box, wire(), size);
  for (const FrictionModel model : {FrictionModel::box, FrictionModel::cone}) {
    add(e, "tower", model, tower(model), size);
    add(e, "wall", model, wall(model), size);
  }
  add(e, "pile", FrictionModel::box, pile(), size);
  add(e, "block", FrictionModel::cone, block(), size);
  e.check = check;
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
