#include "engine/diagnostics/run_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

#include "10_convergence/convergence.hpp"
#include "engine/diagnostics/passing_points.hpp"
#include "engine/diagnostics/tunnelling.hpp"
#include "engine/diagnostics/understatement.hpp"

namespace spook {

static constexpr double share_unsolved = 1e-2;    // of the right-hand side
static constexpr double stalled_rate = 1 - 1e-4;  // of a solver that does not converge
static constexpr int least_history = 10;          // iterations that show its rate
static constexpr double share_of_roundings =
    16 * std::numeric_limits<double>::epsilon();  // of the twelve products of a row
static constexpr double share_of_size = 0.01;
static constexpr double share_kept = 0.9;  // of a sag from step to step
static constexpr double found_late = 2;    // overlap of a new contact over a size, which is half a thickness
static constexpr int most_deep_steps = 10, most_sagging_steps = 10;

std::string name_of(State state) {
  return std::array{"sound", "unsolved", "lost"}[static_cast<std::size_t>(state)];
}

/// Returns a number as text, with three digits.
static std::string text(double value) {
  std::ostringstream out;
  out.precision(3);
  out << value;
  return out.str();
}

static std::string bodies_text(const Contact& contact) {
  return "bodies " + std::to_string(contact.i) + " and " + std::to_string(contact.j);
}

static double size_of(const Joint& joint) {
  return joint.length ? *joint.length : joint.p_i.norm() + joint.p_j.norm();
}

/// Returns the largest size of bodies and joints [m]; 0 if there is none.
static double largest_size(const std::vector<double>& sizes, const std::vector<Joint>& joints) {
  double largest = 0;
  for (const double size : sizes)
    if (std::isfinite(size)) largest = std::max(largest, size);
  for (const Joint& joint : joints) largest = std::max(largest, size_of(joint));
  return largest;
}

/// Returns the smallest size of bodies and joints [m]; 0 if there is none.
static double smallest_size(const std::vector<double>& sizes, const std::vector<Joint>& joints) {
  double smallest = infinity;
  for (const double size : sizes)
    if (size > 0) smallest = std::min(smallest, size);
  for (const Joint& joint : joints)
    if (size_of(joint) > 0) smallest = std::min(smallest, size_of(joint));
  return std::isfinite(smallest) ? smallest : 0;
}

/// Tells whether the residual rises tenfold in the second half of the history, from which its rate is computed. Then
/// several methods were tried, each from the start, and there is no rate.
static bool begins_anew(const std::vector<double>& history) {
  double least = infinity;
  for (std::size_t k = history.size() / 2; k < history.size(); ++k) {
    if (history[k] > 10 * least) return true;
    least = std::min(least, history[k]);
  }
  return false;
}

/// Returns an upper bound of the products of a row's Jacobian with velocities [m/s]. The rows of a stepper are not known;
/// they are taken for unit ones.
template <int Dof>
static double fastest_products(const World<Dof>& world) {
  double longest = world.settings().stepper ? 1 : 0, fastest = 0;
  for (const Row<Dof>& row : world.rows())
    longest = std::max({longest, row.Gi.squaredNorm(), row.Gj.squaredNorm()});
  for (const Twist<Dof>& W : world.bodies().motion.W) fastest = std::max(fastest, W.squaredNorm());
  return 2 * std::sqrt(longest * fastest);
}

/// Returns the largest right-hand side of the rows of the last step, or velocity change by forces in a step [m/s].
template <int Dof>
static double right_hand_side(const World<Dof>& world, double h) {
  const Bodies<Dof>& bodies = world.bodies();
  double asked = rhs_norm(world.rows());
  for (std::size_t i = 0; i < bodies.size(); ++i)
    asked = std::max(asked, h * bodies.motion.inverse_mass[i].linear * world.forces()[i].norm());
  if (world.settings().stepper)
    for (const Twist<Dof>& W : bodies.motion.W) asked = std::max(asked, W.template head<3>().norm());
  return asked;
}

/// Tells whether indices mean the same bodies as at the last check. A check whose state was just read, and which has no
/// sizes yet, does not know how many bodies its world has removed.
template <int Dof>
bool RunCheck<Dof>::has_same_bodies(const World<Dof>& world) const {
  return (world.removals() == removals_ || sizes_.empty()) && world.bodies().size() == energy_.bodies();
}

template <int Dof>
void RunCheck<Dof>::begin_step(const World<Dof>& world) {
  if (moved_ || !has_same_bodies(world) || world.steps() != last_step_) start(world, true);
}

/// Begins to check with the world as it is.
template <int Dof>
void RunCheck<Dof>::start(const World<Dof>& world, bool velocities_are_given) {
  find_sizes(world);
  overlap_ = infinity;  // how bodies begin is not the step's doing
  long_steps_ = {};
  moved_ = false;
  energy_.start(world, velocities_are_given);
  note_step(world);
}

template <int Dof>
void RunCheck<Dof>::note_step(const World<Dof>& world) {
  last_step_ = world.steps();
  removals_ = world.removals();
}

template <int Dof>
void RunCheck<Dof>::find_sizes(const World<Dof>& world) {
  shapes_ = world.shapes().by_body(world.bodies().size());
  sizes_.clear();
  for (const Shape& shape : shapes_) sizes_.push_back(size_of(shape));
}

template <int Dof>
void RunCheck<Dof>::look(const World<Dof>& world, double h) {
  if (world.steps() == last_step_) return;
  const bool goes_on = world.steps() == last_step_ + 1 && has_same_bodies(world);
  if (!goes_on) return start(world, true);
  if (sizes_.empty()) find_sizes(world);  // a state was read
  if (moved_) overlap_ = infinity;
  look_at_solve(world, h / world.parts());
  look_at_gaps(world, h / world.parts());
  if (!moved_) look_at_motion(world, h);
  // The energy that a kinematic body adds in an impact is unknown.
  if (moved_ || (world.has_kinematic_bodies() && world.report().impacts > 0)) {
    const double overlap = overlap_;
    const bool moved = moved_;
    start(world, moved);
    overlap_ = overlap;
    return;
  }
  look_at_energy(world, h);
  note_step(world);
}

template <int Dof>
void RunCheck<Dof>::look_at_solve(const World<Dof>& world, double h) {
  if (const double products = fastest_products(world); std::isfinite(products))
    fastest_ = std::max(fastest_, products);
  // A solver may have converged to a tolerance that is too large.
  const SolveReport& solved = world.solved();
  if (solved.converged && solved.history.empty()) return;
  double residual = solved.converged ? solved.history.back() : world.report().residual;
  // The report is that of a part that is not solved, and the rows are those of the last part.
  const bool of_parts = world.parts() > 1 && !world.settings().soft_steps;
  if (of_parts && !solved.converged && !solved.history.empty())
    residual = std::max(residual, solved.history.back());
  if (residual <= share_of_roundings * fastest_) return;
  const double asked = right_hand_side(world, h);
  if (world.settings().soft_steps) return look_at_soft_solve(world, residual, asked, h);
  const bool has_rate = !solved.converged && !begins_anew(solved.history);
  double left = has_rate ? estimated_error(residual, solved.history) : residual;
  const bool stalled =
      std::ssize(solved.history) >= least_history && observed_rate(solved.history) >= stalled_rate;
  if (left > share_unsolved * asked && stalled)
    left = std::min(left, residual * std::max(1.0, understatement(world)));
  if (left <= share_unsolved * asked) return;
  ++verdict_.unsolved;
  if (stalled)
    return find(State::unsolved, world,
                "the solver does not converge: its residual stays at " + text(residual) +
                    " m/s, where the right-hand side is " + text(asked) +
                    " m/s; a shorter step, or another solver, may help");
  // Another solver without cones would also have another friction.
  const std::string by_factors = world.settings().solver.friction == FrictionModel::cone ? "newton" : "direct";
  find(State::unsolved, world,
       "the solver's error is " + text(left) + " m/s, where the right-hand side is " + text(asked) +
           " m/s: more sweeps, or the solver " + by_factors + ", would reduce it");
}

/// In soft steps each sweep begins where the last one ended, so a rate cannot be seen, and the residual is the error.
/// It may be as large as what it does to positions.
template <int Dof>
void RunCheck<Dof>::look_at_soft_solve(const World<Dof>& world, double residual, double asked, double h) {
  const double size = smallest_size(sizes_, world.joints()), way = h * residual;
  if (way <= share_unsolved * std::max(h * asked, size)) return;
  ++verdict_.unsolved;
  find(State::unsolved, world,
       "the solver's error is " + text(residual) + " m/s, so bodies move by " + text(way) +
           " m in a step, more than a hundredth of the size " + text(size) +
           " m: more substeps would reduce it");
}

template <int Dof>
typename RunCheck<Dof>::Overlap RunCheck<Dof>::largest_overlap(const World<Dof>& world) const {
  Overlap largest;
  for (const Contact& contact : world.contacts()) {
    const double size = std::min(sizes_[world.index(contact.i)], sizes_[world.index(contact.j)]);
    if (-contact.gap > largest.share * size) largest = {-contact.gap / size, &contact};
  }
  return largest;
}

template <int Dof>
void RunCheck<Dof>::look_at_gaps(const World<Dof>& world, double h) {
  sag_.clear();
  const double sagged_before = sagged_;
  sagged_ = 0;
  const bool soft = world.settings().soft_steps.has_value();
  double deepest = 0, recovered = 0;
  const Contact* deep = nullptr;
  for (int c = 0; c < static_cast<int>(world.contacts().size()); ++c) {
    const Contact& contact = world.contacts()[static_cast<std::size_t>(c)];
    const double size = std::min(sizes_[world.index(contact.i)], sizes_[world.index(contact.j)]);
    const double lambda = world.lambda(c);
    if (soft) {
      if (lambda > 0 && is_first_sag(-contact.gap, size))
        note_sag("the contact of " + bodies_text(contact), -contact.gap, size, "more substeps");
    } else if (-contact.gap > share_of_size * size) {
      const double k = world.materials().of(contact.i, contact.j).k;
      const double sag = std::min(lambda / (h * k), -contact.gap);
      if (is_first_sag(sag, size))
        note_sag("the contact of " + bodies_text(contact), sag, size, "a larger k than " + text(k) + " N/m");
    }
    if (-contact.gap <= std::max(1.0, deepest) * size) continue;
    const PairMaterial touching = world.materials().of(contact.i, contact.j);
    const double depth = (-contact.gap - (soft ? 0 : lambda / (h * touching.k))) / size;
    if (depth <= std::max(1.0, deepest)) continue;
    deep = &contact;
    deepest = depth;
    recovered = 2 / (1 + 4 * touching.d);
  }
  const Overlap overlap = largest_overlap(world);
  if (overlap.share > std::max(found_late, overlap_))
    note(Note::late, bodies_text(*overlap.contact) + " overlap by " + text(-overlap.contact->gap) +
                         " m when their contact is found, more than the thickness of one: a shorter step would "
                         "find it earlier");
  overlap_ = overlap.share;
  // An overlap that shrinks is on its way out.
  deep_steps_ = deep && deepest > (1 - recovered) * deepest_ ? deep_steps_ + 1 : 0;
  deepest_ = deepest;
  if (deep_steps_ >= most_deep_steps)
    return find(State::lost, world,
                bodies_text(*deep) + " overlap by " + text(-deep->gap) + " m, more than the size of one");
  look_at_joints(world, h);
  // A load keeps its sag; an overlap that recovers does not.
  sagging_steps_ = sag_.empty() || sagged_ < share_kept * sagged_before ? 0 : sagging_steps_ + 1;
  if (sagging_steps_ == most_sagging_steps) note(Note::sag, sag_);
}

template <int Dof>
void RunCheck<Dof>::look_at_motion(const World<Dof>& world, double h) {
  const Bodies<Dof>& bodies = world.bodies();
  bool moves = world.has_kinematic_bodies();
  for (std::size_t i = 0; i < bodies.size() && !moves; ++i) moves = !bodies.is_fixed(i);
  if (!moves) return note(Note::nothing_moves, "nothing can move: the world has no dynamic body");
  if (const auto tunnelling =
          has(Note::tunnelling) ? std::nullopt : find_tunnelling(world, energy_.x_before(), shapes_, sizes_, h))
    note(Note::tunnelling, "body " + std::to_string(tunnelling->body) + " moves by " + text(tunnelling->way) +
                               " m in a step relative to body " + std::to_string(tunnelling->other) +
                               ", and contacts are found within " + text(tunnelling->detected_within) +
                               " m: steps shorter than " + text(tunnelling->longest_step) +
                               " of this one would find the contact");
  if (const auto passing = has(Note::points) ? std::nullopt : find_passing_points(world, shapes_))
    note(Note::points,
         "body " + std::to_string(passing->first) + " passes through body " + std::to_string(passing->second) +
             ": its shape is points, which collide with planes only; another shape would be stopped");
}

template <int Dof>
void RunCheck<Dof>::look_at_joints(const World<Dof>& world, double h) {
  const bool soft = world.settings().soft_steps.has_value();
  for (int n = 0; n < static_cast<int>(world.joints().size()); ++n) {
    const Joint& joint = world.joints()[static_cast<std::size_t>(n)];
    const auto name = [n] { return "joint " + std::to_string(n); };
    const JointGap gap = gap_of(joint, world.bodies());
    double force = 0, torque = 0;
    for (int row = 0; row < joint.holding_rows(); ++row) {
      double& of = joint.is_guided() && joint.turns(row) ? torque : force;
      of = std::hypot(of, world.joint_lambda(n, row) / h);
    }
    const bool has_k = !(soft && joint.has_default_k);
    const double size = size_of(joint), sag = has_k ? force / *joint.k : 0;
    if (size > 0 && gap.apart.norm() - sag > size)
      return find(State::lost, world,
                  name() + " is off by " + text(gap.apart.norm()) + " m, more than its size");
    if (const double given = std::min(sag, gap.apart.norm()); size > 0 && has_k && is_first_sag(given, size))
      note_sag(name(), given, size, "a larger k than " + text(*joint.k) + " N/m");
    if (joint.is_guided() && gap.turned.norm() - torque / *joint.k_turn > 1)
      return find(State::lost, world,
                  name() + " is turned by " + text(gap.turned.norm()) + ", more than 1 rad");
  }
}

template <int Dof>
bool RunCheck<Dof>::is_first_sag(double sag, double size) const {
  return sag > share_of_size * size && !has(Note::sag) && sag_.empty();
}

template <int Dof>
void RunCheck<Dof>::note_sag(const std::string& what, double sag, double size, const std::string& remedy) {
  sagged_ = sag / size;
  sag_ = what + " gives by " + text(sag) + " m, more than a hundredth of the size " + text(size) +
         " m: " + remedy + " would hold it";
}

template <int Dof>
void RunCheck<Dof>::note(Note kind, const std::string& what) {
  if (has(kind)) return;
  noted_ |= 1u << static_cast<unsigned>(kind);
  verdict_.note += (verdict_.note.empty() ? "" : "; ") + what;
}

template <int Dof>
void RunCheck<Dof>::look_at_energy(const World<Dof>& world, double h) {
  long_steps_.look(world, energy_.x_before(), h);
  energy_.add_step(world, h, largest_size(sizes_, world.joints()));
  if (energy_.contradicted_too_much())
    note(Note::contradiction, "joints have taken out " + text(energy_.contradicted()) +
                                  " J at the start: the given velocities contradict them");
  const std::string too_long = "h is too long for what turns or swings here";
  if (energy_.gained_too_much())
    find(State::lost, world,
         energy_.had_rows()
             ? "constraints have brought in " + text(energy_.gained()) + " J, and nothing else has"
             : "the steps have brought in " + text(energy_.gained()) + " J: " + too_long);
  if (energy_.lost_too_much() && !energy_.may_dissipate()) {
    const std::string lost = "have taken out " + text(energy_.lost()) + " J";
    if (energy_.had_rows())
      note(Note::joints, "joints " + lost + ", and nothing else has: a shorter step takes out less");
    else
      find(State::lost, world, "the steps " + lost + ": " + too_long);
  }
  if (long_steps_.are_unstable())
    find(State::lost, world,
         "the steps have brought in energy: h is " + text(long_steps_.too_long()) +
             " times as long as leapfrog allows for what swings here");
}

template <int Dof>
void RunCheck<Dof>::find(State state, const World<Dof>& world, const std::string& reason) {
  if (state <= verdict_.state) return;
  verdict_ = {.state = state,
              .step = world.steps(),
              .time = world.time(),
              .reason = reason,
              .unsolved = verdict_.unsolved,
              .note = verdict_.note};
}

template class RunCheck<3>;
template class RunCheck<6>;

}  // namespace spook
