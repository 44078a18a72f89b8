#include "recording/base64.hpp"

#include <cstring>

namespace spook {

static std::string encoded(const std::vector<std::uint32_t>& words) {
  static constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const std::size_t bytes = 4 * words.size();
  const auto byte = [&](std::size_t k) { return k < bytes ? words[k / 4] >> (8 * (k % 4)) & 0xff : 0; };
  std::string text;
  text.reserve((bytes + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes; k += 3) {
    const std::uint32_t three = byte(k) << 16 | byte(k + 1) << 8 | byte(k + 2);
    for (const int shift : {18, 12, 6, 0}) text += letters[three >> shift & 63];
    if (k + 1 >= bytes) text[text.size() - 2] = '=';
    if (k + 2 >= bytes) text[text.size() - 1] = '=';
  }
  return text;
}

template <class Value>
static std::vector<std::uint32_t> words_of(const std::vector<Value>& values) {
  static_assert(sizeof(Value) == sizeof(std::uint32_t));
  std::vector<std::uint32_t> words(values.size());
  if (!values.empty()) std::memcpy(words.data(), values.data(), 4 * values.size());
  return words;
}

std::string base64(const std::vector<float>& values) {
  return encoded(words_of(values));
}

std::string base64(const std::vector<std::int32_t>& values) {
  return encoded(words_of(values));
}

}  // namespace spook
