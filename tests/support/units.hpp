#pragma once
// Units, so that a test can say what the numbers of an exercise are made of, and count them in other units.
//
//   using namespace units;
//   Vec3(3, 0, 1) * (m / s)      // a Quantity: a value and its unit
//   V * velocity               // of bodies: m/s, and rad/s below it
//
// Numbers, vectors and lists of them have one unit throughout, and a plain number has none. What has fields of
// several units says so in a function each_number(Visitor&, Type&, ByField): those of chapters 03 and 04 are in quantities.hpp.
#include <array>
#include <concepts>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/types.hpp"

namespace spook::testing {

/// A product of powers of kilograms, metres and seconds.
struct Unit {
  int mass = 0, length = 0, time = 0;

  constexpr bool operator==(const Unit&) const = default;
  constexpr Unit operator*(const Unit& other) const {
    return {mass + other.mass, length + other.length, time + other.time};
  }
  constexpr Unit operator/(const Unit& other) const {
    return {mass - other.mass, length - other.length, time - other.time};
  }
};

constexpr Unit operator/(int, const Unit& unit) {  // 1 / s
  return Unit{} / unit;
}

/// "kg m/s^2"; empty for a plain number.
std::string show(const Unit& unit);

/// Of what a body's 3 or 6 numbers are: the linear ones, then the angular ones.
struct TwistUnits {
  Unit linear, angular;
};

/// Of bounds, which are checked where they enter: they are counted in other units, but never a NaN.
struct BoundUnits {
  Unit unit;
};

/// What has its own fields, each with its unit.
struct ByField {};

/// What a function returns that returns nothing.
struct Nothing {};

namespace units {
inline constexpr Unit pure{}, kg{1, 0, 0}, m{0, 1, 0}, s{0, 0, 1}, N = kg * m / (s * s), J = N * m;
inline constexpr TwistUnits velocity{m / s, 1 / s};           // W, V
inline constexpr TwistUnits jacobian{pure, m};                // a block of G
inline constexpr TwistUnits responses{1 / kg, 1 / (kg * m)};  // M⁻¹ Gᵀ
inline constexpr BoundUnits impulse_bounds{N * s};
inline constexpr ByField by_field;
inline constexpr Nothing nothing;
}  // namespace units

template <class Value, class Units>
struct Quantity {
  Value value;
  Units units;
};

template <class Units>
concept SomeUnits =
    std::same_as<Units, Unit> || std::same_as<Units, TwistUnits> || std::same_as<Units, BoundUnits>;

template <class Value, SomeUnits Units>
requires(!SomeUnits<Value>) auto operator*(const Value& value, const Units& units) {
  if constexpr (requires { typename Value::PlainObject; })
    return Quantity<typename Value::PlainObject, Units>{value, units};
  else if constexpr (std::is_arithmetic_v<Value>)  // 5 * kg
    return Quantity<double, Units>{static_cast<double>(value), units};
  else
    return Quantity<Value, Units>{value, units};
}

/// What goes over all the numbers of a value.
class Visitor {
 public:
  virtual ~Visitor() = default;
  virtual void number(double& value, const Unit& unit) = 0;
  /// A number that is checked where it enters: a bound, a coefficient.
  virtual void bound(double& value, const Unit& unit) { number(value, unit); }
  /// What is counted has no unit: an index, a size, yes or no.
  virtual void count(long long value) = 0;
  /// From here on comes what no function has any business to change, such as the masses of a row; or again what may.
  virtual void fixed(bool) {}
};

inline void each_number(Visitor& visitor, double& value, const Unit& unit) {
  visitor.number(value, unit);
}

template <std::integral Count, class Units>
void each_number(Visitor& visitor, Count& count, const Units&) {
  visitor.count(static_cast<long long>(count));
}

template <int Rows, int Columns>
void each_number(Visitor& visitor, Eigen::Matrix<double, Rows, Columns>& value, const Unit& unit) {
  if constexpr (Rows < 0 || Columns < 0) visitor.count(value.size());
  for (Eigen::Index k = 0; k < value.size(); ++k) visitor.number(value.data()[k], unit);
}

template <int Rows, int Columns>
void each_number(Visitor& visitor, Eigen::Matrix<double, Rows, Columns>& value, const BoundUnits& units) {
  if constexpr (Rows < 0 || Columns < 0) visitor.count(value.size());
  for (Eigen::Index k = 0; k < value.size(); ++k) visitor.bound(value.data()[k], units.unit);
}

template <int Dof>
void each_number(Visitor& visitor, Twist<Dof>& value, const TwistUnits& units) {
  for (int k = 0; k < Dof; ++k) visitor.number(value[k], k < 3 ? units.linear : units.angular);
}

inline void each_number(Visitor& visitor, Quat& q, const Unit& unit) {
  each_number(visitor, q.coeffs(), unit);
}

template <class Value, class Units>
void each_number(Visitor& visitor, std::optional<Value>& value, const Units& units);
template <class First, class Second, class Units>
void each_number(Visitor& visitor, std::pair<First, Second>& value, const Units& units);
template <class Value, std::size_t size, class Units>
void each_number(Visitor& visitor, std::array<Value, size>& values, const Units& units);

template <class Value, class Units>
void each_number(Visitor& visitor, std::vector<Value>& values, const Units& units) {
  visitor.count(std::ssize(values));
  for (Value& value : values) each_number(visitor, value, units);
}
template <class Units>
void each_number(Visitor& visitor, std::vector<bool>& values, const Units&) {
  visitor.count(std::ssize(values));
  for (const bool value : values) visitor.count(value);
}

template <class Value, class Units>
void each_number(Visitor& visitor, std::optional<Value>& value, const Units& units) {
  visitor.count(value.has_value());
  if (value) each_number(visitor, *value, units);
}

template <class First, class Second, class Units>
void each_number(Visitor& visitor, std::pair<First, Second>& value, const Units& units) {
  each_number(visitor, value.first, units);
  each_number(visitor, value.second, units);
}

template <class Value, std::size_t size, class Units>
void each_number(Visitor& visitor, std::array<Value, size>& values, const Units& units) {
  for (Value& value : values) each_number(visitor, value, units);
}

}  // namespace spook::testing
