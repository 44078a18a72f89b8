#pragma once
// The named parameters of a scene. A name has the same meaning in all scenes, so shared parameters are defined here.
#include <initializer_list>
#include <set>
#include <string>
#include <vector>

#include "04_gauss_seidel/gauss_seidel.hpp"

namespace spook {

/// The range of a number; `whole` allows whole numbers only.
struct Limits {
  double low = -infinity;
  double high = infinity;
  bool low_included = true;
  bool high_included = true;
  bool whole = false;

  bool allow(double value) const;
  /// Returns "more than 0", "a whole number from 1 to 1000", and so on; empty if any finite number is allowed.
  std::string text() const;
};

/// A parameter: a number, or a choice by name. Holds its default until it is set.
struct Parameter {
  std::string name;
  std::string meaning;
  std::string unit = "";  ///< SI unit; empty for a plain number or a choice
  double value = 0;
  Limits limits = {};
  std::vector<std::string> choices = {};  ///< names of a choice, the first is the default; empty for a number
  std::string choice = choices.empty() ? "" : choices.front();

  std::string text() const;  ///< the value as a text for set()
};

class Parameters {
 public:
  explicit Parameters(std::vector<Parameter> known) : all_(std::move(known)) {}

  /// Sets a parameter from text: "1e6", "1/60", or the name of a choice. Throws std::invalid_argument, naming the
  /// parameter and the value, for an unknown name, an unknown choice, a number beyond the limits, and a name that was
  /// set before.
  void set(const std::string& name, const std::string& text);

  double number(const std::string& name) const { return find(name).value; }
  int count(const std::string& name) const { return static_cast<int>(find(name).value); }
  const std::string& choice(const std::string& name) const { return find(name).choice; }

  const std::vector<Parameter>& all() const { return all_; }

 private:
  const Parameter& find(const std::string& name) const;

  std::vector<Parameter> all_;
  std::set<std::string> given_;
};

namespace parameter {

Parameter mass(double value = 1);
Parameter gravity();
Parameter stiffness();
Parameter relaxation();
Parameter radius(double value = 0.5);
Parameter start();
Parameter bodies(double value, double most);
Parameter boxes(double value, double most);
Parameter side();
Parameter friction(double value = 0.5);
Parameter viscosity();
Parameter speed(double value);
Parameter restitution(double value);
Parameter threshold();

/// The friction law of a scene's answer; the first is the default.
Parameter friction_law(std::vector<std::string> laws = {"coulomb", "box"});

/// Gravity above zero, for scenes whose answer is undetermined without weight.
Parameter weighing_gravity();
Parameter ratio();
Parameter links(double value);
Parameter length();
Parameter begin();

}  // namespace parameter

}  // namespace spook
