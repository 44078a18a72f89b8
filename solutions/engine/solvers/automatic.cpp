// The solver "auto", which selects a method for each island:
//
//   factors     at once if they cost less than the allowed sweeps: in fronts, engine/solvers/frontal_direct.hpp, if no
//               bound is in the way, else Eq. (11.1)-(11.15); with contacts on cones those of
//               engine/solvers/solve_on_cones.hpp
//   sweeps      otherwise, up to the allowed number: projected Gauss-Seidel, chapter 04, interleaved, Eq. (14.13). On
//               cones: sweeps of chapter 09 from the impulses of the last step, accelerated, Eq. (10.14), to 1e-6 of
//               the right-hand side; a few suffice at rest
//   factors     after sweeps that left more than 1e-3 of the right-hand side, if factors cost at most 100 times as
//               much; to 1e-6. The bodies are then marked as hard until the next hundredth solve. Hard bodies get
//               factors at once without cones; on cones they get factors unless one sweep converges, as it does at
//               rest
//
// Bodies at rest on cones are marked as hard also if the sweeps converge, but cost more than a factorisation. After
// factors the residual is small, so that the next steps look with one sweep.
//
// Costs are bounds, and those of wide structures are far too high. So where a structure at rest seems too dear, its
// cost is counted, and may be 5 times that of the allowed sweeps. It gets no more factors until the next hundredth
// solve if they fail.
//
// An island of contacts on cones moves if a body is faster than forces make it in a step. Its next step has other
// contacts, so an error does not add up. Then factors follow only if sweeps may have left a tenth of the approach, the
// largest |B| of a normal row. Sweeps and factors end at 3e-3 of it. There are twice as many sweeps as a factorisation
// costs, but at least half and at most twice the allowed number. A sweep may change contacts by less than the residual
// that it leaves. Then the sweeps go on to half of this share.
//
// Factors on cones begin with Newton's method where less than 1e-6 is asked for. They may fail. The more one
// factorisation costs, the fewer are made: 30 to 300.
//
// A given accuracy replaces all of these shares by one.
//
// A history entry is the worst of all islands, after as many sweeps or factorisations of each. The stop rule limits the
// sweeps but not the factorisations. Row updates are those of the sweeps. Caches the islands, and the factors of each.
#include <algorithm>
#include <cmath>
#include <optional>

#include "common/require.hpp"
#include "engine/solvers/anderson.hpp"
#include "engine/solvers/factor_cost.hpp"
#include "engine/solvers/known_islands.hpp"
#include "engine/solvers/registry.hpp"
#include "engine/solvers/small_direct.hpp"
#include "engine/solvers/solve_on_cones.hpp"

namespace spook {

namespace {

template <int Dof>
class Automatic {
 public:
  Automatic(FrictionModel model, std::optional<double> accuracy) : on_cones_(model == FrictionModel::cone) {
    if (accuracy) shares_ = {.left = *accuracy, .enough = *accuracy, .moving = *accuracy};
  }

  SolverResult operator()(const SolverInput<Dof>& s) {
    if (solves_ == 0) {
      hard_.clear();
      unsolved_.clear();
    }
    solves_ = (solves_ + 1) % solves_until_forgotten;
    hard_.resize(s.V.size(), false);
    unsolved_.resize(s.V.size(), false);
    const auto all = (*islands_).of(s.rows(), s.V.size());
    const std::vector<FrictionContact> none;
    const std::vector<FrictionContact>& on_cones = on_cones_ ? s.constraints.friction : none;
    if (all.size() == 1)
      if (auto solved = few_at_once(*all.front(), s.rows(), s.V, on_cones, s.stop)) return *std::move(solved);
    const std::vector<double> last = s.last.impulses(s.constraints, s.contacts, s.h, s.threads);
    if (all.size() == 1)
      return solve_one(
          *all.front(), s,
          {s.rows(), s.V, s.bodies.motion.inverse_mass, last, on_cones, approach(*all.front(), s)});

    SolverResult result{SolveReport{.history = {}, .converged = true}};
    result.row_updates = 0;
    BodyNumbers numbers;
    numbers.begin(s.V.size());
    for (const auto& island : all) {
      IslandProblem<Dof> copy(island->members, s, on_cones, last, numbers);
      auto solved = few_at_once(*island, copy.rows, copy.V, copy.friction, s.stop);
      if (!solved)
        solved = solve_one(
            *island, s, {copy.rows, copy.V, copy.inverse_mass, copy.last, copy.friction, approach(*island, s)});
      result = merge_parallel(std::move(result), *solved);
      copy.write_back(island->members, s.rows(), s.V);
    }
    return result;
  }

  void state(StateStream& s) { s(hard_, unsolved_, solves_); }

 private:
  static constexpr int solves_until_forgotten = 100;
  static constexpr int few_sweeps = 5;                   // are cheaper than to count the cost of factors
  static constexpr double worth_of_a_solution = 100;     // in allowed sweeps, by the bound of the cost
  static constexpr double counted_worth = 5;             // in allowed sweeps, by the counted cost
  static constexpr double worth_of_all_attempts = 2400;  // in allowed sweeps, of all factors of a solve
  static constexpr double share_may_be_left = 0.1;       // of the approach of moving contacts

  /// The residuals that suffice.
  struct Shares {
    double left = 1e-3;    ///< by sweeps, of the right-hand side
    double enough = 1e-6;  ///< by factors, of the right-hand side
    double moving = 3e-3;  ///< of the approach of moving contacts
  };

  /// An island's rows and bodies: a copy, or the whole system if there is only one island.
  struct IslandView {
    std::vector<Row<Dof>>& rows;
    std::vector<Twist<Dof>>& V;
    const std::vector<InverseMass<Dof>>& inverse_mass;
    const std::vector<double>& last;  ///< impulses of the last step; empty: none
    const std::vector<FrictionContact>& friction;
    double approach = 0;  ///< the largest, if the island is of moving contacts; else 0 [m/s]

    /// Tells whether factors can solve the island: on cones they need Σ > 0 in every row.
    bool has_factors() const {
      return friction.empty() ||
             std::all_of(rows.begin(), rows.end(), [](const Row<Dof>& row) { return row.Sigma > 0; });
    }
  };

  /// Solves by dense factors, which do not depend on the last step.
  static std::optional<SolverResult> few_at_once(Island<Dof>& island, std::vector<Row<Dof>>& rows,
                                                 std::vector<Twist<Dof>>& V,
                                                 const std::vector<FrictionContact>& friction,
                                                 const StopRule& stop) {
    if (!island.cost)
      island.cost = friction.empty() ? factor_cost(rows, stop.max_sweeps) : velocity_factor_cost(rows);
    if (*island.cost > stop.max_sweeps) return {};
    auto solved = small_direct(rows, V, stop, friction);
    if (!solved) return {};
    return without_updates(*std::move(solved));
  }

  /// Returns the largest |B| of a normal row if the island is of contacts on cones, and a body is faster than forces
  /// make it in a step; else 0 [m/s].
  double approach(const Island<Dof>& island, const SolverInput<Dof>& s) const {
    if (!on_cones_ || s.constraints.friction.empty()) return 0;
    const Motion<Dof>& motion = s.bodies.motion;
    const auto is_fast = [&](int body) {
      return is_dynamic(motion.inverse_mass[body]) &&
             motion.W[body].template head<3>().norm() > motion.Wf[body].template head<3>().norm();
    };
    bool moves = false;
    double most = 0;
    for (const int k : island.members) {
      if (k < static_cast<int>(s.constraints.first_contact_row)) return 0;
      if (!s.constraints.contact_of_normal_row(k)) continue;
      most = std::max(most, std::abs(s.rows()[k].B));
      moves = moves || is_fast(s.rows()[k].i) || is_fast(s.rows()[k].j);
    }
    return moves ? most : 0;
  }

  SolverResult solve_one(Island<Dof>& island, const SolverInput<Dof>& s, const IslandView& part) {
    const double sweeps = s.stop.max_sweeps;
    const bool moves = part.approach > 0, has_factors = part.has_factors();
    const bool at_once = has_factors && *island.cost <= sweeps;
    const bool hard = has_factors && !moves && any_marked(hard_, island, s.rows()) && is_worth(island, s, part);
    // On cones λ of the last step may be a solution still, which a sweep shows.
    if (at_once || (hard && part.friction.empty())) {
      start_from(part.last, part.rows, part.V);
      return factorised(part, at_once ? s.stop.tolerance : enough(part, s.stop), sweeps, island);
    }
    const int most = hard ? 1 : most_sweeps(island, s.stop, part, has_factors);
    SolverResult swept = this->swept(part, {.max_sweeps = most, .tolerance = s.stop.tolerance});
    swept.row_updates = swept.updates(part.rows.size());
    const int made = static_cast<int>(swept.report.history.size());
    if (has_factors && !moves && !part.friction.empty() && made > few_sweeps && made > counted(island, part))
      mark(hard_, island, s.rows());
    if (!has_factors || is_enough(swept.report, part, hard) || !is_worth(island, s, part)) return swept;
    if (!moves) mark(hard_, island, s.rows());
    const SolverResult solved = factorised(part, enough(part, s.stop), sweeps, island);
    if (!solved.report.converged && !is_cheap(island, s)) mark(unsolved_, island, s.rows());
    return append(std::move(swept), solved, part.rows.size());
  }

  /// Returns the largest number of sweeps before factors.
  static int most_sweeps(Island<Dof>& island, const StopRule& stop, const IslandView& part, bool has_factors) {
    if (part.approach == 0) return stop.max_sweeps;
    const double allowed = stop.max_sweeps;
    const double most =
        has_factors ? std::clamp(2 * counted(island, part), allowed / 2, 2 * allowed) : 2 * allowed;
    return static_cast<int>(most);
  }

  /// Returns the counted cost of a factorisation on cones, in sweeps.
  static double counted(Island<Dof>& island, const IslandView& part) {
    if (!island.counted) island.counted = counted_velocity_factor_cost(part.rows);
    return *island.counted;
  }

  /// Tells whether factors are worth their cost by its bound.
  static bool is_cheap(const Island<Dof>& island, const SolverInput<Dof>& s) {
    return *island.cost <= worth_of_a_solution * s.stop.max_sweeps;
  }

  /// Tells whether factors are worth their cost. It is not counted for contacts that move, which are others in each
  /// step.
  bool is_worth(Island<Dof>& island, const SolverInput<Dof>& s, const IslandView& part) const {
    if (is_cheap(island, s)) return true;
    if (part.friction.empty() || part.approach > 0 || any_marked(unsolved_, island, s.rows())) return false;
    return counted(island, part) <= counted_worth * s.stop.max_sweeps;
  }

  double enough(const IslandView& part, const StopRule& stop) const {
    return std::max({stop.tolerance, shares_.enough * rhs_norm(part.rows), shares_.moving * part.approach});
  }

  /// Tells whether sweeps made factors unnecessary.
  bool is_enough(const SolveReport& swept, const IslandView& part, bool hard) const {
    if (swept.converged)
      return part.approach == 0 || error_of_accelerated(swept.history) <= share_may_be_left * part.approach;
    const double left = estimated_error(swept.history.back(), swept.history);
    return !hard && left <= shares_.left * rhs_norm(part.rows);
  }

  SolverResult swept(const IslandView& part, const StopRule& stop) const {
    if (part.friction.empty())
      return solve_in_order(interleaved_order(part.rows.size()), part.rows, part.V, stop);
    start_from(part.last, part.rows, part.V);
    const double residual = enough(part, stop);
    SolverResult swept = accelerated(part, {.max_sweeps = stop.max_sweeps, .tolerance = residual});
    const int left = stop.max_sweeps - static_cast<int>(swept.report.history.size());
    const bool misses = part.approach > 0 && swept.report.converged && left > 0 &&
                        residual_on_cones(part.friction, part.rows, part.V) > residual;
    if (!misses) return swept;
    const StopRule closer{.max_sweeps = left, .tolerance = std::max(stop.tolerance, residual / 2)};
    return append(std::move(swept), accelerated(part, closer), part.rows.size());
  }

  static SolverResult accelerated(const IslandView& part, const StopRule& stop) {
    return anderson_solve(part.friction, part.rows, part.V, part.inverse_mass, stop);
  }

  /// Solves to `enough` [m/s]. `allowed` is the allowed number of sweeps.
  SolverResult factorised(const IslandView& part, double enough, double allowed, Island<Dof>& island) const {
    if (part.friction.empty()) {
      const StopRule until{.tolerance = enough};
      if (part.rows.size() > most_dense_rows && !wants_bodies(part.rows))
        if (auto solved = frontal_direct(part.rows, part.V, until, island.in_fronts))
          return without_updates(*std::move(solved));
      return without_updates(solve_directly(part.rows, part.inverse_mass, part.V, until, island.factors));
    }
    ConeProblem<Dof> problem(part.rows, part.V, part.friction, part.inverse_mass, island.on_cones);
    const double worth = worth_of_all_attempts * allowed / *island.cost;
    const bool exactly = enough < shares_.enough * rhs_norm(part.rows);
    return solve_on_cones(problem, enough,
                          {.newton_first = exactly,
                           .factorisations = static_cast<int>(std::clamp(worth, 30.0, 300.0)),
                           .suffices = part.approach > 0 ? 0 : shares_.left});
  }

  static void mark(std::vector<bool>& bodies, const Island<Dof>& island, const std::vector<Row<Dof>>& rows) {
    for (const int k : island.members) {
      if (moves_i(rows[k])) bodies[rows[k].i] = true;
      if (moves_j(rows[k])) bodies[rows[k].j] = true;
    }
  }
  static bool any_marked(const std::vector<bool>& bodies, const Island<Dof>& island,
                         const std::vector<Row<Dof>>& rows) {
    return std::any_of(island.members.begin(), island.members.end(), [&](int k) {
      return (moves_i(rows[k]) && bodies[rows[k].i]) || (moves_j(rows[k]) && bodies[rows[k].j]);
    });
  }

  bool on_cones_;
  Shares shares_;
  std::vector<bool> hard_;      // bodies of islands that sweeps did not solve in a recent step
  std::vector<bool> unsolved_;  // of those whose counted factors failed
  int solves_ = 0;              // since bodies lost their marks
  ScratchCache<KnownIslands<Dof>> islands_;
};

}  // namespace

template <int Dof>
Solver<Dof> automatic(FrictionModel model, std::optional<double> accuracy) {
  require_box_or_cone("auto", model);
  if (accuracy && !(*accuracy > 0 && *accuracy < 1))
    reject("accuracy", *accuracy, "between 0 and 1, as a share of the right-hand side");
  return {.solve = Automatic<Dof>(model, accuracy),
          .friction = model,
          .wants_last = true,
          .state_of_solve = state_of_method<Dof, Automatic<Dof>>};
}

template Solver<3> automatic<3>(FrictionModel, std::optional<double>);
template Solver<6> automatic<6>(FrictionModel, std::optional<double>);

}  // namespace spook
