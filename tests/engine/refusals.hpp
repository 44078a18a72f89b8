#pragma once
// Expected refusals, by the words of their messages.
#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace spook {

/// Expects that `call` throws std::invalid_argument with a message that has each of the parts.
inline void expect_refusal(const std::vector<std::string>& named, const std::function<void()>& call) {
  try {
    call();
    ADD_FAILURE() << "nothing was thrown; expected a message with " << named.front();
  } catch (const std::invalid_argument& error) {
    for (const std::string& part : named)
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos)
          << error.what() << "\n  lacks " << part;
  }
}

}  // namespace spook
