#include "scenes/block.hpp"

#include "common/require.hpp"
#include "scenes/number.hpp"

namespace spook {

Block block(const Parameters& parameters) {
  return {
      .mass = parameters.number("m"), .base = parameters.number("base"), .height = parameters.number("height")};
}

template <>
Body<3> lying(const Block& block, double load, const Vec3&, double k) {
  const double radius = block.height / 2;
  return {.x = Vec3(0, 0, radius - load / k), .mass = block.mass, .radius = radius};
}

template <>
Body<6> lying(const Block& block, double load, const Vec3& friction, double k) {
  const double pull = std::abs(friction.x()) + std::abs(friction.y());
  // The back corner carries N/4 - height pull/(4 base), and no corner can pull.
  if (block.height * pull > block.base * load)
    reject("height", block.height,
           "at most " + short_text(block.base * load / pull) + ", or the box tips over");

  const Vec3 half = block.half_sides();
  const Vec3 pitch = half.z() / (k * block.base * block.base) * Vec3(friction.y(), -friction.x(), 0);
  const double angle = pitch.norm();
  const Quat q = angle == 0 ? Quat::Identity() : Quat(Eigen::AngleAxisd(angle, pitch / angle));
  return {.x = Vec3(0, 0, half.z() - load / (4 * k)),
          .mass = block.mass,
          .q = q,
          .principal = solid_box_moments(block.mass, half),
          .corners = box_corners(half)};
}

namespace parameter {

Parameter base(double value) {
  return {.name = "base",
          .meaning = "side of the square base of the box",
          .unit = "m",
          .value = value,
          .limits = {.low = 0, .low_included = false}};
}

Parameter height(double value) {
  return {.name = "height",
          .meaning = "of the block; the point's sphere has half of it as its radius",
          .unit = "m",
          .value = value,
          .limits = {.low = 0, .low_included = false}};
}

Parameter block_model() {
  return {.name = "model",
          .meaning = "point: a point mass that cannot turn; box: a rigid box on its corners",
          .choices = {"point", "box"}};
}

}  // namespace parameter

}  // namespace spook
