#pragma once
// An exception as a message, thrown again on the other side. Its kind is one of those that tests distinguish.
#include <new>
#include <stdexcept>
#include <string>

#include "common/not_implemented.hpp"
#include "wire.hpp"

namespace spook::remote {

enum class Thrown : int { not_implemented, invalid_argument, bad_alloc, standard, unknown };

/// An exception of another kind.
struct Standard : std::runtime_error {
  using std::runtime_error::runtime_error;
};
struct Unknown {};

/// The exception that is being handled.
inline void describe_exception(Thrown& kind, std::string& text) {
  try {
    throw;
  } catch (const NotImplemented& error) {
    kind = Thrown::not_implemented, text = error.what();
  } catch (const std::invalid_argument& error) {
    kind = Thrown::invalid_argument, text = error.what();
  } catch (const std::bad_alloc& error) {
    kind = Thrown::bad_alloc, text = error.what();
  } catch (const std::exception& error) {
    kind = Thrown::standard, text = error.what();
  } catch (...) {
    kind = Thrown::unknown;
  }
}

[[noreturn]] inline void throw_again(Reader& reader) {
  int kind = 0;
  std::string text;
  pass(reader, kind);
  pass(reader, text);
  switch (static_cast<Thrown>(kind)) {
    case Thrown::not_implemented:
      throw NotImplemented(text);
    case Thrown::invalid_argument:
      throw std::invalid_argument(text);
    case Thrown::bad_alloc:
      throw std::bad_alloc();
    case Thrown::standard:
      throw Standard(text);
    case Thrown::unknown:
      throw Unknown{};
  }
  throw Nonsense{};
}

inline void pass_exception(Writer& writer) {
  Thrown thrown = Thrown::unknown;
  std::string text;
  describe_exception(thrown, text);
  int kind = static_cast<int>(thrown);
  pass(writer, kind);
  pass(writer, text);
}

}  // namespace spook::remote
