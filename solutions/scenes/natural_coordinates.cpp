#include "scenes/natural_coordinates.hpp"

namespace spook {

/// Returns the least-squares solution x of A x = right of the smallest norm, where rows of A may be redundant.
static Eigen::VectorXd least(const Eigen::MatrixXd& A, const Eigen::VectorXd& right) {
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> factors;
  factors.setThreshold(1e-9);
  return factors.compute(A).solve(right);
}

NaturalCoordinates::Place NaturalCoordinates::add(const Vec3& x, const Vec3& v) {
  start_.push_back(x);
  start_velocity_.push_back(v);
  M_.conservativeResizeLike(Eigen::MatrixXd::Zero(numbers(), numbers()));
  weight_.conservativeResizeLike(Vector::Zero(numbers()));
  return {.moving = static_cast<int>(start_.size()) - 1};
}

Vec3 NaturalCoordinates::difference(const Place& a, const Place& b, const Vector& y, bool velocity) const {
  const auto of = [&](const Place& place) -> Vec3 {
    if (place.moving < 0) return velocity ? Vec3::Zero() : place.fixed;
    return y.segment<3>(3 * place.moving + (velocity ? numbers() : 0));
  };
  return of(a) - of(b);
}

void NaturalCoordinates::hold(const Place& a, const Place& b, const Place& c, const Place& d) {
  const Vector y = start();
  constraints_.push_back({a, b, c, d, difference(a, b, y, false).dot(difference(c, d, y, false))});
}

/// Adds the energy ½ m |a' - b'|².
void NaturalCoordinates::add_mass(const Place& a, const Place& b, double mass) {
  for (const auto& [k, sign_k] : {std::pair(a.moving, 1), std::pair(b.moving, -1)})
    for (const auto& [l, sign_l] : {std::pair(a.moving, 1), std::pair(b.moving, -1)})
      if (k >= 0 && l >= 0) M_.block<3, 3>(3 * k, 3 * l) += sign_k * sign_l * mass * Mat3::Identity();
}

void NaturalCoordinates::add_rod(const Place& a, const Place& b, double mass, const Vec3& gravity) {
  // ½ m |(a' + b')/2|² + ½ (m/12) |a' - b'|² = ½ (m/6) (|a'|² + |b'|² + a'·b')
  const Place nothing = fixed(Vec3::Zero());
  add_mass(a, nothing, mass / 2);
  add_mass(b, nothing, mass / 2);
  add_mass(a, b, mass / 12 - mass / 4);
  for (const Place& end : {a, b})
    if (end.moving >= 0)
      weight_.segment<3>(3 * end.moving) += mass / 2 * gravity;
    else
      energy_of_fixed_ -= mass / 2 * gravity.dot(end.fixed);
}

void NaturalCoordinates::add_second_moment(const Place& unit, double moment) {
  add_mass(unit, fixed(Vec3::Zero()), moment);
}

NaturalCoordinates::Vector NaturalCoordinates::start() const {
  Vector y(2 * numbers());
  for (std::size_t n = 0; n < start_.size(); ++n) {
    y.segment<3>(3 * static_cast<Eigen::Index>(n)) = start_[n];
    y.segment<3>(numbers() + 3 * static_cast<Eigen::Index>(n)) = start_velocity_[n];
  }
  return y;
}

NaturalCoordinates::Vector NaturalCoordinates::gaps(const Vector& y) const {
  Vector gaps(constraints_.size());
  for (std::size_t n = 0; n < constraints_.size(); ++n) {
    const Constraint& h = constraints_[n];
    gaps[static_cast<Eigen::Index>(n)] =
        difference(h.a, h.b, y, false).dot(difference(h.c, h.d, y, false)) - h.value;
  }
  return gaps;
}

Eigen::MatrixXd NaturalCoordinates::jacobian(const Vector& y) const {
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(constraints_.size()), numbers());
  for (std::size_t n = 0; n < constraints_.size(); ++n) {
    const Constraint& h = constraints_[n];
    const Vec3 ab = difference(h.a, h.b, y, false), cd = difference(h.c, h.d, y, false);
    const auto add = [&](const Place& place, const Vec3& by) {
      if (place.moving >= 0) G.block<1, 3>(static_cast<Eigen::Index>(n), 3 * place.moving) += by.transpose();
    };
    add(h.a, cd), add(h.b, -cd), add(h.c, ab), add(h.d, -ab);
  }
  return G;
}

NaturalCoordinates::Vector NaturalCoordinates::rate(const Vector& y) const {
  const Eigen::MatrixXd G = jacobian(y);
  Vector gamma(constraints_.size());
  for (std::size_t n = 0; n < constraints_.size(); ++n) {
    const Constraint& h = constraints_[n];
    gamma[static_cast<Eigen::Index>(n)] = -2 * difference(h.a, h.b, y, true).dot(difference(h.c, h.d, y, true));
  }
  // G M⁻¹ Gᵀ μ = G M⁻¹ Q - γ, with the smallest μ if rows are redundant.
  const Eigen::LLT<Eigen::MatrixXd> mass(M_);
  const Eigen::MatrixXd MinvGt = mass.solve(G.transpose());
  const Vector free = mass.solve(weight_);
  const Vector mu = least(G * MinvGt, G * free - gamma);
  Vector rate(y.size());
  rate << y.tail(numbers()), free - MinvGt * mu;
  return rate;
}

NaturalCoordinates::Vector NaturalCoordinates::projected(const Vector& y) const {
  Vector result = y;
  for (int n = 0; n < 3; ++n) result.head(numbers()) -= least(jacobian(result), gaps(result));
  const Eigen::MatrixXd G = jacobian(result);
  result.tail(numbers()) -= least(G, G * result.tail(numbers()));
  return result;
}

double NaturalCoordinates::energy(const Vector& y) const {
  const Vector v = y.tail(numbers());
  return v.dot(M_ * v) / 2 - weight_.dot(y.head(numbers())) + energy_of_fixed_;
}

}  // namespace spook
