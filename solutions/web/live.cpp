// Class Play for a web page: the functions that tools/viewer/worker.js calls.
#include <emscripten/emscripten.h>

#include <memory>
#include <sstream>
#include <stdexcept>

#include "spook/play.hpp"

namespace {

std::unique_ptr<spook::Play> play;
std::ostringstream lines;
std::string last_text;

/// Returns the lines written since the last call.
const char* written() {
  last_text = lines.str();
  lines.str("");
  return last_text.c_str();
}

spook::RunCommand command_of(const spook::Json& asked) {
  spook::RunCommand run;
  run.scene = asked.at("scene").get<std::string>();
  const spook::Json set = asked.value("set", spook::Json::object());
  for (const auto& [name, value] : set.items())
    run.retype(name, value.is_string() ? value.get<std::string>() : value.dump());
  return run;
}

}  // namespace

extern "C" {

// Each function that returns text returns the lines that it has written.

/// Opens {"scene": NAME, "set": {NAME: value, ...}}. For invalid input it writes {"refused": why} and opens no run.
EMSCRIPTEN_KEEPALIVE const char* spook_open(const char* asked) {
  play.reset();
  try {
    play = std::make_unique<spook::Play>(command_of(spook::Json::parse(asked)), lines);
  } catch (const std::exception& error) {
    lines << spook::Json{{"refused", error.what()}}.dump() << '\n';
  }
  return written();
}

EMSCRIPTEN_KEEPALIVE const char* spook_line(const char* text) {
  if (play)
    play->line(text);
  else
    lines << spook::Json{{"refused", "there is no run"}}.dump() << '\n';
  return written();
}

EMSCRIPTEN_KEEPALIVE const char* spook_frame() {
  if (play) play->frame();
  return written();
}

EMSCRIPTEN_KEEPALIVE bool spook_held() {
  return !play || play->held();
}

EMSCRIPTEN_KEEPALIVE double spook_frame_seconds() {
  return play ? play->frame_seconds() : 0;
}
}
