#include "keyline/lac/space/compound_family.h"

#include <algorithm>
#include <utility>

#include "keyline/core/angle.h"
#include "keyline/lac/segment/piece_shape.h"
#include "keyline/lac/space/two_slopes.h"

namespace keyline::lac::detail::space {
namespace {

constexpr double kSteps = 16;      // of the rate, from one power of ten to the next
constexpr double kLeast = 1e-4;    // of rates but 0
constexpr double kGreatest = 1e8;  // an inflection lies so close to the joint
constexpr double kFall = 700;      // of the logarithm of what is left up to a bound

TwoSlopes law_of(const PlaneRhythm& r) { return {{r.alpha0, r.alpha1}, r.length_share}; }

}  // namespace

double Family::least_turning() const {
  const auto to_chord = [](double x) { return std::min(std::abs(x), core::kPi - std::abs(x)); };
  return std::max(std::abs(turning_), to_chord(from_) + to_chord(from_ + turning_));
}

std::optional<Chain> Family::chain(const Member& m) const {
  const TwoSlopes law = law_of(r_);
  const auto ends = law.ends(m.rate);
  if (!ends) return std::nullopt;
  Chain c{{},
          {{r_.alpha0, law.length(0), m.size * (*ends)[0], m.size},
           {r_.alpha1, law.length(1), m.size, m.size * (*ends)[1]}}};
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
  const TwoSlopes law = law_of(r_);
  for (const int grows : {0, 1}) {
    const double greatest =
        law.slope[grows] > 0 ? std::min(kGreatest, kFall * law.bound(grows)) : kGreatest;
    for (int i = 0;; ++i) {
      const double rate = kLeast * std::pow(10.0, i / kSteps);
      if (rate > greatest) break;
      all.push_back(grows == 0 ? -rate : rate);
    }
  }
  std::ranges::sort(all);
  return all;
}

}  // namespace keyline::lac::detail::space
