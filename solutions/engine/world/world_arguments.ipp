// Checks of arguments that several parts of a world share.
#include "common/require.hpp"

namespace spook {

static void require_kind(bool right, const Joint& joint, const std::string& rule) {
  if (!right) throw std::invalid_argument("kind must be " + rule + ", but is " + name_of(joint.kind));
}

/// Throws std::invalid_argument for an invalid motor.
static void require_sound(const Motor& motor) {
  const Motion<6> at_rest{.inverse_mass = {{}, {}},
                          .W = {Twist<6>::Zero(), Twist<6>::Zero()},
                          .Wf = {Twist<6>::Zero(), Twist<6>::Zero()}};
  const Twist<6> G = Twist<6>::Zero();
  motor_row({.i = 0, .j = 1, .Gi = G, .Gj = G, .value = 0}, motor, 1, at_rest);
}

/// Throws std::invalid_argument if friction would have no bound although a force may press bodies together.
template <int Dof>
static void require_weight_in_box(const Settings<Dof>& settings, bool forced, bool rubs) {
  const bool boxed = rubs && settings.solver.friction == FrictionModel::box && !settings.soft_steps;
  if (boxed && forced && settings.gravity.isZero(0))
    throw std::invalid_argument(
        "gravity must not be 0 where force presses bodies together: the friction box takes its bound from it; "
        "solver cone_gauss_seidel() or two_pass() does not");
}

}  // namespace spook
