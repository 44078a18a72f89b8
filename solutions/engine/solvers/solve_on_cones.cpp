#include "engine/solvers/solve_on_cones.hpp"

#include <algorithm>

#include "engine/solvers/cone_interior_point.hpp"
#include "engine/solvers/cone_newton.hpp"

namespace spook {

namespace {

// Relative to the right-hand side. Contacts without load that do not separate slow the interior-point method to a
// factor of 0.4 per factorisation, and Newton's method may not converge with them. The remaining error is far below
// that of leapfrog.
constexpr double share_within = 1e-8, share_lagged = 1e-6;

/// Tries the methods in turn, until all allowed factorisations were made.
template <int Dof>
class Attempts {
 public:
  Attempts(ConeProblem<Dof>& problem, double tolerance, const ConeEffort& effort)
      : problem_(problem), tolerance_(tolerance), effort_(effort) {}

  SolveReport solve() {
    problem_.sweep(1);
    start_ = best_ = problem_.impulses();
    const double first = problem_.residual();
    const bool solved = problem_.is_solved(first, tolerance_) || newton(most_of_newton) || is_accurate() ||
                        from_within(infinity) || accelerated() || from_within(0.3) || from_within(0.1) ||
                        from_within(0.03) || by_sweeps_and_newton();
    if (report_.history.empty()) report_.history.push_back(first);
    report_.converged = solved;
    return std::move(report_);
  }

 private:
  static constexpr int most_of_newton = 12, most_within = 60;

  int remaining() const { return effort_.most - static_cast<int>(report_.history.size()); }
  double part(double share) const { return std::max(tolerance_, share * problem_.rhs_norm()); }

  bool newton(int most) {
    return cone_newton(problem_, tolerance_, std::min(most, remaining()), report_.history);
  }

  /// Accepts the best λ of Newton's method, the initial λ included, if its residual is small enough. Remembers it.
  bool is_accurate() {
    keep(problem_.residual());
    return least_ <= part(share_within);
  }

  /// One attempt of the interior point. `share` of the limits is current, the rest lagged.
  bool from_within(double share) {
    const LimitRule rule{.share = share, .factorisations = std::min(most_within, remaining())};
    if (rule.factorisations <= 0) return false;
    problem_.set_impulses(start_);
    tried_within_ = true;
    const double enough = part(share == infinity ? share_within : share_lagged);
    if (cone_interior_point(problem_, tolerance_, enough, rule, report_.history)) return true;
    // The history is empty if the first factorisation of all failed.
    if (!report_.history.empty()) keep(report_.history.back());
    return end_with_best();
  }

  /// Makes accelerated sweeps from the best λ so far, where they reach what is enough sooner than lagged limits do.
  bool accelerated() {
    constexpr int sweeps = 300;
    if (!is_coarse()) return false;
    problem_.set_impulses(best_);
    problem_.accelerated_sweeps(sweeps, suffices());
    keep(problem_.residual());
    return end_with_best();
  }

  /// Alternates sweeps and Newton's method, from the best λ so far.
  bool by_sweeps_and_newton() {
    constexpr int rounds = 8, sweeps = 20, factorisations = 4;
    for (int round = 0; round < rounds && remaining() > 0; ++round) {
      problem_.sweep(sweeps);
      const std::vector<double> swept = problem_.impulses();
      keep(problem_.residual());
      if (is_enough()) break;
      if (newton(factorisations)) return true;
      problem_.set_impulses(swept);
    }
    return end_with_best();
  }

  void keep(double left) {
    if (!(left < least_)) return;
    least_ = left;
    best_ = problem_.impulses();
  }

  double suffices() const { return part(std::max(share_lagged, effort_.suffices)); }
  bool is_enough() const { return tried_within_ && least_ <= suffices(); }

  bool is_coarse() const { return suffices() >= 1e-4 * problem_.rhs_norm(); }

  /// Returns to the best λ, and tells whether it is enough. The last entry of the history is the residual of λ.
  bool end_with_best() {
    problem_.set_impulses(best_);
    if (!report_.history.empty()) report_.history.back() = least_;
    return is_enough();
  }

  ConeProblem<Dof>& problem_;
  double tolerance_;  // [m/s]
  ConeEffort effort_;
  std::vector<double> start_, best_;
  double least_ = infinity;    // the residual of the best λ after Newton's method [m/s]
  bool tried_within_ = false;  // if false, the residual shows only that too few factorisations were allowed
  SolveReport report_;
};

}  // namespace

template <int Dof>
SolverResult solve_on_cones(ConeProblem<Dof>& problem, double tolerance, const ConeEffort& effort) {
  SolverResult result = Attempts<Dof>(problem, tolerance, effort).solve();
  result.row_updates = problem.row_updates();
  return result;
}

template SolverResult solve_on_cones<3>(ConeProblem<3>&, double, const ConeEffort&);
template SolverResult solve_on_cones<6>(ConeProblem<6>&, double, const ConeEffort&);

}  // namespace spook
