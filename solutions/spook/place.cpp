#include "spook/place.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/support/did_you_mean.hpp"
#include "scenes/number.hpp"

namespace spook {

/// Returns the text in the file, at most a line of it.
static std::string shown(const Json& value) {
  constexpr std::size_t most = 60;
  const std::string text = value.dump();
  return text.size() <= most ? text : text.substr(0, most) + "...";
}

void Place::reject(const std::string& rule) const {
  throw std::invalid_argument((path_.empty() ? "the file" : path_) + " must be " + rule + ", but is " +
                              shown(value_));
}

double Place::number() const {
  if (value_.is_number()) return value_.get<double>();
  if (!value_.is_string()) reject("a number");
  if (value_ == "inf") return infinity;
  return value_ == "-inf" ? -infinity : parse_number(path_, value_.get<std::string>());
}

int Place::whole() const {
  if (!value_.is_number_integer() || std::abs(value_.get<double>()) > 1e9) reject("a whole number");
  return value_.get<int>();
}

bool Place::flag() const {
  if (!value_.is_boolean()) reject("true or false");
  return value_.get<bool>();
}

std::string Place::text() const {
  if (!value_.is_string()) reject("a text");
  return value_.get<std::string>();
}

std::vector<double> Place::numbers(std::size_t count) const {
  if (!value_.is_array() || value_.size() != count) reject("a list of " + std::to_string(count) + " numbers");
  std::vector<double> all;
  for (const Place& each : list()) all.push_back(each.number());
  return all;
}

Vec3 Place::vector() const {
  const std::vector<double> v = numbers(3);
  return {v[0], v[1], v[2]};
}

Quat Place::quaternion() const {
  const std::vector<double> q = numbers(4);
  return {q[0], q[1], q[2], q[3]};
}

std::vector<Place> Place::list() const {
  if (!value_.is_array()) reject("a list");
  std::vector<Place> all;
  for (std::size_t k = 0; k < value_.size(); ++k)
    all.emplace_back(value_[k], path_ + "[" + std::to_string(k) + "]");
  return all;
}

Place Place::operator[](const std::string& key) const {
  if (!has(key)) throw std::invalid_argument(under(key) + " is missing");
  return {value_.at(key), under(key)};
}

std::optional<Place> Place::find(const std::string& key) const {
  if (!has(key)) return {};
  return Place(value_.at(key), under(key));
}

void Place::require_object() const {
  if (!value_.is_object()) reject("an object");
}

void Place::require_keys(const std::vector<std::string>& known) const {
  require_object();
  for (const auto& [key, value] : value_.items())
    if (std::find(known.begin(), known.end(), key) == known.end())
      throw std::invalid_argument(under(key) + " is unknown" + did_you_mean(key, known));
}

}  // namespace spook
