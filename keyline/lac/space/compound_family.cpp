#include "keyline/lac/space/compound_family.h"

#include <algorithm>
#include <utility>

#include "keyline/core/angle.h"
#include "keyline/lac/chain/extend.h"
#include "keyline/lac/segment/piece_shape.h"

namespace keyline::lac::detail::space {
namespace {

constexpr double kSteps = 16;      // of the rate, from one power of ten to the next
constexpr double kLeast = 1e-4;    // of rates but 0
constexpr double kGreatest = 1e8;  // an inflection lies so close to the joint
constexpr double kFall = 700;      // of the logarithm of what is left up to a bound

struct Side {
  double alpha = 0, length = 0;
  double bound() const { return 1 / (alpha * length); }
};

/// Curvatures over that at the joint where it has grown to and where it has fallen to.
struct Ends {
  double high = 1, low = 1;
};

std::optional<Ends> ends_of(const Side& grows, const Side& falls, double rate) {
  Ends ends;
  double true_rate = rate;
  if (grows.alpha > 0) {
    true_rate = -grows.bound() * std::expm1(-rate / grows.bound());
    ends.high = std::exp(rate * grows.length);
  } else {
    const auto high = curvature_continued(grows.alpha, 1, rate, grows.length);
    if (!high) return std::nullopt;
    ends.high = *high;
  }
  const auto low = curvature_continued(falls.alpha, 1, -true_rate, falls.length);
  if (!low) return std::nullopt;
  ends.low = *low;
  return ends;
}

}  // namespace

double Family::least_turning() const {
  const auto to_chord = [](double x) { return std::min(std::abs(x), core::kPi - std::abs(x)); };
  return std::max(std::abs(turning_), to_chord(from_) + to_chord(from_ + turning_));
}

std::optional<Chain> Family::chain(const Member& m) const {
  const Side first{r_.alpha0, r_.length_share}, second{r_.alpha1, 1 - r_.length_share};
  const bool rises = m.rate >= 0;
  const auto ends = ends_of(rises ? second : first, rises ? first : second, std::abs(m.rate));
  if (!ends) return std::nullopt;
  const double k0 = rises ? ends->low : ends->high, k1 = rises ? ends->high : ends->low;
  Chain c{{},
          {{first.alpha, first.length, m.size * k0, m.size},
           {second.alpha, second.length, m.size, m.size * k1}}};
  return validate(c) ? std::optional(std::move(c)) : std::nullopt;
}

std::optional<Bends> Family::bends(double rate) const {
  const auto c = chain({rate, 1});
  if (!c) return std::nullopt;
  const Piece &a = c->pieces[0], &b = c->pieces[1];
  const Bends all{total_turning(*c), absolute_turning(a) + absolute_turning(b),
                  a.curvature_start < 0 || b.curvature_end < 0};
  return std::isfinite(all.both) ? std::optional(all) : std::nullopt;
}

std::optional<Off> Family::off(const Member& m) const {
  const auto c = chain(m);
  if (!c) return std::nullopt;
  const core::Pose2 end = end_pose(*c);
  const core::Vector2 chord = end.position - core::Point2{};
  if (!(norm(chord) > 1e-6)) return std::nullopt;
  const double start = core::wrap_angle(-core::direction_of(chord) - from_);
  return Off{start, start + end.direction - turning_};
}

std::vector<double> Family::rates() const {
  std::vector<double> all{0};
  for (const auto& [way, grows] : {std::pair{-1.0, Side{r_.alpha0, r_.length_share}},
                                   {1.0, Side{r_.alpha1, 1 - r_.length_share}}}) {
    const double greatest =
        grows.alpha > 0 ? std::min(kGreatest, kFall * grows.bound()) : kGreatest;
    for (int i = 0;; ++i) {
      const double rate = kLeast * std::pow(10.0, i / kSteps);
      if (rate > greatest) break;
      all.push_back(way * rate);
    }
  }
  std::ranges::sort(all);
  return all;
}

}  // namespace keyline::lac::detail::space
