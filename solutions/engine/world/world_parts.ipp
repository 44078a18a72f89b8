// Division of a step: engine/constraints/step_parts.hpp.
#include <algorithm>

namespace spook {

/// Returns the power of two that is not below `parts`, at most the largest number; other numbers would change the step
/// more often.
static int rounded_up(double parts, int most) {
  int power = 1;
  while (power < std::min<double>(parts, most)) power *= 2;
  return power;
}

template <int Dof>
bool World<Dof>::may_divide_steps() const {
  const auto has_default_k = [](const Joint& joint) { return joint.has_default_k; };
  return settings_.max_parts > 1 && std::any_of(joints_.begin(), joints_.end(), has_default_k);
}

/// Divides more as soon as joints need it, and less after a hundred steps that needed no more than half. What the last
/// part needed is known; if bodies or motors have been changed since, the step is taken again.
template <int Dof>
void World<Dof>::divide_steps(double h, bool divides) {
  if (settings_.soft_steps) {
    parts_ = settings_.soft_steps->substeps;
    return;
  }
  if (!divides && parts_ == 1) return;
  const double needed = !divides ? 1 : rows().empty() ? parts_needed_at_first(h) : parts_per_second_ * h;
  const int parts = rounded_up(needed, settings_.max_parts);
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

/// Divides the present step into more parts if the part that has just ended needs them, as when a chain snaps taut. If
/// even the largest number of parts is too small, joints close their gaps as slowly as in a step of the length that
/// they need.
template <int Dof>
bool World<Dof>::divide_more(double h) {
  const double needed = parts_needed_now(h);
  parts_per_second_ = needed / h;
  if (needed > settings_.max_parts) gap_step_ = std::max(gap_step_, needed / settings_.max_parts * h_);
  const int parts = rounded_up(needed, settings_.max_parts);
  if (parts <= parts_) return false;
  parts_ = parts;
  return true;
}

/// Saves the state that a step changes, for go_back(). Values that the first stages compute anew are left out.
template <int Dof>
void World<Dof>::remember_state() {
  BeforeStep& before = *before_step_;
  before.x = bodies_.x;
  before.W = bodies_.motion.W;
  if constexpr (Dof == 6) before.q = bodies_.orientations.q;
  before.V = V_;
  before.angles.clear();
  for (const std::size_t hinge : hinges_) before.angles.push_back(joints_[hinge].angle);
  before.recovered.clear();
  for (const Joint& joint : joints_) before.recovered.push_back(joint.recovered);
  before.last_impulses = last_impulses_;
  before.time = time_;
  before.h = h_;
  before.gap_step = gap_step_;
  before.force_of_drives = force_of_drives_;
}

template <int Dof>
void World<Dof>::go_back() {
  const BeforeStep& before = *before_step_;
  bodies_.x = before.x;
  bodies_.motion.W = before.W;
  if constexpr (Dof == 6) bodies_.orientations.q = before.q;
  V_ = before.V;
  for (std::size_t n = 0; n < hinges_.size(); ++n) joints_[hinges_[n]].angle = before.angles[n];
  for (std::size_t n = 0; n < joints_.size(); ++n) joints_[n].recovered = before.recovered[n];
  last_impulses_ = before.last_impulses;
  time_ = before.time;
  h_ = before.h;
  gap_step_ = before.gap_step;
  force_of_drives_ = before.force_of_drives;
  impacts_.clear();
  work_of_drives_ = 0;
}

/// Returns the least relaxation of joints in a part of `h` after larger ones [parts]. The gaps of joints grow with the
/// square of the step, and a is 2/h: a smaller part would close the gaps of a larger one with a large speed -a g. So a
/// begins with the value of the larger part, and increases to that of this one.
template <int Dof>
double World<Dof>::least_relaxation(double h) const {
  return gap_step_ > h ? relaxation_of_joints * (2 * gap_step_ / h - 1) : 0;
}

/// Finds the forces of joints before the first step, by a solve without a motion, and returns the number of parts that
/// they need. Bodies, warm start and time are as before.
template <int Dof>
double World<Dof>::parts_needed_at_first(double h) {
  const double last_h = h_;
  WarmStartCache start = last_impulses_;
  evaluate_forces(h);
  set_default_stiffness(h);
  build_rows(h);
  solve_rows(h);
  h_ = h;
  const double needed = parts_needed_now(h);
  forget_the_last_step();
  last_impulses_ = std::move(start);
  h_ = last_h;
  return needed;
}

}  // namespace spook
