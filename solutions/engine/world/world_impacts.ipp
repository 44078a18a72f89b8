// Impacts at the start of a step: engine/impacts/impacts.hpp.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "engine/impacts/impacts.hpp"

namespace spook {

/// Returns the friction and restitution of a contact, and its slowest impact [m/s]. Rows take slower approaches: those
/// that gravity makes in a step or, if the step is short enough to follow the contact's spring, a bounce no higher than
/// its sag, u²/2g = m g/k, and those that the force F of the last step can cause, m u²/2 = F²/2k.
template <int Dof>
ImpactLaw World<Dof>::impact_law(const Contact& contact, double h) const {
  ImpactLaw law = settings_.impacts.value_or(ImpactLaw{});
  double k = materials_.stiffness();
  if (materials_.any()) {
    const PairMaterial touching = materials_.of(contact.i, contact.j);
    law.restitution = touching.restitution;
    law.friction = touching.friction;
    k = touching.k;
  }
  const std::vector<InverseMass<Dof>>& inverse_mass = bodies_.motion.inverse_mass;
  const double both = inverse_mass[contact.i].linear + inverse_mass[contact.j].linear;
  const double gravity = settings_.gravity.norm(), time = std::sqrt(2 / (both * k));  // √(2 m/k)
  law.threshold +=
      h > time
          ? gravity * h
          : std::max(gravity * time, last_impulses_.contact_force(contact.i, contact.j) * std::sqrt(both / k));
  return law;
}

/// Adds the impulses of joints in the last step to W_f of bodies that they carried. A plate on a weld has the W_f of a
/// fall, and does not fall. Larger impulses, as after an impact, are not those of the next step.
template <int Dof>
void World<Dof>::add_last_impulses_of_joints(double h) {
  if (joints_.empty() || h_ <= 0 || V_.size() != bodies_.size()) return;
  std::vector<Vec3> carried(bodies_.size(), Vec3::Zero());
  for (std::size_t k = 0; k < std::min(constraints_.first_contact_row, rows().size()); ++k) {
    const Row<Dof>& row = rows()[k];
    carried[row.i] += h / h_ * row.lambda * row.MinvGi.template head<3>();
    carried[row.j] += h / h_ * row.lambda * row.MinvGj.template head<3>();
  }
  for (std::size_t i = 0; i < carried.size(); ++i) {
    auto Wf = bodies_.motion.Wf[i].template head<3>();
    if (carried[i].norm() <= 1.5 * Wf.norm()) Wf += carried[i];
  }
}

/// Searches for contacts within a step's impacts: each finds pairs that impacts before it have brought together.
static constexpr int most_rounds_of_impacts = 16;

template <int Dof>
void World<Dof>::resolve_impacts(double h) {
  add_last_impulses_of_joints(h);
  const auto law_of = [&](const Contact& contact) { return impact_law(contact, h); };
  const auto move_freely = [&](std::size_t i, double time) {
    Twist<Dof>& W = bodies_.motion.W[i];
    bodies_.x[i] += time * W.template head<3>();
    if constexpr (Dof == 6) {
      Vec3 omega = W.template tail<3>();
      rotate(settings_.rotation, bodies_.orientations, i, omega, time);
      W.template tail<3>() = omega;
    }
  };
  // A body that an impact has turned round may already be inside one that follows it. Their contact is found after the
  // impact, and would get a row, which has no restitution.
  const auto is_new_hit = [&](const Contact& contact, const std::vector<std::pair<int, int>>& known) {
    return contact.gap <= 0 &&
           !std::binary_search(known.begin(), known.end(), std::pair(contact.i, contact.j)) &&
           separation_speed(contact, bodies_.motion) < -impact_law(contact, h).threshold;
  };
  for (int round = 0; round < most_rounds_of_impacts; ++round) {
    const std::vector<Twist<Dof>> before = bodies_.motion.W;
    const std::vector<Impact> hits =
        resolve_late_impacts<Dof>(contacts_, law_of, h, h_, shapes_, joints_, move_freely, bodies_);
    if (hits.empty()) break;
    std::copy_if(hits.begin(), hits.end(), std::back_inserter(impacts_),
                 [](const Impact& hit) { return hit.speed > 0; });
    std::vector<std::pair<int, int>> known;
    for (const Contact& contact : contacts_) known.push_back({contact.i, contact.j});
    std::sort(known.begin(), known.end());
    std::vector<bool> moved(before.size());
    for (std::size_t i = 0; i < moved.size(); ++i) moved[i] = bodies_.motion.W[i] != before[i];
    pairs_ = finder_.find_moved(moved, shapes_, bodies_, margin(h), contacts_, settings_.threads);
    prepare_motion(h);  // the gyroscopic torque depends on ω
    add_last_impulses_of_joints(h);
    if (std::none_of(contacts_.begin(), contacts_.end(),
                     [&](const auto& one) { return is_new_hit(one, known); }))
      break;
  }
  // An open contact that approaches fast enough for an impact gets no row, so that the impact can occur.
  const auto will_hit = [&](const Contact& contact) {
    return contact.gap > 0 && separation_speed(contact, bodies_.motion) < -impact_law(contact, h).threshold;
  };
  contacts_.erase(std::remove_if(contacts_.begin(), contacts_.end(), will_hit), contacts_.end());
  if (!joints_.empty()) prepare_motion(h);
}

}  // namespace spook
