#include "scenes/same_sizes.hpp"

#include <algorithm>

namespace spook {

static bool are_same(const Shape& one, const Shape& other) {
  return match(one, [&]<class Type>(const Type& shape) {
    const Type* same = std::get_if<Type>(&other);
    return same && shape.numbers() == same->numbers();
  });
}

static bool are_same(const Plane& one, const Plane& other) {
  return one.body == other.body && one.n == other.n && one.offset == other.offset;
}

/// Compares points up to round-off: they may have been computed from other positions of the bodies.
static bool are_same(const Joint& one, const Joint& other) {
  const double size = std::max({one.p_i.norm(), one.p_j.norm(), one.length.value_or(0)});
  const auto is_near = [size](double difference) { return std::abs(difference) <= 1e-9 * size; };
  return one.kind == other.kind && one.i == other.i && one.j == other.j &&
         one.length.has_value() == other.length.has_value() &&
         is_near(one.length.value_or(0) - other.length.value_or(0)) && is_near((one.p_i - other.p_i).norm()) &&
         is_near((one.p_j - other.p_j).norm());
}

/// Tells whether the second list begins as the first one.
template <class Value>
static bool begins_as(const std::vector<Value>& all, const std::vector<Value>& before) {
  return before.size() >= all.size() &&
         std::equal(all.begin(), all.end(), before.begin(),
                    [](const Value& a, const Value& b) { return are_same(a, b); });
}

template <int Dof>
bool has_same_sizes(const World<Dof>& world, const World<Dof>& before) {
  const auto shapes_of = [](const World<Dof>& one) { return one.shapes().by_body(one.bodies().size()); };
  return begins_as(shapes_of(world), shapes_of(before)) &&
         begins_as(world.shapes().planes, before.shapes().planes) && begins_as(world.joints(), before.joints());
}

template bool has_same_sizes(const World<3>&, const World<3>&);
template bool has_same_sizes(const World<6>&, const World<6>&);

}  // namespace spook
