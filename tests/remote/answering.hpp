#pragma once
// The side of the student's function: decodes a call, makes it, and sends back the result.
#include <exception>
#include <string>
#include <tuple>
#include <type_traits>

#include "asking.hpp"
#include "channel.hpp"
#include "common/operations.hpp"
#include "exceptions.hpp"
#include "wire.hpp"

namespace spook::remote {

/// A force that is computed on the side of the tests.
ForceField force_of_the_tests();

/// The whole answer to a call of `function`: its operations, its changed arguments, its result.
template <class Result, class... Arguments>
Message answered(Result (*function)(Arguments...), Reader& reader) {
  std::tuple<std::remove_cvref_t<Arguments>...> values;
  std::apply([&reader](auto&... value) { (take_argument(reader, value), ...); }, values);
  std::string operations, changed, result;
  Writer to_operations(operations), to_changed(changed), to_result(result);
  Kind kind = Kind::returned;
  const std::uint64_t before = operations_so_far();
  try {
    std::apply(
        [&](auto&... value) {
          if constexpr (std::is_void_v<Result>) {
            function(static_cast<Arguments>(value)...);
          } else {
            Result got = function(static_cast<Arguments>(value)...);
            pass(to_result, got);
          }
        },
        values);
  } catch (...) {
    kind = Kind::threw;
    result.clear();
    pass_exception(to_result);
  }
  std::uint64_t taken = operations_so_far() - before;
  pass(to_operations, taken);
  std::apply([&](auto&... value) { (give_changed<Arguments>(to_changed, value), ...); }, values);
  return {kind, operations + changed + result};
}

template <class T>
void take_argument(Reader& reader, T& value) {
  if constexpr (is_force<T>)
    value = force_of_the_tests();
  else
    pass(reader, value);
}

template <class Declared, class T>
void give_changed(Writer& writer, T& value) {
  if constexpr (is_changed<Declared>) pass(writer, value);
}

/// The answer to the call of function `number` of the chapter; written by tools/remote.
Message answer_call(int number, Reader& reader);

}  // namespace spook::remote
