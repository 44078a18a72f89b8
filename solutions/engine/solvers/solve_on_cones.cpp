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
    const double first = least_ = problem_.residual();
    const bool newton_first = effort_.newton_first || share_of_light(problem_) > 0.1;
    const bool solved = problem_.is_solved(first, tolerance_) || (newton_first && by_newton()) || from_near() ||
                        (!newton_first && by_newton()) || from_within(infinity) || accelerated() ||
                        from_within(0.3) || from_within(0.1) || from_within(0.03) || by_sweeps_and_newton();
    if (report_.history.empty()) report_.history.push_back(first);
    report_.converged = solved;
    return std::move(report_);
  }

 private:
  static constexpr int most_of_newton = 12, most_near = 20, most_within = 60;

  int remaining() const { return effort_.factorisations - static_cast<int>(report_.history.size()); }
  double part(double share) const { return std::max(tolerance_, share * problem_.rhs_norm()); }

  bool newton(int most) {
    return cone_newton(problem_, tolerance_, std::min(most, remaining()), report_.history);
  }

  /// Newton's method from the best λ so far, which is accepted in the end if its residual is small enough.
  bool by_newton() {
    problem_.set_impulses(best_);
    if (newton(most_of_newton)) return true;
    keep(problem_.residual());
    return is_accurate();
  }
  bool is_accurate() const { return least_ <= part(share_within); }

  /// Attempts of the interior point from the best λ so far.
  bool from_near() {
    constexpr double coarse = 1e-3, widest = 0.1;
    const double B = problem_.rhs_norm();
    if (least_ > coarse * B) return attempt_near(widest * B, most_within);
    for (const double residuals : {3, 30, 300})
      if (attempt_near(std::min(residuals * least_, widest * B), most_near)) return true;
    return false;
  }
  bool attempt_near(double width, int factorisations) {
    return interior_point(best_, {.width = width, .factorisations = factorisations}) || is_accurate();
  }

  /// One attempt from well inside. `share` of the limits is current, the rest lagged.
  bool from_within(double share) {
    tried_within_ = tried_within_ || remaining() > 0;
    return interior_point(start_, {.share = share, .factorisations = most_within});
  }

  bool interior_point(const std::vector<double>& start, InteriorAttempt attempt) {
    attempt.factorisations = std::min(attempt.factorisations, remaining());
    if (attempt.factorisations <= 0) return false;
    problem_.set_impulses(start);
    const double enough = part(attempt.share == infinity ? share_within : share_lagged);
    if (cone_interior_point(problem_, tolerance_, enough, attempt, report_.history)) return true;
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
      keep(problem_.residual());
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
  double least_ = infinity;    // the residual of the best λ [m/s]
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
