#include "keyline/fairing/half_line.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "keyline/core/polygon.h"
#include "keyline/core/text.h"
#include "keyline/fairing/mirror.h"
#include "keyline/lac/chain/extend.h"

namespace keyline::fairing::detail {
namespace {

using core::Point2;

constexpr double kSameCrossing = 0.02;  // of the length: sign changes of noise beside the line
constexpr double kPair = 0.3;           // of the spacing along the curve: side by side
constexpr double kOne = 1e-6;           // of it: no curve goes from one to the other
constexpr double kPartner = 2;          // spacings: a corner's image stands so near another corner
constexpr double kLeastSide = 0.1;      // of the length: less is no side
constexpr long kNear = 6;               // points about where a foot is expected

/// Arc length of the polygon at each point.
std::vector<double> lengths_at(const acquire::KeyLine& line) {
  std::vector<double> at{0};
  for (std::size_t i = 1; i < line.points.size(); ++i)
    at.push_back(at.back() + core::distance(line.points[i - 1], line.points[i]));
  return at;
}

/// Arc lengths at which the polygon goes over to the line's other side for good.
std::vector<double> crossings(const acquire::KeyLine& line, const std::vector<double>& at,
                              const core::Pose2& axis, double whole) {
  const std::size_t n = line.points.size();
  std::vector<double> changes;
  for (std::size_t i = 0; i < (line.closed ? n : n - 1); ++i) {
    const double a = beside(axis, line.points[i]);
    const double b = beside(axis, line.points[(i + 1) % n]);
    if ((a < 0) == (b < 0)) continue;
    const double step = core::distance(line.points[i], line.points[(i + 1) % n]);
    changes.push_back(at[i] + step * std::abs(a) / (std::abs(a) + std::abs(b)));
  }
  std::vector<double> found;
  for (std::size_t i = 0; i < changes.size();) {
    std::size_t next = i + 1;
    while (next < changes.size() && changes[next] - changes[next - 1] < kSameCrossing * whole)
      ++next;
    const double middle = changes[i + (next - i) / 2];
    const bool at_end = !line.closed && std::min(middle, whole - middle) < kSameCrossing * whole;
    if ((next - i) % 2 == 1 && !at_end) found.push_back(middle);
    i = next;
  }
  return found;
}

/// A point on the half and where along it.
struct Member {
  double at = 0;
  Point2 point;
  std::size_t index = 0;  ///< in the key-line
  bool image = false;
};

/// Where along the own side's polygon the point stands, near where it is expected.
double foot_on(const std::vector<Member>& own, Point2 p, double expected) {
  const auto next = std::ranges::lower_bound(own, expected, {}, &Member::at);
  const long middle = next - own.begin();
  const long last = static_cast<long>(own.size()) - 1;
  double best = expected;
  double least = HUGE_VAL;
  for (long i = std::max(0L, middle - kNear); i < std::min(last, middle + kNear); ++i) {
    const core::Vector2 along = own[i + 1].point - own[i].point;
    const double size = core::norm(along);
    if (size == 0) continue;
    double u = core::dot(p - own[i].point, along) / (size * size);
    if (i > 0) u = std::max(0.0, u);
    if (i + 1 < last) u = std::min(1.0, u);
    const double away = core::distance(p, own[i].point + u * along);
    if (away >= least) continue;
    least = away;
    best = own[i].at + u * (own[i + 1].at - own[i].at);
  }
  return best;
}

class Folding {
 public:
  Folding(const acquire::KeyLine& line, const core::Pose2& axis) : line_(line), axis_(axis) {}

  core::Result<HalfLine> run() {
    at_ = lengths_at(line_);
    whole_ = core::polygon_length(line_.points, line_.closed);
    const std::vector<double> cross = crossings(line_, at_, axis_, whole_);
    const std::size_t wanted = line_.closed ? 2 : 1;
    if (cross.size() != wanted)
      return undrawable(fmt::format("it crosses that line {}, not {}",
                                    core::counted(cross.size(), "time"), wanted));
    first_ = line_.closed ? cross[0] : 0;
    last_ = cross.back();
    spacing_ = 2 * (last_ - first_) / static_cast<double>(line_.points.size());
    take_members();
    const bool one_sided =
        !(std::min(last_ - first_, whole_ - last_ + first_) > kLeastSide * whole_);
    if (one_sided || own_ < 3) return undrawable("one side of that line has hardly any points");
    merge();
    if (auto corners = take_corners(); !corners) return std::unexpected(corners.error());
    half_.line.noise = line_.noise * std::sqrt(static_cast<double>(half_.line.points.size()) /
                                               static_cast<double>(half_.measured.size()));
    half_.line.rounding = line_.rounding;
    return std::move(half_);
  }

 private:
  bool is_own(double at) const { return at >= first_ && at <= last_; }

  void take_members() {
    for (std::size_t i = 0; i < line_.points.size(); ++i)
      if (is_own(at_[i])) members_.push_back({at_[i], line_.points[i], i, false});
    own_ = members_.size();
    const std::vector<Member> own = members_;
    if (own_ < 3) return;
    for (std::size_t i = 0; i < line_.points.size(); ++i) {
      if (is_own(at_[i])) continue;
      const double beyond = at_[i] < first_ ? at_[i] + whole_ - last_ : at_[i] - last_;
      const double share = beyond / (whole_ - (last_ - first_));
      const Point2 image = mirrored(axis_, line_.points[i]);
      members_.push_back({foot_on(own, image, last_ - share * (last_ - first_)), image, i, true});
    }
    std::ranges::stable_sort(members_, {}, &Member::at);
  }

  void merge() {
    acquire::KeyLine& half = half_.line;
    const bool weighted = !line_.weights.empty();
    for (std::size_t k = 0; k < members_.size();) {
      const double apart = k == 0 ? pair_at_start() : kPair;  // in spacings
      const bool pair = k + 1 < members_.size() && members_[k].image != members_[k + 1].image &&
                        members_[k + 1].at - members_[k].at < apart * spacing_;
      const std::size_t count = pair ? 2 : 1;
      core::Vector2 sum;
      double weight = 0;
      for (std::size_t i = k; i < k + count; ++i) {
        const double w = weighted ? line_.weights[members_[i].index] : 1;
        sum = sum + w * (members_[i].point - members_[k].point);
        weight += w;
        half_.measured.push_back(members_[i].point);
        half_.belongs.push_back(half.points.size());
      }
      half.points.push_back(members_[k].point + (1 / weight) * sum);
      half.weights.push_back(weight);
      k += count;
    }
  }

  /// A free end stays two points, unless they are one.
  double pair_at_start() const {
    if (line_.closed || line_.ends_meet) return kPair;
    return core::distance(members_[0].point, members_[1].point) < kOne * spacing_ ? kPair : 0;
  }

  static std::unexpected<core::Failure> undrawable(const std::string& why) {
    return core::fail(core::ErrorCode::undrawable, why, "give another line of symmetry");
  }

  /// Corners of both sides, which have to be the same.
  core::Result<void> take_corners() {
    std::vector<std::size_t> own;
    std::vector<std::size_t> other;
    if (!line_.closed && line_.ends_meet) half_.start = HalfEnd::corner;
    if (line_.closed) half_.start = HalfEnd::square;
    for (const std::size_t corner : line_.corners) {
      const double at = at_[corner];
      const double from_first = std::min(std::abs(at - first_), whole_ - std::abs(at - first_));
      if (line_.closed && from_first < kPartner * spacing_) {
        half_.start = HalfEnd::corner;
      } else if (std::abs(at - last_) < kPartner * spacing_) {
        half_.end = HalfEnd::corner;
      } else {
        (is_own(at) ? own : other).push_back(corner);
      }
    }
    if (auto found = partners(own, other); !found) return found;
    if (auto found = partners(other, own); !found) return found;
    for (const std::size_t corner : own) half_.line.corners.push_back(holder_of(corner));
    return {};
  }

  /// Whether every one of the corners has one of the others opposite.
  core::Result<void> partners(const std::vector<std::size_t>& corners,
                              const std::vector<std::size_t>& others) const {
    for (const std::size_t corner : corners) {
      const Point2 at = line_.points[corner];
      const Point2 image = mirrored(axis_, at);
      const auto near = [&](std::size_t c) {
        return core::distance(line_.points[c], image) < kPartner * spacing_;
      };
      if (std::ranges::none_of(others, near))
        return undrawable(
            fmt::format("the corner at ({:.6g}, {:.6g}) has none opposite", at.x, at.y));
    }
    return {};
  }

  std::size_t holder_of(std::size_t index) const {
    for (std::size_t k = 0; k < members_.size(); ++k)
      if (members_[k].index == index) return half_.belongs[k];
    return 0;
  }

  const acquire::KeyLine& line_;
  const core::Pose2& axis_;
  std::vector<double> at_;
  double whole_ = 0;
  double first_ = 0;  ///< arc lengths between which the own side lies
  double last_ = 0;
  double spacing_ = 0;
  std::vector<Member> members_;
  std::size_t own_ = 0;
  HalfLine half_;
};

bool flat(const lac::Piece& piece) { return piece.curvature_start == piece.curvature_end; }

/// The second chain goes on where the first ends; an arc or a line that does so stays one.
void join(lac::Chain& first, const lac::Chain& second) {
  auto from = second.pieces.begin();
  lac::Piece& last = first.pieces.back();
  if (flat(last) && flat(*from) && last.curvature_end == from->curvature_start) {
    last.length += from->length;
    ++from;
  }
  first.pieces.insert(first.pieces.end(), from, second.pieces.end());
}

}  // namespace

core::Result<HalfLine> fold(const acquire::KeyLine& line, const core::Pose2& axis) {
  return Folding(line, axis).run();
}

std::vector<lac::Chain> unfold(const std::vector<lac::Chain>& half, const HalfLine& folded,
                               const core::Pose2& axis, bool closed) {
  std::vector<lac::Chain> all = half;
  for (std::size_t k = half.size(); k-- > 0;) {
    const lac::Chain image = lac::mirrored(lac::reverse(half[k]), axis);
    if (k + 1 == half.size() && folded.end == HalfEnd::square)
      join(all.back(), image);
    else
      all.push_back(image);
  }
  if (!closed || folded.start != HalfEnd::square) return all;
  if (all.size() == 1) {
    all.front().closed = true;
    return all;
  }
  lac::Chain last = std::move(all.back());
  all.pop_back();
  join(last, all.front());
  all.front() = std::move(last);
  return all;
}

}  // namespace keyline::fairing::detail
