#include "io/config/views_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "io/json/schema.h"
#include "io/system/text_file.h"

namespace thermal {
namespace {

constexpr const char* kWeight = "weight";
constexpr std::array kViewColumns = {"altitude_m", "look_angle_deg", "speed_m_s", kWeight};
constexpr std::size_t kNeededColumns = 2;  // the first of them
constexpr std::size_t kMostViewBytes = std::size_t{16} << 20;

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  for (const std::string_view cell : split(line, ',')) {
    const std::size_t first = cell.find_first_not_of(" \t");
    const std::size_t last = cell.find_last_not_of(" \t");
    cells.emplace_back(first == std::string_view::npos ? "" : cell.substr(first, last - first + 1));
  }
  return cells;
}

[[noreturn]] void throw_fault(const std::string& where, const std::string& value, const std::string& rule) {
  throw ConfigError(fault(where, "\"" + value + "\"", "", rule));
}

void check_columns(const std::vector<std::string>& columns, const std::string& where) {
  const std::vector<std::string> known(kViewColumns.begin(), kViewColumns.end());
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (std::ranges::find(known, columns[k]) == known.end())
      throw_fault(where, columns[k], "a column of " + list_names(known) + did_you_mean(columns[k], known));
    if (std::find(columns.begin(), columns.begin() + static_cast<std::ptrdiff_t>(k), columns[k]) !=
        columns.begin() + static_cast<std::ptrdiff_t>(k))
      throw_fault(where, columns[k], "each column once");
  }
  for (std::size_t k = 0; k < kNeededColumns; ++k)
    if (std::ranges::find(columns, known[k]) == columns.end())
      throw ConfigError(
          fmt::format("{}: the column {} is missing; expected it in the first row", where, known[k]));
}

/// Whole numbers without a point, as messages are to show them.
Json as_json(double number) {
  constexpr double kMostWhole = 1e15;
  const bool is_whole = std::abs(number) < kMostWhole && number == std::floor(number);
  return is_whole ? Json(static_cast<std::int64_t>(number)) : Json(number);
}

View read_view(const std::vector<std::string>& columns, const std::string& line, const std::string& where,
               const Json& keys) {
  const std::vector<std::string> cells = cells_of(line);
  if (cells.size() != columns.size())
    throw_fault(where, line, fmt::format("{} numbers: {}", columns.size(), fmt::join(columns, ",")));
  View view;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const std::optional<double> number = number_in<double>(cells[k]);
    if (!number) throw_fault(where + ": " + columns[k], cells[k], "a number");
    if (columns[k] == kWeight) {
      if (!(*number >= 0)) throw_fault(where + ": " + columns[k], cells[k], "at least 0");
      view.weight = *number;
      continue;
    }
    Json value = as_json(*number);
    const std::vector<std::string> faults = check_and_fill(value, keys[columns[k]], columns[k]);
    if (!faults.empty()) throw ConfigError(where + ": " + faults.front());
    view.values[columns[k]] = std::move(value);
  }
  return view;
}

}  // namespace

std::vector<View> read_views(const Path& file, const Json& keys) {
  std::vector<std::string> columns;
  std::vector<View> views;
  double sum = 0;
  const auto take = [&](const std::string& line, const std::string& where) {
    if (columns.empty()) {
      columns = cells_of(line);
      check_columns(columns, where);
      return;
    }
    views.push_back(read_view(columns, line, where, keys));
    sum += views.back().weight;
  };
  for_table_lines(file, take, kMostViewBytes);
  if (!(sum > 0))
    throw ConfigError(fmt::format("{}: no view with a weight above 0; expected at least one", file.string()));
  return views;
}

std::string views_text(const std::map<std::pair<double, double>, int>& counts) {
  std::string text = "altitude_m,look_angle_deg,weight\n";
  for (const auto& [view, count] : counts) text += fmt::format("{},{},{}\n", view.first, view.second, count);
  return text;
}

}  // namespace thermal
