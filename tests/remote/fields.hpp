#pragma once
// The members of a plain struct, as a tuple of references: the struct itself determines how a Row or a Contact is sent.
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

namespace spook::remote {

/// Represents a value of any type; only named, never made.
struct Anything {
  template <class T>
  operator T() const;
};

template <class T, std::size_t... I>
constexpr bool takes(std::index_sequence<I...>) {
  return requires {
    T{(static_cast<void>(I), Anything{})...};
  };
}

/// The largest number of values in braces that T accepts, which is its number of members.
template <class T, std::size_t N = 12>
constexpr std::size_t member_count() {
  if constexpr (N == 0 || takes<T>(std::make_index_sequence<N>{}))
    return N;
  else
    return member_count<T, N - 1>();
}

/// References to the members of `value`, in order.
template <class T>
auto fields(T& value) {
  static_assert(std::is_aggregate_v<T>, "only a plain struct can be sent member by member");
  constexpr std::size_t count = member_count<std::remove_const_t<T>>();
  static_assert(1 <= count && count <= 12, "one to twelve members can be sent");
  if constexpr (count == 1) {
    auto& [a] = value;
    return std::tie(a);
  }
  if constexpr (count == 2) {
    auto& [a, b] = value;
    return std::tie(a, b);
  }
  if constexpr (count == 3) {
    auto& [a, b, c] = value;
    return std::tie(a, b, c);
  }
  if constexpr (count == 4) {
    auto& [a, b, c, d] = value;
    return std::tie(a, b, c, d);
  }
  if constexpr (count == 5) {
    auto& [a, b, c, d, e] = value;
    return std::tie(a, b, c, d, e);
  }
  if constexpr (count == 6) {
    auto& [a, b, c, d, e, f] = value;
    return std::tie(a, b, c, d, e, f);
  }
  if constexpr (count == 7) {
    auto& [a, b, c, d, e, f, g] = value;
    return std::tie(a, b, c, d, e, f, g);
  }
  if constexpr (count == 8) {
    auto& [a, b, c, d, e, f, g, h] = value;
    return std::tie(a, b, c, d, e, f, g, h);
  }
  if constexpr (count == 9) {
    auto& [a, b, c, d, e, f, g, h, i] = value;
    return std::tie(a, b, c, d, e, f, g, h, i);
  }
  if constexpr (count == 10) {
    auto& [a, b, c, d, e, f, g, h, i, j] = value;
    return std::tie(a, b, c, d, e, f, g, h, i, j);
  }
  if constexpr (count == 11) {
    auto& [a, b, c, d, e, f, g, h, i, j, k] = value;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k);
  }
  if constexpr (count == 12) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l] = value;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l);
  }
}

}  // namespace spook::remote
