#include "keyline/exchange/json/json_lists.h"

#include <array>
#include <cmath>

#include <nlohmann/json.hpp>

namespace keyline::exchange::detail {
namespace {

/// As every other number of the text.
void add_number(std::string& text, double value) {
  if (!std::isfinite(value)) {
    text += "null";
    return;
  }
  std::array<char, 64> digits{};
  const char* end = nlohmann::detail::to_chars(digits.data(), digits.data() + digits.size(), value);
  text.append(digits.data(), static_cast<std::size_t>(end - digits.data()));
}

class Filler {
 public:
  Filler(std::string& text, int indent) : text_(text), indent_(indent) {}

  void operator()(const std::vector<core::Point2>* points) { add(*points); }
  void operator()(const std::vector<core::Point3>* points) { add(*points); }

  /// Columns in front of the list's key.
  void set_depth(std::size_t depth) { depth_ = depth; }

 private:
  template <class Point>
  void add(const std::vector<Point>& points) {
    bool first = true;
    for (const Point& p : points) {
      if (!first) text_ += ',';
      new_line(1);
      text_ += '[';
      add_coordinates(p);
      new_line(1);
      text_ += ']';
      first = false;
    }
    new_line(0);
  }

  void add_coordinates(core::Point2 p) { numbers(std::array{p.x, p.y}); }
  void add_coordinates(core::Point3 p) { numbers(std::array{p.x, p.y, p.z}); }

  template <std::size_t N>
  void numbers(const std::array<double, N>& values) {
    for (std::size_t i = 0; i < N; ++i) {
      if (i > 0) text_ += ',';
      new_line(2);
      add_number(text_, values[i]);
    }
  }

  /// So many steps further in than the key.
  void new_line(int steps) {
    if (indent_ < 0) return;
    text_ += '\n';
    text_.append(depth_ + static_cast<std::size_t>(steps * indent_), ' ');
  }

  std::string& text_;
  int indent_;
  std::size_t depth_ = 0;
};

}  // namespace

std::string filled(std::string_view text, const PointLists& lists, int indent) {
  // Quotes within texts are escaped: only a key reads like this.
  const std::string_view mark = indent < 0 ? "\"points\":[]" : "\"points\": []";
  std::string whole;
  Filler filler(whole, indent);
  std::size_t from = 0;
  for (const auto& list : lists) {
    const std::size_t key = text.find(mark, from);
    const std::size_t close = key + mark.size() - 1;
    whole += text.substr(from, close - from);
    // without indents all is one line, which would be gone through for every list
    const std::size_t line = indent < 0 ? std::string_view::npos : text.rfind('\n', key);
    filler.set_depth(key - (line == std::string_view::npos ? 0 : line + 1));
    std::visit(filler, list);
    from = close;
  }
  return whole += text.substr(from);
}

}  // namespace keyline::exchange::detail
