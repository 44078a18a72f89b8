// spook.World and spook.PointWorld: a world of the engine, with arrays to look at it.
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "common/require.hpp"
#include "engine/support/did_you_mean.hpp"
#include "engine/world/world.hpp"
#include "module.hpp"
#include "scenes/method.hpp"
#include "views.hpp"

namespace spook {

namespace {

using namespace py::literals;
using MaybeVec3 = std::optional<Vec3>;

/// Steps between two looks at Ctrl-C.
constexpr std::int64_t patience = 1024;

/// What Python puts on each body; a world without any has none of it. The world's copy has a copy.
template <int Dof>
class Loads {
 public:
  Loads() : loads_(std::make_shared<std::vector<Twist<Dof>>>()) {}
  Loads(const Loads& other) : loads_(std::make_shared<std::vector<Twist<Dof>>>(*other.loads_)) {}
  Loads& operator=(const Loads&) = delete;
  Twist<Dof> operator()(std::size_t i, const Bodies<Dof>&, double) const {
    return i < loads_->size() ? (*loads_)[i] : Twist<Dof>::Zero().eval();
  }
  void set(std::size_t i, const Twist<Dof>& load) const {
    if (i >= loads_->size()) loads_->resize(i + 1, Twist<Dof>::Zero());
    (*loads_)[i] = load;
  }

 private:
  std::shared_ptr<std::vector<Twist<Dof>>> loads_;
};

template <int Dof>
struct PythonWorld {
  World<Dof> world;
  Views views = {};

  PythonWorld(World<Dof> made) : world(std::move(made)) {}
  PythonWorld(const PythonWorld& other) : world(other.world) {}

  /// Throws std::invalid_argument for what is not finite, and for a body that does not move.
  void put_load(int body, const Twist<Dof>& load) {
    const std::size_t i = world.index(body);
    if (world.bodies().is_fixed(i))
      throw std::invalid_argument("body must be one that moves, but is " + std::to_string(body));
    require_all_finite("force", load.template head<3>());
    if constexpr (Dof == 6) require_all_finite("torque", load.template tail<3>());
    if (!world.settings().wrench) world.set_wrench(Loads<Dof>());
    world.settings().wrench.template target<Loads<Dof>>()->set(i, load);
  }
};

template <int Dof>
PythonWorld<Dof> make(const Vec3& gravity, std::optional<double> k, std::optional<double> d, double friction,
                      double viscosity, std::optional<double> restitution, double threshold,
                      const std::string& solver, const std::optional<std::string>& model, int iterations,
                      double tolerance, bool warm_start, std::optional<double> contact_margin, int threads) {
  if (iterations < 1)
    throw std::invalid_argument("iterations must be at least 1, but is " + std::to_string(iterations));
  Method method{.h = 1, .solver = solver};
  if (model) method.friction_model = find_friction_model(*model);
  Settings<Dof> settings{.gravity = gravity,
                         .k = k,
                         .d = d,
                         .friction = friction,
                         .viscosity = viscosity,
                         .solver = make_solver<Dof>(method),
                         .warm_start = warm_start,
                         .contact_margin = contact_margin,
                         .threads = threads,
                         .solver_limits = {.max_sweeps = iterations, .tolerance = tolerance}};
  if (restitution)
    settings.impacts = ImpactLaw{.restitution = *restitution, .friction = friction, .threshold = threshold};
  return World<Dof>(std::move(settings));
}

template <int Dof>
void step(PythonWorld<Dof>& self, double h, std::int64_t steps) {
  if (steps < 0) throw std::invalid_argument("steps must be at least 0, but is " + std::to_string(steps));
  for (std::int64_t n = 1; n <= steps; ++n) {
    self.world.step(h);
    if (n % patience == 0 && PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
}

/// What is left out stays as it is.
template <int Dof>
void place(PythonWorld<Dof>& self, int body, const MaybeVec3& x, const MaybeVec3& v) {
  self.world.place(body, x.value_or(self.world.x(body)), v.value_or(self.world.v(body)));
}

void turn(PythonWorld<6>& self, int body, const std::optional<std::array<double, 4>>& q,
          const MaybeVec3& omega) {
  const Quat turned = q ? Quat((*q)[0], (*q)[1], (*q)[2], (*q)[3]) : orientation(self.world, body);
  self.world.turn(body, turned, omega.value_or(angular_velocity(self.world, body)));
}

int add_point(PythonWorld<3>& self, const Vec3& x, const Vec3& v, double mass, double radius) {
  self.views.require_none("add");
  return self.world.add({.x = x, .v = v, .mass = mass, .radius = radius});
}

int add_rigid(PythonWorld<6>& self, const Vec3& x, const Vec3& v, double mass, double radius,
              const std::array<double, 4>& q, const Vec3& omega, const MaybeVec3& principal, double half_length,
              const Vec3& half_sides, const std::vector<Vec3>& corners) {
  self.views.require_none("add");
  return self.world.add({.x = x,
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

py::array_t<double> orientations(const PythonWorld<6>& self) {
  const std::vector<Quat>& q = self.world.bodies().orientations.q;
  py::array_t<double> copy({static_cast<py::ssize_t>(q.size()), py::ssize_t{4}});
  auto to = copy.mutable_unchecked<2>();
  for (py::ssize_t i = 0; i < to.shape(0); ++i) {
    const Quat& from = q[static_cast<std::size_t>(i)];
    to(i, 0) = from.w();
    for (py::ssize_t axis = 0; axis < 3; ++axis) to(i, axis + 1) = from.vec()[axis];
  }
  return copy;
}

/// The contacts of the last step, an array of each of their numbers.
template <int Dof>
py::dict contacts(const PythonWorld<Dof>& self) {
  const World<Dof>& world = self.world;
  const auto n = static_cast<Eigen::Index>(world.contacts().size());
  Eigen::VectorXi i(n), j(n);
  Eigen::VectorXd gap(n), normal_impulse(n);
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> point(n, 3), normal(n, 3), impulse(n, 3);
  for (int c = 0; c < n; ++c) {
    const Contact& contact = world.contacts()[static_cast<std::size_t>(c)];
    i[c] = contact.i;
    j[c] = contact.j;
    gap[c] = contact.gap;
    point.row(c) = world.x(contact.i) + contact.r_i;
    normal.row(c) = contact.n;
    normal_impulse[c] = world.lambda(c);
    impulse.row(c) = world.impulse(c);
  }
  return py::dict("i"_a = i, "j"_a = j, "gap"_a = gap, "point"_a = point, "normal"_a = normal,
                  "normal_impulse"_a = normal_impulse, "impulse"_a = impulse);
}

template <int Dof>
py::dict report(const PythonWorld<Dof>& self) {
  const StepReport last = self.world.report();
  return py::dict("pairs"_a = last.pairs, "contacts"_a = last.contacts, "impacts"_a = last.impacts,
                  "rows"_a = last.rows, "iterations"_a = last.iterations, "residual"_a = last.residual,
                  "trouble"_a = last.trouble);
}

template <int Dof>
int add_joint(PythonWorld<Dof>& self, int i, int j, const Vec3& p_i, const Vec3& p_j,
              std::optional<double> length, std::optional<double> k, std::optional<double> d) {
  return self.world.add_joint({.i = i, .j = j, .p_i = p_i, .p_j = p_j, .length = length, .k = k, .d = d});
}

/// A pair of numbers as a struct of theirs.
template <class Of>
std::optional<Of> pair_as(const std::optional<std::array<double, 2>>& pair) {
  if (!pair) return {};
  return Of{(*pair)[0], (*pair)[1]};
}

/// A hinge, slider or weld.
int add_guided(PythonWorld<6>& self, JointKind kind, int i, int j, const Vec3& p_i, const Vec3& p_j,
               const Vec3& axis, std::optional<std::array<double, 2>> limits,
               std::optional<std::array<double, 2>> motor, std::optional<double> k, std::optional<double> d,
               std::optional<double> k_turn) {
  return self.world.add_joint({.i = i,
                               .j = j,
                               .p_i = p_i,
                               .p_j = p_j,
                               .k = k,
                               .d = d,
                               .kind = kind,
                               .axis = axis,
                               .k_turn = k_turn,
                               .limits = pair_as<JointLimits>(limits),
                               .motor = pair_as<Motor>(motor)});
}

void bind_guided(py::class_<PythonWorld<6>>& type) {
  using Self = PythonWorld<6>;
  const Vec3 zero = Vec3::Zero(), up = Vec3::UnitZ();
  const auto add = [](JointKind kind) {
    return [kind](Self& self, int i, int j, const Vec3& p_i, const Vec3& p_j, const Vec3& axis,
                  std::optional<std::array<double, 2>> limits, std::optional<std::array<double, 2>> motor,
                  std::optional<double> k, std::optional<double> d, std::optional<double> k_turn) {
      return add_guided(self, kind, i, j, p_i, p_j, axis, limits, motor, k, d, k_turn);
    };
  };
  for (const JointKind kind : {JointKind::hinge, JointKind::slider})
    type.def(("add_" + name_of(kind)).c_str(), add(kind), "i"_a, "j"_a, "p_i"_a = zero, "p_j"_a = zero,
             "axis"_a = up, "limits"_a = py::none(), "motor"_a = py::none(), "k"_a = py::none(),
             "d"_a = py::none(), "k_turn"_a = py::none());
  type.def(
          "add_weld",
          [](Self& self, int i, int j, const Vec3& p_i, const Vec3& p_j, std::optional<double> k,
             std::optional<double> d, std::optional<double> k_turn) {
            return add_guided(self, JointKind::weld, i, j, p_i, p_j, Vec3::UnitZ(), {}, {}, k, d, k_turn);
          },
          "i"_a, "j"_a, "p_i"_a = zero, "p_j"_a = zero, "k"_a = py::none(), "d"_a = py::none(),
          "k_turn"_a = py::none())
      .def(
          "set_motor",
          [](Self& self, int joint, std::optional<std::array<double, 2>> motor) {
            self.world.set_motor(joint, pair_as<Motor>(motor));
          },
          "joint"_a, "motor"_a)
      .def(
          "joint_position", [](const Self& self, int joint) { return self.world.joint_position(joint); },
          "joint"_a)
      .def(
          "joint_speed", [](const Self& self, int joint) { return self.world.joint_speed(joint); }, "joint"_a)
      .def(
          "joint_torque", [](const Self& self, int joint) { return self.world.joint_torque(joint); }, "joint"_a)
      .def(
          "motor_force", [](const Self& self, int joint) { return self.world.motor_force(joint); }, "joint"_a)
      .def(
          "limit_force", [](const Self& self, int joint) { return self.world.limit_force(joint); }, "joint"_a);
}

template <int Dof>
Eigen::VectorXd joint_impulse(const PythonWorld<Dof>& self, int joint) {
  const auto& joints = self.world.joints();
  const bool known = joint >= 0 && joint < static_cast<int>(joints.size());
  Eigen::VectorXd lambda(known ? joints[static_cast<std::size_t>(joint)].rows() : 1);
  for (int row = 0; row < lambda.size(); ++row) lambda[row] = self.world.joint_lambda(joint, row);
  return lambda;
}

template <int Dof>
py::class_<PythonWorld<Dof>> bind(py::module_& module, const char* name, const char* what) {
  using Self = PythonWorld<Dof>;
  const Vec3 zero = Vec3::Zero();
  py::class_<Self> type(module, name, what);
  type.def(py::init(&make<Dof>), py::kw_only(), "gravity"_a = Settings<Dof>{}.gravity, "k"_a = py::none(),
           "d"_a = py::none(), "friction"_a = 0.0, "viscosity"_a = 1e12, "restitution"_a = py::none(),
           "threshold"_a = ImpactLaw{}.threshold, "solver"_a = "auto", "friction_model"_a = py::none(),
           "iterations"_a = StopRule{}.max_sweeps, "tolerance"_a = 0.0, "warm_start"_a = false,
           "contact_margin"_a = py::none(), "threads"_a = 1)
      .def(
          "add_fixed",
          [](Self& self, const Vec3& x, double radius) {
            self.views.require_none("add_fixed");
            return self.world.add_fixed(x, radius);
          },
          "x"_a, "radius"_a = 0.0)
      .def(
          "add_plane",
          [](Self& self, const Vec3& n, double offset) {
            self.views.require_none("add_plane");
            return self.world.add_plane(n, offset);
          },
          "n"_a = Vec3(0, 0, 1), "offset"_a = 0.0)
      .def("add_joint", &add_joint<Dof>, "i"_a, "j"_a, "p_i"_a = zero, "p_j"_a = zero, "length"_a = py::none(),
           "k"_a = py::none(), "d"_a = py::none())
      .def(
          "remove_joint", [](Self& self, int joint) { self.world.remove_joint(joint); }, "joint"_a)
      .def(
          "apply_central_impulse",
          [](Self& self, int body, const Vec3& impulse) { self.world.apply_central_impulse(body, impulse); },
          "body"_a, "impulse"_a)
      .def("place", &place<Dof>, "body"_a, "x"_a = py::none(), "v"_a = py::none())
      .def(
          "move_fixed", [](Self& self, int body, const Vec3& x) { self.world.move_fixed(body, x); }, "body"_a,
          "x"_a)
      .def(
          "start_half_step_back", [](Self& self, double h) { self.world.start_half_step_back(h); }, "h"_a)
      .def(
          "start_consistently", [](Self& self, double h) { self.world.start_consistently(h); }, "h"_a)
      .def(
          "synchronized_velocity",
          [](const Self& self, int body, double h) { return self.world.synchronized_velocity(body, h); },
          "body"_a, "h"_a)
      .def("step", &step<Dof>, "h"_a, "steps"_a = 1)
      .def_property_readonly("time", [](const Self& self) { return self.world.time(); })
      .def_property_readonly("steps", [](const Self& self) { return self.world.steps(); })
      .def("contacts", &contacts<Dof>)
      .def("joint_impulse", &joint_impulse<Dof>, "joint"_a)
      .def(
          "joint_force", [](const Self& self, int joint) { return self.world.joint_force(joint); }, "joint"_a)
      .def("report", &report<Dof>)
      .def("__len__", [](const Self& self) { return self.world.bodies().size(); })
      .def("__copy__", [](const Self& self) { return Self(self); })
      .def(
          "__deepcopy__", [](const Self& self, const py::dict&) { return Self(self); }, "memo"_a)
      .def("__repr__", [name](const Self& self) {
        return "<spook." + std::string(name) + ": " + std::to_string(self.world.bodies().size()) + " bodies, " +
               std::to_string(self.world.joints().size()) + " joints, " +
               py::repr(py::float_(self.world.time())).cast<std::string>() + " s>";
      });
  const auto view = [&type](const char* property, const auto& show) {
    type.def_property_readonly(property,
                               [show](const py::object& object) { return show(object, object.cast<Self&>()); });
  };
  view("x", [](const py::object& o, Self& self) { return self.views.of(self.world.bodies().x, 3, 0, o); });
  view("v",
       [](const py::object& o, Self& self) { return self.views.of(self.world.bodies().motion.W, 3, 0, o); });
  if constexpr (Dof == 6)
    view("omega",
         [](const py::object& o, Self& self) { return self.views.of(self.world.bodies().motion.W, 3, 3, o); });
  return type;
}

}  // namespace

void bind_worlds(py::module_& module) {
  const Vec3 zero = Vec3::Zero();
  bind<3>(module, "PointWorld", "Point masses, by the SPOOK method.")
      .def("add", &add_point, py::kw_only(), "x"_a = zero, "v"_a = zero, "mass"_a = 1.0, "radius"_a = 0.0)
      .def(
          "set_force", [](PythonWorld<3>& self, int body, const Vec3& force) { self.put_load(body, force); },
          "body"_a, "force"_a);
  py::class_<PythonWorld<6>> rigid = bind<6>(module, "World", "Rigid bodies, by the SPOOK method.");
  bind_guided(rigid);
  rigid
      .def("add", &add_rigid, py::kw_only(), "x"_a = zero, "v"_a = zero, "mass"_a = 1.0, "radius"_a = 0.0,
           "q"_a = std::array<double, 4>{1, 0, 0, 0}, "omega"_a = zero, "principal"_a = py::none(),
           "half_length"_a = 0.0, "half_sides"_a = zero, "corners"_a = std::vector<Vec3>{})
      .def(
          "set_force",
          [](PythonWorld<6>& self, int body, const Vec3& force, const Vec3& torque) {
            Twist<6> load;
            load << force, torque;
            self.put_load(body, load);
          },
          "body"_a, "force"_a = zero, "torque"_a = zero)
      .def("turn", &turn, "body"_a, "q"_a = py::none(), "omega"_a = py::none())
      .def(
          "synchronized_angular_velocity",
          [](const PythonWorld<6>& self, int body, double h) {
            return self.world.synchronized_angular_velocity(body, h);
          },
          "body"_a, "h"_a)
      .def_property_readonly("q", &orientations);
}

}  // namespace spook
