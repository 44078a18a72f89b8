#pragma once
// The exception of a stub. Tests report it as "not started"; `--mine` uses the reference for a file that still calls
// not_implemented.
#include <stdexcept>
#include <string>

namespace spook {

class NotImplemented : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// Throws NotImplemented. `exercise` is the exercise's number and name. Other arguments are ignored, so a stub can pass
/// its parameters to avoid warnings about unused ones.
template <class... Unused>
[[noreturn]] void not_implemented(const char* exercise, const Unused&...) {
  throw NotImplemented(std::string(exercise) + " is not implemented yet");
}

}  // namespace spook
