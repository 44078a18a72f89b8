// How a step is divided: engine/constraints/step_parts.hpp.
#include <algorithm>

namespace spook {

/// Divides more as soon as joints need it, and less after a hundred steps that needed no more than half.
template <int Dof>
void World<Dof>::divide_steps(double h) {
  if (settings_.soft_steps) {
    parts_ = settings_.soft_steps->substeps;
    return;
  }
  const auto has_default_k = [](const Joint& joint) { return joint.has_default_k; };
  if (settings_.max_parts == 1 || std::none_of(joints_.begin(), joints_.end(), has_default_k)) return;
  const double needed = rows().empty() ? parts_needed_at_first(h) : parts_needed_now(h);
  int parts = 1;  // powers of two: other numbers would change the step more often
  while (parts < std::min<double>(needed, settings_.max_parts)) parts *= 2;
  calm_steps_ = parts < parts_ ? calm_steps_ + 1 : 0;
  if (parts > parts_) parts_ = parts;
  if (calm_steps_ < 100) return;
  parts_ /= 2;
  calm_steps_ = 0;
}

template <int Dof>
double World<Dof>::parts_needed_now(double h) const {
  return parts_needed<Dof>(joints_, bodies_, h, [&](int joint) { return joint_force(joint).norm(); });
}

/// Finds the forces of joints that no step has found yet, by a step that is not taken. The world is as before.
template <int Dof>
double World<Dof>::parts_needed_at_first(double h) {
  const double last_h = h_;
  WarmStartCache start = start_;
  evaluate_forces(h);
  set_default_stiffness(h);
  build_rows(h);
  solve_rows(h);
  h_ = h;
  const double needed = parts_needed_now(h);
  forget_the_last_step();
  start_ = std::move(start);
  h_ = last_h;
  return needed;
}

}  // namespace spook
