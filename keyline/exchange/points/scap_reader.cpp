#include "keyline/exchange/points/scap_reader.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "keyline/core/text.h"
#include "keyline/exchange/text/byte_lines.h"
#include "keyline/exchange/text/utf16.h"

namespace keyline::exchange {
namespace {

using core::Result;

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (auto word = detail::take_word(line); !word.empty(); word = detail::take_word(line))
    words.push_back(word);
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
    detail::ByteLines lines(detail::without_mark(text));
    for (std::string_view line; lines.next(line);) {
      place_ = lines.place();
      if (!take(words_of(line)))
        return core::fail(core::ErrorCode::bad_input, "is no line of a .scap file",
                          "strokes are { #id group, x y … }", place_);
    }
    if (inside_)
      return core::fail(core::ErrorCode::bad_input, "the file ends within a stroke",
                        "check that it is complete", place_);
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
      begin_ = place_;
      columns_ = 0;
      numbered_ = false;
      return inside_ = true;
    }
    if (words[0] == "}") {
      if (!std::exchange(inside_, false) || words.size() > 1) return false;
      end_stroke();
      return true;
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
      if (numbered_ || a != std::floor(a) || b != std::floor(b)) return false;
      numbered_ = true;
      drawing_.strokes.back().id = static_cast<int>(a);
      drawing_.strokes.back().group = static_cast<int>(b);
    } else {
      drawing_.width = a;
      drawing_.height = b;
    }
    return true;
  }

  void end_stroke() {
    if (!drawing_.strokes.back().points.empty()) return;
    drawing_.strokes.pop_back();
    drawing_.left_out.push_back(begin_ + ": a stroke without points");
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
  std::string place_;      ///< of the line being read
  std::string begin_;      ///< of the last stroke's {
  bool numbered_ = false;  ///< that stroke has its "#id group"
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
