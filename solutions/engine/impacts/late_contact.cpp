#include "engine/impacts/late_contact.hpp"

#include <algorithm>
#include <cmath>

namespace spook {

template <int Dof>
static Twist<Dof> row_of_i(const Contact& contact) {
  return contact_jacobian(contact).Gi.template head<Dof>();
}
template <int Dof>
static Twist<Dof> row_of_j(const Contact& contact) {
  return contact_jacobian(contact).Gj.template head<Dof>();
}

std::vector<double> radii_of(const Shapes& shapes, std::size_t bodies) {
  std::vector<double> radii(bodies, 0);
  for (const Solid& solid : shapes.solids)
    if (const auto* sphere = std::get_if<Sphere>(&solid.shape)) radii[solid.body] = sphere->radius;
  for (const Plane& plane : shapes.planes) radii[plane.body] = -1;
  return radii;
}

/// Tells whether the point keeps its place on body j: if j is a sphere or i a plane, which has no place of its own.
static bool stays_on_j(const Contact& contact, const std::vector<double>& radii) {
  return radii[contact.j] > 0 || radii[contact.i] < 0;
}

template <int Dof>
double lateness(const Contact& contact, double u_n, double h, double longest, const Motion<Dof>& motion) {
  const double a =
      (row_of_i<Dof>(contact).dot(motion.Wf[contact.i]) + row_of_j<Dof>(contact).dot(motion.Wf[contact.j])) / h;
  const double square = std::max(0.0, u_n * u_n - 2 * a * contact.gap);
  return std::clamp(-2 * contact.gap / (std::sqrt(square) - u_n), 0.0, longest);
}

template <int Dof>
Contact contact_before(Contact contact, double late, const std::vector<double>& radii,
                       const Bodies<Dof>& bodies) {
  const auto back = [&](int body) -> Vec3 { return -late * bodies.motion.W[body].template head<3>(); };
  const Vec3 back_i = back(contact.i), back_j = back(contact.j);
  const double radius_i = radii[contact.i], radius_j = radii[contact.j];
  if (radius_i > 0 && radius_j > 0) {
    const Vec3 apart = (bodies.x[contact.j] + back_j) - (bodies.x[contact.i] + back_i);
    if (!apart.isZero(0)) contact.n = apart.normalized();
    contact.r_i = radius_i / (radius_i + radius_j) * apart;
    contact.r_j = contact.r_i - apart;
  } else if (stays_on_j(contact, radii)) {
    contact.r_i += back_j - back_i;
  } else if (radius_i > 0) {
    contact.r_j += back_i - back_j;
  } else {
    contact.r_i += (back_j - back_i) / 2;
    contact.r_j += (back_i - back_j) / 2;
  }
  return contact;
}

Contact moved_on(Contact contact, const Displacements& moved, const std::vector<double>& radii) {
  contact.gap += contact.n.dot(moved.at(contact.j, contact.r_j) - moved.at(contact.i, contact.r_i));
  const Vec3 apart = moved.by[contact.j] - moved.by[contact.i];
  if (stays_on_j(contact, radii))
    contact.r_i += apart;
  else
    contact.r_j -= apart;
  return contact;
}

template double lateness<3>(const Contact&, double, double, double, const Motion<3>&);
template double lateness<6>(const Contact&, double, double, double, const Motion<6>&);
template Contact contact_before<3>(Contact, double, const std::vector<double>&, const Bodies<3>&);
template Contact contact_before<6>(Contact, double, const std::vector<double>&, const Bodies<6>&);

}  // namespace spook
