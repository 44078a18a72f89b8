#pragma once
// A law of nature does not depend on units. So a function that computes one gives the same answer when masses, lengths
// and times are counted in other units. The new units are powers of two of the old ones, so all digits are the same.
// This test detects absolute thresholds, such as `if (x < 1e-9)`, since small numbers depend on the units.
//
//   expect_same_in_any_units("Eq. (1.3)", kick, m / s,                         // the unit of its result
//                            v * (m / s), f * N, 1 / mass * (1 / kg), h * s);  // its arguments with their units
//
// The test also checks three other rules: const arguments do not change; the same call gives the same answer again,
// after any other calls, also one in which every number is another; and a NaN in the input gives a NaN, by rule 2 of
// NUMBERS.md.
#include <functional>
#include <tuple>
#include <type_traits>

#include "common/not_implemented.hpp"
#include "units.hpp"

namespace spook::testing {

/// A choice of units: kilograms, metres and seconds as powers of two, and as words.
struct UnitSystem {
  int mass = 0, length = 0, time = 0;
  const char* name = "kilograms, metres and seconds";

  /// The factor from SI units to this choice of units.
  double factor(const Unit& unit) const;
};

/// The outcome of a call, converted back to SI units.
struct Outcome {
  std::vector<double> numbers = {};
  std::vector<Unit> units = {};
  std::vector<long long> counts = {};
  bool inputs_stayed = true;
  std::string thrown = {};
};

/// Tells whether two outcomes are the same to the last bit.
bool same_bits(const Outcome& a, const Outcome& b);

/// Converts all numbers to other units, or back to SI units.
class Converting : public Visitor {
 public:
  Converting(const UnitSystem& system, bool back) : system_(system), back_(back) {}
  void number(double& value, const Unit& unit) override {
    value *= back_ ? 1 / system_.factor(unit) : system_.factor(unit);
  }
  void count(long long) override {}

 private:
  const UnitSystem& system_;
  bool back_;
};

/// Records all numbers, or only the fixed ones.
class Reading : public Visitor {
 public:
  explicit Reading(Outcome& outcome, bool everything = true) : outcome_(outcome), everything_(everything) {}
  void number(double& value, const Unit& unit) override;
  void count(long long value) override;
  void fixed(bool is) override { fixed_ = is; }

 private:
  Outcome& outcome_;
  bool everything_, fixed_ = false;
};

/// Replaces one number by another, and remembers which; or replaces every number.
class Replacing : public Visitor {
 public:
  static constexpr int every = -2;
  explicit Replacing(int which = -1, double (*by)(double) = nullptr) : which_(which), by_(by) {}
  void next_argument() { ++argument_; }
  void number(double& value, const Unit& unit) override {
    if (count_++ != which_ && !replaces_every()) return;
    place_ = "argument " + std::to_string(argument_);
    was_ = value, unit_ = unit;
    value = by_(value);
  }
  void bound(double&, const Unit&) override {}
  void count(long long) override {}

  bool replaces_every() const { return which_ == every; }
  int numbers() const { return count_; }
  const std::string& place() const { return place_; }
  double was() const { return was_; }
  const Unit& unit() const { return unit_; }

 private:
  int which_, count_ = 0, argument_ = 0;
  double (*by_)(double);
  std::string place_;
  double was_ = 0;
  Unit unit_;
};

/// Tells whether an input has not changed in the call; for an input that may change, its fixed parts.
template <class Quantity>
bool stayed(Quantity& before, Quantity& after, bool may_change) {
  Outcome then, now;
  Reading old(then, !may_change), recent(now, !may_change);
  each_number(old, before.value, before.units);
  each_number(recent, after.value, after.units);
  return same_bits(then, now);
}

/// Calls the function in SI units, in other units, and in SI units again. Returns false, and adds a failure, if the
/// outcomes differ.
bool compare_calls(const std::string& equation,
                   const std::function<Outcome(const UnitSystem&, Replacing&)>& call);

/// Finds the numbers whose change by a thousandth changes the outcome, and calls the function with a NaN in place of
/// each. Returns false, and adds a failure, if the outcome then contains numbers only. A shorter list, or another yes
/// or no, is an accepted answer: rule 3 of NUMBERS.md. Repeats the call with a changed number after one with other
/// numbers, and adds a failure if the outcome is another.
bool nans_are_kept(const std::string& equation, const std::function<Outcome(Replacing&)>& call);

/// The parameters of a function.
template <class Function>
struct Parameters : Parameters<decltype(&Function::operator())> {};
template <class Result, class... All>
struct Parameters<Result (*)(All...)> {
  using result = Result;
  template <std::size_t k>
  static constexpr bool may_change =
      std::is_lvalue_reference_v<std::tuple_element_t<k, std::tuple<All...>>> &&
      !std::is_const_v<std::remove_reference_t<std::tuple_element_t<k, std::tuple<All...>>>>;
};
template <class Result, class Class, class... All>
struct Parameters<Result (Class::*)(All...) const> : Parameters<Result (*)(All...)> {};

/// The type of the elements of a list.
template <class Value>
struct ElementOf {
  using type = Value;
};
template <class Value>
struct ElementOf<std::vector<Value>> : ElementOf<Value> {};
template <class Value, std::size_t size>
struct ElementOf<std::array<Value, size>> : ElementOf<Value> {};

template <class Value>
concept HasFields = requires(Visitor& visitor, typename ElementOf<Value>::type& all) {
  each_number(visitor, all, ByField{});
}
&&!std::is_arithmetic_v<typename ElementOf<Value>::type>;

/// Arguments without a unit: plain numbers, and types whose fields have their own units.
template <class Value>
auto as_quantity(const Value& value) {
  using Units = std::conditional_t<HasFields<Value>, ByField, Unit>;
  if constexpr (requires { typename Value::PlainObject; })
    return Quantity<typename Value::PlainObject, Unit>{value, {}};
  else
    return Quantity<Value, Units>{value, {}};
}
template <class Value, class Units>
auto as_quantity(const Quantity<Value, Units>& quantity) {
  return quantity;
}

/// Returns the outcome of a call with one number replaced, and all numbers in other units.
template <class Function, class Units, class... All>
Outcome outcome_of(const UnitSystem& system, Replacing& replacing, const Function& function,
                   const Units& units_of_result, const All&... all) {
  using Known = Parameters<std::decay_t<Function>>;
  // Other numbers are at other addresses, too: a value may be kept for an address.
  std::array places{std::tuple(as_quantity(all)...), std::tuple(as_quantity(all)...)};
  auto& arguments = places[replacing.replaces_every()];
  Outcome outcome;
  Converting there(system, false), back(system, true);
  const auto prepare = [&](auto& argument) {
    replacing.next_argument();
    each_number(replacing, argument.value, argument.units);
    each_number(there, argument.value, argument.units);
  };
  const auto read = [&](auto& value, const auto& units) {
    Reading reading(outcome);
    each_number(back, value, units);
    each_number(reading, value, units);
  };
  std::apply([&](auto&... each) { (prepare(each), ...); }, arguments);
  auto given = arguments;
  const auto ask = [&](auto&... each) { return function(each.value...); };
  try {
    if constexpr (std::is_void_v<typename Known::result>) {
      std::apply(ask, arguments);
    } else {
      auto result = std::apply(ask, arguments);
      read(result, units_of_result);
    }
  } catch (const NotImplemented&) {
    throw;
  } catch (const std::exception& error) {
    outcome.thrown = error.what();
    return outcome;
  }
  [&]<std::size_t... k>(std::index_sequence<k...>) {
    const auto look = [&]<std::size_t at>(std::integral_constant<std::size_t, at>) {
      auto& after = std::get<at>(arguments);
      auto& before = std::get<at>(given);
      outcome.inputs_stayed = outcome.inputs_stayed && stayed(before, after, Known::template may_change<at>);
      if constexpr (Known::template may_change<at>) read(after.value, after.units);
    };
    (look(std::integral_constant<std::size_t, k>{}), ...);
  }
  (std::index_sequence_for<All...>{});
  return outcome;
}

/// Expects that the function gives the same answer in any units. `units_of_result` is a unit, by_field, or nothing; the
/// arguments follow, each with its unit. Changes that the function makes to its arguments are compared, too.
template <class Function, class Units, class... All>
bool expect_same_in_any_units_nans_aside(const std::string& equation, const Function& function,
                                         const Units& units_of_result, const All&... all) {
  return compare_calls(equation, [&](const UnitSystem& system, Replacing& replacing) {
    return outcome_of(system, replacing, function, units_of_result, all...);
  });
}

/// Expects the same answer in any units, and that NaNs are kept. Do not use it for functions with a rule of their own
/// for NaN, nor for bounds and coefficients of friction and restitution, which are checked on input.
template <class Function, class Units, class... All>
bool expect_same_in_any_units(const std::string& equation, const Function& function,
                              const Units& units_of_result, const All&... all) {
  return expect_same_in_any_units_nans_aside(equation, function, units_of_result, all...) &&
         nans_are_kept(equation, [&](Replacing& replacing) {
           return outcome_of({}, replacing, function, units_of_result, all...);
         });
}

}  // namespace spook::testing
