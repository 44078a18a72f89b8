#pragma once
// Numbers as people type and read them.
#include <string>

namespace spook {

/// Reads "0.02", "1e6" or "1/60", the whole of it. Throws std::invalid_argument, naming `name` and the text, for
/// anything else, and for a value that is not finite.
double parse_number(const std::string& name, const std::string& text);

/// The same for a whole number in [low, high].
int parse_whole(const std::string& name, const std::string& text, int low, int high);

/// The shortest text that reads back as the same number; "inf", "-inf" or "nan" when there is none.
std::string exact_text(double value);

/// Four significant digits, for people.
std::string short_text(double value);

}  // namespace spook
