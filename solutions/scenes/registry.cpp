#include "scenes/registry.hpp"

#include <stdexcept>

#include "engine/support/did_you_mean.hpp"

namespace spook {

const std::vector<SceneDescription>& scenes() {
  static const std::vector<SceneDescription> all = {free_fall(),
                                                    oscillator(),
                                                    orbit(),
                                                    top(),
                                                    resting_sphere(),
                                                    stack(),
                                                    incline(),
                                                    sliding_block(),
                                                    slide_to_roll(),
                                                    spinning_disc(),
                                                    bouncing_ball(),
                                                    cradle(),
                                                    pile(),
                                                    pendulum(),
                                                    double_pendulum(),
                                                    wire(),
                                                    rope(),
                                                    cloth(),
                                                    stiff_wire(),
                                                    closed_loop(),
                                                    tower(),
                                                    wall(),
                                                    flat_box_100_contacts(),
                                                    door(),
                                                    physical_pendulum(),
                                                    flywheel(),
                                                    gyroscope(),
                                                    bead(),
                                                    four_bar(),
                                                    andrews(),
                                                    bricard(),
                                                    slider_crank(),
                                                    governor()};
  return all;
}

const SceneDescription& find_scene(std::string_view name) {
  std::vector<std::string> names;
  for (const SceneDescription& scene : scenes()) {
    if (scene.name == name) return scene;
    names.push_back(scene.name);
  }
  const std::string given(name);
  throw std::invalid_argument("unknown scene \"" + given + "\"" + did_you_mean(given, names));
}

}  // namespace spook
