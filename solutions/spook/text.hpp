#pragma once
// Layout of text for a terminal of 80 columns.
#include <ostream>
#include <string>

namespace spook {

/// Returns the number of columns of a UTF-8 text, one for each character.
std::size_t width(const std::string& text);

/// Prints a label in the first columns and, beside it, the text, with line breaks between words.
void print_entry(std::ostream& out, const std::string& label, const std::string& text, std::size_t indent = 10);

}  // namespace spook
