#include "engine/impacts/impacts.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <queue>
#include <utility>

#include "engine/impacts/impact_joints.hpp"
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

template <int Dof>
Twist<Dof> row_of_i(const Contact& contact) {
  return contact_jacobian(contact).Gi.template head<Dof>();
}
template <int Dof>
Twist<Dof> row_of_j(const Contact& contact) {
  return contact_jacobian(contact).Gj.template head<Dof>();
}

/// Returns the radius of each sphere among the bodies; 0 for all others [m].
std::vector<double> radii_of(const Shapes& shapes, std::size_t bodies) {
  std::vector<double> radii(bodies, 0);
  for (const Solid& solid : shapes.solids)
    if (const auto* sphere = std::get_if<Sphere>(&solid.shape)) radii[solid.body] = sphere->radius;
  return radii;
}

/// Returns the contact as it was `late` ago [s], with both lever arms to one point, and the normal of two spheres. The
/// point is on the surface of a sphere, and midway for other shapes.
template <int Dof>
Contact before(Contact contact, double late, const std::vector<double>& radii, const Bodies<Dof>& bodies) {
  const auto back = [&](int body) -> Vec3 { return -late * bodies.motion.W[body].template head<3>(); };
  const Vec3 back_i = back(contact.i), back_j = back(contact.j);
  const double radius_i = radii[contact.i], radius_j = radii[contact.j];
  if (radius_i > 0 && radius_j > 0) {
    const Vec3 apart = (bodies.x[contact.j] + back_j) - (bodies.x[contact.i] + back_i);
    contact.n = apart.normalized();
    contact.r_i = radius_i / (radius_i + radius_j) * apart;
    contact.r_j = contact.r_i - apart;
  } else if (radius_j > 0) {
    contact.r_i += back_j - back_i;
  } else if (radius_i > 0) {
    contact.r_j += back_i - back_j;
  } else {
    contact.r_i += (back_j - back_i) / 2;
    contact.r_j += (back_i - back_j) / 2;
  }
  return contact;
}

/// Returns the time since the gap was 0, Eq. (7.15) [s]. The delay of a chain of impacts adds to that of the pair: at
/// most two steps.
template <int Dof>
double lateness(const Contact& contact, double u_n, double h, const Motion<Dof>& motion) {
  const double a =
      (row_of_i<Dof>(contact).dot(motion.Wf[contact.i]) + row_of_j<Dof>(contact).dot(motion.Wf[contact.j])) / h;
  const double square = std::max(0.0, u_n * u_n - 2 * a * contact.gap);
  return std::clamp(-2 * contact.gap / (std::sqrt(square) - u_n), 0.0, 2 * h);
}

/// Displacements of bodies since their contacts were found.
struct Displacements {
  std::vector<Vec3> by, turned;  ///< of the centre [m]; about it [rad]

  Vec3 at(int body, const Vec3& r) const { return by[body] + turned[body].cross(r); }
};

/// Updates a contact after its bodies have moved: its two lever arms meet in one point again, and that of a sphere
/// stays.
Contact moved_on(Contact contact, const Displacements& moved, const std::vector<double>& radii) {
  contact.gap += contact.n.dot(moved.at(contact.j, contact.r_j) - moved.at(contact.i, contact.r_i));
  const Vec3 apart = moved.by[contact.j] - moved.by[contact.i];
  if (radii[contact.j] > 0)
    contact.r_i += apart;
  else
    contact.r_j -= apart;
  return contact;
}

/// A closed contact whose bodies approach, and the time since its gap was 0.
struct Approach {
  double late;  ///< [s]
  std::size_t contact;
  int version;  ///< of the contact, when its bodies had these velocities
  bool operator<(const Approach& other) const {
    return late < other.late || (late == other.late && contact > other.contact);
  }
};

/// Resolves the impacts of a step from the first to the last. Impacts at one time that share a dynamic body are
/// resolved together.
template <int Dof>
class ImpactQueue {
 public:
  ImpactQueue(std::vector<Contact>& contacts, const LawOf& law, double h, const Shapes& shapes,
              const std::vector<Joint>& joints, const MoveFreely& move_freely, Bodies<Dof>& bodies)
      : contacts_(contacts), law_(law), move_freely_(move_freely), h_(h), bodies_(bodies) {
    // A contact that touches up to round-off takes part in simultaneous impacts.
    touching_gap_ = std::isfinite(shapes.smallest) ? 1e-9 * shapes.smallest : 0;
    for (std::size_t c = 0; c < contacts.size(); ++c)
      if (const auto late = lateness_of(contacts[c], law)) queue_.push({*late, c, 0});
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
        const double late = *lateness_of(now(c), law_);
        const std::vector<std::size_t> together = connected(c);
        resolve(together, may_go_back(together) ? late : 0);
      }
    }
    if (!impacts_.empty())
      for (Contact& contact : contacts_) contact = moved_on(contact, moved_, radii_);
    return std::move(impacts_);
  }

 private:
  static constexpr double one_time = 1e-6;      // of a step
  static constexpr double small_overlap = 0.1;  // of the overlap of an impact

  Contact now(std::size_t c) const { return moved_on(contacts_[c], moved_, radii_); }

  /// Returns the delay of an impact at this contact [s]; nothing if there is none.
  std::optional<double> lateness_of(const Contact& contact, const LawOf& law) const {
    if (contact.gap > touching_gap_) return {};
    const double u_n = separation_speed(contact, bodies_.motion);
    if (u_n >= 0 || u_n >= -law(contact).threshold) return {};
    return lateness(contact, u_n, h_, bodies_.motion);
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

  /// Returns contact c, and the waiting contacts that are connected with it by dynamic bodies. They no longer wait.
  std::vector<std::size_t> connected(std::size_t c) {
    std::vector<std::size_t> together{c};
    waiting_[c] = false;
    for (std::size_t n = 0; n < together.size(); ++n)
      for (const int body : {contacts_[together[n]].i, contacts_[together[n]].j})
        around(static_cast<std::size_t>(body), [&](std::size_t other) {
          if (!waiting_[other]) return;
          waiting_[other] = false;
          together.push_back(other);
        });
    return together;
  }

  /// Tells whether the bodies of these impacts may go back to their time. If rows push a body out of another overlap, of
  /// more than a tenth of the impact's, going back returns the body there, in each step anew.
  bool may_go_back(const std::vector<std::size_t>& together) const {
    double deepest = 0;
    for (const std::size_t c : together) deepest = std::min(deepest, now(c).gap);
    bool may = true;
    for (const std::size_t c : together)
      for (const int body : {contacts_[c].i, contacts_[c].j})
        around(static_cast<std::size_t>(body), [&](std::size_t other) {
          const Contact contact = now(other);
          may = may && (contact.gap >= small_overlap * deepest || lateness_of(contact, law_));
        });
    return may;
  }

  /// Resolves impacts that were `late` ago [s]; none if one was too slow then.
  void resolve(const std::vector<std::size_t>& together, double late) {
    Motion<Dof>& motion = bodies_.motion;
    std::vector<Contact> contacts;
    std::vector<ImpactLaw> laws;
    std::vector<std::size_t> moving;  // dynamic bodies
    for (const std::size_t c : together) {
      const Contact contact = now(c);
      contacts.push_back(before(contact, late, radii_, bodies_));
      laws.push_back(law_(contact));
      laws.back().max_passes = 1;
      add_dynamic({contact.i, contact.j}, moving);
    }
    const std::vector<Joint> joints = joints_->of(moving);
    for (const Joint& joint : joints) add_dynamic({joint.i, joint.j}, moving);
    std::sort(moving.begin(), moving.end());
    moving.erase(std::unique(moving.begin(), moving.end()), moving.end());

    std::vector<Pose> poses;
    if (!joints.empty())
      for (const std::size_t body : moving) poses.push_back(carry(body, -late));
    const std::vector<Row<Dof>> joint_rows = impact_rows(joints, h_, bodies_);
    std::vector<Twist<Dof>> W;
    for (const std::size_t body : moving) W.push_back(motion.W[body] -= late / h_ * motion.Wf[body]);
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
      if (joints.empty()) {
        bodies_.x[body] += by;
        moved_.by[body] += by;
      } else {
        carry(body, late);
        note_moved(body, poses[n]);
      }
    }
    if (impacts.empty()) return;
    impacts_.insert(impacts_.end(), impacts.begin(), impacts.end());
    for (const std::size_t c : together) ++impacts_of_[c];
    for (const std::size_t body : moving) around(body, [&](std::size_t other) { look_again(other); });
  }

  struct Pose {
    Vec3 x;
    Quat q = Quat::Identity();
  };

  /// Moves a body of a mechanism freely for a time [s], which may be negative. Returns its pose before.
  Pose carry(std::size_t body, double time) {
    Pose pose{.x = bodies_.x[body]};
    if constexpr (Dof == 6) pose.q = bodies_.orientations.q[body];
    move_freely_(body, time);
    if constexpr (Dof == 6)
      bodies_.motion.inverse_mass[body].angular = bodies_.orientations.inverse_inertia(body);
    return pose;
  }

  /// Adds the way since a pose to the displacements.
  void note_moved(std::size_t body, const Pose& since) {
    moved_.by[body] += bodies_.x[body] - since.x;
    if constexpr (Dof == 6) {
      const Eigen::AngleAxisd turned(bodies_.orientations.q[body] * since.q.conjugate());
      moved_.turned[body] += turned.angle() * turned.axis();
    }
  }

  void add_dynamic(std::initializer_list<int> bodies, std::vector<std::size_t>& moving) const {
    for (const int body : bodies)
      if (!bodies_.is_fixed(static_cast<std::size_t>(body))) moving.push_back(static_cast<std::size_t>(body));
  }

  void look_again(std::size_t c) {
    ++version_[c];
    const Contact contact = now(c);
    const auto late = lateness_of(contact, law_);
    if (late && impacts_of_[c] < law_(contact).max_passes) queue_.push({*late, c, version_[c]});
  }

  std::vector<Contact>& contacts_;
  const LawOf& law_;
  const MoveFreely& move_freely_;
  double h_, touching_gap_;
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
                                         const Shapes& shapes, const std::vector<Joint>& joints,
                                         const MoveFreely& move_freely, Bodies<Dof>& bodies) {
  return ImpactQueue<Dof>(contacts, law, h, shapes, joints, move_freely, bodies).resolve();
}

template double separation_speed<3>(const Contact&, const Motion<3>&);
template double separation_speed<6>(const Contact&, const Motion<6>&);
template std::vector<Impact> resolve_late_impacts<3>(std::vector<Contact>&, const LawOf&, double, const Shapes&,
                                                     const std::vector<Joint>&, const MoveFreely&, Bodies<3>&);
template std::vector<Impact> resolve_late_impacts<6>(std::vector<Contact>&, const LawOf&, double, const Shapes&,
                                                     const std::vector<Joint>&, const MoveFreely&, Bodies<6>&);

}  // namespace spook
