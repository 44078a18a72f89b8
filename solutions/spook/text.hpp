#pragma once
// Text for a terminal of 80 columns.
#include <ostream>
#include <string>

namespace spook {

/// How many columns a UTF-8 text takes, one a character.
std::size_t width(const std::string& text);

/// A label in the first columns, and the text beside it, its lines broken between words.
void print_entry(std::ostream& out, const std::string& label, const std::string& text, std::size_t indent = 10);

}  // namespace spook
