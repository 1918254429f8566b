#include "keyline/sketch/refine_stroke.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "keyline/core/polygon.h"
#include "keyline/core/quantile.h"
#include "keyline/sketch/polyline_tools.h"
#include "keyline/sketch/rows.h"
#include "keyline/sketch/whittaker.h"

namespace keyline::sketch {
namespace {

using core::distance;
using core::norm;
using core::Point2;
using core::Vector2;

constexpr double kStep = 0.25;  ///< of a profile, pixels
/// Half widths, and pixels for their rounding: in a knot wider ink is that of two lines.
constexpr double kAloneWidth = 2.2;
constexpr double kAloneRounding = 0.6;
/// Of a normal across the picture's rim, from which a line runs along it (within 10 degrees):
/// beyond there is paper then. What crosses the rim goes on, and of it nothing is measured that
/// reaches beyond.
constexpr double kAlongRim = 0.985;
constexpr double kFlank = 1;          ///< pixels beside the ink that tell where it ends
constexpr double kGuessWeight = 0.1;  ///< of a guessed place, where a measured one has 1

/// Index clamped, or wrapped round.
std::size_t neighbour(std::size_t i, long step, std::size_t n, bool closed) {
  const long k = static_cast<long>(i) + step;
  const long m = static_cast<long>(n);
  if (closed) return static_cast<std::size_t>(((k % m) + m) % m);
  return static_cast<std::size_t>(std::clamp(k, 0L, m - 1));
}

Vector2 tangent_at(const std::vector<Point2>& p, std::size_t i, long reach, bool closed) {
  const Vector2 d =
      p[neighbour(i, reach, p.size(), closed)] - p[neighbour(i, -reach, p.size(), closed)];
  const double length = norm(d);
  return length > 0 ? d / length : Vector2{1, 0};
}

/// Median over some forty points around each.
template <class Values>
std::vector<double> usual_of(const Values& values) {
  const std::size_t n = values.size();
  std::vector<double> usual(n);
  constexpr std::size_t kBlock = 16;  // points that share one median
  std::vector<double> scratch;
  for (std::size_t start = 0; start < n; start += kBlock) {
    const std::size_t low = start > 16 ? start - 16 : 0;
    const std::size_t high = std::min(n, start + kBlock + 16);
    scratch.assign(values.begin() + static_cast<long>(low),
                   values.begin() + static_cast<long>(high));
    const double m = core::quantile(scratch);
    for (std::size_t i = start; i < std::min(n, start + kBlock); ++i) usual[i] = m;
  }
  return usual;
}

/// Guessed points before the first and after the last sure one (where a line ends at another) hold
/// their guess: left to the smoother they would run on along a parabola.
void hold_guessed_ends(const RawStroke& raw, std::vector<Point2>& centres,
                       std::vector<double>& weights) {
  if (raw.closed) return;
  const auto hold = [&](std::size_t i) {
    if (raw.sure[i]) return false;
    centres[i] = raw.points[i];
    weights[i] = kGuessWeight;
    return true;
  };
  const std::size_t n = raw.sure.size();
  std::size_t i = 0;
  while (i < n && hold(i)) ++i;
  i = n;
  while (i > 0 && hold(i - 1)) --i;
}

/// Darkness between four pixels of the picture, bilinear; x and y from the first one's middle.
class DarkInside {
 public:
  DarkInside(const Raster<std::uint16_t>& level, const std::vector<float>& darkness)
      : pixels_(level.data.data()), width_(level.width), darkness_(darkness.data()) {}

  double operator()(double x, double y) const {
    const auto x0 = static_cast<std::int32_t>(x);
    const auto y0 = static_cast<std::int32_t>(y);
    const double u = x - x0;
    const double v = y - y0;
    const std::uint16_t* above = pixels_ + y0 * width_ + x0;
    const std::uint16_t* below = above + width_;
    const auto at = [this](std::uint16_t level) -> double { return darkness_[level]; };
    return (1 - v) * ((1 - u) * at(above[0]) + u * at(above[1])) +
           v * ((1 - u) * at(below[0]) + u * at(below[1]));
  }

 private:
  const std::uint16_t* pixels_;
  std::ptrdiff_t width_;
  const float* darkness_;
};

/// Values along a profile, read as far as they are asked for: of most lines the flanks are near.
template <class Read>
class Along {
 public:
  Along(int reach, const Read& read) : read_(read) {
    if (reach > kFew) large_.resize(2 * static_cast<std::size_t>(reach) + 1);
    middle_ = reach > kFew ? large_.data() + reach : few_.data() + kFew;
  }
  Along(const Along&) = delete;
  Along& operator=(const Along&) = delete;

  double operator()(int k) {
    while (last_ < k) ++last_, middle_[last_] = read_(last_ * kStep);
    while (first_ > k) --first_, middle_[first_] = read_(first_ * kStep);
    return middle_[k];
  }

 private:
  static constexpr int kFew = 63;  ///< places either way that take no allocation
  const Read& read_;
  std::array<double, 2 * kFew + 1> few_;
  std::vector<double> large_;
  double* middle_;
  int first_ = 0;
  int last_ = -1;
};

}  // namespace

Refiner::Refiner(const Tone& tone)
    : tone_(tone), darkness_of_level_(level_table<float>([&](double level) {
        return static_cast<float>(darkness_of(level / Tone::kWhite, tone.gain));
      })) {}

double Refiner::darkness(Point2 p) const {
  const int w = tone_.level.width;
  const int h = tone_.level.height;
  const double x = std::clamp(p.x - 0.5, 0.0, w - 1.0);
  const double y = std::clamp(p.y - 0.5, 0.0, h - 1.0);
  if (x < w - 1 && y < h - 1) return DarkInside(tone_.level, darkness_of_level_)(x, y);
  const int x0 = static_cast<int>(x);
  const int y0 = static_cast<int>(y);
  const int x1 = std::min(x0 + 1, w - 1);
  const int y1 = std::min(y0 + 1, h - 1);
  const double u = x - x0;
  const double v = y - y0;
  const auto at = [&](int i, int j) -> double { return darkness_of_level_[tone_.level.at(i, j)]; };
  return (1 - v) * ((1 - u) * at(x0, y0) + u * at(x1, y0)) +
         v * ((1 - u) * at(x0, y1) + u * at(x1, y1));
}

Refiner::Profile Refiner::profile(Point2 p, Vector2 normal, double half_width) const {
  const int reach = static_cast<int>((1.6 * half_width + 2.5) / kStep);
  const double beyond = reach * kStep + 1.5;
  if (p.x > beyond && p.y > beyond && p.x + beyond < tone_.level.width &&
      p.y + beyond < tone_.level.height) {
    const auto read = [p, normal, dark = DarkInside(tone_.level, darkness_of_level_)](double s) {
      const Point2 at = p + s * normal;
      return dark(at.x - 0.5, at.y - 0.5);
    };
    return profile_along(Along(reach, read), reach, half_width);
  }
  const double width = tone_.level.width;
  const double height = tone_.level.height;
  const bool along_side = std::abs(normal.x) > kAlongRim;
  const bool along_top = std::abs(normal.y) > kAlongRim;
  const auto is_off_x = [&](double s) {
    return std::abs(2 * (p.x + s * normal.x) - width) > width;
  };
  const auto is_off_y = [&](double s) {
    return std::abs(2 * (p.y + s * normal.y) - height) > height;
  };
  const auto read = [&](double s) {
    const bool off = (along_side && is_off_x(s)) || (along_top && is_off_y(s));
    return off ? 0 : darkness(p + s * normal);
  };
  Profile found = profile_along(Along(reach, read), reach, half_width);
  for (const double side : {-1, 1}) {
    const double flank = found.centre + side * (0.5 * found.width + kFlank);
    if ((!along_side && is_off_x(flank)) || (!along_top && is_off_y(flank))) found.good = false;
  }
  return found;
}

template <class Values>
Refiner::Profile Refiner::profile_along(Values&& at, int reach, double half_width) {
  const int near = static_cast<int>(std::max(1.0, 0.6 * half_width) / kStep);
  int top = 0;
  for (int k = -near; k <= near; ++k)
    if (at(k) > at(top) + 1e-9) top = k;
  const double peak = at(top);
  if (peak < 0.02) return {};
  // flanks: where the profile falls to half, on either side, before it comes to a darker line
  const auto flank = [&](int step, double& where) {
    for (int k = top; std::abs(k + step) <= reach && 0.5 * at(k + step) <= peak; k += step)
      if (at(k + step) < 0.5 * peak) {
        const double u = (at(k) - 0.5 * peak) / (at(k) - at(k + step));
        where = (k + step * u) * kStep;
        return true;
      }
    return false;
  };
  double low = 0;
  double high = 0;
  if (!flank(-1, low) || !flank(1, high)) return {};
  Profile result{true, 0.5 * (low + high), high - low, peak};
  if (result.width < 4) {  // thin: the centre of gravity uses every grey value
    double sum = 0;
    double moment = 0;
    const auto margin = static_cast<int>(1.0 / kStep);
    for (int k = static_cast<int>(low / kStep) - margin;
         k <= static_cast<int>(high / kStep) + margin; ++k) {
      if (std::abs(k) > reach) continue;
      const double v = std::max(0.0, at(k) - 0.15 * peak);
      sum += v;
      moment += v * k * kStep;
    }
    if (sum > 0) result.centre = std::clamp(moment / sum, low, high);
  }
  return result;
}

double Refiner::extension(Point2 end, Vector2 direction, double half_width) const {
  const double inside = darkness(end - std::min(half_width, 2.0) * direction);
  const double rim = rim_ahead(end, direction);
  double reach = 0;
  const double most = 2.5 * half_width + 3;
  while (reach < std::min(most, rim) && darkness(end + reach * direction) > 0.5 * inside)
    reach += kStep;
  if (reach >= rim) return rim;
  if (reach >= most) return 0;
  return reach - half_width;
}

std::optional<double> Refiner::ink_ahead(Point2 from, Vector2 out, double near,
                                         double width) const {
  double darkest = darkness(from);
  double at = 0;
  for (double s = kStep; s <= near; s += kStep)
    if (const double here = darkness(from + s * out); here > darkest) {
      darkest = here;
      at = s;
    }
  const double most = near + width + 3;
  double last = darkest;
  while (at < most) {
    at += kStep;
    const double here = darkness(from + at * out);
    if (here < 0.5 * darkest) return at - kStep * (0.5 * darkest - here) / (last - here);
    last = here;
  }
  return {};
}

double Refiner::rim_ahead(Point2 p, Vector2 direction) const {
  const double least = std::sqrt(1 - kAlongRim * kAlongRim);
  const auto ahead = [least](double at, double way, int size) {
    if (std::abs(way) < least) return HUGE_VAL;
    return ((way > 0 ? size : 0) - at) / way;
  };
  return std::min(ahead(p.x, direction.x, tone_.level.width),
                  ahead(p.y, direction.y, tone_.level.height));
}

double Refiner::edge_offset(Point2 p, Vector2 out) const {
  constexpr double kReach = 2;  // pixels on either side of the edge
  const double ink = std::max(darkness(p - kReach * out), darkness(p - 0.5 * kReach * out));
  const double half = 0.5 * (ink + darkness(p + kReach * out));
  double last = darkness(p - kReach * out);
  for (double s = -kReach + kStep; s <= kReach; s += kStep) {
    const double here = darkness(p + s * out);
    if (last >= half && here < half) return s - kStep * (half - here) / (last - here);
    last = here;
  }
  return 0;
}

/// Lengthens or shortens the end of the stroke to where the pen's centre stopped.
void Refiner::trim_end(std::vector<Point2>& points, std::vector<double>& widths,
                       double half_width) const {
  const std::size_t n = points.size();
  const auto back = static_cast<std::size_t>(std::clamp(2 * half_width, 4.0, 12.0));
  if (n < back + 2) return;
  const Vector2 d = points[n - 1] - points[n - 1 - back];
  if (norm(d) < 1e-9) return;
  const Vector2 direction = d / norm(d);
  double extra = extension(points.back(), direction, half_width);
  if (extra > 0) {
    points.push_back(points.back() + extra * direction);
    widths.push_back(widths.back());
    return;
  }
  while (extra < -1e-9 && points.size() > n / 2 + 2) {
    const double last = distance(points[points.size() - 2], points.back());
    if (last > -extra) {
      points.back() = core::mix(points.back(), points[points.size() - 2], -extra / last);
      return;
    }
    extra += last;
    points.pop_back();
    widths.pop_back();
  }
}

std::size_t Refiner::read_centres(const RawStroke& raw, const std::vector<double>& usual,
                                  const std::vector<Point2>& line, Centres& read) const {
  const std::size_t n = raw.points.size();
  std::vector<std::size_t> good;
  std::vector<double> peaks;
  for (std::size_t i = 0; i < n; ++i) {
    read.weights[i] = 0;
    read.widths[i] = 2 * std::max<double>(usual[i], raw.radii[i]);
    const double to_end = std::min(raw.free_start ? static_cast<double>(i) : 1e9,
                                   raw.free_end ? static_cast<double>(n - 1 - i) : 1e9);
    if (!raw.sure[i] || to_end < 0.7 * usual[i]) continue;
    const auto reach = static_cast<long>(2 + usual[i]);
    const Vector2 normal = core::perpendicular_left(tangent_at(line, i, reach, raw.closed));
    const Profile found = profile(line[i], normal, usual[i]);
    const double most =
        raw.sure[i] == 2 ? kAloneWidth * usual[i] + kAloneRounding : 3 * usual[i] + 1.5;
    if (!found.good || std::abs(found.centre) > 0.6 * usual[i] + 1 || found.width > most ||
        found.width < 0.8 * usual[i])
      continue;
    read.places[i] = line[i] + found.centre * normal;
    // of a grainy line, the ink's
    read.widths[i] = std::max({found.width, 2 * usual[i], 2.0 * raw.radii[i] - 1});
    good.push_back(i);
    peaks.push_back(found.peak);
  }
  const std::vector<double> dark = usual_of(peaks);
  for (std::size_t k = 0; k < good.size(); ++k)
    read.weights[good[k]] = 0.5 * peaks[k] > dark[k] ? 0 : 1;  // a darker line's
  return good.size();
}

FineStroke Refiner::refine(const RawStroke& raw) const {
  const std::size_t n = raw.points.size();
  const std::vector<double> usual = usual_of(raw.radii);
  const double half = core::quantile(usual);
  const double wave = 5 + 1.2 * half;
  Centres read{raw.points, usual, std::vector<double>(n, 1)};
  auto& [centres, widths, weights] = read;
  std::vector<Point2> line =
      smooth_points(raw.points, weights, lambda_of_wavelength(8 + 3 * half), raw.closed);
  for (int round = 0; round < 2; ++round) {
    const std::size_t good = read_centres(raw, usual, line, read);
    if (good < 2 || 4 * good < n)
      for (std::size_t i = 0; i < n; ++i)
        if (weights[i] == 0) weights[i] = raw.sure[i] ? 0.1 : 0.01, centres[i] = raw.points[i];
    hold_guessed_ends(raw, centres, weights);
    line = smooth_points(centres, weights, lambda_of_wavelength(wave), raw.closed);
  }
  FineStroke fine;
  fine.wave = wave;
  fine.closed = raw.closed;
  fine.free_start = raw.free_start;
  fine.free_end = raw.free_end;
  fine.width = core::quantile(widths);
  if (raw.free_end) trim_end(line, widths, 0.5 * fine.width);
  if (raw.free_start) {
    std::reverse(line.begin(), line.end());
    std::reverse(widths.begin(), widths.end());
    trim_end(line, widths, 0.5 * fine.width);
    std::reverse(line.begin(), line.end());
    std::reverse(widths.begin(), widths.end());
  }
  resample(line, widths, 1.0, raw.closed, fine.points, fine.widths);
  return fine;
}

}  // namespace keyline::sketch
