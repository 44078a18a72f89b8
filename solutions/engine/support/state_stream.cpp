#include "engine/support/state_stream.hpp"

#include <cstring>

namespace spook {

void StateStream::bytes(void* data, std::size_t size) {
  if (size == 0) return;
  if (written_) {
    written_->append(static_cast<const char*>(data), size);
    return;
  }
  if (size > unread_.size()) throw std::runtime_error("the state ends too early");
  std::memcpy(data, unread_.data(), size);
  unread_.remove_prefix(size);
}

void StateStream::require_same(const std::string& name, std::size_t count) {
  std::uint64_t written = count;
  visit(written);
  if (written != count)
    throw std::invalid_argument(name + " must be " + std::to_string(written) +
                                ", as where the state was written, but is " + std::to_string(count));
}

void StateStream::require_same_hash(const std::string& name, std::size_t hash) {
  std::uint64_t written = hash;
  visit(written);
  if (written != hash) throw std::invalid_argument(name + " must be those with which the state was written");
}

std::uint64_t hash_of(std::string_view bytes) {
  std::uint64_t hash = 14695981039346656037u;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211u;
  return hash;
}

std::string_view intact_state(std::string_view bytes) {
  std::uint64_t hash = 0;
  const std::size_t size = bytes.size() < sizeof hash ? 0 : bytes.size() - sizeof hash;
  if (size > 0) std::memcpy(&hash, bytes.data() + size, sizeof hash);
  if (size == 0 || hash != hash_of(bytes.substr(0, size))) throw std::runtime_error("the state is damaged");
  return bytes.substr(0, size);
}

}  // namespace spook
