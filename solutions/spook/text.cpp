#include "spook/text.hpp"

#include <algorithm>
#include <sstream>

namespace spook {

static constexpr std::size_t columns = 80;

std::size_t width(const std::string& text) {
  // Counts all bytes except continuation bytes, 10xxxxxx.
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

void print_entry(std::ostream& out, const std::string& label, const std::string& text, std::size_t indent) {
  std::string line = label;
  line.append(indent > width(label) ? indent - width(label) : 1, ' ');
  bool fresh = true;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!fresh && width(line) + 1 + width(word) > columns) {
      out << line << '\n';
      line.assign(indent, ' ');
      fresh = true;
    }
    line += (fresh ? "" : " ") + word;
    fresh = false;
  }
  out << line << '\n';
}

}  // namespace spook
