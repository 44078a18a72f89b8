// Reads bodies and joints of a file; errors name the path in the file.
#include "spook/file_world.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/constraints/mechanisms.hpp"

namespace spook {

namespace {

void read(const std::optional<Place>& place, double& number) {
  if (place) number = place->number();
}
void read(const std::optional<Place>& place, Vec3& v) {
  if (place) v = place->vector();
}
void read(const std::optional<Place>& place, std::optional<double>& number) {
  if (place) number = place->number();
}

/// Calls `action` for a place, and adds the place to an error of the engine: bodies[3].mass must be ...
template <class Action>
void at(const Place& place, const Action& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    const std::string what = error.what(), key = what.substr(0, what.find(' '));
    if (what.rfind(place.path(), 0) == 0) throw;
    if (place.has(key)) throw std::invalid_argument(place.path() + "." + what);
    for (const char* part : {"limits", "motor", "spring"})
      if (place.has(part) && place[part].has(key))
        throw std::invalid_argument(place.path() + "." + part + "." + what);
    throw std::invalid_argument(place.path() + ": " + what);
  }
}

/// Returns the volume of a solid body [m³]; `place` is its density's.
double volume(const Place& place, const Shape& shape) {
  return match(shape, [&]<class Type>(const Type& solid) -> double {
    if constexpr (HasInterior<Type>)
      return solid.volume();
    else
      place.reject("left out for a body that is no sphere, no capsule and no box");
  });
}

/// Reads the numbers that describe a rigid body's shape.
void read_shape(const Place& place, Body<6>& body) {
  read(place.find("radius"), body.radius);
  read(place.find("half_length"), body.half_length);
  read(place.find("half_sides"), body.half_sides);
  if (const auto corners = place.find("corners"))
    for (const Place& corner : corners->list()) body.corners.push_back(corner.vector());
}

template <int Dof>
void add_moving(const Place& place, World<Dof>& world) {
  Body<Dof> body;
  read(place.find("x"), body.x);
  read(place.find("v"), body.v);
  if constexpr (Dof == 3) {
    place.require_keys({"name", "material", "x", "v", "mass", "density", "radius", "fixed"});
    read(place.find("radius"), body.radius);
  } else {
    place.require_keys({"name", "material", "x", "v", "mass", "density", "radius", "q", "omega", "principal",
                        "half_length", "half_sides", "corners", "fixed"});
    if (const auto q = place.find("q")) body.q = q->quaternion();
    read(place.find("omega"), body.omega);
    if (const auto moments = place.find("principal")) body.principal = moments->vector();
    read_shape(place, body);
  }
  const auto density = place.find("density");
  if (density && place.has("mass")) density->reject("left out where mass is given");
  body.mass = density ? density->number() * volume(*density, shape_of(body)) : place["mass"].number();
  world.add(body);
}

/// Returns the keyframes of a kinematic body. Their errors name the place of the keyframe.
template <int Dof>
Keyframes keyframes_in(const Place& place) {
  std::vector<Keyframe> frames;
  for (const Place& each : place.list()) {
    each.require_keys(Dof == 3 ? std::vector<std::string>{"time", "x"}
                               : std::vector<std::string>{"time", "x", "q"});
    frames.push_back({.time = each["time"].number(), .x = each["x"].vector()});
    if (const auto q = each.find("q")) frames.back().q = q->quaternion();
    const auto checked = frames.end() - std::min<std::ptrdiff_t>(2, std::ssize(frames));  // with the one before
    at(each, [&] { Keyframes({checked, frames.end()}); });
  }
  return Keyframes(std::move(frames));
}

/// Sets the velocity of the static body that was added last.
template <int Dof>
void add_velocity(const Place& place, World<Dof>& world) {
  const int body = static_cast<int>(world.bodies().size()) - 1;
  if (const auto keyframes = place.find("keyframes")) {
    for (const char* key : {"x", "q", "v", "omega", "surface_velocity"})
      if (place.has(key)) place[key].reject("left out where keyframes are given");
    return world.set_keyframes(body, keyframes_in<Dof>(*keyframes));
  }
  const auto surface = place.find("surface_velocity");
  if (surface) world.set_surface_velocity(body, surface->vector());
  Vec3 v = Vec3::Zero(), omega = Vec3::Zero();
  read(place.find("v"), v);
  if constexpr (Dof == 6) read(place.find("omega"), omega);
  if (v.isZero(0) && omega.isZero(0)) return;
  if (surface) surface->reject("left out where v or omega is given");
  if constexpr (Dof == 6)
    world.set_velocity(body, v, omega);
  else
    world.set_velocity(body, v);
}

/// Returns the position of a static body; keyframes have their own.
Vec3 position_in(const Place& place) {
  return place.has("keyframes") ? Vec3::Zero() : place["x"].vector();
}

template <int Dof>
void add_static(const Place& place, World<Dof>& world) {
  if constexpr (Dof == 3) {
    place.require_keys({"name", "material", "fixed", "x", "radius", "v", "surface_velocity", "keyframes"});
    double radius = 0;
    read(place.find("radius"), radius);
    world.add_fixed(position_in(place), radius);
  } else {
    place.require_keys({"name", "material", "fixed", "x", "q", "radius", "half_length", "half_sides", "corners",
                        "v", "omega", "surface_velocity", "keyframes"});
    Body<6> body;
    if (const auto q = place.find("q")) body.q = q->quaternion();
    read_shape(place, body);
    world.add_fixed(position_in(place), shape_of(body), body.q);
  }
  add_velocity(place, world);
}

const std::vector<std::string> material_keys = {"friction", "restitution",        "k",
                                                "d",        "rolling_resistance", "torsional_resistance"};

/// Reads the numbers of a material.
Material material_in(const Place& place) {
  Material material;
  read(place.find("friction"), material.friction);
  read(place.find("restitution"), material.restitution);
  read(place.find("k"), material.k);
  read(place.find("d"), material.d);
  read(place.find("rolling_resistance"), material.rolling_resistance);
  read(place.find("torsional_resistance"), material.torsional_resistance);
  if (material == Material{}) place.reject("a friction, restitution, k, d or resistance");
  return material;
}

/// Adds a body without its material.
template <int Dof>
void add_kind_of_body(const Place& place, World<Dof>& world) {
  if (const auto plane = place.find("plane")) {
    place.require_keys({"name", "material", "plane", "surface_velocity"});
    plane->require_keys({"n", "offset"});
    at(*plane, [&] { world.add_plane((*plane)["n"].vector(), (*plane)["offset"].number()); });
    add_velocity(place, world);
  } else if (place.has("fixed") && place["fixed"].flag()) {
    add_static(place, world);
  } else {
    add_moving(place, world);
  }
}

template <int Dof>
void add_body(const Place& place, World<Dof>& world) {
  add_kind_of_body(place, world);
  const auto material = place.find("material");
  if (!material) return;
  material->require_keys(material_keys);
  const int body = static_cast<int>(world.bodies().size()) - 1;
  at(*material, [&] { world.set_material(body, material_in(*material)); });
}

/// Sets the material of a pair.
template <int Dof>
void add_material(const Place& place, const BodyNames& names, World<Dof>& world) {
  std::vector<std::string> keys = material_keys;
  keys.insert(keys.end(), {"i", "j"});
  place.require_keys(keys);
  at(place, [&] { world.set_material(names.index(place["i"]), names.index(place["j"]), material_in(place)); });
}

JointLimits limits_in(const Place& place) {
  place.require_keys({"lower", "upper"});
  JointLimits limits;
  read(place.find("lower"), limits.lower);
  read(place.find("upper"), limits.upper);
  return limits;
}

Motor motor_in(const Place& place) {
  place.require_keys({"speed", "strength", "viscosity"});
  Motor motor;
  read(place.find("speed"), motor.speed);
  read(place.find("strength"), motor.strength);
  read(place.find("viscosity"), motor.viscosity);
  return motor;
}

Spring spring_in(const Place& place) {
  place.require_keys({"stiffness", "damping", "rest"});
  Spring spring;
  read(place.find("stiffness"), spring.stiffness);
  read(place.find("damping"), spring.damping);
  read(place.find("rest"), spring.rest);
  return spring;
}

std::map<std::string, JointKind> joint_kinds() {
  std::map<std::string, JointKind> kinds;
  for (const JointProperties& each : joint_properties) kinds.emplace(each.name, each.kind);
  return kinds;
}

/// Throws std::invalid_argument for a key that a joint of this kind does not use, and for a length that is missing.
void require_of_kind(const Place& place, const Joint& joint) {
  const bool has_limits = joint.kind == JointKind::rope || joint.limits;
  const std::string of_kind = "left out for a joint of kind " + name_of(joint.kind);
  if (joint.needs_length() && !joint.length)
    throw std::invalid_argument(place.path() + ".length is missing: a joint of kind " + name_of(joint.kind) +
                                " has one");
  for (const char* key : {"axis", "rest", "k_turn"})
    if (!joint.is_guided() && place.has(key)) place[key].reject(of_kind);
  if (joint.kind != JointKind::hinge && place.has("angle")) place["angle"].reject(of_kind);
  if (!has_limits && place.has("limit_d"))
    place["limit_d"].reject(joint.is_guided() ? "left out without limits" : of_kind);
}

template <int Dof>
void add_joint(const Place& place, const BodyNames& names, World<Dof>& world) {
  place.require_keys({"i", "j", "p_i", "p_j", "length", "k", "d", "kind", "axis", "rest", "k_turn", "limits",
                      "limit_d", "spring", "motor", "angle"});
  Joint joint{.i = names.index(place["i"]), .j = names.index(place["j"])};
  read(place.find("p_i"), joint.p_i);
  read(place.find("p_j"), joint.p_j);
  read(place.find("length"), joint.length);
  read(place.find("k"), joint.k);
  read(place.find("d"), joint.d);
  if (const auto kind = place.find("kind")) joint.kind = one_of(*kind, joint_kinds());
  read(place.find("axis"), joint.axis);
  if (const auto rest = place.find("rest")) joint.rest = rest->quaternion();
  read(place.find("k_turn"), joint.k_turn);
  if (const auto limits = place.find("limits")) joint.limits = limits_in(*limits);
  read(place.find("limit_d"), joint.limit_d);
  if (const auto spring = place.find("spring")) joint.spring = spring_in(*spring);
  if (const auto motor = place.find("motor")) joint.motor = motor_in(*motor);
  read(place.find("angle"), joint.angle);
  if (joint.length && joint.kind == JointKind::ball) joint.kind = JointKind::distance;
  require_of_kind(place, joint);
  world.add_joint(joint);
}

}  // namespace

BodyNames::BodyNames(const Place& bodies) {
  for (const Place& body : bodies.list()) {
    if (const auto name = body.find("name"))
      if (!indices_.emplace(name->text(), count_).second) name->reject("another name than those before");
    ++count_;
  }
}

int BodyNames::index(const Place& place) const {
  const int i = place.holds_text() ? one_of(place, indices_) : place.whole();
  if (i < 0 || i >= count_) place.reject("the number of a body, less than " + std::to_string(count_));
  return i;
}

template <int Dof>
Settings<Dof> settings_in(const Place& file) {
  Settings<Dof> settings;
  const std::optional<Place> place = file.find("settings");
  if (!place) return settings;
  // Version 1 called the integrator's order "compose".
  const std::string order = file["version"].whole() == 1 ? "compose" : "integrator_order";
  place->require_keys({"gravity", "k", "d", "friction", "friction_model", "viscosity", order, "impacts",
                       "rotation", "gyroscopic_torque", "points_pass", "max_parts"});
  read(place->find("gravity"), settings.gravity);
  read(place->find("k"), settings.k);
  read(place->find("d"), settings.d);
  read(place->find("friction"), settings.friction);
  read(place->find("viscosity"), settings.viscosity);
  if (const auto parts = place->find("max_parts")) settings.max_parts = parts->whole();
  if (const auto given = place->find(order)) settings.integrator_order = given->whole();
  if (const auto impacts = place->find("impacts")) {
    impacts->require_keys({"restitution", "friction", "threshold", "max_passes"});
    ImpactLaw law;
    read(impacts->find("restitution"), law.restitution);
    read(impacts->find("friction"), law.friction);
    read(impacts->find("threshold"), law.threshold);
    if (const auto passes = impacts->find("max_passes")) law.max_passes = passes->whole();
    settings.impacts = law;
  }
  if constexpr (Dof == 6) {
    if (const auto update = place->find("rotation"))
      settings.rotation.update =
          one_of<RotationUpdate>(*update, {{"splitting", RotationUpdate::splitting},
                                           {"first_order", RotationUpdate::first_order},
                                           {"exponential", RotationUpdate::exponential}});
    if (const auto torque = place->find("gyroscopic_torque"))
      settings.rotation.gyroscopic_torque = torque->flag();
  }
  return settings;
}

/// Points stop at planes alone. Throws std::invalid_argument for a body of points beside another such body, or a solid,
/// that no joint connects to it: they would pass through each other.
template <int Dof>
static void refuse_points_that_could_meet(const Place& file, const World<Dof>& world) {
  const Shapes& shapes = world.shapes();
  if (shapes.corners.empty()) return;
  if (const auto settings = file.find("settings"))
    if (const auto allowed = settings->find("points_pass"); allowed && allowed->flag()) return;
  Mechanisms<Dof> mechanisms(world.joints(), world.bodies());
  const auto refuse = [&](int points, int other) {
    if (mechanisms.connect(points, other) || shapes.exclusions.excludes(points, other)) return;
    const auto named = [](int body) { return "bodies[" + std::to_string(body) + "]"; };
    throw std::invalid_argument(named(points) + ".corners are points, which pass through " + named(other) +
                                ": give it another shape, or set settings.points_pass");
  };
  for (const Corners& points : shapes.corners) {
    for (const Corners& others : shapes.corners)
      if (others.body < points.body) refuse(points.body, others.body);
    for (const Solid& solid : shapes.solids) refuse(points.body, solid.body);
  }
}

/// Reads the lists of bodies that do not touch each other.
template <int Dof>
static void exclude_contacts(const Place& lists, const BodyNames& names, World<Dof>& world) {
  for (const Place& list : lists.list()) {
    std::vector<int> bodies;
    for (const Place& body : list.list()) bodies.push_back(names.index(body));
    at(list, [&] { world.exclude_contacts(bodies); });
  }
}

template <int Dof>
void add_all(const Place& file, const BodyNames& names, World<Dof>& world) {
  for (const Place& body : file["bodies"].list()) at(body, [&] { add_body(body, world); });
  if (const auto joints = file.find("joints"))
    for (const Place& joint : joints->list()) at(joint, [&] { add_joint(joint, names, world); });
  if (const auto materials = file.find("materials"))
    for (const Place& each : materials->list()) at(each, [&] { add_material(each, names, world); });
  if (const auto lists = file.find("no_contact")) exclude_contacts(*lists, names, world);
  refuse_points_that_could_meet(file, world);
}

template Settings<3> settings_in(const Place&);
template Settings<6> settings_in(const Place&);
template void add_all(const Place&, const BodyNames&, World<3>&);
template void add_all(const Place&, const BodyNames&, World<6>&);

}  // namespace spook
