#pragma once
// Numbers of the lessons' worked examples and predictions, computed by the reference. The program prints a line for
// each, "group.name value"; compare_numbers.py reads them.
#include <string>

namespace spook::lessons {

/// Prints one number to ten digits; a number that is 0 up to round-off is printed as 0.
void say(const std::string& name, double value);

void worked_examples();
void predicted_numbers();

}  // namespace spook::lessons
