#include "channel.hpp"

#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "wire.hpp"

namespace spook::remote {

namespace {

// Length and kind precede each message.
constexpr std::size_t head_size = 5;

// Bytes that were read and not yet used: most messages come whole, and cost one system call.
std::array<char, 1 << 16> arrived;
std::size_t taken = 0, filled = 0;

bool receive_exactly(char* to, std::size_t size) {
  while (size > 0) {
    if (taken == filled) {
      const ssize_t count = read(channel, arrived.data(), arrived.size());
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return false;
      taken = 0;
      filled = static_cast<std::size_t>(count);
    }
    const std::size_t part = std::min(size, filled - taken);
    std::memcpy(to, arrived.data() + taken, part);
    taken += part;
    to += part;
    size -= part;
  }
  return true;
}

Message receive_rest(const std::array<char, head_size>& head) {
  std::uint32_t length = 0;
  std::memcpy(&length, head.data(), sizeof length);
  const auto kind = static_cast<unsigned char>(head[4]);
  if (length > longest_message || kind >= static_cast<unsigned char>(Kind::closed)) throw Nonsense{};
  Message message{static_cast<Kind>(kind), std::string(length, '\0')};
  if (!receive_exactly(message.bytes.data(), length)) return {};
  return message;
}

}  // namespace

Message receive() {
  std::array<char, head_size> head;
  return receive_exactly(head.data(), head.size()) ? receive_rest(head) : Message{};
}

bool send(Kind kind, const std::string& bytes) {
  if (bytes.size() > longest_message) return false;
  const auto length = static_cast<std::uint32_t>(bytes.size());
  std::string text(head_size, '\0');
  std::memcpy(text.data(), &length, sizeof length);
  text[4] = static_cast<char>(kind);
  text += bytes;
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t count = ::send(channel, text.data() + at, text.size() - at, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    at += static_cast<std::size_t>(count);
  }
  return true;
}

bool something_has_arrived() {
  return taken < filled;
}

}  // namespace spook::remote
