#pragma once
// A value in a JSON file, with its path for error messages: bodies[3].mass.
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "common/types.hpp"
#include "spook/json.hpp"

namespace spook {

class Place {
 public:
  Place(const Json& value, std::string path) : value_(value), path_(std::move(path)) {}

  /// Throws std::invalid_argument: "bodies[3].mass must be `rule`, but is -1".
  [[noreturn]] void reject(const std::string& rule) const;

  /// Returns the value, or rejects a value of another kind. A number may be a text such as "1/60".
  double number() const;
  int whole() const;
  bool flag() const;
  std::string text() const;
  Vec3 vector() const;
  Quat quaternion() const;
  std::vector<Place> list() const;

  bool holds_text() const { return value_.is_string(); }
  bool has(const std::string& key) const { return value_.is_object() && value_.contains(key); }
  Place operator[](const std::string& key) const;  ///< throws if the key is missing
  std::optional<Place> find(const std::string& key) const;

  void require_object() const;  ///< throws std::invalid_argument unless the value is an object

  /// Throws std::invalid_argument unless the value is an object, and for an unknown key, with the nearest known key.
  void require_keys(const std::vector<std::string>& known) const;

  const std::string& path() const { return path_; }

 private:
  std::string under(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }
  std::vector<double> numbers(std::size_t count) const;

  const Json& value_;
  std::string path_;
};

}  // namespace spook
