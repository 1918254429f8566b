#include "keyline/lac/space/space_stretch.h"

namespace keyline::lac::detail {
namespace {

constexpr double kMostApart = 4, kMostGrowth = 8;
constexpr int kMostCuts = 12;

/// Whether a small whole power of the distance: smooth as it is.
bool is_plain(double slope) { return slope < -0.19 && smoothing_power(slope) == 1; }

LawZero zero_of(const LawRun& law) {
  return law.slope < 0 ? LawZero{law.place, law.slope} : LawZero{};
}

}  // namespace

void add_cuts(const LawRun& law, std::vector<double>& cuts) {
  if (std::abs(law.slope) < 1e-6 || !std::isfinite(law.place)) {
    const int parts =
        std::min<int>(kMostCuts, std::ceil(std::abs(law.growth) / std::log(kMostGrowth)));
    for (int i = 1; i < parts; ++i) cuts.push_back(i / double(parts));
    return;
  }
  if (is_plain(law.slope)) return;
  const bool inside = law.place >= 0 && law.place <= 1;
  const int most = inside && smoothing_power(law.slope) != 1 ? 1 : kMostCuts;
  const double apart = std::min(kMostApart, std::pow(kMostGrowth, std::abs(law.slope)));
  for (const double end : {0.0, 1.0}) {
    const double from = std::clamp(law.place, 0.0, 1.0);
    double place = law.place + (end - law.place) / apart;
    for (int i = 0; i < most && std::abs(place - end) < std::abs(from - end); ++i) {
      cuts.push_back(place);
      place = law.place + (place - law.place) / apart;
    }
  }
}

std::vector<Stretch> graded_stretches(const LawRun& a, const LawRun& b) {
  std::vector<double> cuts;
  add_cuts(a, cuts);
  add_cuts(b, cuts);
  std::sort(cuts.begin(), cuts.end());
  std::vector<Stretch> all;
  const Stretches whole = stretches_between(zero_of(a), zero_of(b));
  for (const Stretch& s : whole) {
    double from = s.from;
    const auto add = [&](double to) {
      const bool touches = s.power != 1 && (s.zero_at_start ? from == s.from : to == s.to);
      all.push_back({from, to, touches ? s.power : 1, touches && s.zero_at_start});
      from = to;
    };
    for (const double cut : cuts)
      if (cut > from + 1e-9 && cut < s.to - 1e-9) add(cut);
    add(s.to);
  }
  return all;
}

}  // namespace keyline::lac::detail
