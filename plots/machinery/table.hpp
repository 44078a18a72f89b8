#pragma once
// A table as it stands in a CSV file, for the claims to look at.
#include <string>
#include <vector>

namespace spook::plots {

class Table {
 public:
  Table(std::vector<std::string> columns, std::vector<std::vector<std::string>> rows);

  /// The rows in which a column has that text, or that number.
  /// Throws std::out_of_range for a column that there is not, and std::runtime_error when no row is left: a claim
  /// about nothing would hold.
  Table where(const std::string& column, const std::string& text) const;
  Table where(const std::string& column, double value) const;

  /// A column as numbers. Throws std::invalid_argument where a cell is none.
  std::vector<double> numbers(const std::string& column) const;

  /// Of a table with one row.
  double number(const std::string& column) const;

  std::size_t size() const { return rows_.size(); }

 private:
  std::size_t index(const std::string& column) const;

  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
};

/// The slope of log y over log x by least squares.
double log_log_slope(const std::vector<double>& x, const std::vector<double>& y);

/// Between the last two points only: what is left when h has become small.
double last_log_log_slope(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace spook::plots
