#include "engine/impacts/impacts.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <queue>
#include <utility>

#include "engine/impacts/impact_joints.hpp"
#include "engine/impacts/late_contact.hpp"
#include "engine/impacts/simultaneous_impacts.hpp"

namespace spook {

template <int Dof>
double separation_speed(const Contact& contact, const Motion<Dof>& motion) {
  const auto along_n = [&](int body, const Vec3& r) {
    const Twist<Dof>&W = motion.W[body], &Wf = motion.Wf[body];
    Vec3 v = W.template head<3>() + Wf.template head<3>() / 2;
    if constexpr (Dof == 6) v += (W.template tail<3>() + Wf.template tail<3>() / 2).cross(r);
    return contact.n.dot(v);
  };
  return along_n(contact.j, contact.r_j) - along_n(contact.i, contact.r_i);
}

namespace {

/// A closed contact whose bodies approach, and the time since its gap was 0.
struct Approach {
  double late;  ///< [s]
  std::size_t contact;
  int version;  ///< of the contact, when its bodies had these velocities
  bool operator<(const Approach& other) const {
    return late < other.late || (late == other.late && contact > other.contact);
  }
};

/// Resolves the impacts of a step from the first to the last. Impacts at one time that dynamic bodies or joints connect
/// are resolved together.
template <int Dof>
class ImpactQueue {
 public:
  ImpactQueue(std::vector<Contact>& contacts, const LawOf& law, double h, double last_h, const Shapes& shapes,
              const std::vector<Joint>& joints, const MoveFreely& move_freely, Bodies<Dof>& bodies)
      : contacts_(contacts),
        law_(law),
        move_freely_(move_freely),
        h_(h),
        longest_(2 * std::max(h, last_h)),
        bodies_(bodies) {
    // A contact that touches up to round-off takes part in simultaneous impacts.
    touching_gap_ = std::isfinite(shapes.smallest) ? 1e-9 * shapes.smallest : 0;
    for (std::size_t c = 0; c < contacts.size(); ++c)
      if (const auto late = lateness_of(contacts[c])) queue_.push({*late, c, 0});
    if (queue_.empty()) return;
    joints_.emplace(joints, bodies);
    radii_ = radii_of(shapes, bodies.size());
    moved_.by.assign(bodies.size(), Vec3::Zero());
    moved_.turned = moved_.by;
    version_.assign(contacts.size(), 0);
    impacts_of_.assign(contacts.size(), 0);
    waiting_.assign(contacts.size(), false);
    list_contacts_of_bodies();
  }

  /// Returns the impacts, a contact as often as it was resolved.
  std::vector<Impact> resolve() {
    std::vector<std::size_t> first;
    while (!queue_.empty()) {
      take_first(first);
      for (const std::size_t c : first) {
        if (!waiting_[c]) continue;
        waiting_[c] = false;
        if (const auto late = approach(c)) resolve(connected(c), *late);
      }
    }
    if (!impacts_.empty())
      for (Contact& contact : contacts_) contact = moved_on(contact, moved_, radii_);
    return std::move(impacts_);
  }

 private:
  static constexpr double one_time = 1e-6;      // of a step
  static constexpr double small_overlap = 0.1;  // of an overlap

  Contact now(std::size_t c) const { return moved_on(contacts_[c], moved_, radii_); }

  /// Returns the delay of an impact at this contact [s]; nothing if there is none.
  std::optional<double> lateness_of(const Contact& contact) const {
    if (contact.gap > touching_gap_) return {};
    const double u_n = separation_speed(contact, bodies_.motion);
    if (u_n >= 0 || u_n >= -law_(contact).threshold) return {};
    return lateness(contact, u_n, h_, longest_, bodies_.motion);
  }

  /// Returns the delay of the next impact of contact c [s]; nothing if there is none.
  std::optional<double> approach(std::size_t c) const {
    const Contact contact = now(c);
    const std::optional<double> late = lateness_of(contact);
    return late && impacts_of_[c] < law_(contact).max_passes ? late : std::nullopt;
  }

  void list_contacts_of_bodies() {
    first_of_.assign(bodies_.size() + 1, 0);
    const auto for_each = [&](const auto& visit) {
      for (std::size_t c = 0; c < contacts_.size(); ++c)
        for (const int body : {contacts_[c].i, contacts_[c].j})
          if (!bodies_.is_fixed(static_cast<std::size_t>(body))) visit(static_cast<std::size_t>(body), c);
    };
    for_each([&](std::size_t body, std::size_t) { ++first_of_[body + 1]; });
    for (std::size_t body = 0; body < bodies_.size(); ++body) first_of_[body + 1] += first_of_[body];
    contacts_of_.resize(first_of_.back());
    std::vector<std::size_t> next = first_of_;
    for_each([&](std::size_t body, std::size_t c) { contacts_of_[next[body]++] = c; });
  }

  /// Calls `visit` with each contact of a dynamic body.
  template <class Visit>
  void around(std::size_t body, const Visit& visit) const {
    for (std::size_t k = first_of_[body]; k < first_of_[body + 1]; ++k) visit(contacts_of_[k]);
  }

  /// Takes the first impact from the queue, and all at the same time.
  void take_first(std::vector<std::size_t>& first) {
    first.clear();
    double late = 0;
    while (!queue_.empty() && (first.empty() || queue_.top().late >= late - one_time * h_)) {
      const Approach top = queue_.top();
      queue_.pop();
      if (top.version != version_[top.contact]) continue;
      if (first.empty()) late = top.late;
      first.push_back(top.contact);
      waiting_[top.contact] = true;
    }
  }

  /// Returns contact c, and the waiting contacts that dynamic bodies and their joints connect with it. These no longer
  /// wait.
  std::vector<std::size_t> connected(std::size_t c) {
    std::vector<std::size_t> together{c};
    const auto take_around = [&](int body) {
      around(static_cast<std::size_t>(body), [&](std::size_t other) {
        if (!waiting_[other]) return;
        waiting_[other] = false;
        together.push_back(other);
      });
    };
    std::vector<std::size_t> bodies;
    for (std::size_t n = 0; n < together.size(); ++n) {
      bodies.clear();
      add_dynamic({contacts_[together[n]].i, contacts_[together[n]].j}, bodies);
      for (const std::size_t body : bodies) take_around(static_cast<int>(body));
      for (const Joint& joint : joints_->of(bodies)) take_around(joint.i), take_around(joint.j);
    }
    return together;
  }

  /// Resolves impacts that were `late` ago [s]; none if one was too slow then. If going back by that time closes
  /// another overlap, out of which rows push its bodies, they would return there in each step. Then the bodies stay in
  /// place.
  void resolve(const std::vector<std::size_t>& together, double late) {
    std::vector<std::size_t> moving;  // dynamic bodies
    for (const std::size_t c : together) add_dynamic({contacts_[c].i, contacts_[c].j}, moving);
    const std::vector<Joint> joints = joints_->of(moving);
    for (const Joint& joint : joints) add_dynamic({joint.i, joint.j}, moving);
    std::sort(moving.begin(), moving.end());
    moving.erase(std::unique(moving.begin(), moving.end()), moving.end());

    std::vector<Start> starts;
    for (const std::size_t body : moving) starts.push_back(start_of(body));
    const std::vector<Overlap> others = other_overlaps(together, moving);
    std::vector<Impact> impacts = resolve_at(late, together, moving, joints);
    for (std::size_t n = 0; n < moving.size(); ++n) note_moved(moving[n], starts[n]);
    if (closed_further(others)) {
      for (std::size_t n = 0; n < moving.size(); ++n) put_back(moving[n], starts[n]);
      impacts = resolve_at(0, together, moving, joints);
    }
    if (impacts.empty()) return;
    impacts_.insert(impacts_.end(), impacts.begin(), impacts.end());
    for (const std::size_t c : together) ++impacts_of_[c];
    for (const std::size_t body : moving) around(body, [&](std::size_t other) { look_again(other); });
  }

  /// Resolves impacts with the velocities of a time `late` ago [s], and moves the bodies by Eq. (7.16). Returns the
  /// impacts.
  std::vector<Impact> resolve_at(double late, const std::vector<std::size_t>& together,
                                 const std::vector<std::size_t>& moving, const std::vector<Joint>& joints) {
    Motion<Dof>& motion = bodies_.motion;
    std::vector<Contact> contacts;
    std::vector<ImpactLaw> laws;
    for (const std::size_t c : together) {
      const Contact contact = now(c);
      contacts.push_back(contact_before(contact, late, radii_, bodies_));
      laws.push_back(law_(contact));
      laws.back().max_passes = 1;
    }
    if (!joints.empty())
      for (const std::size_t body : moving) carry(body, -late);
    std::vector<Twist<Dof>> W;
    for (const std::size_t body : moving) W.push_back(motion.W[body] -= late / h_ * motion.Wf[body]);
    const std::vector<Row<Dof>> joint_rows = impact_rows(joints, h_, bodies_);
    std::vector<Impact> impacts;
    for (const Contact& contact : contacts)
      impacts.push_back({contact.i, contact.j, -separation_speed(contact, motion)});
    if (together.size() > 1 || !joints.empty())
      resolve_together(contacts, laws, joint_rows, motion);
    else if (spook::resolve_impacts(contacts, laws.front(), motion).impacts == 0)
      impacts.clear();
    for (std::size_t n = 0; n < moving.size(); ++n) {
      const std::size_t body = moving[n];
      const Vec3 by = late * (motion.W[body] - W[n]).template head<3>();  // Eq. (7.16)
      motion.W[body] += late / h_ * motion.Wf[body];
      if (joints.empty())
        bodies_.x[body] += by;
      else
        carry(body, late);
    }
    return impacts;
  }

  /// A contact that overlaps, and its gap before impacts are resolved [m].
  struct Overlap {
    std::size_t contact;
    double gap;
  };

  /// Returns the overlaps of these bodies that are more than a tenth of that of the impacts, and have no impact.
  std::vector<Overlap> other_overlaps(const std::vector<std::size_t>& together,
                                      const std::vector<std::size_t>& moving) const {
    double deepest = 0;
    for (const std::size_t c : together) deepest = std::min(deepest, now(c).gap);
    std::vector<Overlap> others;
    for (const std::size_t body : moving)
      around(body, [&](std::size_t other) {
        const double gap = now(other).gap;
        if (gap < small_overlap * deepest && !approach(other)) others.push_back({other, gap});
      });
    return others;
  }

  /// Tells whether one of these overlaps is deeper by more than a tenth than it was.
  bool closed_further(const std::vector<Overlap>& overlaps) const {
    return std::any_of(overlaps.begin(), overlaps.end(), [&](const Overlap& overlap) {
      return now(overlap.contact).gap < (1 + small_overlap) * overlap.gap;
    });
  }

  /// Where a body was, how it moved, and its displacement, before impacts were resolved.
  struct Start {
    Vec3 x;
    Quat q = Quat::Identity();
    Twist<Dof> W;
    Vec3 by, turned;
  };

  Start start_of(std::size_t body) const {
    Start start{.x = bodies_.x[body],
                .W = bodies_.motion.W[body],
                .by = moved_.by[body],
                .turned = moved_.turned[body]};
    if constexpr (Dof == 6) start.q = bodies_.orientations.q[body];
    return start;
  }

  void put_back(std::size_t body, const Start& start) {
    bodies_.x[body] = start.x;
    bodies_.motion.W[body] = start.W;
    moved_.by[body] = start.by;
    moved_.turned[body] = start.turned;
    if constexpr (Dof == 6) {
      bodies_.orientations.q[body] = start.q;
      bodies_.motion.inverse_mass[body].angular = bodies_.orientations.inverse_inertia(body);
    }
  }

  /// Adds the way of a body since its start to the displacements.
  void note_moved(std::size_t body, const Start& start) {
    moved_.by[body] += bodies_.x[body] - start.x;
    if constexpr (Dof == 6) {
      const Quat& q = bodies_.orientations.q[body];
      if (q.coeffs() == start.q.coeffs()) return;
      const Eigen::AngleAxisd turned(q * start.q.conjugate());
      moved_.turned[body] += turned.angle() * turned.axis();
    }
  }

  /// Moves a body of a mechanism freely for a time [s], which may be negative.
  void carry(std::size_t body, double time) {
    move_freely_(body, time);
    if constexpr (Dof == 6)
      bodies_.motion.inverse_mass[body].angular = bodies_.orientations.inverse_inertia(body);
  }

  void add_dynamic(std::initializer_list<int> bodies, std::vector<std::size_t>& moving) const {
    for (const int body : bodies)
      if (!bodies_.is_fixed(static_cast<std::size_t>(body))) moving.push_back(static_cast<std::size_t>(body));
  }

  /// Puts a contact into the queue, or anew, after its bodies have moved.
  void look_again(std::size_t c) {
    ++version_[c];
    waiting_[c] = false;
    if (const auto late = approach(c)) queue_.push({*late, c, version_[c]});
  }

  std::vector<Contact>& contacts_;
  const LawOf& law_;
  const MoveFreely& move_freely_;
  double h_, longest_, touching_gap_;
  Bodies<Dof>& bodies_;
  std::priority_queue<Approach> queue_;
  std::vector<double> radii_;
  std::vector<Impact> impacts_;
  std::optional<ImpactJoints<Dof>> joints_;
  Displacements moved_;
  std::vector<int> version_, impacts_of_;            // of each contact
  std::vector<bool> waiting_;                        // contacts of the current time
  std::vector<std::size_t> first_of_, contacts_of_;  // the contacts of each dynamic body
};

}  // namespace

template <int Dof>
std::vector<Impact> resolve_late_impacts(std::vector<Contact>& contacts, const LawOf& law, double h,
                                         double last_h, const Shapes& shapes, const std::vector<Joint>& joints,
                                         const MoveFreely& move_freely, Bodies<Dof>& bodies) {
  return ImpactQueue<Dof>(contacts, law, h, last_h, shapes, joints, move_freely, bodies).resolve();
}

template double separation_speed<3>(const Contact&, const Motion<3>&);
template double separation_speed<6>(const Contact&, const Motion<6>&);
template std::vector<Impact> resolve_late_impacts<3>(std::vector<Contact>&, const LawOf&, double, double,
                                                     const Shapes&, const std::vector<Joint>&,
                                                     const MoveFreely&, Bodies<3>&);
template std::vector<Impact> resolve_late_impacts<6>(std::vector<Contact>&, const LawOf&, double, double,
                                                     const Shapes&, const std::vector<Joint>&,
                                                     const MoveFreely&, Bodies<6>&);

}  // namespace spook
