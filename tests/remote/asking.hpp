#pragma once
// The side of the tests: a graded function sends its arguments away, and returns the answer.
#include <concepts>
#include <functional>
#include <string>
#include <tuple>
#include <type_traits>

#include "channel.hpp"
#include "exceptions.hpp"
#include "wire.hpp"

namespace spook::remote {

/// Returns the answer to a call: a Returned or Threw, without its operations, which are added to
/// testing::operations_elsewhere. Calls of the force in the meantime are answered. If the other side sends anything
/// else, or has ended, this process reports that to the grader, and ends.
Message answer_to(const std::string& call, const ForceField* force);

[[noreturn]] void end_for_nonsense();

/// Called after a test: an unexpected message can only say that the other side has ended. Ends this process.
[[noreturn]] void take_what_has_arrived();

template <class T>
inline constexpr bool is_force = std::is_same_v<std::remove_cvref_t<T>, ForceField>;

/// The arguments that a function may change: they come back with the answer.
template <class T>
inline constexpr bool is_changed =
    std::is_lvalue_reference_v<T> && !std::is_const_v<std::remove_reference_t<T>>;

template <int number, class Function>
struct Asked;

template <int number, class Result, class... Arguments>
struct Asked<number, Result(Arguments...)> {
  static Result call(Arguments... arguments) {
    std::string bytes;
    Writer writer(bytes);
    int which = number;
    pass(writer, which);
    (send_argument(writer, arguments), ...);
    const ForceField* force = nullptr;
    (find_force(force, arguments), ...);
    const Message answer = answer_to(bytes, force);
    Reader reader(answer.bytes);
    try {
      (take_changed<Arguments>(reader, arguments), ...);
      if (answer.kind == Kind::threw) throw_again(reader);
      if constexpr (!std::is_void_v<Result>) {
        Result result{};
        pass(reader, result);
        reader.expect(reader.left() == 0);
        return result;
      }
      reader.expect(reader.left() == 0);
    } catch (const Nonsense&) {
      end_for_nonsense();
    }
  }

 private:
  template <class T>
  static void send_argument(Writer& writer, T& argument) {
    // Writing changes nothing: constants and variables are written by the same code.
    if constexpr (!is_force<T>) pass(writer, const_cast<std::remove_const_t<T>&>(argument));
  }

  template <class T>
  static void find_force(const ForceField*& force, const T& argument) {
    if constexpr (is_force<T>) force = &argument;
  }

  template <class Declared, class T>
  static void take_changed(Reader& reader, T& argument) {
    if constexpr (is_changed<Declared>) pass(reader, argument);
  }
};

/// A function that does nothing: it returns zeros and changes nothing. A test that it passes says nothing about an
/// answer.
template <class Function>
struct Idle;

template <class Result, class... Arguments>
struct Idle<Result(Arguments...)> {
  static Result call(Arguments...) {
    if constexpr (!std::is_void_v<Result>) {
      const std::string zeros(1024, '\0');
      Reader reader(zeros);
      Result result{};
      pass(reader, result);
      return result;
    }
  }
};

/// One function of the chapter: the slot through which its callers jump, and its possible targets.
struct Graded {
  const char* exercise;
  void (**slot)();
  void (*asked)();
  void (*idle)();
};

/// The functions of the chapter, and their number; written by tools/remote.
extern const Graded graded_functions[];
extern const int graded_count;

}  // namespace spook::remote
