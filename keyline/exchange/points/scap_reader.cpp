#include "keyline/exchange/points/scap_reader.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "keyline/core/text.h"

namespace keyline::exchange {
namespace {

using core::Result;

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  constexpr std::string_view kBlank = " \t\r";
  for (std::size_t at = line.find_first_not_of(kBlank); at != std::string_view::npos;
       at = line.find_first_not_of(kBlank, at)) {
    const std::size_t end = std::min(line.find_first_of(kBlank, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

bool parse(std::string_view text, double& value) {
  const auto number = core::parse_number(text);
  value = number.value_or(0);
  return number && std::abs(value) < 1e9;
}

class Reader {
 public:
  Result<ScapDrawing> read(std::string_view text) {
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      ++line_;
      if (!take(words_of(text.substr(0, end))))
        return core::fail(core::ErrorCode::bad_input, "is no line of a .scap file",
                          "strokes are { #id group, x y … }", "line " + std::to_string(line_));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    if (inside_)
      return core::fail(core::ErrorCode::bad_input, "the file ends within a stroke",
                        "check that it is complete", "line " + std::to_string(line_));
    std::erase_if(drawing_.strokes, [](const ScapStroke& s) { return s.points.empty(); });
    if (drawing_.strokes.empty())
      return core::fail(core::ErrorCode::bad_input, "holds no stroke", "give a .scap drawing");
    return std::move(drawing_);
  }

 private:
  bool take(const std::vector<std::string_view>& words) {
    if (words.empty()) return true;
    if (words[0] == "{") {
      if (inside_ || words.size() > 1) return false;
      drawing_.strokes.emplace_back();
      columns_ = 0;
      return inside_ = true;
    }
    if (words[0] == "}") {
      const bool was = inside_;
      inside_ = false;
      return was && words.size() == 1;
    }
    double a = 0;
    double b = 0;
    if (words[0][0] == '@') {
      if (words.size() > 1 || !parse(words[0].substr(1), a) || a <= 0) return false;
      if (!inside_) drawing_.pen = a;
      return true;
    }
    const bool head = words[0][0] == '#';
    if (head && !inside_ && !drawing_.strokes.empty()) return true;  // notes on the strokes
    if (words.size() < 2 || (head && words.size() > 2)) return false;
    if (!parse(words[0].substr(head ? 1 : 0), a) || !parse(words[1], b)) return false;
    if (!head) {
      if (!inside_ || !is_row(words)) return false;
      auto& points = drawing_.strokes.back().points;
      if (points.empty() || points.back() != core::Point2{a, b}) points.push_back({a, b});
    } else if (inside_) {
      drawing_.strokes.back().id = static_cast<int>(a);
      drawing_.strokes.back().group = static_cast<int>(b);
    } else {
      drawing_.width = a;
      drawing_.height = b;
    }
    return true;
  }

  /// Whether these are numbers, as many as in the stroke's first row: x, y and what else was
  /// recorded.
  bool is_row(const std::vector<std::string_view>& words) {
    if (columns_ == 0) columns_ = words.size();
    double number = 0;
    return words.size() == columns_ &&
           std::ranges::all_of(words, [&](std::string_view w) { return parse(w, number); });
  }

  ScapDrawing drawing_;
  std::size_t columns_ = 0;
  int line_ = 0;
  bool inside_ = false;
};

}  // namespace

std::vector<core::Point2> upright(const ScapDrawing& drawing, const ScapStroke& stroke) {
  std::vector<core::Point2> points = stroke.points;
  for (core::Point2& p : points) p.y = drawing.height - p.y;
  return points;
}

Result<ScapDrawing> read_scap(std::string_view text) { return Reader().read(text); }

}  // namespace keyline::exchange
