#include "checks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <iomanip>
#include <sstream>

#include "common/not_implemented.hpp"
#include "exercise_test.hpp"

namespace spook::testing {

void this_failure_explains() {
  ::testing::Test::RecordProperty("rank", 2);
}

void this_failure_has_a_clue_that_fits() {
  if (!::testing::Test::HasFailure()) ::testing::Test::RecordProperty("rank", 1);
}

std::string show(double value, int digits) {
  if (std::isnan(value)) return "NaN";
  std::ostringstream out;
  out << std::setprecision(digits) << value + 0.0;  // shows -0 as 0
  return out.str();
}

std::string show(const Eigen::MatrixXd& value, int digits) {
  std::string out;
  for (Eigen::Index row = 0; row < (value.cols() > 1 ? value.rows() : 1); ++row) {
    Eigen::VectorXd entries = value.col(0);
    if (value.cols() > 1) entries = value.row(row).transpose();
    out += row ? "\n            (" : "(";
    for (Eigen::Index k = 0; k < entries.size(); ++k) out += (k ? ", " : "") + show(entries[k], digits);
    out += ")";
  }
  return out;
}

template <class Value>
static int digits_until_they_differ(const Value& a, const Value& b) {
  int digits = 10;
  while (digits < 17 && show(a, digits) == show(b, digits)) ++digits;
  return digits;
}

int digits_apart(double a, double b) {
  return digits_until_they_differ(a, b);
}

int digits_apart(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return digits_until_they_differ(a, b);
}

// Breaks text into lines of at most 78 letters, each after two spaces. A byte of 10xxxxxx continues a letter.
static std::string wrapped(const std::string& text) {
  std::istringstream words(text);
  std::string out, word;
  std::size_t column = 0;
  while (words >> word) {
    const auto letters = static_cast<std::size_t>(std::count_if(
        word.begin(), word.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
    const bool fits = column > 0 && column + 1 + letters <= 78;
    out += fits ? " " : out.empty() ? "  " : "\n  ";
    out += word;
    column = fits ? column + 1 + letters : 2 + letters;
  }
  return out.empty() ? out : out + "\n";
}

void report_failure(const std::string& what, const std::string& equation, const std::string& body,
                    const std::string& clue) {
  const std::string& exercise = current_exercise();
  std::ostringstream out;
  out << wrapped(exercise + ": " + what + " " + equation).substr(2) << wrapped(given()) << body
      << wrapped(clue);
  if (Random::seed_was_used()) out << "  random inputs, seed " << Random::seed() << "\n";
  const std::string number = exercise.substr(0, exercise.find(' '));
  if (!number.empty()) out << "  ./course hint " << number << "\n";
  ADD_FAILURE() << out.str();
}

std::string digits_clue(double error, double size, const Tolerance& tolerance) {
  if (tolerance.value > 1e-12 * size || !(error <= 1.2e-7 * size)) return "";
  return error > 1e-10 * size
             ? " It is right to the seven digits of a float: did you use float somewhere? Use double."
             : " Only the last digits are wrong: has a series been cut off, did an iteration end early, or has "
               "something "
               "small been left out?";
}

std::string nan_clue(bool is_nan) {
  if (!is_nan) return "";
  this_failure_has_a_clue_that_fits();
  return "It is NaN. Does a number, or a block of a vector or matrix, never get a value? Those of Eigen begin "
         "as NaN here. Or is 0 divided by 0? ";
}

void expect_near(const std::string& what, const std::string& equation, double got, double expected,
                 const Tolerance& tolerance, std::initializer_list<Clue<double>> clues,
                 const std::string& otherwise) {
  const auto distance = [](double a, double b) { return std::abs(a - b); };
  if (distance(got, expected) <= tolerance.value) return;
  const double close = std::max(10 * tolerance.value, 1e-9 * std::abs(expected));
  const std::string unknown = nan_clue(std::isnan(got) && !std::isnan(expected)) + otherwise +
                              digits_clue(distance(got, expected), std::abs(expected), tolerance);
  report_difference(what, equation, expected, got, tolerance, explain(got, clues, distance, close, unknown));
}

void expect_at_most(const std::string& what, const std::string& equation, double got, double bound,
                    const std::string& why, const std::string& clue) {
  if (got <= bound) return;
  const int digits = digits_apart(got, bound);
  report_failure(
      what, equation,
      "  expected  at most " + show(bound, digits) + " (" + why + ")\n  got       " + show(got, digits) + "\n",
      nan_clue(std::isnan(got)) + clue);
}

void expect_at_least(const std::string& what, const std::string& equation, double got, double bound,
                     const std::string& why, const std::string& clue) {
  if (got >= bound) return;
  const int digits = digits_apart(got, bound);
  report_failure(
      what, equation,
      "  expected  at least " + show(bound, digits) + " (" + why + ")\n  got       " + show(got, digits) + "\n",
      nan_clue(std::isnan(got)) + clue);
}

void expect_true(const std::string& what, const std::string& equation, bool holds, const std::string& clue) {
  if (!holds) report_failure(what, equation, "  does not hold\n", clue);
}

void expect_order(const std::string& what, const std::string& equation,
                  const std::function<double(double)>& error, double coarsest_h, int halvings, double order,
                  double margin, const std::string& otherwise, std::initializer_list<Clue<double>> clues) {
  std::ostringstream table;
  table << "  " << std::setw(12) << "h [s]" << std::setw(14) << "error" << std::setw(10) << "order"
        << "\n";
  double observed = std::nan("");
  double before = std::nan("");
  for (int k = 0; k <= halvings; ++k) {
    const double h = coarsest_h / std::pow(2, k);
    const double now = error(h);
    if (k > 0) observed = std::log2(before / now);
    table << "  " << std::setw(12) << show(h) << std::setw(14) << std::setprecision(4) << now;
    if (k > 0) table << std::setw(10) << std::setprecision(3) << observed;
    table << "\n";
    before = now;
  }
  if (observed >= order - margin) return;
  report_failure(what, equation,
                 "  expected  order " + show(order) + ", at least " + show(order - margin) +
                     " at the last halving\n" + table.str(),
                 explain(
                     observed, clues, [](double a, double b) { return std::abs(a - b); }, 0.25, otherwise));
}

// Returns true if the text has the name as a word of its own: the d of "and" does not count.
static bool names(const std::string& text, const std::string& name) {
  const auto is_letter = [&](std::size_t k) {
    return k < text.size() && (std::isalnum(static_cast<unsigned char>(text[k])) || text[k] == '_');
  };
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1))
    if (!(at > 0 && is_letter(at - 1)) && !is_letter(at + name.size())) return true;
  return false;
}

void expect_rejects(const std::string& what, const std::string& parameter, const std::function<void()>& call,
                    const std::string& clue, const std::function<std::vector<double>()>& state) {
  const std::vector<double> before = state ? state() : std::vector<double>();
  std::string got = "nothing was thrown";
  try {
    call();
  } catch (const NotImplemented&) {
    throw;
  } catch (const std::invalid_argument& error) {
    const std::string text = error.what();
    if (names(text, parameter)) {
      if (state && state() != before)
        report_failure(what + ": refused, but not before something was changed", "", "",
                       "A call that is refused must change nothing: check " + parameter + " first.");
      return;
    }
    got = "std::invalid_argument that does not name it: " + text;
  } catch (const std::exception& error) {
    got = std::string("another exception: ") + error.what();
  }
  report_failure(what, "",
                 "  expected  std::invalid_argument that names " + parameter + "\n  got       " + got + "\n",
                 clue);
}

}  // namespace spook::testing
