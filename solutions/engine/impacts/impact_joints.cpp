#include "engine/impacts/impact_joints.hpp"

#include <algorithm>
#include <cmath>

#include "engine/constraints/joint_rows.hpp"
#include "engine/constraints/mechanisms.hpp"

namespace spook {

template <int Dof>
ImpactJoints<Dof>::ImpactJoints(const std::vector<Joint>& joints, const Bodies<Dof>& bodies) {
  if (joints.empty()) return;
  Mechanisms<Dof> mechanisms(joints, bodies);
  joints_.resize(bodies.size());
  for (const Joint& joint : joints) joints_[mechanisms.of(joint)].push_back(joint);
  for (int body = 0; body < std::ssize(joints_); ++body) mechanism_of_.push_back(mechanisms.of(body));
}

template <int Dof>
std::vector<Joint> ImpactJoints<Dof>::of(const std::vector<std::size_t>& bodies) const {
  if (joints_.empty()) return {};
  std::vector<int> numbers;
  for (const std::size_t body : bodies) numbers.push_back(mechanism_of_[body]);
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  std::vector<Joint> all;
  for (const int number : numbers) all.insert(all.end(), joints_[number].begin(), joints_[number].end());
  return all;
}

static constexpr double reached = 1e-6;  // of an extent

/// Returns the length of a rope, the range of a slider [m], or 1 rad for a hinge; 1 m for a range without an end.
static double extent_of(const Joint& joint) {
  if (joint.length) return *joint.length;
  const bool has_range = joint.kind == JointKind::slider && joint.limits;
  const double range = has_range ? joint.limits->upper - joint.limits->lower : 1;
  return std::isfinite(range) ? range : 1;
}

/// Makes the row of a joint one that takes impulses.
template <int Dof>
static void make_impulsive(const Joint& joint, double h, const Motion<Dof>& motion, Row<Dof>& row) {
  const bool is_one_sided = row.lo == 0;  // a limit, or a rope
  if (!is_one_sided) {
    row.B = 0;
    return;
  }
  const auto speed_of = [&](const std::vector<Twist<Dof>>& W) {
    return row.Gi.dot(W[row.i]) + row.Gj.dot(W[row.j]);
  };
  const double speed = speed_of(motion.W), change = speed_of(motion.Wf);
  // Where it is not reached, B is -g/h - G (W + W_f): engine/constraints/joint_rows.cpp.
  if (-h * (row.B + speed + change) > reached * extent_of(joint)) row.hi = 0;
  row.B = -(speed + change / 2);
}

template <int Dof>
std::vector<Row<Dof>> impact_rows(const std::vector<Joint>& joints, double h, const Bodies<Dof>& bodies) {
  std::vector<Row<Dof>> rows, taking;
  add_joint_rows(joints, h, bodies, rows);
  auto row = rows.begin();
  for (const Joint& joint : joints) {
    const auto end = row + joint.rows();
    for (const auto drives = row + joint.spring_row(); row < drives; ++row) {
      make_impulsive(joint, h, bodies.motion, *row);
      taking.push_back(*row);
    }
    row = end;
  }
  return taking;
}

template class ImpactJoints<3>;
template class ImpactJoints<6>;
template std::vector<Row<3>> impact_rows<3>(const std::vector<Joint>&, double, const Bodies<3>&);
template std::vector<Row<6>> impact_rows<6>(const std::vector<Joint>&, double, const Bodies<6>&);

}  // namespace spook
