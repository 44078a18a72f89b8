#pragma once
// All scenes. To add a scene, write a file of its own, and add a line here and in registry.cpp.
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

/// Returns the scene of that name. Throws std::invalid_argument, with the nearest known name, for an unknown name.
const SceneDescription& find_scene(std::string_view name);

/// Builds a scene, for SceneDescription::build.
template <class SomeScene>
std::unique_ptr<Scene> build_as(const Parameters& parameters, const Method& method) {
  return std::make_unique<SomeScene>(parameters, method);
}

/// Builds a scene of point masses or rigid bodies, as the parameter `model` says.
template <template <int Dof> class SomeScene>
std::unique_ptr<Scene> build_model(const Parameters& parameters, const Method& method) {
  if (parameters.choice("model") == "point") return build_as<SomeScene<3>>(parameters, method);
  return build_as<SomeScene<6>>(parameters, method);
}

}  // namespace spook
