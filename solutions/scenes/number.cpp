#include "scenes/number.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <stdexcept>

namespace spook {

#ifdef __cpp_lib_to_chars

/// Returns false unless [first, last) is exactly one finite decimal number.
static bool read_decimal(const char* first, const char* last, double& value) {
  const auto result = std::from_chars(first, last, value);
  return result.ec == std::errc() && result.ptr == last && std::isfinite(value);
}

std::string exact_text(double value) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

#else  // older libraries of clang lack both for double; C's functions replace them, in the C locale

static bool read_decimal(const char* first, const char* last, double& value) {
  const std::string text(first, last);
  // strtod would also take white space, a plus sign and hexadecimal digits.
  if (text.empty() || text.front() == '+' || text.find_first_not_of("0123456789.eE+-") != std::string::npos)
    return false;
  char* end = nullptr;
  value = std::strtod(text.c_str(), &end);
  return end == text.c_str() + text.size() && std::isfinite(value);
}

std::string exact_text(double value) {
  std::array<char, 32> text;
  std::string shortest;
  for (int digits = 1; digits <= 17; ++digits) {  // 17 digits distinguish any two doubles
    std::snprintf(text.data(), text.size(), "%.*g", digits, value);
    if (std::strtod(text.data(), nullptr) != value) continue;
    // One digit writes 90 as 9e+01.
    if (shortest.empty() || std::strlen(text.data()) < shortest.size()) shortest = text.data();
  }
  return shortest.empty() ? text.data() : shortest;  // empty for a NaN
}

#endif

double parse_number(const std::string& name, const std::string& text) {
  const char* const first = text.data();
  const char* const last = first + text.size();
  const std::size_t slash = text.find('/');
  double value = 0, divisor = 1;
  const bool whole = slash == std::string::npos;
  const bool read =
      whole ? read_decimal(first, last, value)
            : read_decimal(first, first + slash, value) && read_decimal(first + slash + 1, last, divisor);
  if (!read || !std::isfinite(value / divisor))
    throw std::invalid_argument(name + " must be a finite number such as 0.02, 1e6 or 1/60, but is \"" + text +
                                "\"");
  return value / divisor;
}

int parse_whole(const std::string& name, const std::string& text, int low, int high) {
  const auto parsed = [&] {
    try {
      return parse_number(name, text);
    } catch (const std::invalid_argument&) {
      return std::nan("");
    }
  };
  const double value = parsed();
  if (!(value == std::floor(value)) || value < low || value > high)
    throw std::invalid_argument(name + " must be a whole number from " + std::to_string(low) + " to " +
                                std::to_string(high) + ", but is \"" + text + "\"");
  return static_cast<int>(value);
}

std::string short_text(double value) {
  std::ostringstream text;
  text.precision(4);
  text << value;
  return text.str();
}

}  // namespace spook
