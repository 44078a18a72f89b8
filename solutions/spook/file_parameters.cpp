#include "spook/file_parameters.hpp"

#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>

#include "engine/support/did_you_mean.hpp"
#include "spook/place.hpp"

namespace spook {

std::vector<Parameter> parameters_in(const Json& file) {
  const std::optional<Place> place = Place(file, "").find("parameters");
  if (!place) return {};
  place->require_object();
  std::vector<Parameter> all;
  for (const auto& [name, declared] : file.at("parameters").items()) {
    const Place each(declared, "parameters." + name);
    each.require_keys({"default", "unit", "meaning"});
    if (name == "h" || name == "time")
      throw std::invalid_argument(each.path() + " must have another name, since " + name +
                                  " is an option of run");
    all.push_back({.name = name,
                   .meaning = each.has("meaning") ? each["meaning"].text() : "a parameter of the file",
                   .unit = each.has("unit") ? each["unit"].text() : "",
                   .value = each["default"].number()});
  }
  return all;
}

/// Returns a number as files have it: a whole one as such, and an infinite one as a text.
static Json number_in_file(double value) {
  if (!std::isfinite(value)) return value > 0 ? "inf" : "-inf";
  const bool whole = value == std::floor(value) && std::abs(value) <= 1e9;
  return whole ? Json(static_cast<std::int64_t>(value)) : Json(value);
}

/// Returns the part of a file at `path` with values in the place of names, and takes those names out of `unused`.
static Json valued(const Json& json, const std::map<std::string, double>& values, std::set<std::string>& unused,
                   const std::string& path) {
  if (json.is_string() && json.get_ref<const std::string&>().rfind('$', 0) == 0) {
    const std::string name = json.get<std::string>().substr(1);
    const auto found = values.find(name);
    if (found == values.end()) {
      std::vector<std::string> names;
      for (const auto& [known, value] : values) names.push_back(known);
      throw std::invalid_argument(path + " names no parameter of the file: \"$" + name + "\"" +
                                  did_you_mean(name, names));
    }
    unused.erase(name);
    return number_in_file(found->second);
  }
  Json copy = json;
  if (json.is_object())
    for (const auto& [key, value] : json.items()) {
      if (path.empty() && (key == "parameters" || key == "summary")) continue;
      copy[key] = valued(value, values, unused, path.empty() ? key : path + "." + key);
    }
  if (json.is_array())
    for (std::size_t k = 0; k < json.size(); ++k)
      copy[k] = valued(json[k], values, unused, path + "[" + std::to_string(k) + "]");
  return copy;
}

Json with_values(const Json& file, const std::vector<Parameter>& parameters) {
  std::map<std::string, double> values;
  std::set<std::string> unused;
  for (const Parameter& parameter : parameters) {
    values[parameter.name] = parameter.value;
    unused.insert(parameter.name);
  }
  Json whole = valued(file, values, unused, "");
  if (!unused.empty())
    throw std::invalid_argument("parameters." + *unused.begin() + " is used nowhere: write \"$" +
                                *unused.begin() + "\" in the place of a number");
  return whole;
}

}  // namespace spook
