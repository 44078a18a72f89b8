#pragma once
// Prints numbers, vectors, matrices and lists of them with a name and a unit, for playgrounds (./course try).
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>

namespace spook {

template <class Value>
std::string text(const Value& value);

/// Prints entries in brackets, with commas between them.
template <class List>
std::string listed(const List& list, const char* open, const char* close) {
  std::string joined;
  for (const auto& entry : list) joined += (joined.empty() ? "" : ", ") + text(entry);
  return open + joined + close;
}

/// Prints a vector as (1, 2, 3), a matrix with a line for each row, and a quaternion as (w, x, y, z).
template <class Value>
std::string text(const Value& value) {
  if constexpr (std::is_same_v<Value, bool>) {
    return value ? "true" : "false";
  } else if constexpr (std::is_convertible_v<Value, std::string>) {
    return value;
  } else if constexpr (std::is_arithmetic_v<Value>) {
    std::ostringstream out;
    out.precision(10);
    out << value + Value(0);  // prints -0 as 0
    return out.str();
  } else if constexpr (std::is_same_v<Value, Eigen::Quaterniond>) {
    return text(Eigen::Vector4d(value.w(), value.x(), value.y(), value.z()));
  } else if constexpr (std::is_base_of_v<Eigen::SparseMatrixBase<Value>, Value>) {
    return text(Eigen::MatrixXd(value));
  } else if constexpr (std::is_base_of_v<Eigen::EigenBase<Value>, Value>) {
    const Eigen::MatrixXd all = value;
    if (all.cols() == 1) return listed(all.reshaped(), "(", ")");
    std::string lines;
    for (Eigen::Index k = 0; k < all.rows(); ++k)
      lines += "\n  " + text(Eigen::VectorXd(all.row(k).transpose()));
    return lines;
  } else if constexpr (requires { value.first; }) {
    return "(" + text(value.first) + ", " + text(value.second) + ")";
  } else if constexpr (requires { value.has_value(); }) {
    return value ? text(*value) : "none";
  } else {
    return listed(value, "[", "]");
  }
}

/// Prints `name = value unit`; a matrix below its name.
template <class Value>
void show(const std::string& name, const Value& value, const std::string& unit = "") {
  const std::string printed = text(value), behind = unit.empty() ? "" : " " + unit;
  if (printed.rfind("\n", 0) == 0)
    std::cout << name << behind << " =" << printed << '\n';
  else
    std::cout << name << " = " << printed << behind << '\n';
}

}  // namespace spook
