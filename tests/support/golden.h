#pragma once

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/// One line of a CSV of golden values, as text and as the nearest doubles: 0 if it is not a number or is smaller than
/// any double.
struct GoldenRow {
  std::vector<std::string> texts;
  std::vector<double> numbers;
};

/// Reads tests/data/<name>; leaves out comments and the header.
inline std::vector<GoldenRow> read_golden(const std::string& name) {
  std::ifstream file(std::string(VELDT_SOURCE_DIR) + "/tests/data/" + name);
  if (!file) throw std::runtime_error("tests/data/" + name + " cannot be read");
  std::vector<GoldenRow> rows;
  bool header = true;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("#")) continue;
    if (std::exchange(header, false)) continue;
    GoldenRow& row = rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) {
      row.texts.push_back(cell);
      row.numbers.push_back(std::strtod(cell.c_str(), nullptr));
    }
  }
  return rows;
}
