#pragma once
// The energy of springs: of contacts, of joints, and of the springs on hinges and sliders.
#include "engine/world/world.hpp"

namespace spook {

/// The energy of all springs under the forces of the last step, which took `h` [s]: ½ (λ/h)²/k for each row of a joint
/// and each normal row of a contact, and ½ k x² for a spring on a hinge or slider [J]. If k h² is much larger than the
/// masses, a gap is an error of the step and not a spring's deflection, so ½ k gap² would be wrong. At integrator order
/// 4 joints are rigid: 0.
template <int Dof>
double spring_energy(const World<Dof>& world, double h);

}  // namespace spook
