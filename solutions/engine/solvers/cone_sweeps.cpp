#include "engine/solvers/cone_sweeps.hpp"

#include <algorithm>
#include <cmath>

#include "09_better_friction/cone_rows.hpp"
#include "engine/support/larger.hpp"

namespace spook {

namespace {

template <int Dof>
ConeBlock<Dof> block_of(const FrictionContact& contact, const std::vector<Row<Dof>>& rows) {
  const Row<Dof>* of = &rows[contact.normal];
  ConeBlock<Dof> block;
  block.i = of->i, block.j = of->j;
  for (int k = 0; k < 3; ++k) {
    block.E.col(k) = of[k].Gj.template head<3>();
    block.Ai.col(k) = of[k].Gi.template tail<Dof - 3>();
    block.Aj.col(k) = of[k].Gj.template tail<Dof - 3>();
    block.B[k] = of[k].B;
    block.Sigma[k] = of[k].Sigma;
    block.lambda[k] = of[k].lambda;
  }
  for (int k = 1; k < 3; ++k) block.S_tn[k - 1] = of[k].Gi.dot(of->MinvGi) + of[k].Gj.dot(of->MinvGj);
  block.S_nn = of->diagonal;
  block.s = stiffest_direction(of[1], of[2]);
  block.mass_n = 1 / block.S_nn;
  block.mass_t = 1 / block.s;
  block.mu = contact.mu;
  return block;
}

/// Adds M⁻¹ Gᵀ Δλ of the three rows to V.
template <int Dof>
inline void push(const ConeBlock<Dof>& block, const Vec3& delta,
                 const std::vector<InverseMass<Dof>>& inverse_mass, std::vector<Twist<Dof>>& V) {
  const Vec3 impulse = block.E * delta;
  Twist<Dof>&Vi = V[block.i], &Vj = V[block.j];
  const InverseMass<Dof>&of_i = inverse_mass[block.i], &of_j = inverse_mass[block.j];
  Vi.template head<3>() -= of_i.linear * impulse;
  Vj.template head<3>() += of_j.linear * impulse;
  if constexpr (Dof > 3) {
    const Vec3 torque_i = block.Ai * delta, torque_j = block.Aj * delta;
    Vi.template tail<3>() += of_i.angular * torque_i;
    Vj.template tail<3>() += of_j.angular * torque_j;
  }
}

/// Updates the three rows. Returns the larger of S_nn |Δλ_n| and s |Δλ_t| [m/s], or NaN.
template <int Dof>
inline double update(ConeBlock<Dof>& block, const std::vector<InverseMass<Dof>>& inverse_mass,
                     std::vector<Twist<Dof>>& V) {
  const Twist<Dof>&Vi = V[block.i], &Vj = V[block.j];
  const Vec3 apart = Vj.template head<3>() - Vi.template head<3>();
  Vec3 u = block.E.transpose() * apart;
  if constexpr (Dof > 3) {
    u.noalias() += block.Ai.transpose() * Vi.template tail<3>();
    u.noalias() += block.Aj.transpose() * Vj.template tail<3>();
  }
  const Vec3 before = block.lambda, r = block.B - u - block.Sigma.cwiseProduct(before);  // Eq. (4.6)

  const double normal = std::max(before[0] + block.mass_n * r[0], 0.0),
               delta = normal - before[0];  // Eq. (4.7)
  const Vec2 wanted(before[1] + block.mass_t * (r[1] - block.S_tn[0] * delta),
                    before[2] + block.mass_t * (r[2] - block.S_tn[1] * delta));
  const double limit = block.mu * normal;
  // A contact that sticks needs no square root.
  const bool sticks = wanted.squaredNorm() <= limit * limit;
  const Vec2 along = sticks ? wanted : onto_disc(wanted, limit);  // Eq. (9.6)

  block.lambda = Vec3(normal, along[0], along[1]);
  const Vec3 change = block.lambda - before;
  push(block, change, inverse_mass, V);
  return larger(block.S_nn * std::abs(change[0]), block.s * change.template tail<2>().norm());
}

}  // namespace

template <int Dof>
ConeSweeps<Dof>::ConeSweeps(const std::vector<FrictionContact>& contacts, std::vector<Row<Dof>>& rows,
                            std::vector<Twist<Dof>>& V, const std::vector<InverseMass<Dof>>& inverse_mass)
    : rows_(rows), V_(V), inverse_mass_(inverse_mass), weights_(std::ssize(rows)) {
  auto contact = contacts.begin();
  blocks_.reserve(contacts.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    weights_[k] = std::sqrt(rows[k].diagonal);
    if (contact == contacts.end() || k < contact->normal) {
      others_.push_back(k);
    } else if (k == contact->normal + 2) {
      blocks_.push_back(block_of(*contact, rows));
      normals_.push_back(contact++->normal);
    }
  }
}

template <int Dof>
double ConeSweeps<Dof>::sweep() {
  double largest = 0;
  for (const std::size_t k : others_)
    largest = larger(largest, rows_[k].diagonal * std::abs(update_row(rows_[k], V_)));
  for (ConeBlock<Dof>& block : blocks_) largest = larger(largest, update(block, inverse_mass_, V_));
  return largest;
}

template <int Dof>
Eigen::VectorXd ConeSweeps<Dof>::scaled_impulses() const {
  Eigen::VectorXd all(weights_.size());
  for (const std::size_t k : others_) all[k] = weights_[k] * rows_[k].lambda;
  for (std::size_t c = 0; c < blocks_.size(); ++c)
    all.template segment<3>(normals_[c]) =
        weights_.template segment<3>(normals_[c]).cwiseProduct(blocks_[c].lambda);
  return all;
}

template <int Dof>
void ConeSweeps<Dof>::start_from(const Eigen::VectorXd& impulses) {
  std::fill(V_.begin(), V_.end(), Twist<Dof>::Zero());
  for (const std::size_t k : others_) {
    Row<Dof>& row = rows_[k];
    row.lambda = std::clamp(impulses[k] / weights_[k], row.lo, row.hi);
    apply_impulse(row, row.lambda, V_);
  }
  for (std::size_t c = 0; c < blocks_.size(); ++c) {
    ConeBlock<Dof>& block = blocks_[c];
    const Vec3 lambda =
        impulses.template segment<3>(normals_[c]).cwiseQuotient(weights_.template segment<3>(normals_[c]));
    const double normal = std::max(lambda[0], 0.0);
    const Vec2 along = onto_disc({lambda[1], lambda[2]}, block.mu * normal);
    block.lambda = Vec3(normal, along[0], along[1]);
    push(block, block.lambda, inverse_mass_, V_);
  }
}

template <int Dof>
void ConeSweeps<Dof>::write_back() const {
  for (std::size_t c = 0; c < blocks_.size(); ++c)
    for (int k = 0; k < 3; ++k) rows_[normals_[c] + k].lambda = blocks_[c].lambda[k];
}

template class ConeSweeps<3>;
template class ConeSweeps<6>;

}  // namespace spook
