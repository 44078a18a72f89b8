#include "engine/constraints/soft_rows.hpp"

#include <algorithm>

#include "common/require.hpp"

namespace spook {

static void require_sound(const std::string& of, const SoftSpring& spring) {
  require_positive(of + " frequency", spring.frequency);
  require_positive(of + " damping", spring.damping);
}

void require_sound(const SoftSteps& soft) {
  if (soft.substeps < 1 || soft.substeps > 1024) reject("substeps", soft.substeps, "from 1 to 1024");
  require_sound("contacts'", soft.contacts);
  require_sound("joints'", soft.joints);
  require_positive("closing_speed", soft.closing_speed);
}

template <int Dof>
static void set(Row<Dof>& row, double S, double B, double Sigma) {
  row.B = B;
  row.Sigma = Sigma;
  row.diagonal = S + Sigma;
}

template <int Dof>
void make_soft(const SoftGap& at, const SoftSpring& spring, double closing_speed, double h, Row<Dof>& row) {
  if (at.kind == SoftKind::unchanged) return;
  if (at.kind == SoftKind::limits && at.gap > 0) return set(row, at.S, -at.gap / h, 0);
  const double speed = -spring.closed_part() / h * at.gap;
  set(row, at.S, at.kind == SoftKind::limits ? std::min(speed, closing_speed) : speed,
      spring.softness() * at.S);
}

template <int Dof>
void make_rigid(const SoftGap& at, double h, Row<Dof>& row) {
  if (at.kind == SoftKind::unchanged) return;
  set(row, at.S, at.kind == SoftKind::limits ? -std::max(0.0, at.gap) / h : 0, 0);
}

template <int Dof>
void soften_joint(const Joint& joint, double h, Row<Dof>* rows, SoftGap* gaps) {
  const int holding = joint.holding_rows();
  const double built = spook_parameters(h, *joint.k, *joint.d).a;  // B = -a g
  for (int k = 0; k < holding; ++k) {
    const double S = rigid_diagonal(rows[k]), gap = -rows[k].B / built;
    const double a = 1 / (h * (1 + *joint.d));
    gaps[k] = {.kind = joint.has_default_k ? SoftKind::holds : SoftKind::unchanged, .gap = gap, .S = S};
    if (!joint.has_default_k) set(rows[k], S, -a * gap, a / (h * joint.stiffness(k)));
  }
  if (!joint.limits) return;
  Row<Dof>& limit = rows[holding];
  const double closed = spook_parameters(h, joint.stiffness(holding), *joint.limit_d).a;
  gaps[holding] = {.kind = SoftKind::limits,
                   .gap = limit.B < 0 ? -limit.B * h : -limit.B / closed,
                   .S = rigid_diagonal(limit)};
  limit.hi = infinity;
}

template void make_soft<3>(const SoftGap&, const SoftSpring&, double, double, Row<3>&);
template void make_soft<6>(const SoftGap&, const SoftSpring&, double, double, Row<6>&);
template void make_rigid<3>(const SoftGap&, double, Row<3>&);
template void make_rigid<6>(const SoftGap&, double, Row<6>&);
template void soften_joint<3>(const Joint&, double, Row<3>*, SoftGap*);
template void soften_joint<6>(const Joint&, double, Row<6>*, SoftGap*);

}  // namespace spook
