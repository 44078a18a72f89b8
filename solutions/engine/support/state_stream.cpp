#include "engine/support/state_stream.hpp"

#include <istream>
#include <ostream>
#include <stdexcept>

#include "common/require.hpp"

namespace spook {

void StateStream::bytes(void* data, std::size_t size) {
  if (size == 0) return;
  const auto count = static_cast<std::streamsize>(size);
  if (out_ && !out_->write(static_cast<const char*>(data), count))
    throw std::runtime_error("the state cannot be written");
  if (in_ && !in_->read(static_cast<char*>(data), count)) throw std::runtime_error("the state ends too early");
}

void StateStream::require_same(const std::string& name, std::size_t count) {
  std::uint64_t written = count;
  visit(written);
  if (written != count)
    reject(name, static_cast<double>(count), std::to_string(written) + ", as where the state was written");
}

}  // namespace spook
