#pragma once
// The state of a run as bytes, from which another process continues with the same bits.
//
// A class lists what steps change, once for writing and reading:
//
//   void state(StateStream& s) { s(time_, x_, sums_); }
//
// It leaves out what follows from its parameters: whoever reads a state has built the object as the writer did. A
// struct of a chapter has a function state_of(s, object) instead, next to the class that needs it. The bytes are those
// of one machine and one build.
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace spook {

class StateStream {
 public:
  explicit StateStream(std::string* written) : written_(written) {}
  explicit StateStream(std::string_view unread) : unread_(unread) {}

  /// Writes the values, or replaces them by those that were written. Throws std::runtime_error if a state ends too
  /// early.
  template <class... Values>
  void operator()(Values&... values) {
    (visit(values), ...);
  }

  /// Writes a count, or throws std::invalid_argument, naming the count, if it differs from the one that was written.
  void require_same(const std::string& name, std::size_t count);

  /// Writes a hash, or throws std::invalid_argument, naming what was hashed, if it differs from the one that was
  /// written.
  void require_same_hash(const std::string& name, std::size_t hash);

  std::size_t unread_bytes() const { return unread_.size(); }

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
    if (written_) return;
    if (size > unread_.size())
      throw std::runtime_error("the state ends too early");  // each entry has a byte or more
    container.resize(size);
  }

  std::string* written_ = nullptr;  // null: the stream reads
  std::string_view unread_;
};

/// Returns the FNV-1a hash of some bytes.
std::uint64_t hash_of(std::string_view bytes);

/// Returns a state without the hash at its end. Throws std::runtime_error if the state is damaged.
std::string_view intact_state(std::string_view bytes);

/// Returns the state of an object as bytes, with their hash at the end.
template <class Object>
std::string bytes_of_state(Object& object) {
  std::string bytes;
  StateStream stream(&bytes);
  object.state(stream);
  std::uint64_t hash = hash_of(bytes);
  stream(hash);
  return bytes;
}

/// Puts an object into a state. Throws std::runtime_error for damaged bytes, and for those of another kind of object,
/// which may leave this one changed. Throws what the object's own checks throw.
template <class Object>
void read_state(std::string_view bytes, Object& object) {
  StateStream stream(intact_state(bytes));
  object.state(stream);
  if (stream.unread_bytes() > 0) throw std::runtime_error("the state is that of another object");
}

}  // namespace spook
