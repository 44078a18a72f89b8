// Operator splitting: alternates between the rows without bounds and the bounds without rows.
//
//   x   (S + R) x = B + R (z - u)                    by factors of M + Gᵀ (Σ + R)⁻¹ G, computed once, Eq. (11.15)
//   z   the projection of 1.6 x - 0.6 z + u on the bounds, or on Coulomb's cone
//   u   the sum of the differences of x and z; R u converges to the residual of the rows
//
//   R   ρ S_kk, equal for the rows of a contact. ρ grows while x and z differ, and shrinks while z changes, by the
//       root of their ratio. A new ρ needs new factors, so it changes at most in every tenth iteration
//   cone: adding μ |u_t| to the normal right-hand side (De Saxcé's change of variables) makes z a projection on a cone
//
//   B. Stellato, G. Banjac, P. Goulart, A. Bemporad, S. Boyd, OSQP: an operator splitting solver for quadratic programs,
//   Math. Program. Comput. 12 (2020).
//   J. Carpentier, Q. Le Lidec, L. Montaut, From compliant to rigid contact simulation: a unified and efficient approach,
//   Robotics: Science and Systems (2024).
#include <algorithm>
#include <cmath>

#include "engine/linear/velocity_system.hpp"
#include "methods/methods.hpp"

namespace spook::plots {

namespace {

/// Returns the nearest (n, t) with |t| <= μ n.
Vec3 onto_cone(const Vec3& point, double mu) {
  const double n = point[0], t = point.tail<2>().norm();
  if (t <= mu * n) return point;
  if (mu * t <= -n) return Vec3::Zero();
  const double nearest = (n + mu * t) / (1 + mu * mu);
  return {nearest, mu * nearest / t * point[1], mu * nearest / t * point[2]};
}

template <int Dof>
class Splitting {
 public:
  Splitting(const SolverInput<Dof>& s, bool on_cones)
      : s_(s), on_cones_(on_cones), on_(s.rows(), s.bodies.motion.inverse_mass), scale_(std::ssize(s.rows())) {
    for (Eigen::Index k = 0; k < scale_.size(); ++k) scale_[k] = s.rows()[k].diagonal;
    if (on_cones)
      for (const FrictionContact& contact : s.constraints.friction) {
        const auto first = static_cast<Eigen::Index>(contact.normal);
        scale_.segment<3>(first).setConstant(scale_.segment<3>(first).maxCoeff());
      }
    z_ = u_ = Vector::Zero(scale_.size());
    for (Eigen::Index k = 0; k < z_.size(); ++k) z_[k] = s.rows()[k].lambda;
    factorise_anew();
  }

  /// Returns the larger of the difference of x and z and the change of z, as a velocity [m/s].
  double iterate() {
    const Vector x = unbounded(), before = z_;
    const Vector relaxed = 1.6 * x - 0.6 * z_ + u_;
    z_ = allowed(relaxed);
    u_ = relaxed - z_;
    const double apart = scale_.cwiseProduct(x - z_).cwiseAbs().maxCoeff();
    const double moved = rho_ * scale_.cwiseProduct(z_ - before).cwiseAbs().maxCoeff();
    work_ += (4 * Dof + 8) * static_cast<double>(z_.size()) + solve_work(factors_);
    if (++since_ >= 10 && apart > 0 && moved > 0) {
      const double ratio = std::sqrt(apart / moved);
      if (ratio > 5 || ratio < 0.2) change_rho(ratio);
    }
    return std::max(apart, moved);
  }

  void finish() const {
    std::fill(s_.V.begin(), s_.V.end(), Twist<Dof>::Zero());
    for (std::size_t k = 0; k < s_.rows().size(); ++k) {
      s_.rows()[k].lambda = z_[static_cast<Eigen::Index>(k)];
      apply_impulse(s_.rows()[k], s_.rows()[k].lambda, s_.V);
    }
  }
  double work() const { return work_; }

 private:
  void factorise_anew() {
    stiffness_.resize(scale_.size());
    for (Eigen::Index k = 0; k < scale_.size(); ++k)
      stiffness_[k] = 1 / (s_.rows()[k].Sigma + rho_ * scale_[k]);
    factorise(on_.matrix(s_.rows(), stiffness_), factors_);
    work_ += factor_work(factors_) + 3.0 * Dof * Dof * static_cast<double>(scale_.size());
    since_ = 0;
  }
  void change_rho(double ratio) {
    const double next = std::clamp(rho_ * ratio, 1e-6, 1e3);
    u_ *= rho_ / next;
    rho_ = next;
    factorise_anew();
  }

  Vector unbounded() const {
    Vector q = rho_ * scale_.cwiseProduct(z_ - u_);
    for (Eigen::Index k = 0; k < q.size(); ++k) q[k] += s_.rows()[k].B;
    if (on_cones_)
      for (const FrictionContact& contact : s_.constraints.friction) {
        const auto n = static_cast<Eigen::Index>(contact.normal);
        q[n] -= contact.mu * rho_ * scale_[n] * u_.segment<2>(n + 1).norm();
      }
    Vector right = Vector::Zero(on_.size());
    for (Eigen::Index k = 0; k < q.size(); ++k) on_.scatter(s_.rows()[k], stiffness_[k] * q[k], right);
    const Vector v = factors_.ldlt.solve(right);
    for (Eigen::Index k = 0; k < q.size(); ++k) q[k] = stiffness_[k] * (q[k] - on_.gather(s_.rows()[k], v));
    return q;
  }

  Vector allowed(const Vector& x) const {
    Vector nearest = x;
    for (Eigen::Index k = 0; k < x.size(); ++k) nearest[k] = std::clamp(x[k], s_.rows()[k].lo, s_.rows()[k].hi);
    if (on_cones_)
      for (const FrictionContact& contact : s_.constraints.friction) {
        const auto n = static_cast<Eigen::Index>(contact.normal);
        nearest.segment<3>(n) = onto_cone(x.segment<3>(n), contact.mu);
      }
    return nearest;
  }

  const SolverInput<Dof>& s_;
  bool on_cones_;
  VelocitySystem<Dof> on_;
  Factors factors_;
  Vector scale_, stiffness_, z_, u_;
  double rho_ = 0.1, work_ = 0;
  int since_ = 0;
};

}  // namespace

template <int Dof>
Solver<Dof> admm(FrictionModel model) {
  const bool on_cones = model == FrictionModel::cone;
  return {.solve =
              [on_cones](const SolverInput<Dof>& s) {
                Splitting<Dof> splitting(s, on_cones);
                SolveReport report;
                while (!report.converged && std::ssize(report.history) < s.stop.max_sweeps) {
                  report.history.push_back(splitting.iterate());
                  report.converged = report.history.back() <= s.stop.tolerance;
                }
                splitting.finish();
                SolverResult result(std::move(report));
                result.row_updates = std::llround(splitting.work() / update_work<Dof>);
                return result;
              },
          .friction = on_cones ? FrictionModel::cone : FrictionModel::box};
}

template Solver<3> admm<3>(FrictionModel);
template Solver<6> admm<6>(FrictionModel);

}  // namespace spook::plots
