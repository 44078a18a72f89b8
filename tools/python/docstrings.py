"""Writes the docstrings of _spook.pyi as C++, so that help() and editors show the same text.

docstrings.py _spook.pyi docstrings.cpp
"""

import ast
import json
import sys
from pathlib import Path


def docstrings(stub: str) -> dict[str, str]:
    """Returns the text of each class, function and member that has one, by its dotted name."""
    found = {}

    def look(node, prefix: str):
        for child in node.body:
            if not isinstance(child, (ast.ClassDef, ast.FunctionDef)):
                continue
            if text := ast.get_docstring(child):
                found[prefix + child.name] = text
            if isinstance(child, ast.ClassDef):
                look(child, f"{prefix}{child.name}.")

    look(ast.parse(stub), "")
    return found


def as_cpp(texts: dict[str, str]) -> str:
    entries = "".join(f"      {{{json.dumps(name)}, {json.dumps(text, ensure_ascii=False)}}},\n" for name, text in texts.items())
    return f"""#include <map>
#include <stdexcept>

#include "module.hpp"

namespace spook {{

const char* docstring(const std::string& name) {{
  static const std::map<std::string, const char*> texts = {{
{entries}  }};
  const auto found = texts.find(name);
  if (found == texts.end()) throw std::logic_error("_spook.pyi says nothing of " + name);
  return found->second;
}}

}}  // namespace spook
"""


if __name__ == "__main__":
    Path(sys.argv[2]).write_text(as_cpp(docstrings(Path(sys.argv[1]).read_text(encoding="utf-8"))), encoding="utf-8")
