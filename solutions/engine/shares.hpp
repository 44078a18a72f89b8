#pragma once
// Work on many things that do not feel each other, shared among threads.
#include <cstddef>
#include <functional>

namespace spook {

/// The most threads that a world may be given.
inline constexpr int most_threads = 256;

/// Calls work(share, first, end) for n things in as many shares as there are `threads`, at the same time; in fewer, where
/// a share would have less than a thousand things. Share by share they are in order. What one throws is thrown.
void in_shares(int threads, std::size_t n,
               const std::function<void(std::size_t share, std::size_t first, std::size_t end)>& work);

/// How many shares that makes; at least one.
std::size_t shares_of(int threads, std::size_t n);

}  // namespace spook
