#pragma once
// A test of an exercise, in three states: a stub is skipped ("not started"), a wrong answer fails, a right one passes.
//
//   EXERCISE(Kick, "1.1 kick");                      // once in a file: the suite's number and function
//   EXERCISE_TEST(Kick, AddsForceOverMass) { ... }   // as TEST, with the checks of checks.hpp inside
#include <gtest/gtest.h>

#include <map>
#include <new>
#include <string>

#include "checks.hpp"
#include "common/not_implemented.hpp"
#include "random_input.hpp"

namespace spook::testing {

/// The exercise of the running test, such as "1.1 kick".
inline std::string& current_exercise() {
  static std::string name;
  return name;
}

/// The exercise of each suite.
inline std::map<std::string, std::string>& exercises() {
  static std::map<std::string, std::string> of_suites;
  return of_suites;
}

inline bool name_exercise(const char* suite, const char* exercise) {
  exercises()[suite] = exercise;
  return true;
}

inline void run_exercise(const char* suite, void (*body)()) {
  current_exercise() = exercises().at(suite);
  Random::forget_seed();
  given().clear();
  try {
    body();
  } catch (const NotImplemented& stub) {
    // A test of one exercise may use another; only its own stub means "not started".
    GTEST_SKIP() << stub.what();
  } catch (const std::bad_alloc&) {
    report_failure("this test's call", "",
                   "  expected  an answer\n  got       std::bad_alloc: there is no more memory\n",
                   "Does a list grow without end? Or is a size, such as a number of cells, computed wrongly, "
                   "so that it is very large or negative?");
  } catch (const std::exception& error) {
    report_failure("this test's call", "",
                   "  expected  no exception\n  got       one that says: " + std::string(error.what()) + "\n",
                   "");
  } catch (...) {
    report_failure("this test's call", "",
                   "  expected  no exception\n  got       one that is no std::exception\n",
                   "Throw std::invalid_argument: the helpers in common/require.hpp do.");
  }
}

}  // namespace spook::testing

// Files of one suite may be compiled as one: each name is used once.
#define SPOOK_JOIN_AGAIN(a, b) a##b
#define SPOOK_JOIN(a, b) SPOOK_JOIN_AGAIN(a, b)
#define EXERCISE(Suite, number_and_function)                             \
  [[maybe_unused]] static const bool SPOOK_JOIN(Suite##_, __COUNTER__) = \
      spook::testing::name_exercise(#Suite, number_and_function)

#define EXERCISE_TEST(Suite, Name)                               \
  static void Suite##_##Name##_body();                           \
  TEST(Suite, Name) {                                            \
    spook::testing::run_exercise(#Suite, Suite##_##Name##_body); \
  }                                                              \
  static void Suite##_##Name##_body()
