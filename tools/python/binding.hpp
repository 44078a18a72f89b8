#pragma once
// A Python class for worlds, whose members have the docstrings of _spook.pyi.
#include "module.hpp"
#include "python_world.hpp"

namespace spook {

template <int Dof>
class Binding {
 public:
  using Self = PythonWorld<Dof>;

  Binding(py::module_& module, const char* name) : name_(name), type_(module, name, docstring(name)) {}

  py::class_<Self>& type() { return type_; }

  template <class Function, class... Extra>
  Binding& def(const std::string& member, const Function& function, const Extra&... extra) {
    type_.def(member.c_str(), function, documentation(member), extra...);
    return *this;
  }
  /// A function of the engine's world that changes nothing.
  template <class Function, class... Extra>
  Binding& ask(const std::string& member, const Function& function, const Extra&... extra) {
    return def(
        member, [function](const Self& self, int n) { return function(self.world(), n); }, extra...);
  }
  template <class Function>
  Binding& property(const char* member, const Function& function) {
    type_.def_property_readonly(member, function, documentation(member));
    return *this;
  }
  /// An array over numbers of the engine.
  template <class Show>
  Binding& view(const char* member, const Show& show) {
    return property(member, [show](const py::object& object) { return show(object, object.cast<Self&>()); });
  }

  /// Returns the text of a member, its own or that of both worlds.
  const char* documentation(const std::string& member) const {
    try {
      return docstring(name_ + "." + member);
    } catch (const std::logic_error&) {
      return docstring("_EitherWorld." + member);
    }
  }

 private:
  std::string name_;
  py::class_<Self> type_;
};

}  // namespace spook
