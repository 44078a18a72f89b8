#pragma once
// Reports to the grader, on a descriptor that only the tests have: records of fields, each field ended by a NUL.
//
//   verdict    GoogleTest's result, tests that ran, "skipped" or nothing, and each failure
//   nonsense   the answer to a call was invalid
//   partner    the end of the student's process: its wait status, and its processor time [s]
//   done       the end of the test's process: its wait status; the last record of this test
#include <string>
#include <vector>

#include "channel.hpp"

namespace spook::remote {

inline constexpr int report_descriptor = 4;
inline constexpr int partner_has_ended = 77;  ///< exit code of a test that has reported its own end

inline constexpr int stream_is_lost = 78;  ///< exit code after an invalid message: nothing can follow it

/// One record, preceded by its length.
void report(const std::vector<std::string>& fields);

void report_ending(const Ending& ending);

}  // namespace spook::remote
