#include "scenes/andrews_squeezer.hpp"

#include <cmath>

namespace spook::squeezer {

using Closure = Eigen::Matrix<double, 6, 1>;
using Jacobian = Eigen::Matrix<double, 6, 7>;

Angles start() {
  Angles q;
  q << -0.0617138900142764496, 0, 0.455279819163070380, 0.222668390165885885, 0.487364979543842550,
      -0.222668390165885885, 1.23054744454982119;
  return q;
}

Angles of_bodies(const Angles& q) {
  Angles a;
  a << q[0], q[0] + q[1], q[2], q[4] + q[3], q[4], q[5] + q[6], q[6];
  return a;
}

static Vec3 at(double angle) {
  return {std::cos(angle), std::sin(angle), 0};
}
static Vec3 left_of(double angle) {
  return {-std::sin(angle), std::cos(angle), 0};
}

std::array<Vec3, 7> centres(const Angles& q) {
  const Angles a = of_bodies(q);
  const Vec3 A(xa, ya, 0), B(xb, yb, 0);
  return {ra * at(a[0]),
          rr * at(a[0]) - da * at(a[1]),
          B + sb * at(a[2]) + sa * Vec3(std::sin(a[2]), -std::cos(a[2]), 0),
          A + zt * at(a[4]) - (e - ea) * left_of(a[3]),
          A + ta * at(a[4]) + tb * left_of(a[4]),
          A - u * left_of(a[6]) + (zf - fa) * at(a[5]),
          A - ua * left_of(a[6]) - ub * at(a[6])};
}

Vec3 spring_end(double gamma) {
  return Vec3(xb, yb, 0) + sd * at(gamma) - sc * left_of(gamma);
}

Vec3 spring_force(const Vec3& D) {
  const Vec3 from_C = D - Vec3(xc, yc, 0);
  const double L = from_C.norm();
  return -c0 * (L - l0) / L * from_C;
}

Closure closure(const Angles& q) {
  const Angles a = of_bodies(q);
  const Vec3 E = rr * at(a[0]) - d * at(a[1]), A(xa, ya, 0);
  const Vec3 to_3 = E - Vec3(xb, yb, 0) + ss * left_of(a[2]);
  const Vec3 to_4 = E - A - zt * at(a[4]) + e * left_of(a[3]);
  const Vec3 to_6 = E - A - zf * at(a[5]) + u * left_of(a[6]);
  return (Closure() << to_3.head<2>(), to_4.head<2>(), to_6.head<2>()).finished();
}

/// The Jacobian of the closure: the rate of at(a) is left_of(a) a', and that of left_of(a) is -at(a) a'.
static Jacobian jacobian(const Angles& q) {
  const Angles a = of_bodies(q);
  const Vec3 dE_beta = rr * left_of(a[0]) - d * left_of(a[1]), dE_theta = -d * left_of(a[1]);
  Jacobian G = Jacobian::Zero();
  for (const int loop : {0, 2, 4}) {
    G.block<2, 1>(loop, 0) = dE_beta.head<2>();
    G.block<2, 1>(loop, 1) = dE_theta.head<2>();
  }
  G.block<2, 1>(0, 2) = -ss * at(a[2]).head<2>();
  G.block<2, 1>(2, 3) = -e * at(a[3]).head<2>();
  G.block<2, 1>(2, 4) = (-zt * left_of(a[4]) - e * at(a[3])).head<2>();
  G.block<2, 1>(4, 5) = -zf * left_of(a[5]).head<2>();
  G.block<2, 1>(4, 6) = (-zf * left_of(a[5]) - u * at(a[6])).head<2>();
  return G;
}

/// Returns -(dG/dt) q'.
static Closure gamma(const Angles& q, const Angles& v) {
  const Angles a = of_bodies(q), w = of_bodies(v), w2 = w.cwiseAbs2();
  const Vec3 E = -rr * w2[0] * at(a[0]) + d * w2[1] * at(a[1]);
  const Vec3 to_3 = E - ss * w2[2] * left_of(a[2]);
  const Vec3 to_4 = E + zt * w2[4] * at(a[4]) - e * w2[3] * left_of(a[3]);
  const Vec3 to_6 = E + zf * w2[5] * at(a[5]) - u * w2[6] * left_of(a[6]);
  return -(Closure() << to_3.head<2>(), to_4.head<2>(), to_6.head<2>()).finished();
}

static Eigen::Matrix<double, 7, 7> mass_matrix(const Angles& q) {
  const double cos_theta = std::cos(q[1]), sin_phi = std::sin(q[3]), sin_omega = std::sin(q[5]);
  const double e4 = e - ea, z6 = zf - fa;
  const auto& m = mass;
  const auto& I = inertia;
  Eigen::Matrix<double, 7, 7> M = Eigen::Matrix<double, 7, 7>::Zero();
  M(0, 0) = m[0] * ra * ra + m[1] * (rr * rr - 2 * da * rr * cos_theta + da * da) + I[0] + I[1];
  M(1, 0) = M(0, 1) = m[1] * (da * da - da * rr * cos_theta) + I[1];
  M(1, 1) = m[1] * da * da + I[1];
  M(2, 2) = m[2] * (sa * sa + sb * sb) + I[2];
  M(3, 3) = m[3] * e4 * e4 + I[3];
  M(4, 3) = M(3, 4) = m[3] * (e4 * e4 + zt * e4 * sin_phi) + I[3];
  M(4, 4) = m[3] * (zt * zt + 2 * zt * e4 * sin_phi + e4 * e4) + m[4] * (ta * ta + tb * tb) + I[3] + I[4];
  M(5, 5) = m[5] * z6 * z6 + I[5];
  M(6, 5) = M(5, 6) = m[5] * (z6 * z6 - u * z6 * sin_omega) + I[5];
  M(6, 6) = m[5] * (z6 * z6 - 2 * u * z6 * sin_omega + u * u) + m[6] * (ua * ua + ub * ub) + I[5] + I[6];
  return M;
}

static Angles forces(const Angles& q, const Angles& v) {
  const Vec3 D = spring_end(q[2]);
  const double e4 = e - ea, z6 = zf - fa;
  Angles f;
  f << drive - mass[1] * da * rr * v[1] * (v[1] + 2 * v[0]) * std::sin(q[1]),
      mass[1] * da * rr * v[0] * v[0] * std::sin(q[1]), (D - Vec3(xb, yb, 0)).cross(spring_force(D)).z(),
      mass[3] * zt * e4 * v[4] * v[4] * std::cos(q[3]),
      -mass[3] * zt * e4 * v[3] * (v[3] + 2 * v[4]) * std::cos(q[3]),
      -mass[5] * u * z6 * v[6] * v[6] * std::cos(q[5]),
      mass[5] * u * z6 * v[5] * (v[5] + 2 * v[6]) * std::cos(q[5]);
  return f;
}

State rate(const State& y) {
  const Angles q = y.head<7>(), v = y.tail<7>();
  Eigen::Matrix<double, 13, 13> A = Eigen::Matrix<double, 13, 13>::Zero();
  A.topLeftCorner<7, 7>() = mass_matrix(q);
  A.bottomLeftCorner<6, 7>() = jacobian(q);
  A.topRightCorner<7, 6>() = jacobian(q).transpose();
  Eigen::Matrix<double, 13, 1> right;
  right << forces(q, v), gamma(q, v);
  State rate;
  rate << v, A.fullPivLu().solve(right).head<7>();
  return rate;
}

State projected(const State& y) {
  State result = y;
  const auto least = [&](const Closure& lacking) -> Angles {
    const Jacobian G = jacobian(result.head<7>());
    return G.transpose() * (G * G.transpose()).ldlt().solve(lacking);
  };
  for (int n = 0; n < 3; ++n) result.head<7>() -= least(closure(result.head<7>()));
  result.tail<7>() -= least(jacobian(result.head<7>()) * result.tail<7>());
  return result;
}

}  // namespace spook::squeezer
