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
    start_ = problem_.impulses();
    const double first = problem_.residual();
    const bool solved = problem_.is_solved(first, tolerance_) || newton(most_of_newton) || is_accurate() ||
                        from_within() || by_sweeps();
    if (report_.history.empty()) report_.history.push_back(first);
    report_.converged = solved;
    return std::move(report_);
  }

 private:
  static constexpr int most_of_newton = 12, most_within = 60;

  int remaining() const { return effort_.most - static_cast<int>(report_.history.size()); }
  double part(double share) const { return std::max(tolerance_, share * problem_.asked()); }

  bool newton(int most) {
    return cone_newton(problem_, tolerance_, std::min(most, remaining()), report_.history);
  }

  /// Accepts the best λ of Newton's method, the initial λ included, if its residual is small enough.
  bool is_accurate() const { return problem_.residual() <= part(share_within); }

  bool from_within() {
    std::vector<double> best = problem_.impulses();
    double least = problem_.residual();
    for (const double share : {infinity, 0.3, 0.1, 0.03}) {
      const LimitRule rule{.share = share, .factorisations = std::min(most_within, remaining())};
      if (rule.factorisations <= 0) break;
      problem_.set_impulses(start_);
      tried_within_ = true;
      const double enough = part(share == infinity ? share_within : share_lagged);
      if (cone_interior_point(problem_, tolerance_, enough, rule, report_.history)) return true;
      if (report_.history.back() < least) {
        least = report_.history.back();
        best = problem_.impulses();
      }
      if (least <= part(std::max(share_lagged, effort_.suffices))) {
        end_with(best, least);
        return true;
      }
    }
    end_with(best, least);
    return false;
  }

  bool by_sweeps() {
    constexpr int rounds = 8, sweeps = 20, factorisations = 4;
    std::vector<double> best = problem_.impulses();
    double least = problem_.residual();
    for (int round = 0; round < rounds && remaining() > 0 && least > part(share_lagged); ++round) {
      problem_.sweep(sweeps);
      const std::vector<double> swept = problem_.impulses();
      if (const double left = problem_.residual(); left < least) {
        least = left;
        best = swept;
      }
      if (newton(factorisations)) return true;
      problem_.set_impulses(swept);
    }
    end_with(best, least);
    return tried_within_ && least <= part(share_lagged);
  }

  /// The last entry of the history is the residual of λ.
  void end_with(const std::vector<double>& lambda, double left) {
    problem_.set_impulses(lambda);
    if (!report_.history.empty()) report_.history.back() = left;
  }

  ConeProblem<Dof>& problem_;
  double tolerance_;  // [m/s]
  ConeEffort effort_;
  std::vector<double> start_;
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
