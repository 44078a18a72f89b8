#include "engine/support/did_you_mean.hpp"

#include <algorithm>
#include <map>
#include <numeric>

namespace spook {

/// Returns the number of letters to insert, drop, change, or swap with their neighbour, to get from `a` to `b`.
static std::size_t typing_slips(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before, last(b.size() + 1), now(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      now[j] = std::min({now[j - 1] + 1, last[j] + 1, changed});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        now[j] = std::min(now[j], before[j - 2] + 1);
    }
    before = last;
    last = now;
  }
  return last.back();
}

std::string present_name(const std::string& name) {
  static const std::map<std::string, std::string> renamed = {
      {"--compose", "--integrator-order"}, {"--margin", "--contact-margin"},    {"--order", "--row-order"},
      {"compose", "integrator_order"},     {"margin", "contact_margin"},        {"order", "row_order"},
      {"stiff", "geometric_stiffness"},    {"stripes", "spatial_decomposition"}};
  const auto found = renamed.find(name);
  return found == renamed.end() ? "" : found->second;
}

std::string did_you_mean(const std::string& given, const std::vector<std::string>& known) {
  const std::string present = present_name(given);
  if (!present.empty() && std::find(known.begin(), known.end(), present) != known.end())
    return "; it is now called \"" + present + "\"";
  const auto nearer = [&](const std::string& a, const std::string& b) {
    return typing_slips(given, a) < typing_slips(given, b);
  };
  const auto nearest = std::min_element(known.begin(), known.end(), nearer);
  if (nearest == known.end()) return "";
  const std::size_t slips = typing_slips(given, *nearest);
  if (slips <= 2 && 2 * slips < nearest->size()) return "; did you mean \"" + *nearest + "\"?";
  std::string all = "; there ";
  all += known.size() == 1 ? "is only " : "are: ";
  for (std::size_t k = 0; k < known.size(); ++k) all += (k ? ", " : "") + known[k];
  return all;
}

}  // namespace spook
