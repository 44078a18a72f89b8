#include "engine/constraints/soft_contacts.hpp"

#include <algorithm>
#include <cmath>

#include "09_better_friction/cone_rows.hpp"
#include "engine/support/larger.hpp"

namespace spook {

/// Returns the row of `row`, with 1/m by its linear parts: M⁻¹ Gᵀ is e/m there.
template <int Dof>
static PointRow<Dof> point_row(const Row<Dof>& row) {
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
          .lambda = row.lambda};
}

/// Returns u of the row [m/s].
template <int Dof>
static inline double speed(const PointRow<Dof>& row, const Twist<Dof>& Wi, const Twist<Dof>& Wj) {
  double u = row.e.dot(Wj.template head<3>() - Wi.template head<3>());
  if constexpr (Dof > 3) u += row.Ai.dot(Wi.template tail<3>()) + row.Aj.dot(Wj.template tail<3>());
  return u;
}

/// Adds M⁻¹ Gᵀ Δλ of the row to W.
template <int Dof>
static inline void push(const PointRow<Dof>& row, double delta, Twist<Dof>& Wi, Twist<Dof>& Wj) {
  const Vec3 impulse = delta * row.e;
  Wi.template head<3>() -= row.inverse_mass_i * impulse;
  Wj.template head<3>() += row.inverse_mass_j * impulse;
  if constexpr (Dof > 3) {
    Wi.template tail<3>() += delta * row.MinvAi;
    Wj.template tail<3>() += delta * row.MinvAj;
  }
}

/// Adds M⁻¹ Gᵀ Δλ of two rows of one contact to W, with one read and one write.
template <int Dof>
static inline void push(const PointRow<Dof>& row1, const PointRow<Dof>& row2, const Vec2& delta, Twist<Dof>& Wi,
                        Twist<Dof>& Wj) {
  const Vec3 impulse = delta[0] * row1.e + delta[1] * row2.e;
  Wi.template head<3>() -= row1.inverse_mass_i * impulse;
  Wj.template head<3>() += row1.inverse_mass_j * impulse;
  if constexpr (Dof > 3) {
    Wi.template tail<3>() += delta[0] * row1.MinvAi + delta[1] * row2.MinvAi;
    Wj.template tail<3>() += delta[0] * row1.MinvAj + delta[1] * row2.MinvAj;
  }
}

template <int Dof>
void SoftContacts<Dof>::assign(const std::vector<Contact>& contacts, const ConstraintSet<Dof>& constraints) {
  normals_.clear();
  friction_.clear();
  const std::vector<Row<Dof>>& rows = constraints.rows;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Row<Dof>& row = rows[constraints.normal_row(c)];
    const double S = rigid_diagonal(row);
    normals_.push_back({point_row(row), contacts[c].gap, S, 1 / S, false});
  }
  for (const FrictionContact& contact : constraints.friction) {
    const Row<Dof>&row1 = rows[contact.normal + 1], &row2 = rows[contact.normal + 2];
    const double s = stiffest_direction(row1, row2);
    friction_.push_back({point_row(row1), point_row(row2), s, 1 / s, row1.Sigma, contact.mu});
  }
}

template <int Dof>
void SoftContacts<Dof>::warm_start(std::vector<Twist<Dof>>& W) const {
  for (const Normal& normal : normals_)
    if (normal.row.lambda != 0) push(normal.row, normal.row.lambda, W[normal.row.i], W[normal.row.j]);
  for (const Friction& one : friction_) {
    const Vec2 lambda(one.row1.lambda, one.row2.lambda);
    if (!lambda.isZero(0)) push(one.row1, one.row2, lambda, W[one.row1.i], W[one.row1.j]);
  }
}

template <int Dof>
double SoftContacts<Dof>::sweep_friction(std::vector<Twist<Dof>>& W) {
  double largest = 0;
  for (std::size_t c = 0; c < friction_.size(); ++c) {
    Friction& one = friction_[c];
    const double radius = one.mu * normals_[c].row.lambda;
    const Vec2 before(one.row1.lambda, one.row2.lambda);
    if (radius == 0 && before.isZero(0)) continue;
    Twist<Dof>&Wi = W[one.row1.i], &Wj = W[one.row1.j];
    const Vec2 r = -Vec2(speed(one.row1, Wi, Wj), speed(one.row2, Wi, Wj)) - one.Sigma * before;
    const Vec2 after = onto_disc(before + one.mass * r, radius), change = after - before;  // Eq. (9.6)
    one.row1.lambda = after[0];
    one.row2.lambda = after[1];
    push(one.row1, one.row2, change, Wi, Wj);
    largest = larger(largest, one.s * change.norm());
  }
  return largest;
}

/// Updates the normal rows, by Eq. (10.21): `target(gap)` is w of a closed gap, and `softness` Σ/S.
template <int Dof>
template <class Target>
double SoftContacts<Dof>::sweep_normals(const Target& target, double softness, double h,
                                        std::vector<Twist<Dof>>& W) {
  const double mass_scale = 1 / (1 + softness), impulse_scale = softness / (1 + softness);
  double largest = 0;
  for (Normal& normal : normals_) {
    const bool open = normal.gap > 0;
    const double w = open ? -normal.gap / h : target(normal.gap);
    const double mass = open ? normal.mass : mass_scale * normal.mass, given_back = open ? 0 : impulse_scale;
    const double before = normal.row.lambda;
    Twist<Dof>&Wi = W[normal.row.i], &Wj = W[normal.row.j];
    const double change = mass * (w - speed(normal.row, Wi, Wj)) - given_back * before;
    normal.row.lambda = std::max(before + change, 0.0);
    const double delta = normal.row.lambda - before;
    if (delta == 0) continue;
    push(normal.row, delta, Wi, Wj);
    largest = larger(largest, (open ? 1 : 1 + softness) * normal.S * std::abs(delta));
  }
  return largest;
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
  for (Normal& normal : normals_) {
    normal.gap += h * speed(normal.row, W[normal.row.i], W[normal.row.j]);
    normal.pressed |= normal.row.lambda > 0;
  }
}

template <int Dof>
void SoftContacts<Dof>::return_rows(double h, ConstraintSet<Dof>& constraints) const {
  for (std::size_t c = 0; c < normals_.size(); ++c) {
    const Normal& normal = normals_[c];
    Row<Dof>* const of = &constraints.rows[constraints.normal_row(c)];
    of[0].lambda = normal.row.lambda;
    of[0].B = -std::max(normal.gap, 0.0) / h;
    of[0].Sigma = 0;
    of[0].diagonal = normal.S;
    if (friction_.empty()) continue;
    of[1].lambda = friction_[c].row1.lambda;
    of[2].lambda = friction_[c].row2.lambda;
  }
}

template class SoftContacts<3>;
template class SoftContacts<6>;

}  // namespace spook
