#pragma once
// The table of a CSV file, from which claims are computed.
#include <string>
#include <vector>

namespace spook::plots {

class Table {
 public:
  Table(std::vector<std::string> columns, std::vector<std::vector<std::string>> rows);

  /// Returns the rows in which a column has that text, or that number. Throws std::out_of_range for an unknown column,
  /// and std::runtime_error if no row is left, since a claim about no rows would hold.
  Table where(const std::string& column, const std::string& text) const;
  Table where(const std::string& column, double value) const;

  /// Returns a column as it is written.
  std::vector<std::string> texts(const std::string& column) const;

  /// Returns a column as numbers. Throws std::invalid_argument for a cell that is not a number.
  std::vector<double> numbers(const std::string& column) const;

  /// Returns the number in a column of a table with one row.
  double number(const std::string& column) const;

  std::size_t size() const { return rows_.size(); }

 private:
  std::size_t index(const std::string& column) const;

  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
};

/// Returns the slope of log y over log x by least squares.
double log_log_slope(const std::vector<double>& x, const std::vector<double>& y);

/// Returns the slope between the last two points, that is for the smallest h.
double last_log_log_slope(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace spook::plots
