#include "regions.hpp"

#include <gtest/gtest.h>

#include "checks.hpp"

namespace spook::testing {

Regions::Regions(const std::vector<std::string>& names, int times) : times_(times) {
  for (const std::string& name : names) seen_[name] = 0;
}

bool Regions::lack_draws() {
  if (::testing::Test::HasFailure()) return false;
  std::string rare;
  for (const auto& [name, count] : seen_)
    if (count < times_) rare = name;
  if (rare.empty()) return false;
  if (draws_ < 100000) return true;
  ADD_FAILURE() << "of 100000 draws only " << seen_[rare] << " were of the kind: " << rare;
  return false;
}

void Regions::draw(const std::vector<std::pair<std::string, bool>>& is_in) {
  ++draws_;
  std::string kinds;
  for (const auto& [name, is] : is_in) {
    if (!is) continue;
    ++seen_.at(name);
    kinds += (kinds.empty() ? "" : "; ") + name;
  }
  given() = "given random input of these kinds: " + kinds;
}

}  // namespace spook::testing
