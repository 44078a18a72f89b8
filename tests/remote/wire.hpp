#pragma once
// Values as bytes, to the last bit, and back. The input comes from a program that may be hostile. So every size is
// compared with the received bytes, and every index with its matrix, before it is used.
#include <Eigen/SparseCholesky>
#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "11_direct/direct.hpp"
#include "fields.hpp"

namespace spook::remote {

/// The received bytes are not a valid message.
struct Nonsense {};

/// Appends values to a message.
class Writer {
 public:
  static constexpr bool reads = false;
  explicit Writer(std::string& bytes) : bytes_(bytes) {}

  void raw(const void* from, std::size_t size) { bytes_.append(static_cast<const char*>(from), size); }
  void expect(bool) {}

 private:
  std::string& bytes_;
};

/// Reads values from a message.
class Reader {
 public:
  static constexpr bool reads = true;
  explicit Reader(const std::string& bytes) : bytes_(bytes) {}

  void raw(void* to, std::size_t size) {
    expect(size <= left());
    if (size > 0) std::memcpy(to, bytes_.data() + at_, size);
    at_ += size;
  }
  void expect(bool holds) const {
    if (!holds) throw Nonsense{};
  }
  std::size_t left() const { return bytes_.size() - at_; }

 private:
  const std::string& bytes_;
  std::size_t at_ = 0;
};

template <class T>
inline constexpr bool is_dense = std::is_base_of_v<Eigen::DenseBase<T>, T>;
template <class T>
inline constexpr bool is_vector = false;
template <class T>
inline constexpr bool is_vector<std::vector<T>> = true;
template <class T>
inline constexpr bool is_array = false;
template <class T, std::size_t N>
inline constexpr bool is_array<std::array<T, N>> = true;
template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;
template <class T>
inline constexpr bool is_pair = false;
template <class A, class B>
inline constexpr bool is_pair<std::pair<A, B>> = true;

template <class Wire, class T>
void pass(Wire& wire, T& value);

/// A size. When it is read, at least `bytes_each` must follow for each element.
template <class Wire>
std::size_t pass_size(Wire& wire, std::size_t size, std::size_t bytes_each = 1) {
  std::uint64_t sent = size;
  wire.raw(&sent, sizeof sent);
  if constexpr (Wire::reads) wire.expect(sent <= wire.left() / bytes_each);
  return sent;
}

/// A bool is a byte of 0 or 1, whatever was received.
template <class Wire>
void pass_bool(Wire& wire, bool& value) {
  unsigned char byte = value ? 1 : 0;
  wire.raw(&byte, 1);
  if constexpr (Wire::reads) value = byte != 0;
}

template <class Wire, class T>
void pass_vector(Wire& wire, std::vector<T>& values) {
  const std::size_t size = pass_size(wire, values.size());
  if constexpr (Wire::reads) values.assign(size, T());
  for (std::size_t k = 0; k < size; ++k) {
    if constexpr (std::is_same_v<T, bool>) {
      bool value = values[k];
      pass_bool(wire, value);
      if constexpr (Wire::reads) values[k] = value;
    } else {
      pass(wire, values[k]);
    }
  }
}

template <class Wire, class Matrix>
void pass_dense(Wire& wire, Matrix& value) {
  using Scalar = typename Matrix::Scalar;
  if constexpr (Matrix::SizeAtCompileTime == Eigen::Dynamic) {
    static_assert(Matrix::ColsAtCompileTime == 1, "of dynamic size only vectors are sent");
    const std::size_t size = pass_size(wire, static_cast<std::size_t>(value.size()), sizeof(Scalar));
    if constexpr (Wire::reads) value.resize(static_cast<Eigen::Index>(size));
  }
  wire.raw(value.data(), static_cast<std::size_t>(value.size()) * sizeof(Scalar));
}

/// A compressed matrix: the numbers of rows and columns, the start of each column, and each entry's row and value.
template <class Wire, class Scalar>
void pass_sparse(Wire& wire, Eigen::SparseMatrix<Scalar>& value) {
  Eigen::Index rows = value.rows(), columns = value.cols();
  std::vector<int> starts, indices;
  std::vector<Scalar> entries;
  if constexpr (!Wire::reads) {
    Eigen::SparseMatrix<Scalar> copy = value;
    copy.makeCompressed();
    starts.assign(copy.outerIndexPtr(), copy.outerIndexPtr() + columns + 1);
    indices.assign(copy.innerIndexPtr(), copy.innerIndexPtr() + copy.nonZeros());
    entries.assign(copy.valuePtr(), copy.valuePtr() + copy.nonZeros());
  }
  wire.raw(&rows, sizeof rows);
  wire.raw(&columns, sizeof columns);
  pass_vector(wire, starts);
  pass_vector(wire, indices);
  pass_vector(wire, entries);
  if constexpr (Wire::reads) {
    wire.expect(0 <= rows && rows < (1 << 24) && 0 <= columns &&
                starts.size() == static_cast<std::size_t>(columns) + 1);
    wire.expect(indices.size() == entries.size() && starts.front() == 0 &&
                starts.back() == static_cast<int>(entries.size()));
    for (std::size_t c = 0; c + 1 < starts.size(); ++c) {
      wire.expect(starts[c] <= starts[c + 1] && starts[c + 1] <= starts.back());
      for (int k = starts[c]; k < starts[c + 1]; ++k)
        wire.expect(0 <= indices[k] && indices[k] < rows && (k == starts[c] || indices[k - 1] < indices[k]));
    }
    value.resize(rows, columns);
    value.resizeNonZeros(static_cast<Eigen::Index>(entries.size()));
    std::copy(starts.begin(), starts.end(), value.outerIndexPtr());
    std::copy(indices.begin(), indices.end(), value.innerIndexPtr());
    std::copy(entries.begin(), entries.end(), value.valuePtr());
  }
}

/// A permutation has each index once.
template <class Wire, class Permutation>
void pass_permutation(Wire& wire, Permutation& value) {
  pass_dense(wire, value.indices());
  if constexpr (Wire::reads) {
    std::vector<bool> seen(static_cast<std::size_t>(value.size()));
    for (Eigen::Index k = 0; k < value.size(); ++k) {
      const int index = value.indices()[k];
      wire.expect(0 <= index && index < value.size() && !seen[static_cast<std::size_t>(index)]);
      seen[static_cast<std::size_t>(index)] = true;
    }
  }
}

/// Eigen's factors cannot be set from outside: a derived class can access their protected members.
struct OpenSolver : Eigen::SparseSolverBase<Eigen::SimplicialLDLT<SparseMatrix>> {
  static bool& is_initialised(Eigen::SimplicialLDLT<SparseMatrix>& f) {
    return f.*(&OpenSolver::m_isInitialized);
  }
};

struct Open : Eigen::SimplicialLDLT<SparseMatrix> {
  template <class Wire>
  static void pass_all(Wire& wire, Eigen::SimplicialLDLT<SparseMatrix>& f) {
    int info = f.*(&Open::m_info);
    pass_bool(wire, OpenSolver::is_initialised(f));
    pass_bool(wire, f.*(&Open::m_factorizationIsOk));
    pass_bool(wire, f.*(&Open::m_analysisIsOk));
    pass(wire, info);
    if (!Wire::reads && !(f.*(&Open::m_factorizationIsOk) && info == Eigen::Success))
      clear_entries(f.*(&Open::m_matrix));
    pass_sparse(wire, f.*(&Open::m_matrix));
    pass_dense(wire, f.*(&Open::m_diag));
    pass_dense(wire, f.*(&Open::m_parent));
    pass_dense(wire, f.*(&Open::m_nonZerosPerCol));
    pass_permutation(wire, f.*(&Open::m_P));
    pass_permutation(wire, f.*(&Open::m_Pinv));
    if constexpr (Wire::reads) {
      f.*(&Open::m_info) = static_cast<Eigen::ComputationInfo>(info);
      const Eigen::Index n = (f.*(&Open::m_matrix)).cols();
      wire.expect((f.*(&Open::m_matrix)).rows() == n && sizes_are(f, n));
      const auto& parent = f.*(&Open::m_parent);
      for (Eigen::Index k = 0; k < parent.size(); ++k) wire.expect(-1 <= parent[k] && parent[k] < n);
    }
  }

 private:
  /// Sets the entries of factors that were analysed only, or whose factorisation stopped at a pivot of 0: Eigen leaves
  /// them undefined, and uses only their number in each column.
  template <class Matrix>
  static void clear_entries(Matrix& L) {
    for (int column = 0; column < L.cols(); ++column)
      for (int k = L.outerIndexPtr()[column], row = column; k < L.outerIndexPtr()[column + 1]; ++k) {
        L.innerIndexPtr()[k] = ++row;
        L.valuePtr()[k] = 0;
      }
  }

  /// Factors are empty before the first factorisation. Without an order of its own P is empty.
  static bool sizes_are(Eigen::SimplicialLDLT<SparseMatrix>& f, Eigen::Index n) {
    const auto is = [n](Eigen::Index size) { return size == n || size == 0; };
    const bool used = f.*(&Open::m_factorizationIsOk);
    return is((f.*(&Open::m_diag)).size()) && is((f.*(&Open::m_parent)).size()) &&
           is((f.*(&Open::m_nonZerosPerCol)).size()) && is((f.*(&Open::m_P)).size()) &&
           (f.*(&Open::m_P)).size() == (f.*(&Open::m_Pinv)).size() &&
           (!used || (f.*(&Open::m_diag)).size() == n);
  }
};

/// The library's generator consists of its words and the number of used ones.
template <class Wire>
void pass_generator(Wire& wire, std::mt19937_64& generator) {
  constexpr std::size_t size = std::mt19937_64::state_size;
  std::array<std::uint64_t, size + 1> words;
  static_assert(sizeof words == sizeof generator && std::is_trivially_copyable_v<std::mt19937_64>);
  std::memcpy(words.data(), &generator, sizeof words);
  wire.raw(words.data(), sizeof words);
  wire.expect(words[size] <= size);
  if constexpr (Wire::reads) std::memcpy(&generator, words.data(), sizeof words);
}

template <class Wire, class T>
void pass(Wire& wire, T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    pass_bool(wire, value);
  } else if constexpr (std::is_arithmetic_v<T>) {
    wire.raw(&value, sizeof value);
  } else if constexpr (std::is_same_v<T, std::string>) {
    const std::size_t size = pass_size(wire, value.size());
    if constexpr (Wire::reads) value.assign(size, '\0');
    wire.raw(value.data(), size);
  } else if constexpr (is_vector<T>) {
    pass_vector(wire, value);
  } else if constexpr (is_array<T>) {
    for (auto& entry : value) pass(wire, entry);
  } else if constexpr (is_pair<T>) {
    pass(wire, value.first);
    pass(wire, value.second);
  } else if constexpr (is_optional<T>) {
    bool there = value.has_value();
    pass_bool(wire, there);
    if constexpr (Wire::reads) {
      if (there)
        value.emplace();
      else
        value.reset();
    }
    if (there) pass(wire, *value);
  } else if constexpr (is_dense<T>) {
    pass_dense(wire, value);
  } else if constexpr (std::is_same_v<T, Quat>) {
    pass_dense(wire, value.coeffs());
  } else if constexpr (std::is_same_v<T, SparseMatrix>) {
    pass_sparse(wire, value);
  } else if constexpr (std::is_same_v<T, std::mt19937_64>) {
    pass_generator(wire, value);
  } else if constexpr (std::is_same_v<T, Factors>) {
    Open::pass_all(wire, value.ldlt);
    pass(wire, value.columns);
    pass(wire, value.entries);
    pass(wire, value.analyses);
  } else {
    std::apply([&wire](auto&... member) { (pass(wire, member), ...); }, fields(value));
  }
}

}  // namespace spook::remote
