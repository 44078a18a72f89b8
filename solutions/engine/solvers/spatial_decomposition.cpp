// The solver "spatial_decomposition": projected Gauss-Seidel on several threads, in stripes:
// engine/constraints/stripes.hpp.
//
// Within a stripe rows are interleaved, Eq. (14.13). A history entry is the result of a sweep. Has no cache.
#include <utility>

#include "10_convergence/convergence.hpp"
#include "14_fast_rows/fast_rows.hpp"
#include "engine/constraints/stripes.hpp"
#include "engine/solvers/registry.hpp"
#include "engine/support/larger.hpp"

namespace spook {

namespace {

/// Gives each stripe a static body of its own during its lifetime, so that no two stripes write to the same body.
template <int Dof>
class OwnGround {
 public:
  OwnGround(const Stripes& stripes, const std::vector<std::pair<int, int>>& ends, const SolverInput<Dof>& s)
      : s_(s), bodies_(s.V.size()) {
    for (std::size_t n = 0; n < stripes.size(); ++n)
      for (const int k : stripes[n]) {
        if (s.bodies.is_fixed(static_cast<std::size_t>(ends[k].first))) lend(n, s.rows()[k].i);
        if (s.bodies.is_fixed(static_cast<std::size_t>(ends[k].second))) lend(n, s.rows()[k].j);
      }
  }
  OwnGround(const OwnGround&) = delete;
  OwnGround& operator=(const OwnGround&) = delete;
  ~OwnGround() {
    for (const auto& [body, was] : lent_) *body = was;
    s_.V.resize(bodies_);
  }

 private:
  static constexpr std::size_t apart = 4;  // no two stripes share a cache line

  void lend(std::size_t stripe, int& body) {
    const std::size_t own = bodies_ + apart * (stripe + 1);
    if (s_.V.size() <= own) s_.V.resize(own + 1, Twist<Dof>::Zero());
    lent_.emplace_back(&body, std::exchange(body, static_cast<int>(own)));
  }

  const SolverInput<Dof>& s_;
  std::size_t bodies_;
  std::vector<std::pair<int*, int>> lent_;
};

/// Returns the stripes, in each of which two halves of the rows alternate.
template <int Dof>
Stripes interleaved_stripes(const std::vector<std::pair<int, int>>& ends, const SolverInput<Dof>& s) {
  Stripes stripes = divide_into_stripes(ends, s.bodies, s.threads);
  for (std::vector<int>& rows : stripes) {
    std::vector<int> order = interleaved_order(rows.size());
    for (int& k : order) k = rows[k];
    rows = std::move(order);
  }
  return stripes;
}

template <int Dof>
SolverResult solve_in_stripes(const SolverInput<Dof>& s) {
  SolveReport report;
  report.converged = s.rows().empty();
  if (report.converged) return report;
  std::vector<std::pair<int, int>> ends;
  ends.reserve(s.rows().size());
  for (const Row<Dof>& row : s.rows()) ends.emplace_back(row.i, row.j);
  const Stripes stripes = interleaved_stripes(ends, s);
  const OwnGround<Dof> ground(stripes, ends, s);
  const int rounds = rounds_of(stripes), threads = threads_for(stripes, s.rows().size(), s.threads);
  std::vector<double> lacked(stripes.size(), 0);  // residual of each stripe in the last sweep [m/s]

  int round = 0;
  const auto work = [&](int thread) {
    sweep_in_round(round, thread, threads, stripes,
                   [&](int stripe) { lacked[stripe] = sweep_in_order(stripes[stripe], s.rows(), s.V); });
  };
  const auto next = [&] {
    if (++round < rounds) return true;
    round = 0;
    double most = 0;
    for (const double one : lacked) most = larger(most, one);
    report.history.push_back(most);
    report.converged = most <= s.stop.tolerance;
    return !report.converged && std::ssize(report.history) < s.stop.max_sweeps;
  };
  in_rounds(threads, work, next);
  return report;
}

}  // namespace

template <int Dof>
Solver<Dof> spatial_decomposition() {
  return {.solve = solve_in_stripes<Dof>};
}

template Solver<3> spatial_decomposition<3>();
template Solver<6> spatial_decomposition<6>();

}  // namespace spook
