#pragma once
// The parts of a world and the results of its last step, as NumPy arrays. These are copies, since contacts and rows are
// made anew in each step.
#include <pybind11/eigen.h>

#include <limits>

#include "engine/bodies/conserved_quantities.hpp"
#include "engine/diagnostics/spring_energy.hpp"
#include "python_world.hpp"

namespace spook {

using namespace py::literals;

inline py::array_t<double> orientations(const PythonWorld<6>& self) {
  const std::vector<Quat>& q = self.world().bodies().orientations.q;
  py::array_t<double> copy({static_cast<py::ssize_t>(q.size()), py::ssize_t{4}});
  auto to = copy.mutable_unchecked<2>();
  for (py::ssize_t i = 0; i < to.shape(0); ++i) {
    const Quat& from = q[static_cast<std::size_t>(i)];
    to(i, 0) = from.w();
    for (py::ssize_t axis = 0; axis < 3; ++axis) to(i, axis + 1) = from.vec()[axis];
  }
  return copy;
}

/// The contacts of the last step, with an array for each number.
template <int Dof>
py::dict contacts(const PythonWorld<Dof>& self) {
  const World<Dof>& world = self.world();
  const auto n = static_cast<Eigen::Index>(world.contacts().size());
  Eigen::VectorXi i(n), j(n);
  Eigen::VectorXd gap(n), normal_impulse(n);
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> point(n, 3), normal(n, 3), impulse(n, 3),
      force(n, 3);
  for (int c = 0; c < n; ++c) {
    const Contact& contact = world.contacts()[static_cast<std::size_t>(c)];
    i[c] = contact.i;
    j[c] = contact.j;
    gap[c] = contact.gap;
    point.row(c) = world.x(contact.i) + contact.r_i;
    normal.row(c) = contact.n;
    normal_impulse[c] = world.lambda(c);
    impulse.row(c) = world.impulse(c);
    force.row(c) = world.contact_force(c);
  }
  return py::dict("i"_a = i, "j"_a = j, "gap"_a = gap, "point"_a = point, "normal"_a = normal,
                  "normal_impulse"_a = normal_impulse, "impulse"_a = impulse, "force"_a = force);
}

/// The impacts of the last step, with an array for each number.
template <int Dof>
py::dict impacts(const PythonWorld<Dof>& self) {
  const std::vector<Impact>& all = self.world().impacts();
  const auto n = static_cast<Eigen::Index>(all.size());
  Eigen::VectorXi i(n), j(n);
  Eigen::VectorXd speed(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Impact& impact = all[static_cast<std::size_t>(k)];
    i[k] = impact.i;
    j[k] = impact.j;
    speed[k] = impact.speed;
  }
  return py::dict("i"_a = i, "j"_a = j, "speed"_a = speed);
}

/// The joints, with an array for each number.
template <int Dof>
py::dict joints(const PythonWorld<Dof>& self) {
  const World<Dof>& world = self.world();
  const auto n = static_cast<Eigen::Index>(world.joints().size());
  py::list kind;
  Eigen::VectorXi i(n), j(n);
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> force(n, 3), torque(n, 3);
  const double none = std::numeric_limits<double>::quiet_NaN();
  Eigen::VectorXd position = Eigen::VectorXd::Constant(n, none), speed = position;
  for (int c = 0; c < n; ++c) {
    const Joint& joint = world.joints()[static_cast<std::size_t>(c)];
    kind.append(name_of(joint.kind));
    i[c] = joint.i;
    j[c] = joint.j;
    force.row(c) = world.joint_force(c);
    if constexpr (Dof == 6) {
      torque.row(c) = world.joint_torque(c);
      if (joint.has_free_axis()) {
        position[c] = world.joint_position(c);
        speed[c] = world.joint_speed(c);
      }
    }
  }
  py::dict all("kind"_a = kind, "i"_a = i, "j"_a = j, "force"_a = force);
  if constexpr (Dof == 6) {
    all["torque"] = torque;
    all["position"] = position;
    all["speed"] = speed;
  }
  return all;
}

template <int Dof>
py::dict energy(const PythonWorld<Dof>& self) {
  const World<Dof>& world = self.world();
  return py::dict("kinetic"_a = kinetic_energy(world.bodies()),
                  "potential"_a = potential_energy(world.bodies(), world.settings().gravity),
                  "springs"_a = spring_energy(world, self.last_h()));
}

/// Infinite for a static body.
template <int Dof>
Eigen::VectorXd masses(const PythonWorld<Dof>& self) {
  const auto& inverse = self.world().bodies().motion.inverse_mass;
  Eigen::VectorXd all(static_cast<Eigen::Index>(inverse.size()));
  for (Eigen::Index i = 0; i < all.size(); ++i) all[i] = 1 / inverse[static_cast<std::size_t>(i)].linear;
  return all;
}

template <int Dof>
py::dict report(const PythonWorld<Dof>& self) {
  const StepReport last = self.world().report();
  return py::dict("pairs"_a = last.pairs, "contacts"_a = last.contacts, "impacts"_a = last.impacts,
                  "rows"_a = last.rows, "iterations"_a = last.iterations, "residual"_a = last.residual,
                  "trouble"_a = last.trouble);
}

template <int Dof>
Eigen::VectorXd joint_impulse(const PythonWorld<Dof>& self, int joint) {
  const auto& joints = self.world().joints();
  const bool known = joint >= 0 && joint < static_cast<int>(joints.size());
  Eigen::VectorXd lambda(known ? joints[static_cast<std::size_t>(joint)].rows() : 1);
  for (int row = 0; row < lambda.size(); ++row) lambda[row] = self.world().joint_lambda(joint, row);
  return lambda;
}

}  // namespace spook
