// Writes a scene as a file: all numbers of its initial world, so that a run of the file equals a run of the scene.
#include <array>
#include <stdexcept>

#include "spook/file_world.hpp"
#include "spook/scene_file.hpp"

namespace spook {

static Json numbers(const Quat& q) {
  return {q.w(), q.x(), q.y(), q.z()};
}

/// JSON has no infinity.
static Json number(double value) {
  return std::isinf(value) ? Json(value > 0 ? "inf" : "-inf") : Json(value);
}

template <int Dof>
static Json json_of(const Settings<Dof>& settings, const std::string& solver) {
  Json json = {{"gravity", numbers(settings.gravity)},
               {"friction", settings.friction},
               {"viscosity", number(settings.viscosity)}};
  // A file without a model takes the default of its solver, or of another solver that a run names.
  if (settings.solver.friction != friction_model({.h = 1, .solver = solver}))
    json["friction_model"] = name_of(settings.solver.friction);
  if (settings.k) json["k"] = *settings.k;
  if (settings.d) json["d"] = *settings.d;
  if (settings.max_parts != Settings<Dof>{}.max_parts) json["max_parts"] = settings.max_parts;
  if (settings.integrator_order != 2) json["integrator_order"] = settings.integrator_order;
  if (const auto& law = settings.impacts)
    json["impacts"] = {{"restitution", law->restitution},
                       {"friction", law->friction},
                       {"threshold", law->threshold},
                       {"max_passes", law->max_passes}};
  if constexpr (Dof == 6) {
    constexpr std::array updates = {"splitting", "first_order", "exponential"};
    json["rotation"] = updates[static_cast<std::size_t>(settings.rotation.update)];
    json["gyroscopic_torque"] = settings.rotation.gyroscopic_torque;
  }
  return json;
}

/// Returns a body without its shape.
template <int Dof>
static Json json_of_body(const Bodies<Dof>& bodies, std::size_t i) {
  if (bodies.is_fixed(i)) {
    Json json = {{"fixed", true}, {"x", numbers(bodies.x[i])}};
    if constexpr (Dof == 6)
      if (!bodies.orientations.q[i].coeffs().isApprox(Quat::Identity().coeffs(), 0))
        json["q"] = numbers(bodies.orientations.q[i]);
    return json;
  }
  const Twist<Dof>& W = bodies.motion.W[i];
  Json json = {{"x", numbers(bodies.x[i])}, {"v", numbers(W.template head<3>())}, {"mass", bodies.mass[i]}};
  if constexpr (Dof == 6) {
    json["q"] = numbers(bodies.orientations.q[i]);
    json["omega"] = numbers(W.template tail<3>());
    json["principal"] = numbers(bodies.orientations.principal[i]);
  }
  return json;
}

/// Adds what moves a static body.
template <int Dof>
static void put_velocity(Json& json, const Kinematic<Dof>& kinematic, const Twist<Dof>& W) {
  const Vec3 v = W.template head<3>();
  if (!kinematic.moves) {
    json["surface_velocity"] = numbers(v);
  } else if (kinematic.keyframes) {
    json.erase("x");
    json.erase("q");
    for (const Keyframe& frame : kinematic.keyframes->frames()) {
      Json each = {{"time", frame.time}, {"x", numbers(frame.x)}};
      if constexpr (Dof == 6) each["q"] = numbers(frame.q);
      json["keyframes"].push_back(each);
    }
  } else {
    json["v"] = numbers(v);
    if constexpr (Dof == 6) json["omega"] = numbers(W.template tail<3>());
  }
}

template <int Dof>
static Json json_of(const Bodies<Dof>& bodies, const Shapes& shapes) {
  Json list = Json::array();
  for (std::size_t i = 0; i < bodies.size(); ++i) list.push_back(json_of_body(bodies, i));
  for (const Plane& plane : shapes.planes) {
    // Assigned by name, since clang 14 leaks the old value when braces are assigned.
    const Json json = {{"plane", {{"n", numbers(plane.n)}, {"offset", plane.offset}}}};
    list[static_cast<std::size_t>(plane.body)] = json;
  }
  const std::vector<Shape> shape = shapes.by_body(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    Json& body = list[i];
    match(
        shape[i], [](const NoShape&) {}, [&](const Sphere& sphere) { body["radius"] = sphere.radius; },
        [&](const Capsule& capsule) {
          body["radius"] = capsule.radius;
          body["half_length"] = capsule.half_length;
        },
        [&](const Cuboid& box) { body["half_sides"] = numbers(box.half_sides); },
        [&](const PointSet& set) {
          for (const Vec3& point : set.points) body["corners"].push_back(numbers(point));
        });
  }
  return list;
}

/// Adds the members of hinges, sliders and welds that other joints lack.
static void put_guide(Json& json, const Joint& joint) {
  json["kind"] = name_of(joint.kind);
  json["axis"] = numbers(joint.axis);
  json["rest"] = numbers(*joint.rest);
  if (!joint.has_default_k_turn) json["k_turn"] = *joint.k_turn;
  if (joint.kind == JointKind::hinge) json["angle"] = joint.angle;
  if (joint.limits) {
    json["limits"] = {{"lower", number(joint.limits->lower)}, {"upper", number(joint.limits->upper)}};
    json["limit_d"] = *joint.limit_d;
  }
  if (joint.spring)
    json["spring"] = {{"stiffness", joint.spring->stiffness},
                      {"damping", joint.spring->damping},
                      {"rest", joint.spring->rest}};
  if (joint.motor)
    json["motor"] = {{"speed", joint.motor->speed},
                     {"strength", number(joint.motor->strength)},
                     {"viscosity", number(joint.motor->viscosity)}};
}

static Json json_of(const std::vector<Joint>& joints) {
  Json list = Json::array();
  for (const Joint& joint : joints) {
    Json json = {{"i", joint.i}, {"j", joint.j}, {"p_i", numbers(joint.p_i)}, {"p_j", numbers(joint.p_j)}};
    if (joint.length) json["length"] = *joint.length;
    if (!joint.has_default_k) json["k"] = *joint.k;
    json["d"] = *joint.d;
    if (joint.is_guided()) put_guide(json, joint);
    if (joint.kind == JointKind::rope) {
      json["kind"] = name_of(joint.kind);
      json["limit_d"] = *joint.limit_d;
    }
    list.push_back(json);
  }
  return list;
}

static Json json_of(const Material& material) {
  Json json = Json::object();
  if (material.friction) json["friction"] = *material.friction;
  if (material.restitution) json["restitution"] = *material.restitution;
  if (material.k) json["k"] = *material.k;
  if (material.d) json["d"] = *material.d;
  if (material.rolling_resistance) json["rolling_resistance"] = *material.rolling_resistance;
  if (material.torsional_resistance) json["torsional_resistance"] = *material.torsional_resistance;
  return json;
}

/// Adds the materials of bodies and of pairs.
static void put_materials(Json& json, const Materials& materials) {
  for (std::size_t i = 0; i < materials.of_bodies().size(); ++i)
    if (materials.of_bodies()[i] != Material{})
      json["bodies"][i]["material"] = json_of(materials.of_bodies()[i]);
  for (const auto& [pair, material] : materials.of_pairs()) {
    Json each = {{"i", pair.first}, {"j", pair.second}};
    each.update(json_of(material));
    json["materials"].push_back(each);
  }
}

template <int Dof>
Json content_of(const World<Dof>& world) {
  Json json = Json::object();
  json["bodies"] = json_of(world.bodies(), world.shapes());
  for (const Kinematic<Dof>& kinematic : world.kinematic_bodies()) {
    const std::size_t i = world.index(kinematic.body);
    put_velocity(json["bodies"][i], kinematic, world.bodies().motion.W[i]);
  }
  put_materials(json, world.materials());
  for (const std::vector<int>& list : world.shapes().exclusions.lists())
    if (list.size() > 1) json["no_contact"].push_back(list);  // others are left of removed bodies
  if (!world.joints().empty()) json["joints"] = json_of(world.joints());
  return json;
}

template Json content_of(const World<3>&);
template Json content_of(const World<6>&);

template <int Dof>
static void put_world(Json& json, const World<Dof>& world, const std::string& name) {
  if (world.settings().force || world.settings().wrench)
    throw std::invalid_argument(name + " cannot be written as a file: its force is a formula");
  json["settings"] = json_of(world.settings(), json["solver"]);
  json.update(content_of(world));
}

Json scene_as_file(const SceneDescription& description, const Parameters& parameters, const Method& method) {
  const std::unique_ptr<Scene> scene = description.build(parameters, method);
  Json json = {{"format", "spook scene"},
               {"version", 2},
               {"summary", description.summary},
               {"model", scene->points() ? "point" : "rigid"},
               {"h", method.h},
               {"time", description.time},
               {"solver", method.solver}};
  if (scene->points())
    put_world(json, *scene->points(), description.name);
  else
    put_world(json, *scene->rigid_bodies(), description.name);
  return json;
}

}  // namespace spook
