#pragma once
// The islands of a world, with what their solution needs: kept from step to step, as long as rows act on the same
// bodies.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "engine/linear/body_numbers.hpp"
#include "engine/linear/contact_velocity_system.hpp"
#include "engine/solvers/frontal_direct.hpp"
#include "engine/solvers/islands.hpp"
#include "engine/solvers/solve_directly.hpp"
#include "engine/solvers/solver.hpp"

namespace spook {

/// One of several islands as a separate system, with its own numbers of bodies.
template <int Dof>
struct IslandProblem {
  std::vector<Row<Dof>> rows;
  std::vector<Twist<Dof>> V;
  std::vector<InverseMass<Dof>> inverse_mass;
  std::vector<double> last;
  std::vector<FrictionContact> friction;
  std::vector<int> bodies;  ///< their numbers in the world

  /// `numbers` is work space: no body has a number before and after the call.
  IslandProblem(const std::vector<int>& members, const SolverInput<Dof>& s,
                const std::vector<FrictionContact>& on_cones, const std::vector<double>& impulses,
                BodyNumbers& numbers) {
    for (const int k : members) {
      if (const auto contact = s.constraints.contact_of_normal_row(k); contact && !on_cones.empty())
        friction.push_back({.normal = rows.size(), .mu = on_cones[*contact].mu});
      rows.push_back(s.rows()[k]);
      rows.back().i = numbers.add(s.rows()[k].i);
      rows.back().j = numbers.add(s.rows()[k].j);
      if (!impulses.empty()) last.push_back(impulses[k]);
    }
    bodies = numbers.bodies();
    for (const int body : bodies) {
      V.push_back(s.V[body]);
      inverse_mass.push_back(s.bodies.motion.inverse_mass[body]);
    }
    numbers.clear();
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

/// An island's rows, and a cache that is valid as long as they act on the same bodies.
template <int Dof>
struct Island {
  std::vector<int> members;
  std::optional<double> cost;     ///< of factors, in sweeps
  std::optional<double> counted;  ///< the same, counted, on cones
  FrontalFactors in_fronts;
  RowAndVelocityFactors<Dof> factors;
  ContactVelocitySystem<Dof> on_cones;
};

/// The islands of rows. Searched for again if a row acts on other bodies than in the last step, or has a new bound.
template <int Dof>
class KnownIslands {
 public:
  std::span<std::unique_ptr<Island<Dof>>> of(const std::vector<Row<Dof>>& rows, std::size_t bodies) {
    const auto kind_of = [](const Row<Dof>& row) -> Kind {
      return {moves_i(row) ? row.i : -1, moves_j(row) ? row.j : -1, is_bounded(row)};
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
        islands_[n]->counted.reset();
      }
    }
    return std::span(islands_).first(count_);
  }

 private:
  using Kind = std::tuple<int, int, bool>;  // the row's dynamic bodies, -1 for others; whether it has a bound

  std::vector<std::unique_ptr<Island<Dof>>> islands_;  // as many as the largest number so far
  std::size_t count_ = 0;
  std::vector<Kind> kinds_;
  std::size_t bodies_ = 0;
};

}  // namespace spook
