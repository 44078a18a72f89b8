#pragma once
// The named parameters of a scene. A name means the same in every scene: what several scenes share is made here.
#include <initializer_list>
#include <set>
#include <string>
#include <vector>

#include "04_gauss_seidel/gauss_seidel.hpp"

namespace spook {

/// What a number may be. Whole numbers only, where `whole`.
struct Limits {
  double low = -infinity;
  double high = infinity;
  bool low_included = true;
  bool high_included = true;
  bool whole = false;

  bool allow(double value) const;
  std::string text()
      const;  ///< "more than 0", "a whole number from 1 to 1000", ...; empty when any finite number will do
};

/// A number, or one of a list of choices by name. Holds its default, and then what it was set to.
struct Parameter {
  std::string name;
  std::string meaning;
  std::string unit = "";  ///< SI; empty for a plain number or a choice
  double value = 0;
  Limits limits = {};
  std::vector<std::string> choices = {};  ///< not empty: a choice, and the first is the default
  std::string choice = choices.empty() ? "" : choices.front();

  std::string text() const;  ///< the value, as it can be given to set()
};

class Parameters {
 public:
  explicit Parameters(std::vector<Parameter> known) : all_(std::move(known)) {}

  /// Sets one from text: "1e6", "1/60", or the name of a choice.
  /// Throws std::invalid_argument, naming the parameter and the value, for an unknown name, an unknown choice, a
  /// number beyond the limits, and a name that was set before.
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

/// Which law of friction a scene's answer follows; the first is the default.
Parameter friction_law(std::vector<std::string> laws = {"coulomb", "box"});

/// g, but not zero: for what has no shape, or no stretch, without a weight.
Parameter weighing_gravity();
Parameter ratio();
Parameter links(double value);
Parameter length();
Parameter begin();

}  // namespace parameter

}  // namespace spook
