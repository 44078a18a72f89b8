#include "machinery/table.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace spook::plots {

Table::Table(std::vector<std::string> columns, std::vector<std::vector<std::string>> rows)
    : columns_(std::move(columns)), rows_(std::move(rows)) {
  for (const auto& row : rows_)
    if (row.size() != columns_.size())
      throw std::runtime_error("a row has " + std::to_string(row.size()) + " cells, but there are " +
                               std::to_string(columns_.size()) + " columns");
}

std::size_t Table::index(const std::string& column) const {
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  if (found == columns_.end()) throw std::out_of_range("there is no column \"" + column + "\"");
  return static_cast<std::size_t>(found - columns_.begin());
}

Table Table::where(const std::string& column, const std::string& text) const {
  const std::size_t c = index(column);
  Table kept(columns_, {});
  for (const auto& row : rows_)
    if (row[c] == text) kept.rows_.push_back(row);
  if (kept.rows_.empty()) throw std::runtime_error("no row has " + column + " = " + text);
  return kept;
}

Table Table::where(const std::string& column, double value) const {
  const std::size_t c = index(column);
  Table kept(columns_, {});
  for (const auto& row : rows_)
    if (std::stod(row[c]) == value) kept.rows_.push_back(row);
  if (kept.rows_.empty()) throw std::runtime_error("no row has " + column + " = " + std::to_string(value));
  return kept;
}

std::vector<std::string> Table::texts(const std::string& column) const {
  const std::size_t c = index(column);
  std::vector<std::string> values;
  for (const auto& row : rows_) values.push_back(row[c]);
  return values;
}

std::vector<double> Table::numbers(const std::string& column) const {
  const std::size_t c = index(column);
  std::vector<double> values;
  for (const auto& row : rows_) values.push_back(std::stod(row[c]));
  return values;
}

double Table::number(const std::string& column) const {
  if (rows_.size() != 1)
    throw std::runtime_error("one row was expected, but there are " + std::to_string(rows_.size()));
  return numbers(column).front();
}

double log_log_slope(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double u = std::log(x[k]), v = std::log(y[k]);
    sx += u;
    sy += v;
    sxx += u * u;
    sxy += u * v;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

double last_log_log_slope(const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t n = x.size();
  return log_log_slope({x[n - 2], x[n - 1]}, {y[n - 2], y[n - 1]});
}

}  // namespace spook::plots
