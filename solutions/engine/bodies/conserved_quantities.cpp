#include "engine/bodies/conserved_quantities.hpp"

namespace spook {

/// Returns I ω of a rigid body [kg m²/s].
static Vec3 spin(const Bodies<6>& bodies, std::size_t i, const Twist<6>& W) {
  const Orientations<6>& turned = bodies.orientations;
  return world_inertia(turned.q[i], turned.principal[i]) * W.tail<3>();
}

template <int Dof>
double kinetic_energy(const Bodies<Dof>& bodies, std::size_t i, const Twist<Dof>& W) {
  double T = bodies.mass[i] * W.template head<3>().squaredNorm() / 2;
  if constexpr (Dof == 6) T += W.template tail<3>().dot(spin(bodies, i, W)) / 2;
  return T;
}

template <int Dof>
double kinetic_energy(const Bodies<Dof>& bodies) {
  double T = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) T += kinetic_energy(bodies, i, bodies.motion.W[i]);
  return T;
}

template <int Dof>
double potential_energy(const Bodies<Dof>& bodies, const Vec3& gravity) {
  double U = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) U -= bodies.mass[i] * gravity.dot(bodies.x[i]);
  return U;
}

template <int Dof>
Vec3 momentum(const Bodies<Dof>& bodies) {
  Vec3 p = Vec3::Zero();
  for (std::size_t i = 0; i < bodies.size(); ++i) p += bodies.mass[i] * bodies.motion.W[i].template head<3>();
  return p;
}

template <int Dof>
Vec3 angular_momentum(const Bodies<Dof>& bodies) {
  Vec3 L = Vec3::Zero();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    L += bodies.mass[i] * bodies.x[i].cross(Vec3(bodies.motion.W[i].template head<3>()));
    if constexpr (Dof == 6) L += spin(bodies, i, bodies.motion.W[i]);
  }
  return L;
}

template double kinetic_energy<3>(const Bodies<3>&);
template double kinetic_energy<6>(const Bodies<6>&);
template double kinetic_energy<3>(const Bodies<3>&, std::size_t, const Twist<3>&);
template double kinetic_energy<6>(const Bodies<6>&, std::size_t, const Twist<6>&);
template double potential_energy<3>(const Bodies<3>&, const Vec3&);
template double potential_energy<6>(const Bodies<6>&, const Vec3&);
template Vec3 momentum<3>(const Bodies<3>&);
template Vec3 momentum<6>(const Bodies<6>&);
template Vec3 angular_momentum<3>(const Bodies<3>&);
template Vec3 angular_momentum<6>(const Bodies<6>&);

}  // namespace spook
