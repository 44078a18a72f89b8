#include "engine/constraints/contact_resistance.hpp"

#include "13_mechanisms/mechanisms.hpp"

namespace spook {

static constexpr double small_sigma = 1e-9;  // of the diagonal: two contacts of a pair have the same rows

/// Adds the row of a motor that brakes the rotation about an axis, with a torque of at most `most` [N m].
static void add_brake(const Contact& contact, const Vec3& axis, double most, double h, const Motion<6>& motion,
                      std::vector<Row<6>>& rows) {
  Coordinate angle{.i = contact.i, .j = contact.j, .Gi = Twist<6>::Zero(), .Gj = Twist<6>::Zero(), .value = 0};
  angle.Gi.tail<3>() = -axis;
  angle.Gj.tail<3>() = axis;
  Row<6> row = motor_row(angle, {.speed = 0, .strength = most, .viscosity = infinity}, h, motion);
  if (row.diagonal == 0) return;  // neither body can turn
  row.Sigma = small_sigma * row.diagonal;
  row.diagonal += row.Sigma;
  rows.push_back(row);
}

void add_resistance_rows(const std::vector<Contact>& contacts, double h, const Materials& materials,
                         const WarmStartCache& last, const Motion<6>& motion, std::vector<Row<6>>& rows) {
  for (const Contact& contact : contacts) {
    const PairMaterial touching = materials.of(contact.i, contact.j);
    if (!(touching.rolling_resistance > 0 || touching.torsional_resistance > 0)) continue;
    const double N = last.contact_force(contact.i, contact.j);
    if (N == 0) continue;
    if (touching.torsional_resistance > 0)
      add_brake(contact, contact.n, touching.torsional_resistance * N, h, motion, rows);
    if (!(touching.rolling_resistance > 0)) continue;
    const Vec3 omega = (motion.W[contact.j] - motion.W[contact.i]).tail<3>();
    const Vec3 rolling = omega - omega.dot(contact.n) * contact.n;
    const bool rolls = rolling.norm() > 1e-9 * omega.norm();
    const Vec3 first = rolls ? rolling.normalized() : tangents(contact.n).t1;
    for (const Vec3& axis : {first, Vec3(contact.n.cross(first))})
      add_brake(contact, axis, touching.rolling_resistance * N, h, motion, rows);
  }
}

}  // namespace spook
