#pragma once
// What the grader is told, on a descriptor that only the tests have: records of fields, each field ended by a NUL.
//
//   verdict    GoogleTest's result, tests that ran, "skipped" or nothing, and each failure
//   nonsense   what came back for a call was no answer
//   partner    how the process of the student's function ended: its wait status, and its processor time [s]
//   done       how the process of the test ended: its wait status; nothing more comes of this test
#include <string>
#include <vector>

#include "channel.hpp"

namespace spook::remote {

inline constexpr int report_descriptor = 4;
inline constexpr int partner_has_ended = 77;  ///< exit code of a test that has told so itself

inline constexpr int stream_is_lost = 78;  ///< of one to which came what is no message: nothing can follow it

/// One record, its length before it.
void report(const std::vector<std::string>& fields);

void report_ending(const Ending& ending);

}  // namespace spook::remote
