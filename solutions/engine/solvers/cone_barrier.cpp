#include "engine/solvers/cone_barrier.hpp"

#include <algorithm>
#include <cmath>

namespace spook {

template <int Dof>
ConeBarrier<Dof>::ConeBarrier(ConeProblem<Dof>& problem, double share, double w)
    : problem_(problem), push_(problem.blocks().size()) {
  for (const ContactBlock& of : problem.blocks()) theta_.push_back(std::min(1.0, share / of.mu));
  if (w > 0)
    start_near(w);
  else
    start_inside();
}

template <int Dof>
void ConeBarrier<Dof>::advance(double fraction, const std::vector<double>& step,
                               const std::vector<Push>& change) {
  std::vector<double> lambda = problem_.impulses();
  for (std::size_t k = 0; k < lambda.size(); ++k) lambda[k] += fraction * step[k];
  problem_.set_impulses(lambda);
  for (std::size_t b = 0; b < size(); ++b) {
    push_[b].lo += fraction * change[b].lo;
    push_[b].hi += fraction * change[b].hi;
    push_[b].slip += fraction * change[b].slip;
  }
}

template <int Dof>
double ConeBarrier<Dof>::limit(std::size_t b) const {
  const double now = normal(block(b)).lambda;
  return block(b).mu * (theta_[b] == 1 ? now : theta_[b] * now + (1 - theta_[b]) * last_[b]);
}

/// Returns R = L (1 - |e|²) of a point in the disc.
static double room_in(double L, const Vec2& friction) {
  const double t = friction.norm();
  return (L - t) * (L + t) / L;
}

template <int Dof>
double ConeBarrier<Dof>::room(std::size_t b) const {
  return room_in(limit(b), problem_.friction(block(b)));
}

template <int Dof>
bool ConeBarrier<Dof>::is_lagged() const {
  return std::any_of(theta_.begin(), theta_.end(), [](double theta) { return theta < 1; });
}

/// Returns the x > 0 with x (x - y) = w². So x - y is that of -y.
static double positive(double y, double w) {
  const double root = std::hypot(y, 2 * w);
  return y > 0 ? (root + y) / 2 : 2 * w * w / (root - y);
}

template <int Dof>
void ConeBarrier<Dof>::start_near(double w) {
  std::vector<double> lambda = problem_.impulses();
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
      push_[b].slip = of.mu * w * w / S / room_in(L, along);
    } else {
      along.setZero();
    }
    lambda[of.row + 1] = along[0], lambda[of.row + 2] = along[1];
  }
  problem_.set_impulses(lambda);
}

template <int Dof>
void ConeBarrier<Dof>::start_inside() {
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
  for (std::size_t b = 0; b < size(); ++b) {
    last_.push_back(normal(block(b)).lambda);
    const double r = problem_.row_residual(block(b).row);
    if (has_lo(block(b))) push_[b].lo = std::max(problem_.rhs_norm(), -r);
    if (has_hi(block(b))) push_[b].hi = std::max(problem_.rhs_norm(), r);
    if (rubs(block(b))) push_[b].slip = problem_.rhs_norm();
  }
}

template <int Dof>
std::vector<double> ConeBarrier<Dof>::answer() const {
  std::vector<double> lambda = problem_.impulses();
  for (std::size_t b = 0; b < size(); ++b) {
    const ContactBlock& of = block(b);
    const Row<Dof>& row = normal(of);
    double& along_normal = lambda[of.row];
    if (has_lo(of) && push_[b].lo > row.diagonal * room_lo(of)) along_normal = row.lo;
    if (has_hi(of) && push_[b].hi > row.diagonal * room_hi(of)) along_normal = row.hi;
    if (!rubs(of)) continue;
    const Vec2 along = problem_.friction(of);
    const double size = along.norm(), to_edge = limit(b) - size;
    if (!(push_[b].slip * direction(b).norm() > of.s * to_edge)) continue;
    lambda[of.row + 1] = along[0] * of.mu * along_normal / size;
    lambda[of.row + 2] = along[1] * of.mu * along_normal / size;
  }
  problem_.project(lambda);
  return lambda;
}

template <int Dof>
void ConeBarrier<Dof>::follow(double pace) {
  std::vector<double> lambda = problem_.impulses();
  for (std::size_t b = 0; b < size(); ++b) {
    if (!rubs(block(b))) continue;
    const std::size_t k = block(b).row;
    const double before = limit(b);
    last_[b] += pace * (lambda[k] - last_[b]);
    const double ratio = limit(b) / before;
    lambda[k + 1] *= ratio, lambda[k + 2] *= ratio;
  }
  problem_.set_impulses(lambda);
}

template class ConeBarrier<3>;
template class ConeBarrier<6>;

}  // namespace spook
