#include "engine/rows.hpp"

#include <cassert>

namespace spook {

template <int Dof>
Constraint<Dof> contact_constraint(const Contact& contact, const Spook& spook) {
  assert(contact.i != contact.j && "a body has no contact with itself");
  const ContactJacobian G = contact_jacobian(contact);
  return {.i = contact.i,
          .j = contact.j,
          .Gi = G.Gi.head<Dof>(),
          .Gj = G.Gj.head<Dof>(),
          .gap = contact.gap,
          .spook = spook,
          .lo = 0,
          .hi = infinity};
}

/// How many contacts there are from `first` on between the same two bodies.
static int contacts_of_pair(const std::vector<Contact>& contacts, std::size_t first) {
  std::size_t end = first;
  while (end < contacts.size() && contacts[end].i == contacts[first].i && contacts[end].j == contacts[first].j)
    ++end;
  return static_cast<int>(end - first);
}

/// Velocity of j's contact point relative to i's, that of the forces included.
static Vec3 slip(const Contact& contact, const Motion<3>& motion) {
  const auto v = [&](int body) { return motion.W[body] + motion.Wf[body]; };
  return v(contact.j) - v(contact.i);
}

static Vec3 slip(const Contact& contact, const Motion<6>& motion) {
  const auto v = [&](int body, const Vec3& r) {
    const Twist<6> W = motion.W[body] + motion.Wf[body];
    return Vec3(W.head<3>() + W.tail<3>().cross(r));
  };
  return v(contact.j, contact.r_j) - v(contact.i, contact.r_i);
}

/// Most contacts of a scene share their k and d.
class SpookOf {
 public:
  explicit SpookOf(double h) : h_(h) {}
  const Spook& operator()(double k, double d) {
    if (k != k_ || d != d_) spook_ = spook_parameters(h_, k, d);
    k_ = k, d_ = d;
    return spook_;
  }

 private:
  double h_, k_ = 0, d_ = 0;  // no k is 0
  Spook spook_{};
};

template <int Dof>
void add_contact_rows(const std::vector<Contact>& contacts, double h, const Materials& materials,
                      const Friction& friction, const Motion<Dof>& motion, std::vector<Row<Dof>>& rows,
                      std::vector<Rubbing>& rubbing) {
  SpookOf spook_of(h);
  if (!materials.rub()) {
    for (const Contact& contact : contacts) {
      const Touching touching = materials.of(contact.i, contact.j);
      rows.push_back(make_row(contact_constraint<Dof>(contact, spook_of(touching.k, touching.d)), motion));
    }
    return;
  }
  const Spook rub = friction_parameters(h, friction.c);
  const auto bound = [&](const Contact& contact, double mu, int count) {
    if (friction.model != FrictionModel::box) return friction.model == FrictionModel::cone ? infinity : 0.0;
    const double mass = representative_mass(motion.inverse_mass[contact.i].linear,
                                            motion.inverse_mass[contact.j].linear, count);
    return friction_bound(mu, mass, std::abs(friction.gravity.dot(contact.n)), h);
  };
  for (std::size_t first = 0; first < contacts.size();) {
    const int count = contacts_of_pair(contacts, first);
    const Touching touching = materials.of(contacts[first].i, contacts[first].j);
    for (const std::size_t end = first + static_cast<std::size_t>(count); first < end; ++first) {
      const Contact& contact = contacts[first];
      if (friction.model != FrictionModel::box)
        rubbing.push_back({.normal = rows.size(), .mu = touching.friction});
      rows.push_back(make_row(contact_constraint<Dof>(contact, spook_of(touching.k, touching.d)), motion));
      const Tangents along = friction.sliding_tangents ? sliding_tangents(contact.n, slip(contact, motion),
                                                                          1e-3 * friction.gravity.norm() * h)
                                                       : tangents(contact.n);
      for (const Constraint<Dof>& row :
           friction_constraints<Dof>(contact, along, bound(contact, touching.friction, count), rub))
        rows.push_back(make_row(row, motion));
    }
  }
}

/// The rows of Eq. (6.6), with both lever arms to one point between the two: Eq. (6.15). There is one force then and no
/// torque, and the gaps are as seen by somebody who turns with the joint.
template <int Dof>
static std::array<Constraint<Dof>, 3> ball_joint_at_one_point(Attachment i, Attachment j, const Spook& spook,
                                                              const Motion<Dof>& motion) {
  std::array<Constraint<Dof>, 3> rows = ball_joint_constraints<Dof>(i, j, spook);
  if constexpr (Dof == 6) {
    const Vec3 apart = (j.x + j.r) - (i.x + i.r);
    const double of_i = motion.inverse_mass[i.body].linear, of_j = motion.inverse_mass[j.body].linear;
    i.r += of_j / (of_i + of_j) * apart;
    j.r -= of_i / (of_i + of_j) * apart;
    const std::array<Constraint<6>, 3> shared = ball_joint_constraints<6>(i, j, spook);
    for (std::size_t axis = 0; axis < rows.size(); ++axis) {
      rows[axis].Gi = shared[axis].Gi;
      rows[axis].Gj = shared[axis].Gj;
    }
  }
  return rows;
}

template <int Dof>
void add_joint_rows(const std::vector<Joint>& joints, double h, const Bodies<Dof>& bodies,
                    std::vector<Row<Dof>>& rows) {
  SpookOf spook_of(h);
  for (const Joint& joint : joints) {
    const Spook& spook = spook_of(*joint.k, *joint.d);
    // (World::step has seen to it that every distance has a direction.)
    const Attachment i = attachment(joint.i, joint.p_i, bodies), j = attachment(joint.j, joint.p_j, bodies);
    if (joint.length) {
      rows.push_back(make_row(distance_constraint<Dof>(i, j, *joint.length, spook), bodies.motion));
    } else {
      for (const Constraint<Dof>& row : ball_joint_at_one_point<Dof>(i, j, spook, bodies.motion))
        rows.push_back(make_row(row, bodies.motion));
    }
  }
}

template Constraint<3> contact_constraint<3>(const Contact&, const Spook&);
template Constraint<6> contact_constraint<6>(const Contact&, const Spook&);
template void add_contact_rows<3>(const std::vector<Contact>&, double, const Materials&, const Friction&,
                                  const Motion<3>&, std::vector<Row<3>>&, std::vector<Rubbing>&);
template void add_contact_rows<6>(const std::vector<Contact>&, double, const Materials&, const Friction&,
                                  const Motion<6>&, std::vector<Row<6>>&, std::vector<Rubbing>&);
template void add_joint_rows<3>(const std::vector<Joint>&, double, const Bodies<3>&, std::vector<Row<3>>&);
template void add_joint_rows<6>(const std::vector<Joint>&, double, const Bodies<6>&, std::vector<Row<6>>&);

}  // namespace spook
