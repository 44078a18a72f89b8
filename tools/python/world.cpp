// spook.World and spook.PointWorld: a world of the engine, with arrays over its numbers.
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <sstream>

#include "arrays.hpp"
#include "binding.hpp"
#include "common/require.hpp"
#include "engine/collision/queries.hpp"
#include "engine/support/require_index.hpp"
#include "scenes/choose.hpp"
#include "scenes/method.hpp"
#include "spook/file_world.hpp"

namespace spook {

namespace {

using namespace py::literals;
using MaybeVec3 = std::optional<Vec3>;
template <int Columns>
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Columns, Eigen::RowMajor>;

/// Throws std::invalid_argument unless there is a finite row for each body, or no row at all.
template <class Given>
void require_a_row_each(const char* name, const Given& rows, std::size_t bodies) {
  if (!rows) return;
  if (static_cast<std::size_t>(rows->rows()) != bodies)
    throw std::invalid_argument(std::string(name) + " must have a row for each of " + std::to_string(bodies) +
                                " bodies, but has " + std::to_string(rows->rows()));
  if (!rows->allFinite()) throw std::invalid_argument(std::string(name) + " must be finite");
}

template <int Dof>
RotationRule<Dof> rotation_rule(const std::string& name) {
  if constexpr (Dof == 6)
    return {.update = choose<RotationUpdate>("rotation", name,
                                             {{"splitting", RotationUpdate::splitting},
                                              {"first_order", RotationUpdate::first_order},
                                              {"exponential", RotationUpdate::exponential}})};
  else
    return {};
}

template <int Dof>
PythonWorld<Dof> make(const Vec3& gravity, std::optional<double> k, std::optional<double> d, double friction,
                      double viscosity, std::optional<double> restitution, double threshold,
                      const std::string& solver, const std::optional<std::string>& model,
                      const std::string& tangents, int iterations, double tolerance, bool warm_start,
                      std::optional<double> contact_margin, int integrator_order, int max_parts,
                      std::optional<int> soft_steps, std::optional<double> accuracy, int threads, bool check,
                      const std::string& rotation) {
  if (iterations < 1)
    throw std::invalid_argument("iterations must be at least 1, but is " + std::to_string(iterations));
  if (soft_steps && (*soft_steps < 1 || *soft_steps > 1024))
    throw std::invalid_argument("soft_steps must be from 1 to 1024, but is " + std::to_string(*soft_steps));
  Method method{.h = 1, .solver = solver};
  if (model) method.friction_model = find_friction_model(*model);
  if (accuracy && soft_steps)
    throw std::invalid_argument("accuracy has no effect with soft_steps: leave one of them out");
  method.accuracy = accuracy;
  const Settings<Dof> standard;
  if (soft_steps && (solver != "auto" || model || iterations != standard.solver_limits.max_sweeps ||
                     tolerance != 0 || warm_start || max_parts != standard.max_parts))
    throw std::invalid_argument(
        "solver, friction_model, iterations, tolerance, warm_start and max_parts have no effect with "
        "soft_steps: leave them out");
  if (!restitution && threshold != ImpactLaw{}.threshold)
    reject("threshold", threshold, "left out without a restitution of the world, which may be 0");
  Settings<Dof> settings{
      .gravity = gravity,
      .k = k,
      .d = d,
      .friction = friction,
      .viscosity = viscosity,
      .sliding_tangents = choose<bool>("tangents", tangents, {{"fixed", false}, {"sliding", true}}),
      .solver = make_solver<Dof>(method),
      .warm_start = warm_start,
      .contact_margin = contact_margin,
      .rotation = rotation_rule<Dof>(rotation),
      .integrator_order = integrator_order,
      .max_parts = max_parts,
      .threads = threads,
      .solver_limits = {.max_sweeps = iterations, .tolerance = tolerance}};
  if (soft_steps) settings.soft_steps = SoftSteps{.substeps = *soft_steps};
  if (restitution)
    settings.impacts = ImpactLaw{.restitution = *restitution, .friction = friction, .threshold = threshold};
  return {World<Dof>(std::move(settings)), check};
}

/// Returns the bodies, joints, materials and excluded contacts as text, and the forces of set_force. Throws
/// py::type_error for a world that cannot be built again.
template <int Dof>
py::tuple content(const PythonWorld<Dof>& self) {
  const World<Dof>& world = self.world();
  for (const Kinematic<Dof>& each : world.kinematic_bodies())
    if (each.velocity && !each.keyframes)
      throw py::type_error("a world cannot be pickled with a velocity function, but body " +
                           std::to_string(each.body) + " has one; set_velocity and set_keyframes can be");
  const Bodies<Dof>& bodies = world.bodies();
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (!bodies.x[i].allFinite() || !bodies.motion.W[i].allFinite())
      throw py::type_error("a world that is no longer finite cannot be pickled");
  return py::make_tuple(content_of(world).dump(), self.loads());
}

/// Adds what `content` returned to an empty world.
template <int Dof>
void fill(PythonWorld<Dof>& self, const std::string& text, const std::optional<Rows<Dof>>& loads) {
  Json json = Json::parse(text);
  json["settings"] = {{"points_pass", true}};
  const Place file(json, "");
  add_all(file, BodyNames(file["bodies"]), self.world());
  if (!loads) return;
  for (Eigen::Index i = 0; i < loads->rows(); ++i)
    if (!self.world().bodies().is_fixed(static_cast<std::size_t>(i)))
      self.put_load(static_cast<int>(i), loads->row(i).transpose());
}

/// Calls a function of Python for three numbers.
Vec3 called(const py::function& function, const char* name, double time) {
  const py::gil_scoped_acquire locked;
  const py::object result = function(time);
  try {
    const auto numbers = result.cast<std::array<double, 3>>();
    return {numbers[0], numbers[1], numbers[2]};
  } catch (const py::cast_error&) {
    throw py::type_error(std::string(name) + " must return three numbers, but returned " +
                         py::repr(result).cast<std::string>());
  }
}

void set_velocity_function_of_points(PythonWorld<3>& self, int body, const py::function& v) {
  self.moved().set_velocity_function(body, [v](double time) -> Twist<3> { return called(v, "v", time); });
}

void set_velocity_function(PythonWorld<6>& self, int body, const py::function& v,
                           const std::optional<py::function>& omega) {
  self.moved().set_velocity_function(body, [v, omega](double time) {
    Twist<6> W = Twist<6>::Zero();
    W.head<3>() = called(v, "v", time);
    if (omega) W.tail<3>() = called(*omega, "omega", time);
    return W;
  });
}

/// Sets keyframes from a list of times and a row for each.
template <int Dof>
void set_keyframes(PythonWorld<Dof>& self, int body, const std::vector<double>& times, const Rows<3>& x,
                   const std::optional<Rows<4>>& q) {
  const auto require_rows = [&](const char* name, Eigen::Index rows) {
    if (rows != std::ssize(times))
      throw std::invalid_argument(std::string(name) + " must have a row for each of " +
                                  std::to_string(times.size()) + " times, but has " + std::to_string(rows));
  };
  require_rows("x", x.rows());
  if (q) require_rows("q", q->rows());
  std::vector<Keyframe> frames;
  for (Eigen::Index n = 0; n < x.rows(); ++n) {
    frames.push_back({.time = times[static_cast<std::size_t>(n)], .x = x.row(n)});
    if (q) frames.back().q = Quat((*q)(n, 0), (*q)(n, 1), (*q)(n, 2), (*q)(n, 3));
  }
  self.moved().set_keyframes(body, Keyframes(std::move(frames)));
}

/// Omitted arguments change nothing.
template <int Dof>
void place(PythonWorld<Dof>& self, int body, const MaybeVec3& x, const MaybeVec3& v) {
  self.moved().place(body, x.value_or(self.world().x(body)), v.value_or(self.world().v(body)));
}

/// Sets rows of all bodies; rows of static bodies are ignored.
template <int Dof>
void place_all(PythonWorld<Dof>& self, const std::optional<Rows<3>>& x, const std::optional<Rows<3>>& v) {
  const Bodies<Dof>& bodies = self.world().bodies();
  require_a_row_each("x", x, bodies.size());
  require_a_row_each("v", v, bodies.size());
  World<Dof>& world = self.moved();
  for (int body = 0; body < static_cast<int>(bodies.size()); ++body)
    if (!bodies.is_fixed(static_cast<std::size_t>(body)))
      world.place(body, x ? Vec3(x->row(body)) : world.x(body), v ? Vec3(v->row(body)) : world.v(body));
}

void turn_all(PythonWorld<6>& self, const std::optional<Rows<4>>& q, const std::optional<Rows<3>>& omega) {
  const Bodies<6>& bodies = self.world().bodies();
  require_a_row_each("q", q, bodies.size());
  require_a_row_each("omega", omega, bodies.size());
  if (q)  // before any body turns
    for (std::size_t i = 0; i < bodies.size(); ++i)
      if (!bodies.is_fixed(i)) require_unit_length("q", q->row(static_cast<Eigen::Index>(i)).norm());
  World<6>& world = self.moved();
  for (int body = 0; body < static_cast<int>(bodies.size()); ++body)
    if (!bodies.is_fixed(static_cast<std::size_t>(body)))
      world.turn(
          body, q ? Quat((*q)(body, 0), (*q)(body, 1), (*q)(body, 2), (*q)(body, 3)) : orientation(world, body),
          omega ? Vec3(omega->row(body)) : angular_velocity(world, body));
}

void turn(PythonWorld<6>& self, int body, const std::optional<std::array<double, 4>>& q,
          const MaybeVec3& omega) {
  const Quat turned = q ? Quat((*q)[0], (*q)[1], (*q)[2], (*q)[3]) : orientation(self.world(), body);
  self.moved().turn(body, turned, omega.value_or(angular_velocity(self.world(), body)));
}

int add_point(PythonWorld<3>& self, const Vec3& x, const Vec3& v, double mass, double radius) {
  return self.bodies_of("add").add({.x = x, .v = v, .mass = mass, .radius = radius});
}

int add_rigid(PythonWorld<6>& self, const Vec3& x, const Vec3& v, double mass, double radius,
              const std::array<double, 4>& q, const Vec3& omega, const MaybeVec3& principal, double half_length,
              const Vec3& half_sides, const std::vector<Vec3>& corners) {
  return self.bodies_of("add").add({.x = x,
                                    .v = v,
                                    .mass = mass,
                                    .radius = radius,
                                    .q = Quat(q[0], q[1], q[2], q[3]),
                                    .omega = omega,
                                    .principal = principal,
                                    .half_length = half_length,
                                    .half_sides = half_sides,
                                    .corners = corners});
}

template <int Dof>
void set_material(PythonWorld<Dof>& self, int body, std::optional<int> other, std::optional<double> friction,
                  std::optional<double> restitution, std::optional<double> k, std::optional<double> d,
                  std::optional<double> rolling_resistance, std::optional<double> torsional_resistance) {
  const Material material{.friction = friction,
                          .restitution = restitution,
                          .k = k,
                          .d = d,
                          .rolling_resistance = rolling_resistance,
                          .torsional_resistance = torsional_resistance};
  if (other)
    self.world().set_material(body, *other, material);
  else
    self.world().set_material(body, material);
}

/// Returns None if the ray hits nothing.
template <int Dof>
py::object hit_by_ray(const PythonWorld<Dof>& self, const Vec3& origin, const Vec3& direction, double longest) {
  const std::optional<RayHit> hit = cast_ray(self.world(), origin, direction, longest);
  if (!hit) return py::none();
  return py::dict("body"_a = hit->body, "point"_a = hit->point, "normal"_a = hit->normal,
                  "distance"_a = hit->distance);
}

/// A static body with the shape that its arguments give, named as those of add.
int add_static(PythonWorld<6>& self, const Vec3& x, double radius, const std::array<double, 4>& q,
               double half_length, const Vec3& half_sides) {
  World<6>& world = self.bodies_of("add_fixed");
  const Quat turned(q[0], q[1], q[2], q[3]);
  if (half_sides == Vec3::Zero() && half_length == 0) return world.add_fixed(x, radius);
  if (half_sides != Vec3::Zero() && radius != 0)
    throw std::invalid_argument("half_sides and radius are two shapes: a body has one");
  if (half_length != 0)
    return world.add_fixed(x, Capsule{.radius = radius, .half_length = half_length}, turned);
  return world.add_fixed_box(x, half_sides, turned);
}

/// Returns the world. Throws std::invalid_argument, naming i or j, for a body that there is not.
template <int Dof>
World<Dof>& with_bodies(PythonWorld<Dof>& self, int i, int j) {
  const std::size_t count = self.world().bodies().size();
  require_index("joint's i", i, count);
  require_index("joint's j", j, count);
  return self.world();
}

/// Throws std::invalid_argument for numbers of a joint without a k, which soft steps do not use.
template <int Dof>
void require_used(const World<Dof>& world, std::optional<double> k, std::optional<double> d,
                  std::optional<double> k_turn = {}) {
  if (!world.settings().soft_steps || k) return;
  const std::string rule = "left out with soft_steps, unless the joint has a k";
  if (d) reject("d", *d, rule);
  if (k_turn) reject("k_turn", *k_turn, rule);
}

template <int Dof>
int add_joint(PythonWorld<Dof>& self, int i, int j, const Vec3& p_i, const Vec3& p_j,
              std::optional<double> length, std::optional<double> k, std::optional<double> d) {
  World<Dof>& world = with_bodies(self, i, j);
  require_used(world, k, d);
  return world.add_joint({.i = i, .j = j, .p_i = p_i, .p_j = p_j, .length = length, .k = k, .d = d});
}

template <int Dof>
int add_rope(PythonWorld<Dof>& self, int i, int j, double length, const Vec3& p_i, const Vec3& p_j,
             std::optional<double> k, std::optional<double> d) {
  return with_bodies(self, i, j)
      .add_joint({.i = i,
                  .j = j,
                  .p_i = p_i,
                  .p_j = p_j,
                  .length = length,
                  .k = k,
                  .kind = JointKind::rope,
                  .limit_d = d});
}

/// Converts a pair of numbers to a struct of two.
template <class Of>
std::optional<Of> pair_as(const std::optional<std::array<double, 2>>& pair) {
  if (!pair) return {};
  return Of{(*pair)[0], (*pair)[1]};
}

/// Stiffness, damping, and the rest coordinate. Default of each: 0.
using SpringNumbers = std::optional<std::vector<double>>;

std::optional<Spring> spring_of(const SpringNumbers& numbers) {
  if (!numbers) return {};
  if (numbers->empty() || numbers->size() > 3)
    throw std::invalid_argument("spring must have a stiffness, a damping and a rest, but has " +
                                std::to_string(numbers->size()) + " numbers");
  std::vector<double> all = *numbers;
  all.resize(3, 0.0);
  return Spring{.stiffness = all[0], .damping = all[1], .rest = all[2]};
}

/// Throws std::invalid_argument unless the lower limit comes first.
void require_in_order(const std::optional<std::array<double, 2>>& limits) {
  if (!limits || (*limits)[0] < (*limits)[1]) return;
  std::ostringstream text;
  text << "limits must be two numbers, the lower one first, but are " << (*limits)[0] << " and "
       << (*limits)[1];
  if ((*limits)[0] == (*limits)[1]) text << "; use a weld to lock a joint";
  throw std::invalid_argument(text.str());
}

/// Returns the world. Throws std::invalid_argument, naming the joint, for one that is no hinge or slider.
template <class World>
World& with_free_axis(World& world, int joint) {
  const Joint& found = world.joints()[require_index("joint", joint, world.joints().size())];
  if (!found.has_free_axis())
    throw std::invalid_argument("joint " + std::to_string(joint) +
                                " must be a hinge or slider, but is of kind " + name_of(found.kind));
  return world;
}

/// A hinge, slider or weld.
int add_guided(PythonWorld<6>& self, JointKind kind, int i, int j, const Vec3& p_i, const Vec3& p_j,
               const Vec3& axis, std::optional<std::array<double, 2>> limits,
               std::optional<std::array<double, 2>> motor, const SpringNumbers& spring, std::optional<double> k,
               std::optional<double> d, std::optional<double> k_turn) {
  World<6>& world = with_bodies(self, i, j);
  require_used(world, k, d, k_turn);
  require_in_order(limits);
  return world.add_joint({.i = i,
                          .j = j,
                          .p_i = p_i,
                          .p_j = p_j,
                          .k = k,
                          .d = d,
                          .kind = kind,
                          .axis = axis,
                          .k_turn = k_turn,
                          .limits = pair_as<JointLimits>(limits),
                          .spring = spring_of(spring),
                          .motor = pair_as<Motor>(motor)});
}

void bind_guided(Binding<6>& type) {
  using Self = PythonWorld<6>;
  const Vec3 zero = Vec3::Zero(), up = Vec3::UnitZ();
  const auto add = [](JointKind kind) {
    return [kind](Self& self, int i, int j, const Vec3& p_i, const Vec3& p_j, const Vec3& axis,
                  std::optional<std::array<double, 2>> limits, std::optional<std::array<double, 2>> motor,
                  std::optional<double> k, std::optional<double> d, std::optional<double> k_turn,
                  const SpringNumbers& spring) {
      return add_guided(self, kind, i, j, p_i, p_j, axis, limits, motor, spring, k, d, k_turn);
    };
  };
  const auto along = [](double (World<6>::*number)(int) const) {
    return [number](const World<6>& world, int joint) { return (with_free_axis(world, joint).*number)(joint); };
  };
  for (const JointKind kind : {JointKind::hinge, JointKind::slider})
    type.def("add_" + name_of(kind), add(kind), "i"_a, "j"_a, "p_i"_a = zero, "p_j"_a = zero, "axis"_a = up,
             "limits"_a = py::none(), "motor"_a = py::none(), "k"_a = py::none(), "d"_a = py::none(),
             "k_turn"_a = py::none(), "spring"_a = py::none());
  type.def(
          "add_weld",
          [](Self& self, int i, int j, const Vec3& p_i, const Vec3& p_j, std::optional<double> k,
             std::optional<double> d, std::optional<double> k_turn) {
            return add_guided(self, JointKind::weld, i, j, p_i, p_j, Vec3::UnitZ(), {}, {}, {}, k, d, k_turn);
          },
          "i"_a, "j"_a, "p_i"_a = zero, "p_j"_a = zero, "k"_a = py::none(), "d"_a = py::none(),
          "k_turn"_a = py::none())
      .def(
          "set_motor",
          [](Self& self, int joint, std::optional<std::array<double, 2>> motor) {
            with_free_axis(self.world(), joint).set_motor(joint, pair_as<Motor>(motor));
          },
          "joint"_a, "motor"_a)
      .def(
          "set_spring",
          [](Self& self, int joint, const SpringNumbers& spring) {
            with_free_axis(self.world(), joint).set_spring(joint, spring_of(spring));
          },
          "joint"_a, "spring"_a)
      .ask("joint_position", along(&World<6>::joint_position), "joint"_a)
      .ask("joint_speed", along(&World<6>::joint_speed), "joint"_a)
      .ask("joint_torque", std::mem_fn(&World<6>::joint_torque), "joint"_a)
      .ask("motor_force", along(&World<6>::motor_force), "joint"_a)
      .ask("limit_force", along(&World<6>::limit_force), "joint"_a)
      .ask("spring_force", along(&World<6>::spring_force), "joint"_a);
}

PythonWorld<3> make_points(const Vec3& gravity, std::optional<double> k, std::optional<double> d,
                           double friction, double viscosity, std::optional<double> restitution,
                           double threshold, const std::string& solver, const std::optional<std::string>& model,
                           const std::string& tangents, int iterations, double tolerance, bool warm_start,
                           std::optional<double> contact_margin, int integrator_order, int max_parts,
                           std::optional<int> soft_steps, std::optional<double> accuracy, int threads,
                           bool check) {
  return make<3>(gravity, k, d, friction, viscosity, restitution, threshold, solver, model, tangents,
                 iterations, tolerance, warm_start, contact_margin, integrator_order, max_parts, soft_steps,
                 accuracy, threads, check, "splitting");
}

/// `rest`: the parameters of this world only.
template <int Dof, class Make, class... Rest>
void bind_constructor(Binding<Dof>& type, const Make& make_world, const Rest&... rest) {
  type.type().def(py::init(make_world), type.documentation("__init__"), py::kw_only(),
                  "gravity"_a = Settings<Dof>{}.gravity, "k"_a = py::none(), "d"_a = py::none(),
                  "friction"_a = 0.0, "viscosity"_a = 1e12, "restitution"_a = py::none(),
                  "threshold"_a = ImpactLaw{}.threshold, "solver"_a = "auto", "friction_model"_a = py::none(),
                  "tangents"_a = "fixed", "iterations"_a = StopRule{}.max_sweeps, "tolerance"_a = 0.0,
                  "warm_start"_a = false, "contact_margin"_a = py::none(), "integrator_order"_a = 2,
                  "max_parts"_a = Settings<Dof>{}.max_parts, "soft_steps"_a = py::none(),
                  "accuracy"_a = py::none(), "threads"_a = 1, "check"_a = true, rest...);
}

/// Binds `step`. The second function takes calls whose arguments need a conversion, and explains those that none can
/// take. A wrapper in Python, as other functions have, would cost as much as the call.
template <int Dof>
void bind_step(Binding<Dof>& type) {
  using Self = PythonWorld<Dof>;
  const std::string text =
      std::string("step(h: float, steps: int = 1) -> None\n\n") + type.documentation("step");
  py::options options;
  options.disable_function_signatures();  // else the text lists both functions
  type.type()
      .def("step", &Self::step, text.c_str(), "h"_a, "steps"_a = 1)
      .def("_step", &Self::step, "h"_a, "steps"_a = 1)
      .def("step", [](const py::object& self, const py::args& given, const py::kwargs& named) {
        py::module_::import("spook.arguments").attr("step_otherwise")(self, given, named);
      });
}

template <int Dof>
void bind_both(Binding<Dof>& type, const char* name) {
  using Self = PythonWorld<Dof>;
  const Vec3 zero = Vec3::Zero();
  type.def(
          "add_plane",
          [](Self& self, const Vec3& n, double offset) {
            return self.bodies_of("add_plane").add_plane(n, offset);
          },
          "n"_a = Vec3(0, 0, 1), "offset"_a = 0.0)
      .def("remove_body", &Self::remove_body, "body"_a)
      .def("set_material", &set_material<Dof>, "body"_a, "other"_a = py::none(), py::kw_only(),
           "friction"_a = py::none(), "restitution"_a = py::none(), "k"_a = py::none(), "d"_a = py::none(),
           "rolling_resistance"_a = py::none(), "torsional_resistance"_a = py::none())
      .def(
          "exclude_contacts",
          [](Self& self, const std::vector<int>& bodies) { self.world().exclude_contacts(bodies); }, "bodies"_a)
      .def("add_joint", &add_joint<Dof>, "i"_a, "j"_a, "p_i"_a = zero, "p_j"_a = zero, "length"_a = py::none(),
           "k"_a = py::none(), "d"_a = py::none())
      .def("add_rope", &add_rope<Dof>, "i"_a, "j"_a, "length"_a, "p_i"_a = zero, "p_j"_a = zero,
           "k"_a = py::none(), "d"_a = py::none())
      .def(
          "remove_joint", [](Self& self, int joint) { self.world().remove_joint(joint); }, "joint"_a)
      .def(
          "apply_central_impulse",
          [](Self& self, int body, const Vec3& impulse) { self.moved().apply_central_impulse(body, impulse); },
          "body"_a, "impulse"_a)
      .def("place", &place<Dof>, "body"_a, "x"_a = py::none(), "v"_a = py::none())
      .def("place_all", &place_all<Dof>, py::kw_only(), "x"_a = py::none(), "v"_a = py::none())
      .def("save", [](const Self& self) { return Self(self); })
      .def("restore", &Self::restore, "saved"_a)
      .def("get_state", [](Self& self) { return py::bytes(self.bytes()); })
      .def(
          "set_state", [](Self& self, const py::bytes& state) { self.continue_from(state); }, "state"_a)
      .def(
          "move_fixed", [](Self& self, int body, const Vec3& x) { self.moved().move_fixed(body, x); }, "body"_a,
          "x"_a)
      .def(
          "set_surface_velocity",
          [](Self& self, int body, const Vec3& v) { self.moved().set_surface_velocity(body, v); }, "body"_a,
          "v"_a)
      .def(
          "start_half_step_back", [](Self& self, double h) { self.moved().start_half_step_back(h); }, "h"_a)
      .def(
          "start_consistently", [](Self& self, double h) { self.moved().start_consistently(h); }, "h"_a)
      .def(
          "synchronized_velocity",
          [](const Self& self, int body, double h) {
            require_positive("h", h);
            return self.world().synchronized_velocity(body, h);
          },
          "body"_a, "h"_a)
      .def(
          "velocity_lag",
          [](const Self& self, double h) {
            require_positive("h", h);
            return self.world().velocity_lag(h);
          },
          "h"_a)
      .property("work_of_drives", [](const Self& self) { return self.world().work_of_drives(); })
      .property("parts", [](const Self& self) { return self.world().parts(); })
      .property("time", [](const Self& self) { return self.world().time(); })
      .property("steps", [](const Self& self) { return self.world().steps(); })
      .property("masses", &masses<Dof>)
      .property("energy", &energy<Dof>)
      .property("state", [](const Self& self) { return self.state_name(); })
      .property("reason", &Self::reason)
      .property("note", &Self::note)
      .def("contacts", &contacts<Dof>)
      .def("impacts", &impacts<Dof>)
      .def("joints", &joints<Dof>)
      .def("joint_impulse", &joint_impulse<Dof>, "joint"_a)
      .ask("joint_force", std::mem_fn(&World<Dof>::joint_force), "joint"_a)
      .ask("contact_force", std::mem_fn(&World<Dof>::contact_force), "contact"_a)
      .def("cast_ray", &hit_by_ray<Dof>, "origin"_a, "direction"_a, "longest"_a = infinity)
      .def(
          "overlapping",
          [](const Self& self, const Vec3& centre, double radius) {
            return overlapping(self.world(), centre, radius);
          },
          "centre"_a, "radius"_a)
      .def("report", &report<Dof>);
  bind_step(type);
  type.view("x",
            [](const py::object& o, Self& self) { return self.views.of(self.world().bodies().x, 3, 0, o); });
  type.view("v", [](const py::object& o, Self& self) {
    return self.views.of(self.world().bodies().motion.W, 3, 0, o);
  });
  type.type()
      .def_readwrite("_given", &Self::given)
      .def("_content", &content<Dof>)
      .def("_fill", &fill<Dof>)
      .def("__len__", [](const Self& self) { return self.world().bodies().size(); })
      .def("__copy__", [](const Self& self) { return Self(self); })
      .def(
          "__deepcopy__", [](const Self& self, const py::dict&) { return Self(self); }, "memo"_a)
      .def("__repr__", [name](const Self& self) {
        const auto counted = [](std::size_t count, const char* one, const char* more) {
          return std::to_string(count) + " " + (count == 1 ? one : more);
        };
        return "<spook." + std::string(name) + ": " + counted(self.world().bodies().size(), "body", "bodies") +
               ", " + counted(self.world().joints().size(), "joint", "joints") + ", " +
               std::string(py::str("{:.9g}").format(self.world().time())) + " s>";
      });
}

void bind_points(py::module_& module) {
  const Vec3 zero = Vec3::Zero();
  Binding<3> type(module, "PointWorld");
  bind_constructor(type, &make_points);
  bind_both(type, "PointWorld");
  type.def("add", &add_point, py::kw_only(), "x"_a = zero, "v"_a = zero, "mass"_a = 1.0, "radius"_a = 0.0)
      .def(
          "add_fixed",
          [](PythonWorld<3>& self, const Vec3& x, double radius) {
            return self.bodies_of("add_fixed").add_fixed(x, radius);
          },
          "x"_a, "radius"_a = 0.0)
      .def(
          "set_force", [](PythonWorld<3>& self, int body, const Vec3& force) { self.put_load(body, force); },
          "body"_a, "force"_a)
      .def(
          "set_velocity",
          [](PythonWorld<3>& self, int body, const Vec3& v) { self.moved().set_velocity(body, v); }, "body"_a,
          "v"_a)
      .def("set_velocity_function", &set_velocity_function_of_points, "body"_a, "v"_a)
      .def(
          "set_keyframes",
          [](PythonWorld<3>& self, int body, const std::vector<double>& times, const Rows<3>& x) {
            set_keyframes<3>(self, body, times, x, {});
          },
          "body"_a, "times"_a, "x"_a);
}

void bind_rigid(py::module_& module) {
  const Vec3 zero = Vec3::Zero();
  const std::array<double, 4> upright{1, 0, 0, 0};
  Binding<6> type(module, "World");
  bind_constructor(type, &make<6>, "rotation"_a = "splitting");
  bind_both(type, "World");
  bind_guided(type);
  type.def("add", &add_rigid, py::kw_only(), "x"_a = zero, "v"_a = zero, "mass"_a = 1.0, "radius"_a = 0.0,
           "q"_a = upright, "omega"_a = zero, "principal"_a = py::none(), "half_length"_a = 0.0,
           "half_sides"_a = zero, "corners"_a = std::vector<Vec3>{})
      .def("add_fixed", &add_static, "x"_a, "radius"_a = 0.0, py::kw_only(), "q"_a = upright,
           "half_length"_a = 0.0, "half_sides"_a = zero)
      .def(
          "set_force",
          [](PythonWorld<6>& self, int body, const Vec3& force, const Vec3& torque) {
            Twist<6> load;
            load << force, torque;
            self.put_load(body, load);
          },
          "body"_a, "force"_a = zero, "torque"_a = zero)
      .def(
          "set_velocity",
          [](PythonWorld<6>& self, int body, const Vec3& v, const Vec3& omega) {
            self.moved().set_velocity(body, v, omega);
          },
          "body"_a, "v"_a, "omega"_a = zero)
      .def("set_velocity_function", &set_velocity_function, "body"_a, "v"_a, "omega"_a = py::none())
      .def("set_keyframes", &set_keyframes<6>, "body"_a, "times"_a, "x"_a, "q"_a = py::none())
      .def("turn", &turn, "body"_a, "q"_a = py::none(), "omega"_a = py::none())
      .def("turn_all", &turn_all, py::kw_only(), "q"_a = py::none(), "omega"_a = py::none())
      .def(
          "synchronized_angular_velocity",
          [](const PythonWorld<6>& self, int body, double h) {
            require_positive("h", h);
            return self.world().synchronized_angular_velocity(body, h);
          },
          "body"_a, "h"_a)
      .property("q", &orientations)
      .view("omega", [](const py::object& o, PythonWorld<6>& self) {
        return self.views.of(self.world().bodies().motion.W, 3, 3, o);
      });
}

}  // namespace

void bind_worlds(py::module_& module) {
  bind_points(module);
  bind_rigid(module);
}

}  // namespace spook
