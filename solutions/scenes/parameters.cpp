#include "scenes/parameters.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/support/did_you_mean.hpp"
#include "scenes/number.hpp"

namespace spook {

bool Limits::allow(double value) const {
  if (!std::isfinite(value) || (whole && value != std::floor(value))) return false;
  const bool above = low_included ? value >= low : value > low;
  const bool below = high_included ? value <= high : value < high;
  return above && below;
}

std::string Limits::text() const {
  const bool bounded_below = std::isfinite(low), bounded_above = std::isfinite(high);
  std::string text = whole ? "a whole number" : "";
  const auto add = [&](const std::string& more) { text += (text.empty() ? "" : " ") + more; };
  if (bounded_below && bounded_above && low_included && high_included) {
    add("from " + exact_text(low) + " to " + exact_text(high));
    return text;
  }
  if (bounded_below) add((low_included ? "at least " : "more than ") + exact_text(low));
  if (bounded_below && bounded_above) add("and");
  if (bounded_above) add((high_included ? "at most " : "less than ") + exact_text(high));
  return text;
}

std::string Parameter::text() const {
  return choices.empty() ? exact_text(value) : choice;
}

void Parameters::set(const std::string& name, const std::string& text) {
  const auto found = std::find_if(all_.begin(), all_.end(), [&](const Parameter& p) { return p.name == name; });
  if (found == all_.end()) {
    std::vector<std::string> names;
    for (const Parameter& known : all_) names.push_back(known.name);
    throw std::invalid_argument("unknown parameter \"" + name + "\"" + did_you_mean(name, names));
  }
  if (!given_.insert(name).second)
    throw std::invalid_argument(name + " is given twice, the second time as " + text);

  const std::vector<std::string>& choices = found->choices;
  if (!choices.empty()) {
    if (std::find(choices.begin(), choices.end(), text) == choices.end())
      throw std::invalid_argument("unknown " + name + " \"" + text + "\"" + did_you_mean(text, choices));
    found->choice = text;
    return;
  }
  const double value = parse_number(name, text);
  if (!found->limits.allow(value))
    throw std::invalid_argument(name + " must be " + found->limits.text() + ", but is " + text);
  found->value = value;
}

const Parameter& Parameters::find(const std::string& name) const {
  const auto found = std::find_if(all_.begin(), all_.end(), [&](const Parameter& p) { return p.name == name; });
  if (found == all_.end()) throw std::logic_error("this scene has no parameter " + name);
  return *found;
}

namespace parameter {

static constexpr Limits positive = {.low = 0, .low_included = false};
static constexpr Limits not_negative = {.low = 0};

Parameter mass(double value) {
  return {.name = "m",
          .meaning = "mass of a body; of the light ones where one is heavy",
          .unit = "kg",
          .value = value,
          .limits = positive};
}

Parameter gravity() {
  return {.name = "g", .meaning = "gravity, downwards", .unit = "m/s²", .value = 9.81, .limits = not_negative};
}

Parameter stiffness() {
  return {.name = "k", .meaning = "stiffness", .unit = "N/m", .value = 1e6, .limits = positive};
}

Parameter relaxation() {
  return {.name = "d", .meaning = "relaxation", .unit = "steps", .value = 3, .limits = not_negative};
}

Parameter radius(double value) {
  return {.name = "radius", .meaning = "radius of a sphere", .unit = "m", .value = value, .limits = positive};
}

Parameter start() {
  return {.name = "start",
          .meaning = "half_step: velocities begin half a step back; unshifted: they do not",
          .choices = {"half_step", "unshifted"}};
}

Parameter bodies(double value, double most) {
  return {.name = "bodies",
          .meaning = "how many",
          .value = value,
          .limits = {.low = 1, .high = most, .whole = true}};
}

Parameter boxes(double value, double most) {
  Parameter all = bodies(value, most);
  all.name = "boxes";
  all.meaning = "how many";
  return all;
}

Parameter side() {
  return {.name = "side", .meaning = "of a box", .unit = "m", .value = 1, .limits = positive};
}

Parameter friction(double value) {
  return {.name = "mu", .meaning = "friction coefficient", .value = value, .limits = not_negative};
}

Parameter viscosity() {
  return {.name = "viscosity",
          .meaning = "a sticking contact creeps at its load over this",
          .unit = "N s/m",
          .value = 1e12,
          .limits = positive};
}

Parameter speed(double value) {
  return {.name = "v0", .meaning = "speed at time 0", .unit = "m/s", .value = value, .limits = positive};
}

Parameter restitution(double value) {
  return {.name = "restitution",
          .meaning = "speed after an impact over speed before, along the normal",
          .value = value,
          .limits = {.low = 0, .high = 1}};
}

Parameter threshold() {
  return {.name = "threshold",
          .meaning = "slowest impact; added to the larger of g h and g sqrt(2 m/k)",
          .unit = "m/s",
          .value = 0,
          .limits = not_negative};
}

Parameter friction_law(std::vector<std::string> laws) {
  return {.name = "answer",
          .meaning = "law of friction of the answer; model, if listed: that of --friction-model",
          .choices = std::move(laws)};
}

Parameter weighing_gravity() {
  Parameter g = gravity();
  g.limits = positive;
  return g;
}

Parameter ratio() {
  return {.name = "ratio",
          .meaning = "mass ratio, heavy over light",
          .value = 1,
          .limits = {.low = 1, .high = 1e12}};
}

Parameter links(double value) {
  return {.name = "links",
          .meaning = "how many",
          .value = value,
          .limits = {.low = 1, .high = 10000, .whole = true}};
}

Parameter length() {
  return {.name = "length",
          .meaning = "of all links together, without load",
          .unit = "m",
          .value = 1,
          .limits = positive};
}

Parameter begin() {
  return {.name = "begin",
          .meaning = "natural: links begin at their unloaded length; at_rest: at their length in the answer",
          .choices = {"natural", "at_rest"}};
}

}  // namespace parameter

}  // namespace spook
