#include "machinery/claims.hpp"

#include <algorithm>
#include <limits>

namespace spook::plots {

constexpr double infinity = std::numeric_limits<double>::infinity();

void Claims::between(const std::string& text, double measured, double low, double high) {
  all_.push_back({.text = text, .measured = measured, .low = low, .high = high});
}

void Claims::near(const std::string& text, double measured, double expected, double margin) {
  between(text, measured, expected - margin, expected + margin);
}

void Claims::at_most(const std::string& text, double measured, double bound) {
  between(text, measured, -infinity, bound);
}

void Claims::at_least(const std::string& text, double measured, double bound) {
  between(text, measured, bound, infinity);
}

bool Claims::hold() const {
  return std::all_of(all_.begin(), all_.end(), [](const Claim& claim) { return claim.holds(); });
}

}  // namespace spook::plots
