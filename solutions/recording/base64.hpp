#pragma once
// Arrays of numbers as text: little-endian, in base64 (RFC 4648).
#include <cstdint>
#include <string>
#include <vector>

namespace spook {

/// Encodes the bytes of `values`, 4 each.
std::string base64(const std::vector<float>& values);
std::string base64(const std::vector<std::int32_t>& values);

}  // namespace spook
