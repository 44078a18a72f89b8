#pragma once
// A step composed of the chapters' functions, stage by stage, with possible mistakes in each stage.
#include <functional>

#include "07_impacts/impacts.hpp"
#include "quantities.hpp"
#include "simulations.hpp"

namespace spook::testing {

/// Mistakes of a step; the default has none.
struct Stages {
  bool moves_before = false;           ///< moves the bodies, and then makes rows of old contacts
  bool kicks_before = false;           ///< kicks the bodies before the rows are made, and again when they move
  bool adds_forces = false;            ///< adds W_f along with V, and kicks again when they move
  bool forgets_forces = false;         ///< W_f = 0
  bool forgets_V = false;              ///< solves, and does not add V
  bool adds_linear_part_only = false;  ///< of V
  bool one_by_one = false;             ///< a system of one row for each, from the same velocities
  int max_sweeps = 0;                  ///< in place of the simulation's; 0: its own
  bool without_friction = false;
  bool counts_no_pairs = false;        ///< N = 1
  bool overlapping_only = false;       ///< no rows where a gap is above 0
  bool approaching_only = false;       ///< no rows where the bodies part
  bool open_approaching_only = false;  ///< no rows where a gap is above 0 and the bodies part
  bool whole_gravity = false;          ///< |g| for g_n
  bool contact_parameters = false;     ///< a, b, Σ of contacts for friction
  bool normals_first = false;          ///< the rows of all normals, then those of all tangents
  bool without_joints = false;
  bool joints_last = false;
  bool joints_as_contacts = false;    ///< k and d of contacts for joints
  bool points_unturned = false;       ///< r = p
  bool length_ignored = false;        ///< ball joints only
  bool coincident_once = false;       ///< no row for a contact at the points of the one before
  bool one_way_weight = false;        ///< no friction where gravity pulls along n
  bool tangents_of_first = false;     ///< the first contact's tangents for all
  bool one_joint_a_pair = false;      ///< no rows for a second joint of two bodies
  bool joints_d_of_contacts = false;  ///< k of the joint, d of contacts
  bool counts_bodies = false;         ///< N counts the contacts that share a body
  bool counts_joints = false;         ///< N counts the joints between two bodies, too
  bool mass_of_j = false;             ///< where j moves, its own mass in place of that of both
  bool open_is_ice = false;           ///< no friction where a gap is above 0
  bool unjoined_only = false;         ///< no rows for a contact of two bodies that have a joint
  bool points_by_i = false;           ///< both points of a joint turned by the orientation of i
  bool pulls_only = false;            ///< a distance does not push
};

inline int contacts_between(const std::vector<Contact>& contacts, int i, int j) {
  int count = 0;
  for (const Contact& contact : contacts) count += contact.i == i && contact.j == j;
  return count;
}

inline int joints_between(const Simulation& all, int i, int j) {
  int count = 0;
  for (const PointJoint& joint : all.joints) count += joint.i == i && joint.j == j;
  return count;
}

/// Returns N of a contact, with the mistakes of `stages`.
inline int load_shared_by(const Simulation& all, const std::vector<Contact>& contacts, const Contact& one,
                          const Stages& stages) {
  if (stages.counts_no_pairs) return 1;
  const int joints = stages.counts_joints ? joints_between(all, one.i, one.j) : 0;
  if (!stages.counts_bodies) return contacts_between(contacts, one.i, one.j) + joints;
  const auto shares = [&](const Contact& other) { return other.i == one.i || other.j == one.j; };
  return static_cast<int>(std::count_if(contacts.begin(), contacts.end(), shares));
}

inline bool are_coincident(const Contact& a, const Contact& b) {
  return a.i == b.i && a.j == b.j && a.r_i == b.r_i && a.r_j == b.r_j;
}

inline std::vector<Constraint<6>> joint_constraints(const Simulation& all, double h, const Stages& stages) {
  std::vector<Constraint<6>> constraints;
  for (const PointJoint& joint : all.joints) {
    const auto same_bodies = [&](const PointJoint& other) { return other.i == joint.i && other.j == joint.j; };
    if (stages.one_joint_a_pair && &*std::find_if(all.joints.begin(), all.joints.end(), same_bodies) != &joint)
      continue;
    const auto attached = [&](int body, const Vec3& p) {
      const RigidBody& to = all.bodies[static_cast<std::size_t>(body)];
      const Quat& q = stages.points_by_i ? all.bodies[static_cast<std::size_t>(joint.i)].q : to.q;
      return Attachment{.body = body, .x = to.x, .r = stages.points_unturned ? p : Vec3(q * p)};
    };
    const SpookParameters spook =
        spook_parameters(h, stages.joints_as_contacts ? all.k : joint.k,
                         stages.joints_as_contacts || stages.joints_d_of_contacts ? all.d : joint.d);
    const Attachment i = attached(joint.i, joint.p_i), j = attached(joint.j, joint.p_j);
    if (joint.length > 0 && !stages.length_ignored) {
      constraints.push_back(distance_constraint<6>(i, j, joint.length, spook));
      if (stages.pulls_only) constraints.back().hi = 0;
    } else {
      for (const Constraint<6>& along : ball_joint_constraints<6>(i, j, spook)) constraints.push_back(along);
    }
  }
  return constraints;
}

inline std::vector<Constraint<6>> contact_constraints(const Simulation& all,
                                                      const std::vector<Contact>& contacts, double h,
                                                      const Stages& stages) {
  const SpookParameters spook = spook_parameters(h, all.k, all.d);
  const SpookParameters of_friction = stages.contact_parameters ? spook : friction_parameters(h, all.viscosity);
  std::vector<Constraint<6>> constraints, tangential;
  for (const Contact& contact : contacts) {
    if (stages.overlapping_only && contact.gap > 0) continue;
    if (stages.unjoined_only && joints_between(all, contact.i, contact.j) > 0) continue;
    const Contact* const before = &contact == contacts.data() ? nullptr : &contact - 1;
    if (stages.coincident_once && before && are_coincident(*before, contact)) continue;
    const auto [Gi, Gj] = contact_jacobian(contact);
    const auto W_of = [&](int body) { return twist_of(all.bodies[static_cast<std::size_t>(body)]); };
    const bool parts = Gi.dot(W_of(contact.i)) + Gj.dot(W_of(contact.j)) > 0;
    if (parts && (stages.approaching_only || (stages.open_approaching_only && contact.gap > 0))) continue;
    constraints.push_back(
        {.i = contact.i, .j = contact.j, .Gi = Gi, .Gj = Gj, .gap = contact.gap, .spook = spook});
    if (all.mu == 0 || stages.without_friction) continue;
    const auto inverse = [&](int body) {
      return inverse_mass_of(all.bodies[static_cast<std::size_t>(body)]).linear;
    };
    const double of_i = stages.mass_of_j && inverse(contact.j) > 0 ? 0 : inverse(contact.i);
    const int count = load_shared_by(all, contacts, contact, stages);
    const double along = all.gravity.dot(contact.n);
    const double g = stages.whole_gravity    ? all.gravity.norm()
                     : stages.one_way_weight ? std::max(0.0, -along)
                                             : std::abs(along);
    const Vec3& n = stages.tangents_of_first ? contacts.front().n : contact.n;
    const double mu = stages.open_is_ice && contact.gap > 0 ? 0 : all.mu;
    const double bound = friction_bound(mu, representative_mass(of_i, inverse(contact.j), count), g, h);
    for (const Constraint<6>& along : friction_constraints<6>(contact, tangents(n), bound, of_friction))
      (stages.normals_first ? tangential : constraints).push_back(along);
  }
  constraints.insert(constraints.end(), tangential.begin(), tangential.end());
  return constraints;
}

/// Returns V of all rows solved together, or of each row alone.
inline std::vector<Twist<6>> solved(const Simulation& all, std::vector<Row<6>> rows, const Stages& stages) {
  std::vector<Twist<6>> V(all.bodies.size(), Twist<6>::Zero());
  const StopRule stop{.max_sweeps = stages.max_sweeps ? stages.max_sweeps : all.max_sweeps,
                      .tolerance = all.tolerance};
  if (!stages.one_by_one) {
    solve(rows, V, stop);
    return V;
  }
  for (const Row<6>& row : rows) {
    std::vector<Row<6>> alone = {row};
    std::vector<Twist<6>> of_it(V.size(), Twist<6>::Zero());
    solve(alone, of_it, stop);
    for (std::size_t b = 0; b < V.size(); ++b) V[b] += of_it[b];
  }
  return V;
}

/// Builds rows, solves and integrates, as the steps of chapters 04 to 06.
inline Simulation assembled(Simulation all, const std::vector<Contact>& contacts, double h,
                            const Stages& stages = {}) {
  if (stages.moves_before) step_free(all, h);
  if (stages.kicks_before)
    for (RigidBody& body : all.bodies)
      if (body.mass > 0) body.v += h * all.gravity;
  Motion<6> motion = motion_of(all, h);
  if (stages.forgets_forces) motion.Wf.assign(motion.Wf.size(), Twist<6>::Zero());

  std::vector<Row<6>> rows;
  const auto add = [&](const std::vector<Constraint<6>>& constraints) {
    for (const Constraint<6>& constraint : constraints) rows.push_back(make_row(constraint, motion));
  };
  if (!stages.without_joints && !stages.joints_last) add(joint_constraints(all, h, stages));
  add(contact_constraints(all, contacts, h, stages));
  if (!stages.without_joints && stages.joints_last) add(joint_constraints(all, h, stages));

  std::vector<Twist<6>> V = solved(all, rows, stages);
  for (std::size_t b = 0; b < V.size(); ++b) {
    if (stages.adds_linear_part_only) V[b].tail<3>().setZero();
    if (!stages.forgets_V) add_twist(all.bodies[b], V[b]);
    if (stages.adds_forces) add_twist(all.bodies[b], motion.Wf[b]);
  }
  if (!stages.moves_before) step_free(all, h);
  return all;
}

/// Solves the rows of joints and contacts, as a step does, and returns the report.
inline SolveReport solve_of(const Simulation& all, const std::vector<Contact>& contacts, double h) {
  const Motion<6> motion = motion_of(all, h);
  std::vector<Row<6>> rows;
  for (const Constraint<6>& constraint : joint_constraints(all, h, {}))
    rows.push_back(make_row(constraint, motion));
  for (const Constraint<6>& constraint : contact_constraints(all, contacts, h, {}))
    rows.push_back(make_row(constraint, motion));
  std::vector<Twist<6>> V(all.bodies.size(), Twist<6>::Zero());
  return solve(rows, V, {.max_sweeps = all.max_sweeps, .tolerance = all.tolerance});
}

/// Expects the report of the solve in a step, `step(simulation)`: of all its sweeps, and of a single sweep that is
/// within the tolerance; and with a tolerance that no sweep meets. `right(simulation)` returns the report of the same
/// rows.
template <class Step, class Right>
void expect_report(const std::string& equation, Simulation all, const Step& step, const Right& right,
                   const Tolerance& tolerance) {
  for (const double enough : {0.0, 1e-300, 1e6}) {
    all.tolerance = enough;
    const SolveReport expected = right(all);
    Simulation stepped = all;
    const SolveReport got = step(stepped);
    const std::string clue =
        got.history.size() > expected.history.size()
            ? "More sweeps than the simulation allows: hand both max_sweeps and tolerance to solve. Either "
              "ends it."
            : "The step solves, and returns the report of something else: return that of its solve.";
    expect_true("as many entries in the history of the report as sweeps in the step, " +
                    std::to_string(expected.history.size()),
                equation, got.history.size() == expected.history.size(), clue);
    expect_true("converged as the last sweep tells", "Eq. (4.9)", got.converged == expected.converged, clue);
    for (std::size_t k = 0; k < std::min(got.history.size(), expected.history.size()); ++k)
      expect_near("result of sweep " + std::to_string(k + 1) + " in the report [m/s]", equation, got.history[k],
                  expected.history[k], tolerance, {}, clue);
  }
}

/// Bodies, every fifth of them static, with contacts at random places; some pairs have several, or two at one place.
struct Crowd {
  Simulation all;
  std::vector<Contact> contacts;
};

inline Contact random_contact(Random& random, int i, int j) {
  return {i, j, random.unit_vector(), random.uniform(-0.02, -0.01), random.vector(0.5), random.vector(0.5)};
}

inline Crowd crowd(Random& random, int bodies, int contacts) {
  Crowd made;
  made.all.gravity = random.vector(5, 10);
  made.all.k = 1e3;
  made.all.max_sweeps = 5;  // so that the order of rows shows
  for (int b = 0; b < bodies; ++b)
    made.all.bodies.push_back(b % 5 == 4 ? random_static_body(random) : random_rigid_body(random));
  while (std::ssize(made.contacts) < contacts) {
    const int i = random.integer(0, bodies - 1);
    const int step = random.integer(1, bodies - 1);
    const int j = (i + step) % bodies;
    const auto is_static = [&](int b) { return made.all.bodies[static_cast<std::size_t>(b)].mass == 0; };
    if (is_static(i) && is_static(j)) continue;
    made.contacts.push_back(random_contact(random, i, j));
    const bool twice = random.integer(0, 1) == 1;
    if (twice) made.contacts.push_back(random_contact(random, i, j));
    if (made.contacts.size() % 4 == 0) {  // at the same points, with another gap
      made.contacts.push_back(made.contacts.back());
      made.contacts.back().gap /= 2;
    }
  }
  return made;
}

/// Opens every third contact by 0.02 m: it may close within the step, so that it has its rows.
inline void open_every_third(std::vector<Contact>& contacts) {
  for (std::size_t k = 0; k < contacts.size(); k += 3) contacts[k].gap = 0.02;
}

/// Returns momentum, then angular momentum about the world's origin, with the velocities of `now` at the positions of
/// `places`.
inline Twist<6> momenta(const Simulation& now, const Simulation& places) {
  Twist<6> sum = Twist<6>::Zero();
  for (std::size_t b = 0; b < now.bodies.size(); ++b) {
    const RigidBody& body = now.bodies[b];
    const Vec3 p = body.mass * body.v, L = world_inertia(body.q, body.principal) * body.omega;
    sum += twist(p, places.bodies[b].x.cross(p) + L);
  }
  return sum;
}

/// Texts about some mistakes, with their results.
inline std::vector<Mistake> mistakes_of(const Simulation& all, const std::vector<Contact>& contacts, double h,
                                        const std::vector<std::pair<Stages, std::string>>& which) {
  std::vector<Mistake> mistakes;
  for (const auto& [stages, text] : which) mistakes.push_back({assembled(all, contacts, h, stages), text});
  return mistakes;
}

/// A step of chapters 04 to 06.
using Step = std::function<void(Simulation& all, const std::vector<Contact>& contacts, double h)>;

inline bool have_same_bodies(const Contact& a, const Contact& b) {
  return a.i == b.i && a.j == b.j;
}

inline bool share_a_moving_body(const Simulation& all, const PointJoint& joint, const Contact& contact) {
  const auto moves = [&](int b) { return all.bodies[static_cast<std::size_t>(b)].mass != 0; };
  return (moves(joint.i) && (joint.i == contact.i || joint.i == contact.j)) ||
         (moves(joint.j) && (joint.j == contact.i || joint.j == contact.j));
}

/// Returns a sentence about a few contacts that are enough for a wrong result; empty if there are none.
inline std::string wrong_contacts(const std::vector<Contact>& contacts,
                                  const std::function<bool(const std::vector<Contact>&)>& is_wrong) {
  for (std::size_t a = 0; a < contacts.size(); ++a)
    for (std::size_t b = a + 1; b < contacts.size(); ++b)
      if (have_same_bodies(contacts[a], contacts[b]) && is_wrong({contacts[a], contacts[b]}))
        return "Two contacts of the same two bodies are enough for a wrong result: each has its own rows.";
  for (std::size_t a = 0; a + 2 < contacts.size(); ++a)
    for (std::size_t b = a + 1; b < contacts.size(); ++b)
      for (const std::size_t other : {a + 1, a + 2}) {
        if (!have_same_bodies(contacts[a], contacts[b]) || have_same_bodies(contacts[a], contacts[other]))
          continue;
        if (is_wrong({contacts[a], contacts[other], contacts[b]}) &&
            !is_wrong({contacts[a], contacts[b], contacts[other]}))
          return "Two contacts of the same two bodies, with a contact of other bodies between them in the "
                 "list, are enough for a wrong result: look at the whole list, not at the neighbours of a "
                 "contact.";
      }
  return "";
}

/// Returns a sentence about the smallest part of a simulation with which a step is wrong, too: no joint and no contact,
/// one joint alone, one contact alone, or two or three of them. Empty if `got` is right. For a mistake that is not among
/// the known ones.
inline std::string wrong_part(const Simulation& got, const Simulation& right, const Simulation& all,
                              const std::vector<Contact>& contacts, double h, const Step& step,
                              const Tolerance& tolerance) {
  if (got.bodies.size() != right.bodies.size() || are_alike(got, right, tolerance.value)) return "";
  const auto is_wrong = [&](const Simulation& part, const std::vector<Contact>& some) {
    Simulation stepped = part;
    step(stepped, some, h);
    return stepped.bodies.size() != part.bodies.size() ||
           !are_alike(stepped, assembled(part, some, h), tolerance.value);
  };
  const auto between = [&](int i, int j) {
    const auto body = [&](int b) {
      return std::to_string(b) +
             (all.bodies[static_cast<std::size_t>(b)].mass == 0 ? ", which is static," : "");
    };
    return " between body i = " + body(i) + " and body j = " + body(j) + " is enough for a wrong result.";
  };
  Simulation part = all;
  part.joints.clear();
  if (is_wrong(part, {})) return " The result is wrong without a joint or contact, too.";
  for (const PointJoint& joint : all.joints) {
    part.joints = {joint};
    if (!is_wrong(part, {})) continue;
    const RigidBody &i = all.bodies[static_cast<std::size_t>(joint.i)],
                    &j = all.bodies[static_cast<std::size_t>(joint.j)];
    const double apart = (j.x + j.q * joint.p_j - i.x - i.q * joint.p_i).norm();
    return " A single " +
           (joint.length > 0
                ? "distance of " + show(joint.length) + " m, with points " + show(apart) + " m apart,"
                : std::string("ball joint")) +
           between(joint.i, joint.j);
  }
  part.joints.clear();
  for (const Contact& contact : contacts)
    if (is_wrong(part, {contact}))
      return " A single contact with a gap of " + show(contact.gap) + " m" + between(contact.i, contact.j);
  const std::string first = " With one joint or contact alone the result is right. ";
  const std::string several =
      wrong_contacts(contacts, [&](const std::vector<Contact>& some) { return is_wrong(part, some); });
  if (!several.empty()) return first + several;
  for (const PointJoint& joint : all.joints)
    for (const Contact& contact : contacts) {
      part.joints = {joint};
      if (!share_a_moving_body(all, joint, contact) || !is_wrong(part, {contact})) continue;
      return first +
             "A joint and a contact of one body are enough for a wrong result: are they solved together?";
    }
  return first + "So look at what several have in common.";
}

/// The mistakes of stages that chapters 04 to 06 have in common.
inline std::vector<std::pair<Stages, std::string>> mistakes_in_order() {
  const std::string parting =
      "The contacts whose bodies part are missing. Forces and other rows may still close them: make rows for "
      "all.";
  return {
      {{.approaching_only = true}, parting},
      {{.open_approaching_only = true}, parting},
      {{.forgets_V = true}, "The rows have no effect: is V added to the velocities before the bodies move?"},
      {{.moves_before = true},
       "The bodies have moved before the rows were made. Rows need the gaps and velocities before the move."},
      {{.kicks_before = true},
       "Gravity counts twice: the bodies are kicked before the rows are made, and step_free kicks them again."},
      {{.adds_forces = true},
       "Gravity counts twice: W_f is added along with V, and step_free kicks the bodies again."},
      {{.forgets_forces = true},
       "W_f is missing: the rows need the effect of this step's forces. motion_of has it."},
      {{.adds_linear_part_only = true}, "V has an angular part, too: it changes ω."},
      {{.one_by_one = true},
       "Each row is solved for itself, without the others: put all into one list, and solve that."},
      {{.coincident_once = true},
       "Of two contacts at the same points one is missing: each in the list has its rows."}};
}

}  // namespace spook::testing
