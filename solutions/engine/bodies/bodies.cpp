#include "engine/bodies/bodies.hpp"

#include "common/require.hpp"

namespace spook {

void require_unit_length(const std::string& name, double length) {
  if (!(std::abs(length - 1) <= 1e-9)) reject("length of " + name, length, "1");
}

template <int Dof>
Shape shape_of(const Body<Dof>& body) {
  require_not_negative("radius", body.radius);
  Shape shape = NoShape{};
  if (body.radius > 0) shape = Sphere{body.radius};
  if constexpr (Dof == 6) {
    require_not_negative("half_length", body.half_length);
    const bool box = !body.half_sides.isZero(0), points = !body.corners.empty();
    if (body.half_length > 0) {
      if (body.radius == 0) reject("radius", body.radius, "positive for a body with a half_length");
      shape = Capsule{body.radius, body.half_length};
    }
    if (points && body.radius != 0) reject("radius", body.radius, "0 for a body with corners");
    if (box && body.radius != 0) reject("radius", body.radius, "0 for a body with half_sides");
    if (box && points)
      reject("number of corners", static_cast<double>(body.corners.size()), "0 for a body with half_sides");
    if (box) shape = Cuboid{body.half_sides};
    if (points) shape = PointSet{body.corners};
  }
  require_sound(shape);
  return shape;
}

/// Returns the given moments of a body, or those of its shape.
static Vec3 moments_of(const Body<6>& body) {
  if (body.principal) return *body.principal;
  return match(shape_of(body), [&]<class Type>(const Type& shape) -> Vec3 {
    if constexpr (HasInterior<Type>)
      return shape.moments(body.mass);
    else
      throw std::invalid_argument(
          "principal moments must be given for a body other than a sphere, capsule or box, but are missing");
  });
}

/// Throws unless the number and its inverse are positive and finite.
static void require_invertible(const std::string& name, double value) {
  require_positive(name, value);
  if (!std::isfinite(1 / value)) reject(name, value, "so large that its inverse is finite");
}

/// Throws unless no moment exceeds the sum of the other two: each moment is a sum over two of three squares.
static void require_moments(const Body<6>& body) {
  if (!body.principal) return;
  for (const double moment : *body.principal) require_positive("principal moment", moment);
  const double largest = body.principal->maxCoeff(), others = body.principal->sum() - largest;
  if (largest > others * (1 + 1e-9)) reject("principal moment", largest, "at most the sum of the other two");
}

template <int Dof>
static void require_sound(const Body<Dof>& body) {
  require_all_finite("x", body.x);
  require_all_finite("v", body.v);
  require_invertible("mass", body.mass);
  shape_of(body);
  if constexpr (Dof == 6) {
    require_unit_length("q", body.q.norm());
    require_all_finite("omega", body.omega);
    require_moments(body);
  }
}

template <int Dof>
static void add_at(Bodies<Dof>& bodies, const Vec3& x, double mass, double inverse_mass) {
  bodies.x.push_back(x);
  bodies.mass.push_back(mass);
  bodies.motion.inverse_mass.push_back({.linear = inverse_mass});
  bodies.motion.W.push_back(Twist<Dof>::Zero());
  bodies.motion.Wf.push_back(Twist<Dof>::Zero());
}

template <int Dof>
int Bodies<Dof>::add(const Body<Dof>& body) {
  require_sound(body);
  Vec3 principal;
  if constexpr (Dof == 6) {
    principal = moments_of(body);
    for (const double moment : principal) require_invertible("principal moment", moment);
  }
  add_at(*this, body.x, body.mass, 1 / body.mass);
  motion.W.back().template head<3>() = body.v;
  if constexpr (Dof == 6) {
    motion.W.back().template tail<3>() = body.omega;
    orientations.q.push_back(body.q.normalized());
    orientations.principal.push_back(principal);
    orientations.inverse_principal.push_back(principal.cwiseInverse());
    motion.inverse_mass.back().angular = orientations.inverse_inertia(size() - 1);
  }
  return static_cast<int>(size()) - 1;
}

template <int Dof>
int Bodies<Dof>::add_fixed(const Vec3& position) {
  require_all_finite("x", position);
  add_at(*this, position, 0, 0);
  if constexpr (Dof == 6) {
    orientations.q.push_back(Quat::Identity());
    orientations.principal.push_back(Vec3::Zero());
    orientations.inverse_principal.push_back(Vec3::Zero());
  }
  return static_cast<int>(size()) - 1;
}

template <int Dof>
void Bodies<Dof>::remove(std::size_t i) {
  const auto out_of = [&](auto& all) { all.erase(all.begin() + static_cast<std::ptrdiff_t>(i)); };
  out_of(x);
  out_of(mass);
  out_of(motion.inverse_mass);
  out_of(motion.W);
  out_of(motion.Wf);
  if constexpr (Dof == 6) {
    out_of(orientations.q);
    out_of(orientations.principal);
    out_of(orientations.inverse_principal);
  }
}

template Shape shape_of<3>(const Body<3>&);
template Shape shape_of<6>(const Body<6>&);
template struct Bodies<3>;
template struct Bodies<6>;

}  // namespace spook
