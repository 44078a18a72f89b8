#include "engine/bodies/materials.hpp"

#include <algorithm>

#include "common/require.hpp"

namespace spook {

/// Throws std::invalid_argument for numbers out of range.
static void require_sound(const Material& material) {
  if (material.friction) require_not_negative("friction", *material.friction);
  if (material.restitution && !(*material.restitution >= 0 && *material.restitution <= 1))
    reject("restitution", *material.restitution, "from 0 to 1");
  if (material.k) require_positive("k", *material.k);
  if (material.d) require_not_negative("d", *material.d);
  if (material.rolling_resistance) require_not_negative("rolling_resistance", *material.rolling_resistance);
  if (material.torsional_resistance)
    require_not_negative("torsional_resistance", *material.torsional_resistance);
}

/// Counts a material once `more`, or once less if `more` is -1.
void Materials::count(const Material& material, int more) {
  if (material != Material{}) set_ += more;
  if (material.friction.value_or(0) > 0) rub_ += more;
  if (material.restitution) bounce_ += more;
  if (material.rolling_resistance.value_or(0) > 0 || material.torsional_resistance.value_or(0) > 0)
    resist_ += more;
}

void Materials::set(int body, const Material& material) {
  require_sound(material);
  if (body >= std::ssize(bodies_)) bodies_.resize(static_cast<std::size_t>(body) + 1);
  Material& own = bodies_[static_cast<std::size_t>(body)];
  count(own, -1);
  own = material;
  count(own, 1);
}

void Materials::set(int i, int j, const Material& material) {
  require_sound(material);
  Material& own = pairs_[std::minmax(i, j)];
  count(own, -1);
  own = material;
  count(own, 1);
}

void Materials::remove(int body) {
  if (body < std::ssize(bodies_)) {
    count(bodies_[static_cast<std::size_t>(body)], -1);
    bodies_.erase(bodies_.begin() + body);
  }
  std::map<std::pair<int, int>, Material> left;
  for (const auto& [pair, material] : pairs_) {
    const auto [i, j] = pair;
    if (i == body || j == body)
      count(material, -1);
    else
      left[{i - (i > body), j - (j > body)}] = material;
  }
  pairs_ = std::move(left);
}

PairMaterial Materials::of_body(int body) const {
  if (body >= std::ssize(bodies_)) return world_;
  const Material& own = bodies_[static_cast<std::size_t>(body)];
  return {.friction = own.friction.value_or(world_.friction),
          .restitution = own.restitution.value_or(world_.restitution),
          .k = own.k.value_or(world_.k),
          .d = own.d.value_or(world_.d),
          .rolling_resistance = own.rolling_resistance.value_or(0),
          .torsional_resistance = own.torsional_resistance.value_or(0)};
}

PairMaterial Materials::of(int i, int j) const {
  if (!any()) return world_;
  const PairMaterial a = of_body(i), b = of_body(j);
  PairMaterial both{.friction = std::sqrt(a.friction * b.friction),
                    .restitution = std::max(a.restitution, b.restitution),
                    .k = std::min(a.k, b.k),
                    .d = std::max(a.d, b.d),
                    .rolling_resistance = std::max(a.rolling_resistance, b.rolling_resistance),
                    .torsional_resistance = std::max(a.torsional_resistance, b.torsional_resistance)};
  if (const auto found = pairs_.find(std::minmax(i, j)); found != pairs_.end()) {
    const Material& given = found->second;
    both = {.friction = given.friction.value_or(both.friction),
            .restitution = given.restitution.value_or(both.restitution),
            .k = given.k.value_or(both.k),
            .d = given.d.value_or(both.d),
            .rolling_resistance = given.rolling_resistance.value_or(both.rolling_resistance),
            .torsional_resistance = given.torsional_resistance.value_or(both.torsional_resistance)};
  }
  return both;
}

}  // namespace spook
