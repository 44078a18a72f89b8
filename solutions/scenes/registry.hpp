#pragma once
// All scenes. A new one is a file of its own, a line here, and a line in registry.cpp.
#include <string_view>

#include "scenes/scene.hpp"

namespace spook {

SceneDescription free_fall();
SceneDescription oscillator();
SceneDescription orbit();
SceneDescription top();
SceneDescription resting_sphere();
SceneDescription stack();
SceneDescription incline();
SceneDescription sliding_block();
SceneDescription slide_to_roll();
SceneDescription spinning_disc();
SceneDescription bouncing_ball();
SceneDescription cradle();
SceneDescription pile();
SceneDescription pendulum();
SceneDescription double_pendulum();
SceneDescription wire();
SceneDescription rope();
SceneDescription cloth();
SceneDescription stiff_wire();
SceneDescription closed_loop();
SceneDescription tower();
SceneDescription wall();
SceneDescription flat_box_100_contacts();
SceneDescription door();
SceneDescription physical_pendulum();
SceneDescription flywheel();
SceneDescription gyroscope();
SceneDescription bead();
SceneDescription four_bar();
SceneDescription andrews();
SceneDescription bricard();
SceneDescription slider_crank();
SceneDescription governor();

const std::vector<SceneDescription>& scenes();

/// Throws std::invalid_argument, with the nearest name there is, for a name that is no scene's.
const SceneDescription& find_scene(std::string_view name);

/// For SceneDescription::build.
template <class SomeScene>
std::unique_ptr<Scene> build_as(const Parameters& parameters, const Method& method) {
  return std::make_unique<SomeScene>(parameters, method);
}

/// The same where the parameter `model` says if its bodies are point masses or rigid.
template <template <int Dof> class SomeScene>
std::unique_ptr<Scene> build_model(const Parameters& parameters, const Method& method) {
  if (parameters.choice("model") == "point") return build_as<SomeScene<3>>(parameters, method);
  return build_as<SomeScene<6>>(parameters, method);
}

}  // namespace spook
