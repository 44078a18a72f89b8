#include "engine/impacts/impact_joints.hpp"

#include <algorithm>

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

static constexpr double reached = 1e-6;  // [m or rad]

template <int Dof>
std::vector<Row<Dof>> impact_rows(const std::vector<Joint>& joints, double h, const Bodies<Dof>& bodies) {
  std::vector<Row<Dof>> rows, taking;
  add_joint_rows(joints, h, bodies, rows);
  auto first = rows.begin();
  for (const Joint& joint : joints) {
    taking.insert(taking.end(), first, first + joint.spring_row());
    first += joint.rows();
  }
  const auto speed_of = [&](const Row<Dof>& row, const std::vector<Twist<Dof>>& of) {
    return row.Gi.dot(of[row.i]) + row.Gj.dot(of[row.j]);
  };
  const Motion<Dof>& motion = bodies.motion;
  for (Row<Dof>& row : taking) {
    const bool is_one_sided = row.lo == 0;
    const double u = speed_of(row, motion.W) + speed_of(row, motion.Wf) / 2;
    // Where it is not reached, its B is -g/h - G (W + W_f): engine/constraints/joint_rows.cpp.
    const double gap = -h * (row.B + speed_of(row, motion.W) + speed_of(row, motion.Wf));
    if (is_one_sided && gap > reached) row.hi = 0;
    row.B = is_one_sided ? -u : 0;
  }
  return taking;
}

template class ImpactJoints<3>;
template class ImpactJoints<6>;
template std::vector<Row<3>> impact_rows<3>(const std::vector<Joint>&, double, const Bodies<3>&);
template std::vector<Row<6>> impact_rows<6>(const std::vector<Joint>&, double, const Bodies<6>&);

}  // namespace spook
