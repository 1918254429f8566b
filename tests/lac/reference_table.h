#pragma once

#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace keyline::lac {

/// A row of a reference table by column name; "none" in the first answer column: no such curve.
using ReferenceRow = std::map<std::string, std::string>;

/// Rows of the shared reference table; empty where the shared data are absent.
inline std::vector<ReferenceRow> read_reference(const std::string& name) {
  std::ifstream file(std::string(KEYLINE_SHARED_DATA) + "/reference/" + name);
  std::vector<ReferenceRow> rows;
  std::vector<std::string> columns;
  std::string line;
  while (std::getline(file, line)) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    std::vector<std::string> cells;
    std::stringstream cell_stream(line);
    std::string cell;
    while (std::getline(cell_stream, cell, ',')) cells.push_back(cell);
    if (columns.empty()) {
      columns = cells;
      continue;
    }
    ReferenceRow row;
    for (std::size_t i = 0; i < cells.size(); ++i) row[columns[i]] = cells[i];
    rows.push_back(row);
  }
  return rows;
}

}  // namespace keyline::lac
