// For each island by itself, "auto" by name:
//
//   factors     at once where they cost less than the sweeps that are allowed, Eq. (11.1)-(11.15)
//   sweeps      else: projected Gauss-Seidel, chapter 04, as many as are allowed, interleaved: Eq. (14.13)
//   and factors where those left more than a thousandth of what was asked for, if they cost no more than a hundred times
//               as much, until they leave a millionth; its bodies have factors at once then, for the next hundred steps
//
// One entry of its history is the worst of all islands, after as many sweeps or factorisations of each. The number of sweeps
// is asked for, and that of factorisations is not. Row updates are those of the sweeps. Keeps the islands, and the factors
// of each.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <tuple>

#include "engine/solvers/islands.hpp"
#include "engine/solvers/registry.hpp"
#include "engine/solvers/small_direct.hpp"
#include "engine/solvers/solve_directly.hpp"

namespace spook {

namespace {

/// One of several islands as a system of its own, with bodies of its own numbers.
template <int Dof>
struct IslandProblem {
  std::vector<Row<Dof>> rows;
  std::vector<Twist<Dof>> V;
  std::vector<InverseMass<Dof>> inverse_mass;
  std::vector<double> last;
  std::vector<int> bodies;  ///< their numbers outside

  /// `numbers` has -1 for every body, before and after.
  IslandProblem(const std::vector<int>& members, const SolverInput<Dof>& s, const std::vector<double>& impulses,
                std::vector<int>& numbers) {
    const auto number = [&](int body) {
      if (numbers[body] < 0) {
        numbers[body] = static_cast<int>(bodies.size());
        bodies.push_back(body);
        V.push_back(s.V[body]);
        inverse_mass.push_back(s.bodies.motion.inverse_mass[body]);
      }
      return numbers[body];
    };
    for (const int k : members) {
      rows.push_back(s.rows[k]);
      rows.back().i = number(s.rows[k].i);
      rows.back().j = number(s.rows[k].j);
      if (!impulses.empty()) last.push_back(impulses[k]);
    }
    for (const int body : bodies) numbers[body] = -1;
  }

  void write_back(const std::vector<int>& members, std::vector<Row<Dof>>& all,
                  std::vector<Twist<Dof>>& outside) const {
    for (std::size_t k = 0; k < members.size(); ++k) all[members[k]].lambda = rows[k].lambda;
    for (const Row<Dof>& row : rows) {
      if (moves_i(row)) outside[bodies[row.i]] = V[row.i];
      if (moves_j(row)) outside[bodies[row.j]] = V[row.j];
    }
  }
};

/// An island's rows, and what holds for them as long as they act on the same bodies.
template <int Dof>
struct Island {
  std::vector<int> members;
  std::optional<double> cost;  ///< of factors, in sweeps
  RowAndVelocityFactors<Dof> factors;
};

/// The islands of rows, looked for anew where a row acts on other bodies than the last ones did, or has a bound more.
template <int Dof>
class KnownIslands {
 public:
  std::span<std::unique_ptr<Island<Dof>>> of(const std::vector<Row<Dof>>& rows, std::size_t bodies) {
    const auto kind_of = [](const Row<Dof>& row) -> Kind {
      const bool bounded = std::isfinite(row.lo) || std::isfinite(row.hi);
      return {moves_i(row) ? row.i : -1, moves_j(row) ? row.j : -1, bounded};
    };
    const auto alike = [&](const Row<Dof>& row, const Kind& kind) { return kind_of(row) == kind; };
    if (bodies_ != bodies || !std::equal(rows.begin(), rows.end(), kinds_.begin(), kinds_.end(), alike)) {
      bodies_ = bodies;
      kinds_.clear();
      for (const Row<Dof>& row : rows) kinds_.push_back(kind_of(row));
      std::vector<std::vector<int>> all = islands(rows, bodies);
      count_ = all.size();
      while (islands_.size() < count_) islands_.push_back(std::make_unique<Island<Dof>>());
      for (std::size_t n = 0; n < all.size(); ++n) {
        islands_[n]->members = std::move(all[n]);
        islands_[n]->cost.reset();
      }
    }
    return std::span(islands_).first(count_);
  }

 private:
  using Kind = std::tuple<int, int, bool>;  // on which bodies that move, -1 for others; with a bound

  std::vector<std::unique_ptr<Island<Dof>>> islands_;  // more than there are now, where there were more
  std::size_t count_ = 0;
  std::vector<Kind> kinds_;
  std::size_t bodies_ = 0;
};

template <int Dof>
class Automatic {
 public:
  SolverResult operator()(const SolverInput<Dof>& s) {
    if (calls_++ % calls_until_forgotten == 0) hard_.clear();
    hard_.resize(s.V.size(), false);
    const auto all = (*islands_).of(s.rows, s.V.size());
    if (all.size() == 1)
      if (auto solved = few_at_once(*all.front(), s.rows, s.V, s.stop)) return *std::move(solved);
    const std::vector<double> last = s.last.impulses(s.rows.size(), s.first_contact_row, s.contacts, s.h);
    if (all.size() == 1) return solve_one(*all.front(), s, {s.rows, s.V, s.bodies.motion.inverse_mass, last});

    SolverResult outcome{SolveReport{.history = {}, .converged = true}};
    outcome.row_updates = 0;
    std::vector<int> numbers(s.V.size(), -1);
    for (const auto& island : all) {
      IslandProblem<Dof> copy(island->members, s, last, numbers);
      auto solved = few_at_once(*island, copy.rows, copy.V, s.stop);
      if (!solved) solved = solve_one(*island, s, {copy.rows, copy.V, copy.inverse_mass, copy.last});
      outcome = merge_parallel(std::move(outcome), *solved);
      copy.write_back(island->members, s.rows, s.V);
    }
    return outcome;
  }

 private:
  static constexpr int calls_until_forgotten = 100;
  static constexpr double worth_of_a_solution = 100;                   // sweeps for one
  static constexpr double share_left = 1e-3, share_of_factors = 1e-6;  // of what was asked for

  /// An island's rows and bodies: a copy, or all that there are.
  struct IslandView {
    std::vector<Row<Dof>>& rows;
    std::vector<Twist<Dof>>& V;
    const std::vector<InverseMass<Dof>>& inverse_mass;
    const std::vector<double>& last;  ///< impulses of the last step; empty: none
  };

  /// Dense factors, which need not know how the last step ended.
  static std::optional<SolverResult> few_at_once(Island<Dof>& island, std::vector<Row<Dof>>& rows,
                                                 std::vector<Twist<Dof>>& V, const StopRule& stop) {
    if (!island.cost) island.cost = factor_cost(rows);
    if (*island.cost > stop.max_sweeps) return {};
    auto solved = small_direct(rows, V, stop);
    if (!solved) return {};
    return without_updates(*std::move(solved));
  }

  SolverResult solve_one(Island<Dof>& island, const SolverInput<Dof>& s, const IslandView& part) {
    const double sweeps = s.stop.max_sweeps;
    const bool may = *island.cost <= worth_of_a_solution * sweeps;
    const bool at_once = *island.cost <= sweeps;
    if (at_once || (may && is_hard(island, s.rows))) {
      start_from(part.last, part.rows, part.V);
      return factorised(part, at_once ? s.stop.tolerance : enough(part, s.stop), island.factors);
    }
    SolverResult swept = solve_in_order(interleaved_order(part.rows.size()), part.rows, part.V, s.stop);
    swept.row_updates = swept.updates(part.rows.size());
    if (swept.report.converged || !may ||
        estimated_error(swept.report.history.back(), swept.report.history) <= share_left * rhs_norm(part.rows))
      return swept;
    for (const int k : island.members) {
      if (moves_i(s.rows[k])) hard_[s.rows[k].i] = true;
      if (moves_j(s.rows[k])) hard_[s.rows[k].j] = true;
    }
    return append(std::move(swept), factorised(part, enough(part, s.stop), island.factors), part.rows.size());
  }

  static double enough(const IslandView& part, const StopRule& stop) {
    return std::max(stop.tolerance, share_of_factors * rhs_norm(part.rows));
  }

  static SolverResult factorised(const IslandView& part, double tolerance,
                                 RowAndVelocityFactors<Dof>& factors) {
    const StopRule stop{.tolerance = tolerance};
    return without_updates(solve_directly(part.rows, part.inverse_mass, part.V, stop, factors));
  }

  bool is_hard(const Island<Dof>& island, const std::vector<Row<Dof>>& rows) const {
    return std::any_of(island.members.begin(), island.members.end(), [&](int k) {
      return (moves_i(rows[k]) && hard_[rows[k].i]) || (moves_j(rows[k]) && hard_[rows[k].j]);
    });
  }

  std::vector<bool> hard_;  // bodies of islands that sweeps did not solve
  int calls_ = 0;
  ScratchCache<KnownIslands<Dof>> islands_;
};

}  // namespace

template <int Dof>
Solver<Dof> automatic() {
  return {.solve = Automatic<Dof>(), .wants_last = true};
}

template Solver<3> automatic<3>();
template Solver<6> automatic<6>();

}  // namespace spook
