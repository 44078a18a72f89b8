#include "engine/solvers/cone_interior_point.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "engine/solvers/cone_barrier.hpp"
#include "engine/solvers/cone_newton.hpp"

namespace spook {

namespace {

/// Targets of the products of slack and multiplier [J], and the second-order term of the slip [m/s].
struct ConeTarget {
  double lo = 0, hi = 0, slip = 0;
  Vec2 turn = Vec2::Zero();
};

template <int Dof>
class InteriorPoint {
 public:
  InteriorPoint(ConeProblem<Dof>& problem, const InteriorAttempt& attempt)
      : problem_(problem),
        next_try_(attempt.width > 0 ? 1e-3 * std::min(1.0, problem.residual() / problem.rhs_norm()) : 1e-3),
        best_(problem.impulses()),
        barrier_(problem, attempt.share, attempt.width),
        lagged_(barrier_.is_lagged()) {}

  bool solve(double tolerance, double enough, int most, std::vector<double>& history) {
    for (int n = 0, short_steps = 0, waited = 0; n < most && short_steps < most_short_steps; ++n) {
      const double part = step(std::isfinite(least_) ? least_ / problem_.rhs_norm() : 1);
      if (part < 0) break;
      const std::vector<double> inside = problem_.impulses();
      problem_.set_impulses(barrier_.answer());
      const double left = problem_.residual();
      if (!std::isfinite(left)) break;
      short_steps = !lagged_ && part < short_step ? short_steps + 1 : 0;
      waited = left < 0.8 * least_ ? 0 : waited + 1;
      keep(left);
      history.push_back(sweeps_help(left, enough) ? least_ : left);
      if (least_ <= std::max(enough, next_try_ * problem_.rhs_norm())) {
        if (problem_.is_solved(least_, tolerance) || cone_newton(problem_, tolerance, newton_steps, history))
          return true;
        keep(problem_.residual());
        while (least_ <= next_try_ * problem_.rhs_norm()) next_try_ *= 1e-3;
      }
      if (least_ <= enough) break;
      problem_.set_impulses(inside);
      if (!lagged_) continue;
      if (waited > most_waits) {
        pace_ = slow_pace;
        waited = 0;
      }
      barrier_.follow(pace_);
    }
    problem_.set_impulses(best_);
    if (!history.empty()) history.back() = least_;
    return least_ <= enough;
  }

 private:
  static constexpr int most_short_steps = 3, most_waits = 3, newton_steps = 2, sweeps = 15;
  static constexpr double short_step = 0.1, slow_pace = 0.6, reach_of_sweeps = 8;

  /// Keeps the current λ, with its residual, if it is the best so far. Returns whether it is.
  bool keep(double residual) {
    if (!(residual < least_)) return false;
    least_ = residual;
    best_ = problem_.impulses();
    return true;
  }

  /// Sweeps where that may suffice, and keeps the result if it is better. Returns whether it is.
  bool sweeps_help(double left, double enough) {
    if (least_ <= enough || left > std::min(reach_of_sweeps * enough, last_swept_ / 2)) return false;
    last_swept_ = left;
    problem_.accelerated_sweeps(sweeps, enough / 3);
    const bool better = keep(problem_.residual());
    problem_.set_impulses(best_);
    return better;
  }

  /// Returns a product relative to the target residual.
  double weight(std::size_t b) const {
    return barrier_.normal(barrier_.block(b)).diagonal / (problem_.rhs_norm() * problem_.rhs_norm());
  }

  double normal_step(std::size_t b) const { return step_[barrier_.block(b).row]; }
  Vec2 friction_step(std::size_t b) const {
    return {step_[barrier_.block(b).row + 1], step_[barrier_.block(b).row + 2]};
  }

  /// Takes one step: two solves with one factorisation. Returns the fraction of the step that was taken, or -1 if the
  /// solve failed. `left`: the least residual so far, over the right-hand side.
  double step(double left) {
    constexpr double share_of_residual = 0.003;
    factorise();
    std::vector<ConeTarget> target(barrier_.size());
    if (!solve(target)) return -1;
    const double far = longest_step(), before = mean_product(0), after = mean_product(far);
    double centre = before > 0 ? std::pow(std::max(0.0, after / before), 3) * before : 0;
    // Limits that still change would leave λ too close to the boundary.
    if (lagged_) centre = std::max(centre, share_of_residual * std::min(1.0, left * left));
    for (std::size_t b = 0; b < barrier_.size(); ++b) target[b] = second_order(b, centre / weight(b));
    if (!solve(target)) return -1;
    const double longest = longest_step(), part = longest < 1 ? (0.9 + 0.09 * far) * longest : 1;
    barrier_.advance(part, step_, change_);
    return part;
  }

  /// Sets K = A⁻¹ of A Δλ + G v = b.
  void factorise() {
    for (std::size_t b = 0; b < barrier_.size(); ++b) {
      ContactBlock& of = problem_.blocks()[b];
      of.K.setZero();
      if (!barrier_.is_open(of)) continue;
      double normal_softness = barrier_.normal(of).Sigma;
      if (barrier_.has_lo(of)) normal_softness += barrier_.push(b).lo / barrier_.room_lo(of);
      if (barrier_.has_hi(of)) normal_softness += barrier_.push(b).hi / barrier_.room_hi(of);
      of.K(0, 0) = 1 / normal_softness;
      if (!barrier_.rubs(of)) continue;
      const double slip = barrier_.push(b).slip;
      const Vec2 e = barrier_.direction(b);
      Mat3 A = Mat3::Zero();
      A(0, 0) = normal_softness;
      A(1, 1) = A(2, 2) = problem_.row(of.row + 1).Sigma + slip / barrier_.limit(b);
      A.block<2, 2>(1, 1) += 2 * slip / barrier_.room(b) * e * e.transpose();
      A.block<2, 1>(1, 0) = -2 * slip * barrier_.limit_rate(b) / barrier_.room(b) * e;
      of.K = A.inverse();
    }
    problem_.factorise();
  }

  /// Computes Newton's step towards the target: for λ, then for the multipliers.
  bool solve(const std::vector<ConeTarget>& target) {
    for (std::size_t b = 0; b < barrier_.size(); ++b) {
      ContactBlock& of = problem_.blocks()[b];
      Vec3 right(problem_.row_residual(of.row), 0, 0);
      if (barrier_.has_lo(of)) right[0] += target[b].lo / barrier_.room_lo(of);
      if (barrier_.has_hi(of)) right[0] -= target[b].hi / barrier_.room_hi(of);
      if (barrier_.rubs(of)) {
        const Vec2 r(problem_.row_residual(of.row + 1), problem_.row_residual(of.row + 2));
        right.tail<2>() = r - target[b].slip / barrier_.room(b) * barrier_.direction(b) + target[b].turn;
      }
      of.k = of.K * right;
    }
    if (!problem_.solve(step_)) return false;
    change_.assign(barrier_.size(), {});
    for (std::size_t b = 0; b < barrier_.size(); ++b) {
      const ContactBlock& of = barrier_.block(b);
      const Push& now = barrier_.push(b);
      if (barrier_.has_lo(of))
        change_[b].lo = (target[b].lo - now.lo * normal_step(b)) / barrier_.room_lo(of) - now.lo;
      if (barrier_.has_hi(of))
        change_[b].hi = (target[b].hi + now.hi * normal_step(b)) / barrier_.room_hi(of) - now.hi;
      if (barrier_.rubs(of))
        change_[b].slip = (target[b].slip - now.slip * room_change(b)) / barrier_.room(b) - now.slip;
    }
    return true;
  }

  /// Returns the first-order change of R with λ [N s].
  double room_change(std::size_t b) const {
    const Vec2 e = barrier_.direction(b);
    return barrier_.limit_rate(b) * normal_step(b) * (1 + e.squaredNorm()) - 2 * e.dot(friction_step(b));
  }

  /// Sets the target of the products to `centre`, minus the second-order change by the predictor: Eq. (11.11).
  ConeTarget second_order(std::size_t b, double centre) const {
    const double along = normal_step(b);
    ConeTarget target{.lo = centre - along * change_[b].lo, .hi = centre + along * change_[b].hi};
    if (!barrier_.rubs(barrier_.block(b))) return target;
    const double L = barrier_.limit(b), of_L = barrier_.limit_rate(b) * along, slip = barrier_.push(b).slip;
    const Vec2 e = barrier_.direction(b), of_e = (friction_step(b) - of_L * e) / L;
    const double of_room = -2 * of_L * e.dot(of_e) - L * of_e.squaredNorm();
    target.slip = barrier_.block(b).mu * centre - change_[b].slip * room_change(b) - slip * of_room;
    target.turn = (slip * of_L / L - change_[b].slip) * of_e;
    return target;
  }

  /// Returns the fraction of the step after which the first slack or multiplier is 0; 1 if there is none.
  double longest_step() const {
    double part = 1;
    const auto keep = [&](double room, double change) {
      if (change < 0) part = std::min(part, -room / change);
    };
    for (std::size_t b = 0; b < barrier_.size(); ++b) {
      const ContactBlock& of = barrier_.block(b);
      if (barrier_.has_lo(of))
        keep(barrier_.room_lo(of), normal_step(b)), keep(barrier_.push(b).lo, change_[b].lo);
      if (barrier_.has_hi(of))
        keep(barrier_.room_hi(of), -normal_step(b)), keep(barrier_.push(b).hi, change_[b].hi);
      if (!barrier_.rubs(of)) continue;
      keep(barrier_.push(b).slip, change_[b].slip);
      // L² - |λ_t|² = c + 2 b α + a α², which is positive at α = 0
      const Vec2 along = friction_step(b);
      const double L = barrier_.limit(b), of_L = barrier_.limit_rate(b) * normal_step(b),
                   c = barrier_.room(b) * L, half_b = L * of_L - problem_.friction(of).dot(along),
                   a = of_L * of_L - along.squaredNorm(), discriminant = half_b * half_b - a * c;
      if (discriminant < 0) continue;
      const double q = -(half_b + std::copysign(std::sqrt(discriminant), half_b));
      for (const double root : {q / a, c / q})
        if (root > 0) part = std::min(part, root);
    }
    return part;
  }

  /// Returns the mean of all products after that fraction of the step, relative to the target residual.
  double mean_product(double part) const {
    double sum = 0;
    int count = 0;
    const auto add = [&](std::size_t b, double product) {
      sum += weight(b) * product;
      ++count;
    };
    for (std::size_t b = 0; b < barrier_.size(); ++b) {
      const ContactBlock& of = barrier_.block(b);
      const double along = part * normal_step(b);
      if (barrier_.has_lo(of))
        add(b, (barrier_.room_lo(of) + along) * (barrier_.push(b).lo + part * change_[b].lo));
      if (barrier_.has_hi(of))
        add(b, (barrier_.room_hi(of) - along) * (barrier_.push(b).hi + part * change_[b].hi));
      if (!barrier_.rubs(of)) continue;
      const double L = barrier_.limit(b) + barrier_.limit_rate(b) * along;
      const Vec2 friction = problem_.friction(of) + part * friction_step(b);
      add(b, (L * L - friction.squaredNorm()) / (L * of.mu) * (barrier_.push(b).slip + part * change_[b].slip));
    }
    return count > 0 ? sum / count : 0;
  }

  ConeProblem<Dof>& problem_;
  double next_try_;           // of Newton's method [share of the right-hand side]
  std::vector<double> best_;  // λ of the least residual
  double least_ = infinity;   // that residual [m/s]
  ConeBarrier<Dof> barrier_;  // the current point
  bool lagged_;
  double pace_ = 1, last_swept_ = infinity;
  std::vector<double> step_;  // Δλ of each row
  std::vector<Push> change_;  // of the multipliers of each block
};

}  // namespace

template <int Dof>
bool cone_interior_point(ConeProblem<Dof>& problem, double tolerance, double enough,
                         const InteriorAttempt& attempt, std::vector<double>& history) {
  return InteriorPoint<Dof>(problem, attempt).solve(tolerance, enough, attempt.factorisations, history);
}

template bool cone_interior_point<3>(ConeProblem<3>&, double, double, const InteriorAttempt&,
                                     std::vector<double>&);
template bool cone_interior_point<6>(ConeProblem<6>&, double, double, const InteriorAttempt&,
                                     std::vector<double>&);

}  // namespace spook
