#include "engine/solvers/cone_interior_point.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/solvers/cone_newton.hpp"

namespace spook {

namespace {

/// Multipliers of both bounds of a block's first row, and its slip speed [m/s].
struct Push {
  double lo = 0, hi = 0, slip = 0;
};

/// Targets of the products of slack and multiplier [J], and the second-order term of the slip [m/s].
struct Target {
  double lo = 0, hi = 0, slip = 0;
  Vec2 turn = Vec2::Zero();
};

template <int Dof>
class InteriorPoint {
 public:
  InteriorPoint(ConeProblem<Dof>& problem, const InteriorAttempt& attempt) : problem_(problem) {
    for (const ContactBlock& block : problem.blocks())
      theta_.push_back(std::min(1.0, attempt.share / block.mu));
    lagged_ = std::any_of(theta_.begin(), theta_.end(), [](double theta) { return theta < 1; });
    if (attempt.width > 0)
      start_near(attempt.width);
    else
      start_inside();
  }

  bool solve(double tolerance, double enough, int most, std::vector<double>& history) {
    double least = infinity, next_try = first_try_, last_swept = infinity;
    std::vector<double> best = problem_.impulses();
    for (int n = 0, short_steps = 0, waited = 0; n < most && short_steps < most_short_steps; ++n) {
      const double part = step(std::isfinite(least) ? least / problem_.rhs_norm() : 1);
      if (part < 0) break;
      const std::vector<double> inside = problem_.impulses();
      problem_.set_impulses(answer());
      const double left = problem_.residual();
      if (!std::isfinite(left)) break;
      history.push_back(left);
      short_steps = !lagged_ && part < short_step ? short_steps + 1 : 0;
      waited = left < 0.8 * least ? 0 : waited + 1;
      if (left < least) {
        least = left;
        best = problem_.impulses();
      }
      if (least > enough && left <= std::min(reach_of_sweeps * enough, last_swept / 2)) {
        last_swept = left;
        problem_.accelerated_sweeps(sweeps, enough / 3);
        const double swept = problem_.residual();
        if (swept < least) {
          least = history.back() = swept;
          best = problem_.impulses();
        }
        problem_.set_impulses(best);
      }
      if (least <= std::max(enough, next_try * problem_.rhs_norm())) {
        if (problem_.is_solved(least, tolerance) || cone_newton(problem_, tolerance, newton_steps, history))
          return true;
        while (least <= next_try * problem_.rhs_norm()) next_try *= 1e-3;
      }
      if (least <= enough) break;
      if (waited > most_waits && lagged_) {
        pace_ = std::max(least_pace, 0.6 * pace_);
        waited = 0;
      }
      problem_.set_impulses(lagged_ ? with_new_limits(inside) : inside);
    }
    problem_.set_impulses(best);
    if (!history.empty()) history.back() = least;
    return least <= enough;
  }

 private:
  static constexpr int most_short_steps = 3, most_waits = 3, newton_steps = 2, sweeps = 15;
  static constexpr double short_step = 0.1, least_pace = 0.6, reach_of_sweeps = 8;

  const Row<Dof>& normal(const ContactBlock& block) const { return problem_.row(block.row); }
  bool rubs(const ContactBlock& block) const { return block.count == 3 && block.mu > 0 && is_open(block); }
  bool is_open(const ContactBlock& block) const { return normal(block).lo < normal(block).hi; }
  bool has_lo(const ContactBlock& block) const { return is_open(block) && std::isfinite(normal(block).lo); }
  bool has_hi(const ContactBlock& block) const { return is_open(block) && std::isfinite(normal(block).hi); }
  double room_lo(const ContactBlock& block) const { return normal(block).lambda - normal(block).lo; }
  double room_hi(const ContactBlock& block) const { return normal(block).hi - normal(block).lambda; }

  std::size_t size() const { return problem_.blocks().size(); }
  const ContactBlock& block(std::size_t b) const { return problem_.blocks()[b]; }

  /// L, and its derivative with respect to λ_n.
  double limit(std::size_t b) const {
    const double now = normal(block(b)).lambda;
    return block(b).mu * (theta_[b] == 1 ? now : theta_[b] * now + (1 - theta_[b]) * last_[b]);
  }
  double limit_rate(std::size_t b) const { return theta_[b] * block(b).mu; }
  Vec2 direction(std::size_t b) const { return problem_.friction(block(b)) / limit(b); }  // e
  double room(std::size_t b) const {                                                      // R
    const double L = limit(b), t = problem_.friction(block(b)).norm();
    return (L - t) * (L + t) / L;
  }
  double normal_step(std::size_t b) const { return step_[block(b).row]; }
  Vec2 friction_step(std::size_t b) const { return {step_[block(b).row + 1], step_[block(b).row + 2]}; }

  /// Returns a product relative to the target residual.
  double weight(std::size_t b) const {
    return normal(block(b)).diagonal / (problem_.rhs_norm() * problem_.rhs_norm());
  }

  /// Returns the x > 0 with x (x - y) = w². So x - y is that of -y.
  static double positive(double y, double w) {
    const double root = std::hypot(y, 2 * w);
    return y > 0 ? (root + y) / 2 : 2 * w * w / (root - y);
  }

  /// Starts near the current λ, with products of w² [m²/s²].
  void start_near(double w) {
    first_try_ *= std::min(1.0, problem_.residual() / problem_.rhs_norm());
    std::vector<double> lambda = problem_.impulses();
    push_.resize(size());
    for (std::size_t b = 0; b < size(); ++b) {
      const ContactBlock& of = block(b);
      const Row<Dof>& row = normal(of);
      const double S = row.diagonal, r = problem_.row_residual(of.row), before = row.lambda;
      double& now = lambda[of.row];
      const double above = before - row.lo, below = row.hi - before;
      if (has_lo(of) && !(below < above)) {
        const double y = S * above + std::min(r, 0.0);
        now = std::min(row.lo + positive(y, w) / S, (row.lo + row.hi) / 2);
        push_[b] = {.lo = positive(-y, w), .hi = has_hi(of) ? w * w / S / (row.hi - now) : 0};
      } else if (has_hi(of)) {
        const double y = S * below - std::max(r, 0.0);
        now = std::max(row.hi - positive(y, w) / S, (row.lo + row.hi) / 2);
        push_[b] = {.lo = has_lo(of) ? w * w / S / (now - row.lo) : 0, .hi = positive(-y, w)};
      }
      last_.push_back(now);
      if (of.count < 3) continue;
      Vec2 along = problem_.friction(of);
      if (rubs(of)) {
        const Vec2 lacks(problem_.row_residual(of.row + 1), problem_.row_residual(of.row + 2));
        const double L = of.mu * now, slack = of.mu * before - along.norm();
        const bool slides = slack < 0.01 * of.mu * before;
        const double y = of.s * slack - (slides ? lacks.norm() : 0),
                     most = std::max(0.0, L - positive(y, w) / of.s);
        if (along.norm() > most) along *= most / along.norm();
        push_[b].slip = of.mu * w * w / S / ((L - along.norm()) * (L + along.norm()) / L);
      } else {
        along.setZero();
      }
      lambda[of.row + 1] = along[0], lambda[of.row + 2] = along[1];
    }
    problem_.set_impulses(lambda);
  }

  /// Starts well inside the bounds, with multipliers as large as the right-hand side.
  void start_inside() {
    std::vector<double> lambda = problem_.impulses();
    for (std::size_t b = 0; b < size(); ++b) {
      const Row<Dof>& row = normal(block(b));
      double& of = lambda[block(b).row];
      const double scale = problem_.rhs_norm() / row.diagonal, tenth = 0.1 * (row.hi - row.lo);
      if (block(b).count == 3) lambda[block(b).row + 1] = lambda[block(b).row + 2] = 0;
      if (has_lo(block(b)) && has_hi(block(b)))
        of = std::clamp(of, row.lo + tenth, row.hi - tenth);
      else if (has_lo(block(b)))
        of = std::max(of, row.lo + scale);
      else if (has_hi(block(b)))
        of = std::min(of, row.hi - scale);
    }
    problem_.set_impulses(lambda);
    push_.resize(size());
    for (std::size_t b = 0; b < size(); ++b) {
      last_.push_back(normal(block(b)).lambda);
      const double r = problem_.row_residual(block(b).row);
      if (has_lo(block(b))) push_[b].lo = std::max(problem_.rhs_norm(), -r);
      if (has_hi(block(b))) push_[b].hi = std::max(problem_.rhs_norm(), r);
      if (rubs(block(b))) push_[b].slip = problem_.rhs_norm();
    }
  }

  /// Takes one step: two solves with one factorisation. Returns the fraction of the step that was taken, or -1 if the
  /// solve failed. `left`: the least residual so far, over the right-hand side.
  double step(double left) {
    constexpr double share_of_residual = 0.003;
    factorise();
    std::vector<Target> target(size());
    if (!solve(target)) return -1;
    const double far = longest_step(), before = mean_product(0), after = mean_product(far);
    double centre = before > 0 ? std::pow(std::max(0.0, after / before), 3) * before : 0;
    // Limits that still change would leave λ too close to the boundary.
    if (lagged_) centre = std::max(centre, share_of_residual * std::min(1.0, left * left));
    for (std::size_t b = 0; b < size(); ++b) target[b] = second_order(b, centre / weight(b));
    if (!solve(target)) return -1;
    const double longest = longest_step(), part = longest < 1 ? (0.9 + 0.09 * far) * longest : 1;
    std::vector<double> lambda = problem_.impulses();
    for (std::size_t k = 0; k < lambda.size(); ++k) lambda[k] += part * step_[k];
    for (std::size_t b = 0; b < size(); ++b) {
      push_[b].lo += part * change_[b].lo;
      push_[b].hi += part * change_[b].hi;
      push_[b].slip += part * change_[b].slip;
    }
    problem_.set_impulses(lambda);
    return part;
  }

  /// Sets K = A⁻¹ of A Δλ + G v = b.
  void factorise() {
    for (std::size_t b = 0; b < size(); ++b) {
      ContactBlock& of = problem_.blocks()[b];
      of.K.setZero();
      if (!is_open(of)) continue;
      double normal_softness = normal(of).Sigma;
      if (has_lo(of)) normal_softness += push_[b].lo / room_lo(of);
      if (has_hi(of)) normal_softness += push_[b].hi / room_hi(of);
      of.K(0, 0) = 1 / normal_softness;
      if (!rubs(of)) continue;
      const double slip = push_[b].slip;
      const Vec2 e = direction(b);
      Mat3 A = Mat3::Zero();
      A(0, 0) = normal_softness;
      A(1, 1) = A(2, 2) = problem_.row(of.row + 1).Sigma + slip / limit(b);
      A.block<2, 2>(1, 1) += 2 * slip / room(b) * e * e.transpose();
      A.block<2, 1>(1, 0) = -2 * slip * limit_rate(b) / room(b) * e;
      of.K = A.inverse();
    }
    problem_.factorise();
  }

  /// Computes Newton's step towards the target: for λ, then for the multipliers.
  bool solve(const std::vector<Target>& target) {
    for (std::size_t b = 0; b < size(); ++b) {
      ContactBlock& of = problem_.blocks()[b];
      Vec3 right(problem_.row_residual(of.row), 0, 0);
      if (has_lo(of)) right[0] += target[b].lo / room_lo(of);
      if (has_hi(of)) right[0] -= target[b].hi / room_hi(of);
      if (rubs(of)) {
        const Vec2 r(problem_.row_residual(of.row + 1), problem_.row_residual(of.row + 2));
        right.tail<2>() = r - target[b].slip / room(b) * direction(b) + target[b].turn;
      }
      of.k = of.K * right;
    }
    if (!problem_.solve(step_)) return false;
    change_.assign(size(), {});
    for (std::size_t b = 0; b < size(); ++b) {
      const ContactBlock& of = block(b);
      const Push& now = push_[b];
      if (has_lo(of)) change_[b].lo = (target[b].lo - now.lo * normal_step(b)) / room_lo(of) - now.lo;
      if (has_hi(of)) change_[b].hi = (target[b].hi + now.hi * normal_step(b)) / room_hi(of) - now.hi;
      if (rubs(of)) change_[b].slip = (target[b].slip - now.slip * room_change(b)) / room(b) - now.slip;
    }
    return true;
  }

  /// Returns the first-order change of R with λ [N s].
  double room_change(std::size_t b) const {
    const Vec2 e = direction(b);
    return limit_rate(b) * normal_step(b) * (1 + e.squaredNorm()) - 2 * e.dot(friction_step(b));
  }

  /// Sets the target of the products to `centre`, minus the second-order change by the predictor: Eq. (11.11).
  Target second_order(std::size_t b, double centre) const {
    const double along = normal_step(b);
    Target target{.lo = centre - along * change_[b].lo, .hi = centre + along * change_[b].hi};
    if (!rubs(block(b))) return target;
    const double L = limit(b), of_L = limit_rate(b) * along, slip = push_[b].slip;
    const Vec2 e = direction(b), of_e = (friction_step(b) - of_L * e) / L;
    const double of_room = -2 * of_L * e.dot(of_e) - L * of_e.squaredNorm();
    target.slip = block(b).mu * centre - change_[b].slip * room_change(b) - slip * of_room;
    target.turn = (slip * of_L / L - change_[b].slip) * of_e;
    return target;
  }

  /// Returns the fraction of the step after which the first slack or multiplier is 0; 1 if there is none.
  double longest_step() const {
    double part = 1;
    const auto keep = [&](double room, double change) {
      if (change < 0) part = std::min(part, -room / change);
    };
    for (std::size_t b = 0; b < size(); ++b) {
      const ContactBlock& of = block(b);
      if (has_lo(of)) keep(room_lo(of), normal_step(b)), keep(push_[b].lo, change_[b].lo);
      if (has_hi(of)) keep(room_hi(of), -normal_step(b)), keep(push_[b].hi, change_[b].hi);
      if (!rubs(of)) continue;
      keep(push_[b].slip, change_[b].slip);
      // L² - |λ_t|² = c + 2 b α + a α², which is positive at α = 0
      const Vec2 along = friction_step(b);
      const double L = limit(b), of_L = limit_rate(b) * normal_step(b), c = room(b) * L,
                   half_b = L * of_L - problem_.friction(of).dot(along), a = of_L * of_L - along.squaredNorm(),
                   discriminant = half_b * half_b - a * c;
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
    for (std::size_t b = 0; b < size(); ++b) {
      const ContactBlock& of = block(b);
      const double along = part * normal_step(b);
      if (has_lo(of)) add(b, (room_lo(of) + along) * (push_[b].lo + part * change_[b].lo));
      if (has_hi(of)) add(b, (room_hi(of) - along) * (push_[b].hi + part * change_[b].hi));
      if (!rubs(of)) continue;
      const double L = limit(b) + limit_rate(b) * along;
      const Vec2 friction = problem_.friction(of) + part * friction_step(b);
      add(b, (L * L - friction.squaredNorm()) / (L * of.mu) * (push_[b].slip + part * change_[b].slip));
    }
    return count > 0 ? sum / count : 0;
  }

  /// Returns λ, moved to a bound, or to the disc, where the multiplier exceeds the impulse that the slack would add [N
  /// s].
  std::vector<double> answer() const {
    std::vector<double> lambda = problem_.impulses();
    for (std::size_t b = 0; b < size(); ++b) {
      const ContactBlock& of = block(b);
      const Row<Dof>& row = normal(of);
      double& along_normal = lambda[of.row];
      if (has_lo(of) && push_[b].lo > row.diagonal * room_lo(of)) along_normal = row.lo;
      if (has_hi(of) && push_[b].hi > row.diagonal * room_hi(of)) along_normal = row.hi;
      if (!rubs(of)) continue;
      const Vec2 friction = problem_.friction(of);
      const double size = friction.norm(), to_edge = limit(b) - size;
      if (!(push_[b].slip * direction(b).norm() > of.s * to_edge)) continue;
      lambda[of.row + 1] = friction[0] * of.mu * along_normal / size;
      lambda[of.row + 2] = friction[1] * of.mu * along_normal / size;
    }
    problem_.project(lambda);
    return lambda;
  }

  /// Sets λ̄_n to λ_n; friction keeps its ratio to the limit.
  std::vector<double> with_new_limits(std::vector<double> lambda) {
    problem_.set_impulses(lambda);
    for (std::size_t b = 0; b < size(); ++b) {
      if (!rubs(block(b))) continue;
      const std::size_t k = block(b).row;
      const double before = limit(b);
      last_[b] += pace_ * (lambda[k] - last_[b]);
      const double ratio = limit(b) / before;
      lambda[k + 1] *= ratio, lambda[k + 2] *= ratio;
    }
    return lambda;
  }

  ConeProblem<Dof>& problem_;
  std::vector<double> theta_;  // θ of each block
  std::vector<double> last_;   // λ̄_n of each block [N s]
  bool lagged_;
  double pace_ = 1, first_try_ = 1e-3;
  std::vector<Push> push_, change_;
  std::vector<double> step_;  // Δλ of each row
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
