#include "contract.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "checks.hpp"

namespace spook::testing {

namespace {

// 2^60 is about 1e18: far enough to exceed every plausible threshold, and near enough that the fourth power of a volume
// is still a finite number.
const UnitSystem systems[] = {
    {-60, 0, 0, "masses counted in 2^60 kg, a million billion tonnes"},
    {60, 0, 0, "masses counted in 2^-60 kg, about a femtogram"},
    {0, -60, 0, "lengths counted in 2^60 m, about 120 light years"},
    {0, 60, 0, "lengths counted in 2^-60 m, a thousandth of a proton"},
    {0, 0, -60, "times counted in 2^60 s, 37 billion years"},
    {0, 0, 60, "times counted in 2^-60 s, about an attosecond"},
};

// Powers of two change no digit. The tolerance is for functions that use a logarithm or a power.
constexpr double room = 1e-12;

const char* const clue =
    "Only the units were changed, so the result must not change. Is a number compared with one that has no "
    "unit, an absolute threshold such as `if (x < 1e-9)`? What is small in one unit is large in another. "
    "Compare with something of the same unit, or do without. Else: is something added to what has another "
    "unit?";

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (std::isnan(a) && std::isnan(b));
}

// The largest number of the same unit, which is the scale of a difference.
double size_of(const Outcome& outcome, const Unit& unit) {
  double largest = 0;
  for (std::size_t k = 0; k < outcome.numbers.size(); ++k)
    if (outcome.units[k] == unit && std::isfinite(outcome.numbers[k]))
      largest = std::max(largest, std::abs(outcome.numbers[k]));
  return largest;
}

std::string quantity(double value, const Unit& unit, int digits) {
  return show(value, digits) + (unit == Unit{} ? "" : " " + show(unit));
}

// The lines that describe a difference; empty if there is none.
std::string difference(const Outcome& got, const Outcome& expected) {
  if (!got.thrown.empty()) return "  expected  no exception\n  got       one that says: " + got.thrown + "\n";
  if (got.counts != expected.counts || got.units != expected.units) {
    std::string text = "  a whole number differs: a size, an index, or true or false\n";
    for (std::size_t k = 0; k < std::min(got.counts.size(), expected.counts.size()); ++k)
      if (got.counts[k] != expected.counts[k])
        return text + "  expected  " + std::to_string(expected.counts[k]) + "\n  got       " +
               std::to_string(got.counts[k]) + "\n";
    return text;
  }
  for (std::size_t k = 0; k < got.numbers.size(); ++k) {
    const Unit& unit = got.units[k];
    const double a = got.numbers[k], b = expected.numbers[k], allowed = room * size_of(expected, unit);
    if (a == b || same_bits(a, b) || std::abs(a - b) <= allowed) continue;
    const int digits = digits_apart(a, b);
    return "  expected  " + quantity(b, unit, digits) + "\n  got       " + quantity(a, unit, digits) +
           ", counted in SI units again" + "\n  tolerance " + show(allowed) +
           " (powers of two change no digit; a little is allowed for a logarithm)\n";
  }
  return "";
}

}  // namespace

std::string show(const Unit& unit) {
  std::string above, below;
  const auto add = [&](const char* name, int power) {
    std::string& side = power > 0 ? above : below;
    if (power == 0) return;
    side += (side.empty() ? "" : " ") + std::string(name);
    if (std::abs(power) > 1) side += "^" + std::to_string(std::abs(power));
  };
  add("kg", unit.mass);
  add("m", unit.length);
  add("s", unit.time);
  if (below.empty()) return above;
  if (below.find(' ') != std::string::npos) below = "(" + below + ")";
  return (above.empty() ? "1" : above) + "/" + below;
}

double UnitSystem::factor(const Unit& unit) const {
  return std::ldexp(1.0, mass * unit.mass + length * unit.length + time * unit.time);
}

void Reading::number(double& value, const Unit& unit) {
  if (!everything_ && !fixed_) return;
  outcome_.numbers.push_back(value);
  outcome_.units.push_back(unit);
}

void Reading::count(long long value) {
  if (everything_ || fixed_) outcome_.counts.push_back(value);
}

bool same_bits(const Outcome& a, const Outcome& b) {
  return a.counts == b.counts && a.units == b.units &&
         std::equal(a.numbers.begin(), a.numbers.end(), b.numbers.begin(), b.numbers.end(),
                    [](double x, double y) { return same_bits(x, y); });
}

static double another(double x) {
  return x * 1.01;
}

static void report_a_kept_value(const std::string& equation) {
  this_failure_explains();
  report_failure("the same call again, after others", equation,
                 "  expected  the same to the last digit\n  got       something else\n",
                 "A value is kept from one call to the next: is there a static or a global variable, or "
                 "one that never got a value? The result must depend on the arguments only, on all of them.");
}

bool compare_calls(const std::string& equation,
                   const std::function<Outcome(const UnitSystem&, Replacing&)>& with) {
  const auto call = [&](const UnitSystem& system) {
    Replacing none;
    return with(system, none);
  };
  const Outcome first = call({});
  if (!first.thrown.empty()) {
    report_failure("a call with valid numbers", equation,
                   "  expected  no exception\n  got       one that says: " + first.thrown + "\n", "");
    return false;
  }
  if (!first.inputs_stayed) {
    this_failure_explains();
    report_failure("the inputs, after the call", equation,
                   "  expected  the same as before\n  got       something else\n",
                   "An input was changed. It is const, or a fixed part such as a mass, and the caller still "
                   "needs it. Work on a copy.");
    return false;
  }
  for (const UnitSystem& system : systems) {
    const Outcome other = call(system);
    if (!same_bits(call({}), first) || !same_bits(call(system), other)) {
      report_a_kept_value(equation);
      return false;
    }
    const std::string differs = difference(other, first);
    if (differs.empty()) continue;
    // A value that is kept for some of the arguments: after a call in which all are others, it is computed again.
    Replacing every(Replacing::every, another);
    with({}, every);
    if (!same_bits(call(system), other)) {
      report_a_kept_value(equation);
      return false;
    }
    report_failure(std::string("the same, with ") + system.name, equation, differs, clue);
    return false;
  }
  return true;
}

bool nans_are_kept(const std::string& equation, const std::function<Outcome(Replacing&)>& call) {
  Replacing none;
  const Outcome first = call(none);
  for (int which = 0; which < none.numbers(); ++which) {
    const auto a_little = [&] {
      Replacing one(which, [](double x) { return x == 0 ? 1e-3 : x * 1.001; });
      return call(one);
    };
    const Outcome other = a_little();
    Replacing every(Replacing::every, another);
    call(every);
    if (!same_bits(a_little(), other)) {
      report_a_kept_value(equation);
      return false;
    }
    if (!other.thrown.empty() || same_bits(other, first)) continue;
    const auto nan = [](double) { return std::nan(""); };
    Replacing not_a_number(which, nan);
    const Outcome lost = call(not_a_number);
    const bool is_one =
        std::any_of(lost.numbers.begin(), lost.numbers.end(), [](double x) { return std::isnan(x); });
    const auto is_other = [](const Outcome& one, const Outcome& than) {
      return one.counts != than.counts || one.numbers.size() != than.numbers.size();
    };
    // If the change made a yes of a no, a NaN gives the no that was there before.
    const auto sum = [](const Outcome& of) {
      return std::accumulate(of.counts.begin(), of.counts.end(), std::ssize(of.numbers));
    };
    const bool is_no = is_other(lost, first) || (is_other(other, first) && sum(other) > sum(first));
    if (is_one || is_no || !lost.thrown.empty()) continue;
    Replacing again(which, nan);
    call(every);
    if (!same_bits(call(again), lost)) {
      report_a_kept_value(equation);
      return false;
    }
    const std::string was = quantity(not_a_number.was(), not_a_number.unit(), 3);
    report_failure("the result with a NaN in place of " + was + " in " + not_a_number.place(), equation,
                   "  expected  a NaN\n  got       numbers\n",
                   "The NaN was lost. Every comparison with a NaN is false, and std::max(x, NaN) is x: see "
                   "NUMBERS.md. Eigen's ldlt() solves with 0 for a pivot that is NaN; inverse() keeps the NaN. "
                   "A broken simulation must not continue unnoticed.");
    return false;
  }
  return true;
}

}  // namespace spook::testing
