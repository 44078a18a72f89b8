// For each island by itself, by the rule of engine/islands.hpp: the direct solver, chapter 11, where it is sparse, or
// stiff and sparse enough; else projected Gauss-Seidel, chapter 04. "auto" by name.
//
// One entry of its history is the worst of all islands, after as many sweeps or factorisations of each; row updates are
// those of the islands that are swept. Keeps the factors of each island, in order.
#include <deque>

#include "11_direct/direct.hpp"
#include "engine/islands.hpp"
#include "engine/solvers.hpp"

namespace spook {

namespace {

/// One island as a system of its own, with bodies of its own numbers.
template <int Dof>
struct Island {
  std::vector<Row<Dof>> rows;
  std::vector<Twist<Dof>> V;
  std::vector<int> bodies;  ///< their numbers outside

  /// `numbers` has -1 for every body, before and after.
  Island(const std::vector<int>& members, const std::vector<Row<Dof>>& all,
         const std::vector<Twist<Dof>>& outside, std::vector<int>& numbers) {
    const auto number = [&](int body) {
      if (numbers[body] < 0) {
        numbers[body] = static_cast<int>(bodies.size());
        bodies.push_back(body);
        V.push_back(outside[body]);
      }
      return numbers[body];
    };
    for (const int k : members) {
      rows.push_back(all[k]);
      rows.back().i = number(all[k].i);
      rows.back().j = number(all[k].j);
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
    std::deque<Factors>& factors = *factors_;
    const std::vector<std::vector<int>> all = islands(s.rows, s.V.size());
    while (factors.size() < all.size()) factors.emplace_back();
    if (all.size() == 1) return solve_one(s.rows, s.V, s.stop, factors[0]);

    Outcome outcome{SolveReport{.history = {}, .converged = true}};
    outcome.row_updates = 0;
    std::vector<int> numbers(s.V.size(), -1);
    for (std::size_t n = 0; n < all.size(); ++n) {
      Island<Dof> island(all[n], s.rows, s.V, numbers);
      outcome = side_by_side(std::move(outcome), solve_one(island.rows, island.V, s.stop, factors[n]));
      island.write_back(all[n], s.rows, s.V);
    }
    return outcome;
  }

 private:
  static Outcome solve_one(std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V, const StopRule& stop,
                           Factors& factors) {
    const bool directly = wants_direct(rows, stop);
    Outcome outcome = directly ? direct_solve(rows, V, stop, factors) : solve(rows, V, stop);
    outcome.row_updates = directly ? 0 : outcome.updates(rows.size());
    return outcome;
  }

  Kept<std::deque<Factors>> factors_;
};

}  // namespace

template <int Dof>
Solver<Dof> by_island() {
  return {.solve = ByIsland<Dof>()};
}

template Solver<3> by_island<3>();
template Solver<6> by_island<6>();

}  // namespace spook
