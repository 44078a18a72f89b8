#include "engine/impacts/impacts.hpp"

#include <algorithm>
#include <cmath>

namespace spook {

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

/// Updates a contact after its bodies have moved: its two lever arms meet in one point again, and that of a sphere
/// stays.
Contact moved_on(Contact contact, const std::vector<Vec3>& by, const std::vector<double>& radii) {
  const Vec3 apart = by[contact.j] - by[contact.i];
  contact.gap += contact.n.dot(apart);
  if (radii[contact.j] > 0)
    contact.r_i += apart;
  else
    contact.r_j -= apart;
  return contact;
}

}  // namespace

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

template <int Dof>
int resolve_late_impacts(std::vector<Contact>& contacts, const LawOf& law, double h, const Shapes& shapes,
                         Bodies<Dof>& bodies) {
  Motion<Dof>& motion = bodies.motion;
  const std::vector<double> radii = radii_of(shapes, bodies.size());
  std::vector<Vec3> moved(bodies.size(), Vec3::Zero());  // displacement since the contacts were found
  const auto move = [&](int body, const Vec3& by) {
    bodies.x[body] += by;
    moved[body] += by;
  };

  // A contact that touches up to round-off takes part in simultaneous impacts.
  const double touching_gap = std::isfinite(shapes.smallest) ? 1e-9 * shapes.smallest : 0;
  std::vector<Contact> one(1);
  int impacts = 0;
  // The number of impacts at the last impact of each body, and at the last check of each contact.
  std::vector<int> last_of(bodies.size(), 0), looked_at(contacts.size(), -1);
  bool quiet = false;
  for (int pass = 0; !quiet; ++pass) {
    quiet = true;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const int i = contacts[c].i, j = contacts[c].j;
      if (looked_at[c] >= std::max(last_of[i], last_of[j])) continue;  // unchanged since then
      looked_at[c] = impacts;
      const Contact contact = moved_on(contacts[c], moved, radii);
      if (contact.gap > touching_gap) continue;
      const double u_n = separation_speed(contact, motion);
      if (u_n >= 0) continue;
      ImpactLaw of_pair = law(contact);
      if (pass >= of_pair.max_passes || u_n >= -of_pair.threshold) continue;
      const double late = lateness(contact, u_n, h, motion);
      one[0] = before(contact, late, radii, bodies);
      of_pair.max_passes = 1;
      const Twist<Dof> since_i = late / h * motion.Wf[i], since_j = late / h * motion.Wf[j];
      const Twist<Dof> W_i = motion.W[i] -= since_i, W_j = motion.W[j] -= since_j;
      const bool hit = spook::resolve_impacts(one, of_pair, motion).impacts > 0;
      const Twist<Dof> change_i = motion.W[i] - W_i, change_j = motion.W[j] - W_j;
      motion.W[i] += since_i;
      motion.W[j] += since_j;
      if (!hit) continue;
      ++impacts;
      for (const int body : {i, j})
        if (!bodies.is_fixed(static_cast<std::size_t>(body))) last_of[body] = impacts;
      quiet = false;
      move(i, late * change_i.template head<3>());  // Eq. (7.16)
      move(j, late * change_j.template head<3>());
    }
  }
  if (impacts == 0) return 0;
  for (Contact& contact : contacts) contact = moved_on(contact, moved, radii);
  return impacts;
}

template double separation_speed<3>(const Contact&, const Motion<3>&);
template double separation_speed<6>(const Contact&, const Motion<6>&);
template int resolve_late_impacts<3>(std::vector<Contact>&, const LawOf&, double, const Shapes&, Bodies<3>&);
template int resolve_late_impacts<6>(std::vector<Contact>&, const LawOf&, double, const Shapes&, Bodies<6>&);

}  // namespace spook
