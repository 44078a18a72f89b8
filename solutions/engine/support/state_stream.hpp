#pragma once
// The state of a run as bytes, from which another process continues with the same bits.
//
// A class lists what steps change, once for writing and reading:
//
//   void state(StateStream& s) { s(time_, x_, sums_); }
//
// It leaves out what follows from its parameters: whoever reads a state has built the object as the writer did. A
// struct of a chapter has a function state_of(s, object) instead, next to the class that needs it. The bytes are those
// of one machine and one build, and nothing checks them here: spook/checkpoint.hpp does.
#include <Eigen/Geometry>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace spook {

class StateStream {
 public:
  explicit StateStream(std::ostream& out) : out_(&out) {}
  explicit StateStream(std::istream& in) : in_(&in) {}

  /// Writes the values, or replaces them by those that were written. Throws std::runtime_error if a state cannot be
  /// written, or ends too early.
  template <class... Values>
  void operator()(Values&... values) {
    (visit(values), ...);
  }

  /// Writes a count, or throws std::invalid_argument, naming the count, if it differs from the one that was written.
  void require_same(const std::string& name, std::size_t count);

 private:
  void bytes(void* data, std::size_t size);

  template <class Number>
  void visit(Number& number) requires(std::is_arithmetic_v<Number> || std::is_enum_v<Number>) {
    bytes(&number, sizeof number);
  }
  template <class Object>
  void visit(Object& object) requires requires(StateStream& s) {
    object.state(s);
  }
  { object.state(*this); }
  template <class Object>
  void visit(Object& object) requires requires(StateStream& s) {
    state_of(s, object);
  }
  { state_of(*this, object); }
  template <int Rows, int Columns>
  void visit(Eigen::Matrix<double, Rows, Columns>& matrix) {
    if constexpr (Rows == Eigen::Dynamic || Columns == Eigen::Dynamic) {
      std::int64_t rows = matrix.rows(), columns = matrix.cols();
      (*this)(rows, columns);
      matrix.resize(rows, columns);
    }
    bytes(matrix.data(), static_cast<std::size_t>(matrix.size()) * sizeof(double));
  }
  void visit(Eigen::Quaterniond& q) { visit(q.coeffs()); }
  void visit(std::string& text) {
    visit_size(text);
    bytes(text.data(), text.size());
  }
  template <class Value>
  void visit(std::vector<Value>& values) {
    visit_size(values);
    for (Value& value : values) visit(value);
  }
  void visit(std::vector<bool>& flags) {
    std::vector<char> copy(flags.begin(), flags.end());
    visit(copy);
    flags.assign(copy.begin(), copy.end());
  }
  template <class Value>
  void visit(std::optional<Value>& value) {
    bool has_value = value.has_value();
    visit(has_value);
    if (has_value && !value) value.emplace();
    if (!has_value) value.reset();
    if (value) visit(*value);
  }
  template <class Container>
  void visit_size(Container& container) {
    std::uint64_t size = container.size();
    visit(size);
    if (in_) container.resize(size);
  }

  std::ostream* out_ = nullptr;
  std::istream* in_ = nullptr;
};

}  // namespace spook
