#pragma once
// Units, with which a test declares the units of an exercise's numbers, and converts them to other units.
//
//   using namespace units;
//   Vec3(3, 0, 1) * (m / s)      // a Quantity: a value and its unit
//   V * velocity               // velocities of bodies: m/s, then rad/s
//
// Numbers, vectors and lists of them have one unit throughout; a plain number has none. A type whose fields have
// several units defines a function each_number(Visitor&, Type&, ByField); quantities.hpp has those of chapters 03, 04.
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

/// Returns a text such as "kg m/s^2"; empty for a plain number.
std::string show(const Unit& unit);

/// The units of a body's 3 or 6 numbers: the linear ones, then the angular ones.
struct TwistUnits {
  Unit linear, angular;
};

/// The unit of bounds, which are checked on input: they are converted to other units, but are never a NaN.
struct BoundUnits {
  Unit unit;
};

/// Marks a type whose fields have their own units.
struct ByField {};

/// Marks a function without a result.
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

/// Visits all numbers of a value.
class Visitor {
 public:
  virtual ~Visitor() = default;
  virtual void number(double& value, const Unit& unit) = 0;
  /// Visits a number that is checked on input: a bound, a coefficient.
  virtual void bound(double& value, const Unit& unit) { number(value, unit); }
  /// Visits a count, which has no unit: an index, a size, yes or no.
  virtual void count(long long value) = 0;
  /// Marks the following numbers as fixed, since no function may change them (such as the masses of a row), or as
  /// changeable again.
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
