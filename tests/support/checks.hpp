#pragma once
// Checks with failure messages that teach: the quantity, its equation, both numbers, the tolerance and its reason. If
// the wrong number is that of a known mistake, the message names the mistake.
//
//   expect_near("v after one kick [m/s]", "Eq. (1.3)", got, expected, {1e-15, "2 roundings"},
//               {{without_mass, "This is h f: the force has not been divided by the mass."}});
//
// Every comparison is written so that NaN fails.
#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

#include "common/types.hpp"

namespace spook::testing {

struct Tolerance {
  double value;
  std::string reason;
};

/// The tolerance of `count` rounding errors of a number of this size.
inline Tolerance roundings(double count, double size = 1) {
  return {count * 2.3e-16 * std::abs(size),
          std::to_string(static_cast<long long>(std::min(count, 9e18))) + " roundings"};
}

/// A wrong value with a known cause, and that cause.
template <class Value>
struct Clue {
  Value wrong;
  std::string text;
};

/// The priority of a failure. `./course check` shows one failure of an exercise: the first one that explains others, or
/// else the first with a known mistake, or else the first. See Test in tools/course/trial.py.
void this_failure_explains();
void this_failure_has_a_clue_that_fits();

/// Returns the text of the first clue whose wrong value equals `got` within `close`; else `otherwise`.
template <class Value, class Distance>
std::string explain(const Value& got, std::initializer_list<Clue<Value>> clues, const Distance& distance,
                    double close, const std::string& otherwise) {
  for (const Clue<Value>& known : clues)
    if (distance(got, known.wrong) <= close) {
      this_failure_has_a_clue_that_fits();
      return known.text;
    }
  return otherwise;
}

/// Returns the question to a student whose number is accurate to a float's digits or more, but not to a double's; empty
/// for other numbers.
std::string digits_clue(double error, double size, const Tolerance& tolerance);

/// Returns the question to a student whose answer is NaN; empty for other answers.
std::string nan_clue(bool is_nan);

std::string show(double value, int digits = 10);

/// Returns the text of a vector on one line, or of a matrix with a line for each row.
std::string show(const Eigen::MatrixXd& value, int digits = 10);

/// Returns the number of digits that distinguish two numbers, vectors or matrices: 10 to 17.
int digits_apart(double a, double b);
int digits_apart(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// The input of the running test as text, printed with its failures so that they can be worked out by hand; empty at
/// the start of each test.
inline std::string& given() {
  static std::string text;
  return text;
}

/// Adds a GoogleTest failure in the form above. `body` holds whole lines.
void report_failure(const std::string& what, const std::string& equation, const std::string& body,
                    const std::string& clue);

/// Adds a GoogleTest failure that compares two values of one kind, with as many digits as distinguish them.
template <class Value>
void report_difference(const std::string& what, const std::string& equation, const Value& expected,
                       const Value& got, const Tolerance& tolerance, const std::string& clue) {
  const int digits = digits_apart(expected, got);
  report_failure(what, equation,
                 "  expected  " + show(expected, digits) + "\n  got       " + show(got, digits) +
                     "\n  tolerance " + show(tolerance.value) + " (" + tolerance.reason + ")\n",
                 clue);
}

/// Expects |got - expected| <= tolerance, for numbers. `otherwise` is the clue if no known mistake fits.
void expect_near(const std::string& what, const std::string& equation, double got, double expected,
                 const Tolerance& tolerance, std::initializer_list<Clue<double>> clues = {},
                 const std::string& otherwise = "");

/// Expects |got - expected| <= tolerance, for vectors, in the Euclidean norm.
template <class Vector>
void expect_near_vector(const std::string& what, const std::string& equation, const Vector& got,
                        const std::type_identity_t<Vector>& expected, const Tolerance& tolerance,
                        std::initializer_list<Clue<std::type_identity_t<Vector>>> clues = {},
                        const std::string& otherwise = "") {
  const auto distance = [](const Vector& a, const Vector& b) { return (a - b).norm(); };
  if (distance(got, expected) <= tolerance.value) return;
  const double close = std::max(10 * tolerance.value, 1e-9 * expected.norm());
  const std::string unknown = nan_clue(got.hasNaN() && !expected.hasNaN()) + otherwise +
                              digits_clue(distance(got, expected), expected.norm(), tolerance);
  report_difference<Eigen::MatrixXd>(what, equation, expected, got, tolerance,
                                     explain(got, clues, distance, close, unknown));
}

/// Expects got <= bound, and not NaN. `why` is the reason of the bound.
void expect_at_most(const std::string& what, const std::string& equation, double got, double bound,
                    const std::string& why, const std::string& clue = "");

/// Expects got >= bound, and not NaN.
void expect_at_least(const std::string& what, const std::string& equation, double got, double bound,
                     const std::string& why, const std::string& clue = "");

void expect_true(const std::string& what, const std::string& equation, bool holds,
                 const std::string& clue = "");

/// Expects that the error at steps h, h/2, h/4 … falls as h^order, within `margin`, over the last halving. A failure
/// prints the table. An observed order above `order` passes, too. `clues` are lower orders that known mistakes have.
void expect_order(const std::string& what, const std::string& equation,
                  const std::function<double(double)>& error, double coarsest_h, int halvings, double order,
                  double margin, const std::string& otherwise = "",
                  std::initializer_list<Clue<double>> clues = {});

/// Expects that `call` throws std::invalid_argument, with the parameter's name in its text, and that the parts listed
/// by `state` do not change. A stub still counts as not started.
void expect_rejects(const std::string& what, const std::string& parameter, const std::function<void()>& call,
                    const std::string& clue = "", const std::function<std::vector<double>()>& state = {});

}  // namespace spook::testing
