#pragma once
// The parts of the extension module _spook.
#include <pybind11/pybind11.h>

#include <string>

namespace spook {

namespace py = pybind11;

void bind_worlds(py::module_& module);
void bind_scenes(py::module_& module);

/// Returns the text of "World", "World.add" or "scenes" in _spook.pyi. Throws std::logic_error if there is none.
const char* docstring(const std::string& name);

}  // namespace spook
