#pragma once
// Conversion between numbers and text.
#include <string>

namespace spook {

/// Reads "0.02", "1e6" or "1/60", the whole of it. Throws std::invalid_argument, naming `name` and the text, for
/// anything else, and for a value that is not finite.
double parse_number(const std::string& name, const std::string& text);

/// Reads a whole number in [low, high]. Throws as parse_number does.
int parse_whole(const std::string& name, const std::string& text, int low, int high);

/// Returns the shortest text that reads back as the same number; "inf", "-inf" or "nan" if there is none.
std::string exact_text(double value);

/// Returns a text of four significant digits.
std::string short_text(double value);

}  // namespace spook
