#include "keyline/exchange/svg/svg_path.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "keyline/core/angle.h"
#include "keyline/core/leading_number.h"

namespace keyline::exchange {

using core::Point2;
using core::Vector2;
using curve::Bezier2;

namespace detail {

namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

void SvgScanner::skip_space() {
  while (!at_end() && is_space(peek())) ++position_;
}

void SvgScanner::skip_separator() {
  skip_space();
  if (peek() != ',') return;
  ++position_;
  skip_space();
}

bool SvgScanner::number_ahead() const {
  std::string_view ahead = rest();
  if (!ahead.empty() && (ahead[0] == '+' || ahead[0] == '-')) ahead.remove_prefix(1);
  if (ahead.empty()) return false;
  return is_digit(ahead[0]) || (ahead[0] == '.' && ahead.size() > 1 && is_digit(ahead[1]));
}

bool SvgScanner::number(double& value) {
  if (!number_ahead()) return false;
  const auto number = core::leading_number(rest());
  if (!number || !std::isfinite(number->value)) return false;
  value = number->value;
  position_ += number->length;
  return true;
}

bool SvgScanner::flag(bool& value) {
  if (peek() != '0' && peek() != '1') return false;
  value = take() == '1';
  return true;
}

namespace {

/// The ellipse through both ends: half axes, and the angles at which the arc starts and how far it
/// runs, in the frame of the axes scaled to a circle (SVG 1.1, F.6.5).
struct Ellipse {
  double rx = 0;
  double ry = 0;
  double rotation = 0;
  Point2 center;
  double start = 0;
  double turn = 0;
};

Ellipse ellipse_through(Point2 from, Point2 to, double rx, double ry, double rotation, bool large,
                        bool sweep) {
  const Vector2 half = core::rotate_ccw(0.5 * (from - to), -rotation);
  const double excess = std::hypot(half.x / rx, half.y / ry);
  if (excess > 1) {
    rx *= excess;
    ry *= excess;
  }
  const Vector2 unit{half.x / rx, half.y / ry};
  const double square = dot(unit, unit);
  // Rounding alone would move the centre of a half turn by 1e-8 radii.
  constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();
  const double room = excess > 1 || square == 0 ? 0 : 1 / square - 1;
  double k = room > kRounding ? std::sqrt(room) : 0;
  if (large == sweep) k = -k;
  const Vector2 center{k * unit.y, -k * unit.x};  // in the circle's frame
  const Vector2 start = unit - center;
  const Vector2 end = -unit - center;
  Ellipse e{rx, ry, rotation, {}, core::direction_of(start), core::angle_between(start, end)};
  if (sweep && e.turn < 0) e.turn += 2 * core::kPi;
  if (!sweep && e.turn > 0) e.turn -= 2 * core::kPi;
  const Vector2 shift = core::rotate_ccw({rx * center.x, ry * center.y}, rotation);
  e.center = core::mix(from, to, 0.5) + shift;
  return e;
}

Point2 on_ellipse(const Ellipse& e, double angle, double reach) {
  const Vector2 v{e.rx * reach * std::cos(angle), e.ry * reach * std::sin(angle)};
  return e.center + core::rotate_ccw(v, e.rotation);
}

/// The shorter arc through both ends as one piece, where it is one of at most a quarter turn. It
/// needs no centre: that of a slight arc is so far away that differences from it are rounding
/// alone.
std::optional<Bezier2> one_piece(Point2 from, Point2 to, double rx, double ry, double rotation,
                                 bool sweep) {
  const Vector2 half = core::rotate_ccw(0.5 * (from - to), -rotation);
  const Vector2 unit{half.x / rx, half.y / ry};
  const double sine = norm(unit);  // of half the turn
  if (!(sine * sine <= 0.5)) return std::nullopt;
  const double weight = std::sqrt(1 - sine * sine);
  const double reach = (sweep ? -1 : 1) * sine / weight;
  const Vector2 out = core::rotate_ccw({rx * reach * unit.y, -ry * reach * unit.x}, rotation);
  return Bezier2{{from, core::mix(from, to, 0.5) + out, to}, {1, weight, 1}};
}

}  // namespace

std::vector<Bezier2> svg_arc(Point2 from, Point2 to, double rx, double ry, double x_axis_degrees,
                             bool large, bool sweep) {
  if (from == to) return {};
  rx = std::abs(rx);
  ry = std::abs(ry);
  const Bezier2 line{{from, to}, {}};
  const double chord = core::distance(from, to);
  if (!(rx > 1e-12 * chord && ry > 1e-12 * chord)) return {line};
  const double rotation = core::wrap_angle(std::fmod(x_axis_degrees, 360.0) * core::kPi / 180);
  if (!large)
    if (auto piece = one_piece(from, to, rx, ry, rotation, sweep)) return {*std::move(piece)};
  const Ellipse e = ellipse_through(from, to, rx, ry, rotation, large, sweep);
  const double quarters = std::abs(e.turn) / (core::kPi / 2);
  if (!std::isfinite(quarters)) return {line};
  const int count = std::clamp(static_cast<int>(std::ceil(quarters - 1e-9)), 1, 4);
  const double step = e.turn / count;
  const double weight = std::cos(step / 2);
  std::vector<Bezier2> arcs;
  Point2 last = from;
  for (int i = 0; i < count; ++i) {
    const double angle = e.start + i * step;
    const Point2 end = i + 1 == count ? to : on_ellipse(e, angle + step, 1);
    const Point2 handle = on_ellipse(e, angle + step / 2, 1 / weight);
    arcs.push_back({{last, handle, end}, {1, weight, 1}});
    last = end;
  }
  return arcs;
}

namespace {

class PathReader {
 public:
  explicit PathReader(std::string_view d) : scan_(d) {}

  SvgPathData read() {
    scan_.skip_space();
    char command = 0;
    while (!scan_.at_end()) {
      if (!scan_.number_ahead() || command == 0) {
        command = scan_.peek();
        if (!is_command(command)) return stop("a path command is expected here");
        if (!started_ && command != 'M' && command != 'm')
          return stop("a path has to start with M");
        scan_.take();
        scan_.skip_space();
      } else if (command == 'Z' || command == 'z') {
        return stop("a path command is expected after Z");
      } else {
        command = command == 'M' ? 'L' : command == 'm' ? 'l' : command;
      }
      if (!run(command)) return stop("a number is expected here");
      scan_.skip_separator();
    }
    return finish();
  }

 private:
  static bool is_command(char c) {
    return c != '\0' && std::strchr("MmZzLlHhVvCcSsQqTtAa", c) != nullptr;
  }

  SvgPathData stop(std::string why) {
    data_.error = std::move(why);
    data_.error_at = scan_.position();
    return finish();
  }

  SvgPathData finish() {
    flush();
    return std::move(data_);
  }

  void flush() {
    if (!open_.pieces.empty()) data_.subpaths.push_back(std::move(open_));
    open_ = {};
  }

  bool numbers(double* values, int count) {
    for (int i = 0; i < count; ++i) {
      if (i > 0) scan_.skip_separator();
      if (!scan_.number(values[i])) return false;
    }
    return true;
  }

  bool points(Point2* values, int count, bool relative) {
    const Vector2 base = relative ? at_ - Point2{} : Vector2{};
    for (int i = 0; i < count; ++i) {
      if (i > 0) scan_.skip_separator();
      double xy[2];
      if (!numbers(xy, 2)) return false;
      values[i] = Point2{xy[0], xy[1]} + base;
    }
    return true;
  }

  void add(Bezier2 piece) {
    const auto& c = piece.control;
    at_ = c.back();
    const bool moves = std::any_of(c.begin(), c.end(), [&c](Point2 p) { return p != c[0]; });
    if (moves) open_.pieces.push_back(std::move(piece));
  }

  /// Handle mirrored at the current point, if the command before was of the same family.
  Point2 mirrored(bool same_family) const { return same_family ? at_ + (at_ - handle_) : at_; }

  bool run(char command) {
    const bool relative = command >= 'a';
    const char upper = relative ? static_cast<char>(command - 'a' + 'A') : command;
    bool done = false;
    switch (upper) {
      case 'M':
        done = move(relative);
        break;
      case 'Z':
        done = close();
        break;
      case 'L':
        done = line(relative);
        break;
      case 'H':
      case 'V':
        done = straight(upper == 'H', relative);
        break;
      case 'C':
        done = cubic(relative);
        break;
      case 'S':
        done = smooth_cubic(relative);
        break;
      case 'Q':
        done = quadratic(relative);
        break;
      case 'T':
        done = smooth_quadratic(relative);
        break;
      default:
        done = arc(relative);
        break;
    }
    last_ = upper;
    return done;
  }

  bool move(bool relative) {
    Point2 p;
    if (!points(&p, 1, relative)) return false;
    flush();
    at_ = start_ = p;
    started_ = true;
    return true;
  }

  bool close() {
    if (!open_.pieces.empty()) {
      const double size =
          std::max({std::abs(start_.x), std::abs(start_.y), std::abs(at_.x), std::abs(at_.y)});
      if (core::distance(at_, start_) > 1e-9 * size)
        add({{at_, start_}, {}});
      else
        open_.pieces.back().control.back() = start_;
      open_.closed = true;
      flush();
    }
    at_ = start_;
    return true;
  }

  bool line(bool relative) {
    Point2 p;
    if (!points(&p, 1, relative)) return false;
    add({{at_, p}, {}});
    return true;
  }

  bool straight(bool horizontal, bool relative) {
    double value = 0;
    if (!scan_.number(value)) return false;
    Point2 p = at_;
    double& moved = horizontal ? p.x : p.y;
    moved = relative ? moved + value : value;
    add({{at_, p}, {}});
    return true;
  }

  bool cubic(bool relative) {
    Point2 p[3];
    if (!points(p, 3, relative)) return false;
    handle_ = p[1];
    add({{at_, p[0], p[1], p[2]}, {}});
    return true;
  }

  bool smooth_cubic(bool relative) {
    Point2 p[2];
    const Point2 first = mirrored(last_ == 'C' || last_ == 'S');
    if (!points(p, 2, relative)) return false;
    handle_ = p[0];
    add({{at_, first, p[0], p[1]}, {}});
    return true;
  }

  bool quadratic(bool relative) {
    Point2 p[2];
    if (!points(p, 2, relative)) return false;
    handle_ = p[0];
    add({{at_, p[0], p[1]}, {}});
    return true;
  }

  bool smooth_quadratic(bool relative) {
    Point2 p;
    const Point2 first = mirrored(last_ == 'Q' || last_ == 'T');
    if (!points(&p, 1, relative)) return false;
    handle_ = first;
    add({{at_, first, p}, {}});
    return true;
  }

  bool arc(bool relative) {
    double r[3];
    bool large = false;
    bool sweep = false;
    Point2 p;
    if (!numbers(r, 3)) return false;
    scan_.skip_separator();
    if (!scan_.flag(large)) return false;
    scan_.skip_separator();
    if (!scan_.flag(sweep)) return false;
    scan_.skip_separator();
    if (!points(&p, 1, relative)) return false;
    for (Bezier2& piece : detail::svg_arc(at_, p, r[0], r[1], r[2], large, sweep))
      add(std::move(piece));
    at_ = p;
    return true;
  }

  SvgScanner scan_;
  SvgPathData data_;
  SvgSubpath open_;
  Point2 at_;
  Point2 start_;
  Point2 handle_;  ///< last control point before at_, for S and T
  char last_ = 0;
  bool started_ = false;
};

}  // namespace

}  // namespace detail

SvgPathData parse_svg_path(std::string_view d) { return detail::PathReader(d).read(); }

}  // namespace keyline::exchange
