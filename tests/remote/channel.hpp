#pragma once
// Messages between the process that tests and the process with the student's function, over one socket.
//
//   a test begins        Begin →      ← Begun
//   a call               Call →       ← Returned | Threw
//   a call of a force    ForceAt →    the reverse of Call: the student's function calls one of its arguments
//   a test ends          End →        ← Ended, with the end of the answering process
//
// Ended may come at any time: the student's function has crashed, has exited, or has used up its time.
#include <cstdint>
#include <string>

namespace spook::remote {

enum class Kind : std::uint8_t { begin, begun, call, returned, threw, force_at, end, ended, closed };

struct Message {
  Kind kind = Kind::closed;  ///< `closed`: the other end is closed
  std::string bytes;
};

inline constexpr int channel = 3;                             ///< descriptor of the socket, on either side
inline constexpr std::uint32_t longest_message = 64u << 20u;  ///< bytes

/// Waits for the next message; throws Nonsense for anything else.
Message receive();

/// Returns true if more than one message has arrived.
bool something_has_arrived();

/// Returns true if the other end received it.
bool send(Kind kind, const std::string& bytes = "");

/// The end of a process, as in Ended.
struct Ending {
  int status;      ///< of wait(2)
  double seconds;  ///< of processor time
};

}  // namespace spook::remote
