#include "asking.hpp"

#include <unistd.h>

#include "operations.hpp"
#include "report.hpp"

namespace spook::remote {

namespace {

/// The student's function's calls of the force in its arguments.
bool tell_force(const Message& question, const ForceField* force) {
  if (force == nullptr) throw Nonsense{};
  Reader reader(question.bytes);
  std::size_t i = 0;
  std::vector<Vec3> x;
  pass(reader, i);
  pass(reader, x);
  reader.expect(i < x.size());
  std::string bytes;
  Writer writer(bytes);
  Kind kind = Kind::returned;
  try {
    Vec3 f = (*force)(i, x);
    pass(writer, f);
  } catch (...) {
    kind = Kind::threw;
    pass_exception(writer);
  }
  return send(kind, bytes);
}

/// Removes the operations from the front of an answer.
std::uint64_t take_operations(Message& answer) {
  std::uint64_t operations = 0;
  Reader reader(answer.bytes);
  pass(reader, operations);
  answer.bytes.erase(0, sizeof operations);
  return operations;
}

[[noreturn]] void end_with_partner(const Message& ended) {
  Ending ending{};
  if (ended.bytes.size() != sizeof ending) end_for_nonsense();
  std::memcpy(&ending, ended.bytes.data(), sizeof ending);
  report_ending(ending);
  _exit(partner_has_ended);
}

}  // namespace

void end_for_nonsense() {
  report({"nonsense"});
  _exit(stream_is_lost);
}

void take_what_has_arrived() {
  try {
    const Message message = receive();
    if (message.kind == Kind::ended) end_with_partner(message);
  } catch (const Nonsense&) {
  }
  end_for_nonsense();
}

Message answer_to(const std::string& call, const ForceField* force) {
  try {
    bool there = send(Kind::call, call);
    for (;;) {
      Message message = receive();
      if (message.kind == Kind::returned || message.kind == Kind::threw) {
        testing::operations_elsewhere += take_operations(message);
        return message;
      }
      if (message.kind == Kind::ended) end_with_partner(message);
      if (message.kind == Kind::closed || !there) _exit(0);
      if (message.kind != Kind::force_at) end_for_nonsense();
      there = tell_force(message, force);
    }
  } catch (const Nonsense&) {
    end_for_nonsense();
  }
}

}  // namespace spook::remote
