// For each island by itself, "auto" by name:
//
//   factors     at once where they cost less than the sweeps that are allowed, Eq. (11.1)-(11.15)
//   sweeps      else: projected Gauss-Seidel, chapter 04, as many as are allowed
//   and factors where those left more than a thousandth of what was asked for, if they cost no more than a hundred times
//               as much, until they leave a millionth; its bodies have factors at once then, for the next hundred steps
//
// One entry of its history is the worst of all islands, after as many sweeps or factorisations of each. The number of sweeps
// is asked for, and that of factorisations is not. Row updates are those of the sweeps. Keeps the factors of each island,
// in order.
#include <algorithm>
#include <deque>

#include "engine/islands.hpp"
#include "engine/solve_directly.hpp"
#include "engine/solvers.hpp"

namespace spook {

namespace {

/// One island as a system of its own, with bodies of its own numbers.
template <int Dof>
struct Island {
  std::vector<Row<Dof>> rows;
  std::vector<Twist<Dof>> V;
  std::vector<InverseMass<Dof>> inverse_mass;
  std::vector<double> last;  ///< impulses of the last step; empty: none
  std::vector<int> bodies;   ///< their numbers outside

  /// `numbers` has -1 for every body, before and after.
  Island(const std::vector<int>& members, const System<Dof>& s, const std::vector<double>& impulses,
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

template <int Dof>
class ByIsland {
 public:
  Outcome operator()(const System<Dof>& s) {
    if (calls_++ % calls_until_forgotten == 0) hard_.clear();
    hard_.resize(s.V.size(), false);
    std::deque<BothFactors>& factors = *factors_;
    const std::vector<std::vector<int>> all = islands(s.rows, s.V.size());
    while (factors.size() < all.size()) factors.emplace_back();

    const std::vector<double> last = s.last.impulses(s.rows.size(), s.first_contact_row, s.contacts, s.h);
    Outcome outcome{SolveReport{.history = {}, .converged = true}};
    outcome.row_updates = 0;
    std::vector<int> numbers(s.V.size(), -1);
    for (std::size_t n = 0; n < all.size(); ++n) {
      Island<Dof> island(all[n], s, last, numbers);
      outcome = side_by_side(std::move(outcome), solve_one(island, s.stop, factors[n]));
      island.write_back(all[n], s.rows, s.V);
    }
    return outcome;
  }

 private:
  static constexpr int calls_until_forgotten = 100;
  static constexpr double worth_of_a_solution = 100;                   // sweeps for one
  static constexpr double share_left = 1e-3, share_of_factors = 1e-6;  // of what was asked for

  Outcome solve_one(Island<Dof>& island, const StopRule& stop, BothFactors& factors) {
    const double cost = factor_cost(island.rows), sweeps = stop.max_sweeps;
    const bool may = cost <= worth_of_a_solution * sweeps;
    const bool at_once = cost <= sweeps;
    if (at_once || (may && is_hard(island))) {
      begin_with(island.last, island.rows, island.V);
      return factorised(island, at_once ? stop.tolerance : enough(island, stop), factors);
    }
    Outcome swept = solve(island.rows, island.V, stop);
    swept.row_updates = swept.updates(island.rows.size());
    if (swept.report.converged || !may ||
        left_by(swept.report.history.back(), swept.report.history) <= share_left * asked_for(island.rows))
      return swept;
    for (const int body : island.bodies) hard_[body] = true;
    return in_turn(std::move(swept), factorised(island, enough(island, stop), factors), island.rows.size());
  }

  static double enough(const Island<Dof>& island, const StopRule& stop) {
    return std::max(stop.tolerance, share_of_factors * asked_for(island.rows));
  }

  static Outcome factorised(Island<Dof>& island, double tolerance, BothFactors& factors) {
    const StopRule stop{.tolerance = tolerance};
    Outcome outcome = solve_directly(island.rows, island.inverse_mass, island.V, stop, factors);
    outcome.row_updates = 0;
    return outcome;
  }

  bool is_hard(const Island<Dof>& island) const {
    for (std::size_t b = 0; b < island.bodies.size(); ++b)
      if (island.inverse_mass[b].linear > 0 && hard_[island.bodies[b]]) return true;
    return false;
  }

  std::vector<bool> hard_;  // bodies of islands that sweeps did not solve
  int calls_ = 0;
  Kept<std::deque<BothFactors>> factors_;
};

}  // namespace

template <int Dof>
Solver<Dof> by_island() {
  return {.solve = ByIsland<Dof>(), .wants_last = true};
}

template Solver<3> by_island<3>();
template Solver<6> by_island<6>();

}  // namespace spook
