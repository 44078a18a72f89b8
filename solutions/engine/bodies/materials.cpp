#include "engine/bodies/materials.hpp"

#include <algorithm>

#include "common/require.hpp"

namespace spook {

void Materials::look_at(const Material& material) {
  if (material.friction) require_not_negative("friction", *material.friction);
  if (material.restitution && !(*material.restitution >= 0 && *material.restitution <= 1))
    reject("restitution", *material.restitution, "from 0 to 1");
  if (material.k) require_positive("k", *material.k);
  if (material.d) require_not_negative("d", *material.d);
  for (const auto& [name, length] : {std::pair("rolling_resistance", material.rolling_resistance),
                                     std::pair("torsional_resistance", material.torsional_resistance)}) {
    if (!length) continue;
    require_not_negative(name, *length);
    resist_ = resist_ || *length > 0;
  }
  rub_ = rub_ || material.friction.value_or(0) > 0;
  bounce_ = bounce_ || material.restitution;
}

void Materials::set(int body, const Material& material) {
  look_at(material);
  if (body >= std::ssize(bodies_)) bodies_.resize(static_cast<std::size_t>(body) + 1);
  bodies_[static_cast<std::size_t>(body)] = material;
}

void Materials::set(int i, int j, const Material& material) {
  look_at(material);
  pairs_[std::minmax(i, j)] = material;
}

void Materials::remove(int body) {
  if (body < std::ssize(bodies_)) bodies_.erase(bodies_.begin() + body);
  std::map<std::pair<int, int>, Material> left;
  for (const auto& [pair, material] : pairs_) {
    const auto [i, j] = pair;
    if (i != body && j != body) left[{i - (i > body), j - (j > body)}] = material;
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
