#pragma once
// Messages between the process that tests and the process that holds the student's function, over one socket.
//
//   a test begins        Begin →      ← Begun
//   a call               Call →       ← Returned | Threw
//   what a call asks     ForceAt →    as Call the other way about: the student's function calls what it was given
//   a test ends          End →        ← Ended, with how the answering process did
//
// Ended may come at any time: the student's function has crashed, has left, or has used up its time.
#include <cstdint>
#include <string>

namespace spook::remote {

enum class Kind : std::uint8_t { begin, begun, call, returned, threw, force_at, end, ended, closed };

struct Message {
  Kind kind = Kind::closed;  ///< `closed`: there is nobody at the other end any more
  std::string bytes;
};

inline constexpr int channel = 3;                             ///< descriptor of the socket, on either side
inline constexpr std::uint32_t longest_message = 64u << 20u;  ///< bytes

/// Waits for the next message; throws Nonsense for what is none.
Message receive();

/// Whether more than was taken has come already.
bool something_has_arrived();

/// Whether there was somebody to take it.
bool send(Kind kind, const std::string& bytes = "");

/// How a process ended, as Ended carries it.
struct Ending {
  int status;      ///< of wait(2)
  double seconds;  ///< of processor time
};

}  // namespace spook::remote
