#include "engine/constraints/soft_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "09_better_friction/cone_rows.hpp"
#include "14_fast_rows/fast_rows.hpp"
#include "engine/support/larger.hpp"
#include "engine/support/parallel_for.hpp"

namespace spook {

/// Returns the row of `row` with an impulse [N s], and 1/m by its linear parts: M⁻¹ Gᵀ is e/m there.
template <int Dof>
static PointRow<Dof> point_row(const Row<Dof>& row, double lambda) {
  const Vec3 e = row.Gj.template head<3>();
  return {.i = row.i,
          .j = row.j,
          .e = e,
          .inverse_mass_i = -e.dot(row.MinvGi.template head<3>()),
          .inverse_mass_j = e.dot(row.MinvGj.template head<3>()),
          .Ai = row.Gi.template tail<Dof - 3>(),
          .Aj = row.Gj.template tail<Dof - 3>(),
          .MinvAi = row.MinvGi.template tail<Dof - 3>(),
          .MinvAj = row.MinvGj.template tail<Dof - 3>(),
          .lambda = lambda};
}

/// Returns u of the row [m/s].
template <int Dof>
static inline double speed(const PointRow<Dof>& row, const Twist<Dof>& Wi, const Twist<Dof>& Wj) {
  double u = row.e.dot(Wj.template head<3>() - Wi.template head<3>());
  if constexpr (Dof > 3) u += row.Ai.dot(Wi.template tail<3>()) + row.Aj.dot(Wj.template tail<3>());
  return u;
}

/// Adds M⁻¹ Gᵀ Δλ to W, for the forces e Δλ and torques A Δλ of rows that share `row`'s bodies. Does not write to
/// static bodies, which stripes share.
template <int Dof>
static inline void push(const PointRow<Dof>& row, const Vec3& impulse,
                        const Eigen::Matrix<double, Dof - 3, 1>& turn_i,
                        const Eigen::Matrix<double, Dof - 3, 1>& turn_j, Twist<Dof>& Wi, Twist<Dof>& Wj) {
  if (row.inverse_mass_i != 0) {
    Wi.template head<3>() -= row.inverse_mass_i * impulse;
    if constexpr (Dof > 3) Wi.template tail<3>() += turn_i;
  }
  if (row.inverse_mass_j != 0) {
    Wj.template head<3>() += row.inverse_mass_j * impulse;
    if constexpr (Dof > 3) Wj.template tail<3>() += turn_j;
  }
}

/// Adds M⁻¹ Gᵀ Δλ of the row to W.
template <int Dof>
static inline void push(const PointRow<Dof>& row, double delta, Twist<Dof>& Wi, Twist<Dof>& Wj) {
  push<Dof>(row, delta * row.e, delta * row.MinvAi, delta * row.MinvAj, Wi, Wj);
}

/// Adds M⁻¹ Gᵀ Δλ of two rows of one contact to W, with one read and one write.
template <int Dof>
static inline void push(const PointRow<Dof>& row1, const PointRow<Dof>& row2, const Vec2& delta, Twist<Dof>& Wi,
                        Twist<Dof>& Wj) {
  push<Dof>(row1, delta[0] * row1.e + delta[1] * row2.e, delta[0] * row1.MinvAi + delta[1] * row2.MinvAi,
            delta[0] * row1.MinvAj + delta[1] * row2.MinvAj, Wi, Wj);
}

template <int Dof>
void SoftContacts<Dof>::assign(const std::vector<Contact>& contacts, const ConstraintSet<Dof>& constraints,
                               const std::vector<double>& impulses, Stripes stripes, int threads) {
  stripes_ = std::move(stripes);
  threads_ = threads;
  normals_.resize(contacts.size());
  friction_.resize(constraints.friction.size());
  const auto row_at = [&](std::size_t k) {
    return point_row(constraints.rows[k], impulses.empty() ? 0 : impulses[k]);
  };
  parallel_for(threads_, contacts.size(), [&](std::size_t, std::size_t c, std::size_t end) {
    for (; c < end; ++c) {
      const std::size_t k = constraints.normal_row(c);
      const Row<Dof>* const rows = &constraints.rows[k];
      const double S = rigid_diagonal(rows[0]);
      normals_[c] = {row_at(k), contacts[c].gap, S, 1 / S, false};
      if (friction_.empty()) continue;
      const double s = stiffest_direction(rows[1], rows[2]);
      friction_[c] = {row_at(k + 1), row_at(k + 2), s, 1 / s, rows[1].Sigma, constraints.friction[c].mu};
    }
  });
}

template <int Dof>
template <class Update>
double SoftContacts<Dof>::sweep(const Update& update) {
  double most = 0;
  if (stripes_.empty()) {
    for (std::size_t c = 0; c < normals_.size(); ++c) most = larger(most, update(c));
    return most;
  }
  const int rounds = rounds_of(stripes_), threads = threads_for(stripes_, normals_.size(), threads_);
  std::vector<double> largest(stripes_.size(), 0);
  int round = 0;
  const auto work = [&](int thread) {
    sweep_in_round(round, thread, threads, stripes_, [&](int stripe) {
      double of_stripe = 0;
      for (const int c : stripes_[stripe]) of_stripe = larger(of_stripe, update(static_cast<std::size_t>(c)));
      largest[stripe] = of_stripe;
    });
  };
  in_rounds(threads, work, [&] { return ++round < rounds; });
  for (const double of_stripe : largest) most = larger(most, of_stripe);
  return most;
}

template <int Dof>
void SoftContacts<Dof>::warm_start(std::vector<Twist<Dof>>& W) {
  sweep([&](std::size_t c) {
    const PointRow<Dof>& normal = normals_[c].row;
    if (normal.lambda != 0) push(normal, normal.lambda, W[normal.i], W[normal.j]);
    if (friction_.empty()) return 0.0;
    const auto& [row1, row2, s, mass, Sigma, mu] = friction_[c];
    const Vec2 lambda(row1.lambda, row2.lambda);
    if (!lambda.isZero(0)) push(row1, row2, lambda, W[row1.i], W[row1.j]);
    return 0.0;
  });
}

template <int Dof>
double SoftContacts<Dof>::sweep_friction(std::vector<Twist<Dof>>& W) {
  if (friction_.empty()) return 0;
  return sweep([&](std::size_t c) {
    Friction& one = friction_[c];
    const double radius = one.mu * normals_[c].row.lambda;
    const Vec2 before(one.row1.lambda, one.row2.lambda);
    if (radius == 0 && before.isZero(0)) return 0.0;
    Twist<Dof>&Wi = W[one.row1.i], &Wj = W[one.row1.j];
    const Vec2 r = -Vec2(speed(one.row1, Wi, Wj), speed(one.row2, Wi, Wj)) - one.Sigma * before;
    const Vec2 after = onto_disc(before + one.mass * r, radius), change = after - before;  // Eq. (9.6)
    one.row1.lambda = after[0];
    one.row2.lambda = after[1];
    push(one.row1, one.row2, change, Wi, Wj);
    return one.s * change.norm();
  });
}

/// Updates the normal rows, by Eq. (10.21): `target(gap)` is w of a closed gap, and `softness` Σ/S.
template <int Dof>
template <class Target>
double SoftContacts<Dof>::sweep_normals(const Target& target, double softness, double h,
                                        std::vector<Twist<Dof>>& W) {
  const double mass_scale = 1 / (1 + softness), impulse_scale = softness / (1 + softness);
  return sweep([&](std::size_t c) {
    Normal& normal = normals_[c];
    const bool open = normal.gap > 0;
    const double w = open ? -normal.gap / h : target(normal.gap);
    const double mass = open ? normal.mass : mass_scale * normal.mass, given_back = open ? 0 : impulse_scale;
    const double before = normal.row.lambda;
    Twist<Dof>&Wi = W[normal.row.i], &Wj = W[normal.row.j];
    const double change = mass * (w - speed(normal.row, Wi, Wj)) - given_back * before;
    normal.row.lambda = std::max(before + change, 0.0);
    const double delta = normal.row.lambda - before;
    if (delta == 0) return 0.0;
    push(normal.row, delta, Wi, Wj);
    return (open ? 1 : 1 + softness) * normal.S * std::abs(delta);
  });
}

template <int Dof>
double SoftContacts<Dof>::sweep_soft(const SoftSpring& spring, double closing_speed, double h,
                                     std::vector<Twist<Dof>>& W) {
  const double a = spring.closed_part() / h;
  return sweep_normals([&](double gap) { return std::min(-a * gap, closing_speed); }, spring.softness(), h, W);
}

template <int Dof>
double SoftContacts<Dof>::sweep_rigid(double h, std::vector<Twist<Dof>>& W) {
  return sweep_normals([](double) { return 0.0; }, 0, h, W);
}

template <int Dof>
void SoftContacts<Dof>::move_gaps(double h, const std::vector<Twist<Dof>>& W) {
  parallel_for(threads_, normals_.size(), [&](std::size_t, std::size_t c, std::size_t end) {
    for (; c < end; ++c) {
      Normal& normal = normals_[c];
      normal.gap += h * speed(normal.row, W[normal.row.i], W[normal.row.j]);
      normal.pressed |= normal.row.lambda > 0;
    }
  });
}

template <int Dof>
void SoftContacts<Dof>::return_rows(double h, ConstraintSet<Dof>& constraints) const {
  parallel_for(threads_, normals_.size(), [&](std::size_t, std::size_t c, std::size_t end) {
    for (; c < end; ++c) {
      const Normal& normal = normals_[c];
      Row<Dof>* const of = &constraints.rows[constraints.normal_row(c)];
      of[0].lambda = normal.row.lambda;
      of[0].B = -std::max(normal.gap, 0.0) / h;
      of[0].Sigma = 0;
      of[0].diagonal = normal.S;
      if (friction_.empty()) continue;
      of[1].lambda = friction_[c].row1.lambda;
      of[2].lambda = friction_[c].row2.lambda;
      of[1].B = of[2].B = 0;
    }
  });
}

template class SoftContacts<3>;
template class SoftContacts<6>;

}  // namespace spook
