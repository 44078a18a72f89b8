#include "systems.hpp"

#include "05_friction_box/friction_box.hpp"

namespace spook::testing {

System<6> random_system(Random& random, int bodies, int rows) {
  System<6> s;
  for (int body = 0; body < bodies; ++body) {
    s.motion.inverse_mass.push_back(body == 0 ? InverseMass<6>{} : random_body(random));
    s.motion.W.push_back(random.twist());
    s.motion.Wf.push_back(random.twist(0.3));
    if (body == 0) s.motion.W[0].setZero(), s.motion.Wf[0].setZero();
    s.V.push_back(Twist<6>::Zero());
  }
  for (int k = 0; k < rows; ++k) {
    const int i = random.integer(0, bodies - 1), j = (i + random.integer(1, bodies - 1)) % bodies;
    const ContactJacobian G = contact_jacobian(
        {.i = i, .j = j, .n = random.unit_vector(), .gap = 0, .r_i = random.vector(), .r_j = random.vector()});
    const SpookParameters spook{
        .a = random.uniform(1, 10), .b = random.uniform(0.5, 1), .Sigma = random.uniform(0.05, 0.2)};
    s.add({.i = i,
           .j = j,
           .Gi = G.Gi,
           .Gj = G.Gj,
           .gap = random.uniform(-0.1, 0.1),
           .spook = spook,
           .lo = -infinity,
           .hi = infinity});
  }
  return s;
}

void add_random_bounds(Random& random, std::vector<Row<6>>& rows) {
  for (Row<6>& row : rows) {
    const int kind = random.integer(0, 3);
    if (kind & 1) row.lo = random.uniform(-0.3, 0.1);
    if (kind & 2) row.hi = random.uniform(0.11, 0.5);
    if (std::abs(row.lo) < 0.04) row.lo = 0;
    if (row.hi > 0.43 && row.hi < infinity && row.lo < -0.05) row.hi = 0;
  }
}

System<3> HangingWire::system() const {
  System<3> s;
  const Twist<3> down(0, 0, -1);
  s.add(0, Twist<3>::Zero());
  for (int point = 1; point <= links; ++point) s.add(1 / mass(point), h * g * down);
  for (int link = 0; link < links; ++link)
    s.add({.i = link,
           .j = link + 1,
           .Gi = -down,
           .Gj = down,
           .gap = tension(link) / k,
           .spook = spook_parameters(h, k, d),
           .lo = -infinity,
           .hi = infinity});
  return s;
}

System<3> star(Random& random, int points) {
  System<3> s;
  s.add(1, Twist<3>::Zero());
  for (int point = 1; point <= points; ++point) {
    const double mass = random.uniform(0.5, 2);
    s.add(1 / mass, random.vector());
    const Vec3 n = random.unit_vector();
    s.add({.i = 0,
           .j = point,
           .Gi = -n,
           .Gj = n,
           .gap = random.uniform(-0.1, 0.1),
           .spook = {.a = 5, .b = 0.8, .Sigma = 0.1},
           .lo = -infinity,
           .hi = infinity});
  }
  return s;
}

System<6> box_tower(int boxes, double h, double mu, const Vec3& slide) {
  constexpr double g = 9.81;
  System<6> s;
  for (int body = 0; body <= boxes; ++body) {
    s.motion.inverse_mass.push_back(body == 0 ? InverseMass<6>{}
                                              : InverseMass<6>{.linear = 1, .angular = 6 * Mat3::Identity()});
    const double moves = body == 0 ? 0 : 1;
    s.motion.W.push_back((Twist<6>() << moves * slide, 0, 0, 0).finished());
    s.motion.Wf.push_back((Twist<6>() << 0, 0, -moves * h * g, 0, 0, 0).finished());
    s.V.push_back(Twist<6>::Zero());
  }
  const SpookParameters normal{.a = 0, .b = 1, .Sigma = 1e-8};
  const SpookParameters friction{.a = 0, .b = 1, .Sigma = 1e-10};
  for (int below = 0; below < boxes; ++below)
    for (const double x : {-0.5, 0.5})
      for (const double y : {-0.5, 0.5}) {
        const Contact contact{.i = below,
                              .j = below + 1,
                              .n = Vec3(0, 0, 1),
                              .gap = 0,
                              .r_i = Vec3(x, y, 0.5),
                              .r_j = Vec3(x, y, -0.5)};
        const ContactJacobian G = contact_jacobian(contact);
        s.add({.i = below, .j = below + 1, .Gi = G.Gi, .Gj = G.Gj, .gap = 0, .spook = normal});
        const double bound = mu * h * g * (boxes - below) / 4;
        for (const Constraint<6>& one :
             friction_constraints<6>(contact, {Vec3(1, 0, 0), Vec3(0, 1, 0)}, bound, friction))
          s.add(one);
      }
  return s;
}

SparseMatrix lower_triangle(const MatrixXd& A) {
  SparseMatrix lower = MatrixXd(A.triangularView<Eigen::Lower>()).sparseView();
  lower.makeCompressed();
  return lower;
}

MatrixXd full(const SparseMatrix& lower) {
  const MatrixXd A = lower;
  return MatrixXd(A.selfadjointView<Eigen::Lower>());
}

double dense_residual(const Bounded& problem, const VectorXd& lambda) {
  const VectorXd lacking = problem.B - problem.S * lambda;
  double largest = 0;
  for (Eigen::Index k = 0; k < lambda.size(); ++k) {
    const double diagonal = problem.S(k, k);
    const double next = std::clamp(lambda[k] + lacking[k] / diagonal, problem.lo[k], problem.hi[k]);
    const double one = diagonal * std::abs(next - lambda[k]);
    if (std::isnan(one)) return one;
    largest = std::max(largest, one);
  }
  return largest;
}

}  // namespace spook::testing
