#pragma once
// Numbers that the lessons work out by hand, or ask for, as the reference computes them. The program prints a line for
// each, "group.name value"; compare_numbers.py reads them.
#include <string>

namespace spook::lessons {

/// Prints one number to ten digits; what is 0 but for roundings as 0.
void say(const std::string& name, double value);

void worked_examples();
void predicted_numbers();

}  // namespace spook::lessons
