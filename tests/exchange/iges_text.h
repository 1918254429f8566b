#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace keyline::exchange {

/// An entity of an IGES file by what stands in it: its parameters, the type first, and some fields
/// of its directory (IGES 5.3, 2.2.4.4).
struct IgesEntity {
  std::string parameters;
  int level = 0;
  int matrix = 0;  ///< line of the directory
  int color = 0;
  int form = 0;
  std::string status = "00000000";
  std::string label = {};
  std::string subscript = {};
};

namespace iges_text {

inline std::string in_columns(const std::string& value, std::size_t width) {
  return std::string(width - std::min(width, value.size()), ' ') + value;
}

/// Lines of up to 64 columns; no number goes from one to the next (2.2.3).
inline std::vector<std::string> parted(std::string text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t comma = text.size() > 64 ? text.rfind(',', 63) : std::string::npos;
    lines.push_back(text.substr(0, comma == std::string::npos ? 64 : comma + 1));
    text.erase(0, lines.back().size());
  }
  return lines;
}

/// A line of 72 columns and its section's letter and number.
inline std::string line(std::string text, char section, std::size_t number) {
  text.resize(72, ' ');
  return text + section + std::string(7 - std::to_string(number).size(), '0') +
         std::to_string(number) + '\n';
}

}  // namespace iges_text

/// A file of these in a unit (2: mm; 1 to 10; 3: that of the name), written by hand after IGES 5.3,
/// 2.2.4.
inline std::string iges_file(const std::vector<IgesEntity>& entities, int unit = 2,
                             const std::string& unit_name = "u") {
  using iges_text::in_columns;
  std::string directory, parameters;
  std::size_t first = 1;  // parameter line
  for (std::size_t i = 0; i < entities.size(); ++i) {
    const IgesEntity& e = entities[i];
    const std::vector<std::string> lines = iges_text::parted(e.parameters + ';');
    const std::string type = e.parameters.substr(0, e.parameters.find(','));
    const auto row = [&](const std::vector<std::string>& fields, std::size_t number) {
      std::string text;
      for (const std::string& field : fields) text += in_columns(field, 8);
      directory += iges_text::line(text, 'D', number);
    };
    const auto of = [](auto value) { return std::to_string(value); };
    row({type, of(first), "0", "0", of(e.level), "0", of(e.matrix), "0", e.status}, 2 * i + 1);
    row({type, "0", of(e.color), of(lines.size()), of(e.form), "", "", e.label, e.subscript},
        2 * i + 2);
    for (std::string text : lines) {
      text.resize(64, ' ');
      parameters += iges_text::line(text + in_columns(of(2 * i + 1), 8), 'P', first++);
    }
  }
  const std::string global = "1H,,1H;,1Ha,1Ha,1Ha,1H1,32,38,6,38,15,1Ha,1.," +
                             std::to_string(unit) + ',' + std::to_string(unit_name.size()) + 'H' +
                             unit_name + ",1,0.01,";
  const std::string rest = "15H20260101.000000,1E-07,100.,1Ha,1Ha,11,0,15H20260101.000000;";
  const auto counted = [](char section, std::size_t count) {
    return section + in_columns(std::to_string(count), 7);
  };
  const std::string counts = counted('S', 1) + counted('G', 2) + counted('D', 2 * entities.size()) +
                             counted('P', first - 1);
  return iges_text::line("a", 'S', 1) + iges_text::line(global, 'G', 1) +
         iges_text::line(rest, 'G', 2) + directory + parameters + iges_text::line(counts, 'T', 1);
}

}  // namespace keyline::exchange
