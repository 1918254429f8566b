#include "keyline/lac/quasi/quasi_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "keyline/core/angle.h"
#include "keyline/numeric/binomials.h"

namespace keyline::lac::detail {

using core::Vector2;

namespace {

constexpr int kDepth = 9;  // of quarters: squares a 512th wide
/// Looked at in a chart. Along a line of it curves are straight and nothing is told apart, which
/// takes some 4,000. More than twice as many only where rounding hides all, as where coefficients
/// of a high degree grow by 1e40: there squares are left larger, so that these are enough.
constexpr int kMostSquares = 8192;
constexpr int kMostLargerSquares = 512;

/// Bernstein coefficients of a polynomial over the unit square, of one degree in either variable.
class Net {
 public:
  explicit Net(int degree) : size_(degree + 1), at_(size_ * size_) {}
  int degree() const { return size_ - 1; }
  Vector2& operator()(int i, int j) { return at_[i * size_ + j]; }
  const std::vector<Vector2>& all() const { return at_; }

  /// From coefficients of powers.
  void to_bernstein() {
    for (int i = 0; i < size_; ++i) {
      to_bernstein(i * size_, 1);
      if (i + 1 == size_)
        for (int j = 0; j < size_; ++j) to_bernstein(j, size_);
    }
  }

  std::array<Net, 4> quarters() const {
    auto [low, high] = halves(1);
    auto [a, b] = low.halves(size_);
    auto [c, d] = high.halves(size_);
    return {{std::move(a), std::move(b), std::move(c), std::move(d)}};
  }

 private:
  void to_bernstein(int from, int step) {
    const auto& binomial = numeric::kBinomials<kMaxTaylorDegree>;
    for (int i = 0; i < size_; ++i)
      at_[from + i * step] = at_[from + i * step] / binomial[degree()][i];
    for (int k = 1; k < size_; ++k)
      for (int i = size_ - 1; i >= k; --i)
        at_[from + i * step] = at_[from + i * step] + at_[from + (i - 1) * step];
  }

  std::pair<Net, Net> halves(int step) const {
    std::pair<Net, Net> parts{*this, *this};
    auto& low = parts.first.at_;
    auto& high = parts.second.at_;
    const int across = step == 1 ? size_ : 1;
    for (int row = 0; row < size_; ++row)
      for (int k = 0; k < size_; ++k) {
        low[row * across + k * step] = high[row * across];
        for (int i = 0; i + 1 < size_ - k; ++i)
          high[row * across + i * step] =
              0.5 * (high[row * across + i * step] + high[row * across + (i + 1) * step]);
      }
    return parts;
  }

  int size_;
  std::vector<Vector2> at_;
};

/// Directions between two, less than half a turn apart.
struct Directions {
  double low = -HUGE_VAL, high = HUGE_VAL;
};

/// All that the polynomial can have, or any.
Directions directions(const Net& net) {
  Vector2 middle;
  for (const Vector2 v : net.all()) middle = middle + v;
  Vector2 low = middle, high = middle;
  for (const Vector2 v : net.all()) {
    if (!(dot(middle, v) > 0)) return {};
    if (cross(low, v) < 0) low = v;
    if (cross(high, v) > 0) high = v;
  }
  const double direction = core::direction_of(middle);
  return {direction + core::angle_between(middle, low),
          direction + core::angle_between(middle, high)};
}

/// Whether one of `to` may lie by the angle, or by whole turns more, beyond one of `from`, but for
/// rounding.
bool may_differ(const Directions& from, const Directions& to, double angle, double rounding) {
  const double low = to.low - from.high - angle, high = to.high - from.low - angle;
  return !std::isfinite(high - low) ||
         std::abs(core::wrap_angle(0.5 * (low + high))) <= 0.5 * (high - low) + rounding;
}

/// One of the squares that cover the half plane: of value, rate of the given sign and scale one is
/// 1 and the two that follow it in turn run from 0 to 1.
struct Chart {
  int fixed = 0;
  double sign = 1;
  std::array<double, 3> homogeneous(double x, double y) const {
    std::array<double, 3> h;
    h[fixed] = 1;
    h[(fixed + 1) % 3] = x;
    h[(fixed + 2) % 3] = y;
    h[1] *= sign;
    return h;
  }
};

/// Terms of velocity, coefficient k of which is the sum over j of terms[k][j] (i value / unit)^j
/// rate^{k-j}.
using Terms = std::array<std::array<double, kMaxTaylorDegree>, kMaxTaylorDegree>;

struct Square {
  double x = 0, y = 0, width = 1;
  Net first, last, chord;

  std::array<Square, 4> quarters() const {
    auto f = first.quarters(), l = last.quarters(), c = chord.quarters();
    const auto quarter = [&](int i) {
      return Square{x + 0.5 * width * (i % 2), y + 0.5 * width * (i / 2), 0.5 * width,
                    std::move(f[i]),           std::move(l[i]),           std::move(c[i])};
    };
    return {{quarter(0), quarter(1), quarter(2), quarter(3)}};
  }
};

class Search {
 public:
  Search(const SeriesWanted& wanted, double unit) : wanted_(wanted), unit_(unit) {
    const double decay =
        wanted.variable == SeriesVariable::arc_length ? wanted.alpha : 1 - wanted.alpha;
    std::array<double, kMaxTaylorDegree> law{1};
    for (int k = 0; k + 1 < wanted.degree; ++k) law[k + 1] = law[k] * (1 + k * decay) / (k + 1);
    if (wanted.variable == SeriesVariable::arc_length)
      arc_terms(law);
    else
      angle_terms(law);
    double power = 1;
    for (int j = 0; j < wanted.degree; ++j, power *= unit_)
      for (int k = j; k < wanted.degree; ++k) terms_[k][j] *= power;
  }

  SeriesPlaces places() {
    for (const int fixed : {0, 1, 2})
      for (const double sign : {-1.0, 1.0}) {
        chart_ = {fixed, sign};
        search_chart();
      }
    return std::move(found_);
  }

 private:
  void arc_terms(const std::array<double, kMaxTaylorDegree>& law) {
    terms_[0][0] = 1;
    for (int k = 0; k + 1 < wanted_.degree; ++k)
      for (int m = 0; m <= k; ++m)
        for (int j = 0; j <= k - m; ++j)
          terms_[k + 1][j + 1] += law[m] * terms_[k - m][j] / (k + 1);
  }

  void angle_terms(const std::array<double, kMaxTaylorDegree>& law) {
    double factor = 1;
    for (int j = 0; j < wanted_.degree; factor /= ++j)
      for (int k = j; k < wanted_.degree; ++k) terms_[k][j] = factor * law[k - j];
  }

  /// The sum of weight[k] times coefficient k of the velocity over the whole chart.
  Net combined(const std::array<double, kMaxTaylorDegree>& weight) const {
    constexpr std::array<Vector2, 4> kPowers{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};  // of i
    const int d = wanted_.degree - 1;
    Net net(d);
    for (int k = 0; k <= d; ++k)
      for (int j = 0; j <= k; ++j) {
        const std::array<int, 3> power{j, k - j, d - k};
        const double factor = weight[k] * terms_[k][j] * ((k - j) % 2 ? chart_.sign : 1);
        net(power[(chart_.fixed + 1) % 3], power[(chart_.fixed + 2) % 3]) = factor * kPowers[j % 4];
      }
    net.to_bernstein();
    return net;
  }

  Square whole() const {
    std::array<double, kMaxTaylorDegree> first{}, last{}, chord{};
    double before = 1, after = 1;
    for (int k = 0; k < wanted_.degree; ++k) {
      first[k] = before;
      last[k] = after;
      before *= -wanted_.about;
      after *= 1 - wanted_.about;
      chord[k] = (after - before) / (k + 1);
    }
    return {0, 0, 1, combined(first), combined(last), combined(chord)};
  }

  bool may_hold(const Square& s) const {
    const double rounding = 1e-9 * unit_;
    const Directions first = directions(s.first), last = directions(s.last);
    if (!may_differ(first, last, wanted_.turning, rounding)) return false;
    const Directions chord = directions(s.chord);
    return may_differ(first, chord, wanted_.chord_angle, rounding) &&
           may_differ(chord, last, wanted_.turning - wanted_.chord_angle, rounding);
  }

  void search_chart() {
    const std::size_t before = found_.places.size();
    left_ = kMostSquares;
    for (int depth = kDepth; !quarter(whole(), depth); --depth) {
      found_.places.resize(before);
      found_.complete = false;
      left_ = kMostLargerSquares;
    }
  }

  /// False where the squares become too many.
  bool quarter(const Square& s, int depth) {
    if (left_-- == 0) return false;
    if (!may_hold(s)) return true;
    if (depth > 0) {
      for (const Square& q : s.quarters())
        if (!quarter(q, depth - 1)) return false;
      return true;
    }
    const auto [value, rate, scale] = chart_.homogeneous(s.x + 0.5 * s.width, s.y + 0.5 * s.width);
    found_.places.push_back({unit_ * value / scale, rate / scale});
    return true;
  }

  SeriesWanted wanted_;
  double unit_ = 1;  ///< of value
  Terms terms_{};
  Chart chart_;
  SeriesPlaces found_;
  int left_ = 0;
};

}  // namespace

SeriesPlaces series_places(const SeriesWanted& wanted) {
  SeriesPlaces found = Search(wanted, 1).places();
  if (!(wanted.turning < 1)) return found;
  // What turns little is near a line of those charts; there its own turning is the unit.
  const SeriesPlaces little = Search(wanted, wanted.turning).places();
  found.places.insert(found.places.end(), little.places.begin(), little.places.end());
  found.complete = found.complete && little.complete;
  return found;
}

}  // namespace keyline::lac::detail
