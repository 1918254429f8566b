#include "keyline/lac/g2/spline_newton.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/lac/g2/banded.h"

namespace keyline::lac::detail {
namespace {

using core::Vector2;

constexpr int kSteps = 40;
constexpr double kAccepted = 2e-13;

/// What a span contributes: angle from its start tangent to the chord and from the chord to its end
/// tangent, the logarithm of its chord over the one wanted; each with derivatives by the variables
/// of the slots at its ends and by ln(length).
struct SpanValue {
  std::array<double, 3> value{};
  std::array<std::array<double, 3>, 3> by{};  ///< by[value][slot before, slot after, length]
};

/// Fills in the span from the end of a unit curve and its derivatives by the three unknowns.
SpanValue span_value(Vector2 chord, double turning, const std::array<Vector2, 3>& chord_by,
                     const std::array<double, 3>& turning_by, double ratio) {
  SpanValue s;
  const double square = dot(chord, chord);
  const double lead = core::direction_of(chord);
  s.value = {lead, turning - lead, 0.5 * std::log(square) + std::log(ratio)};
  for (int i = 0; i < 3; ++i) {
    const double lead_by = cross(chord, chord_by[i]) / square;
    s.by[0][i] = lead_by;
    s.by[1][i] = turning_by[i] - lead_by;
    s.by[2][i] = dot(chord, chord_by[i]) / square;
  }
  return s;
}

/// Factor from the variable of kappa to that of kappa * length.
double scale_of(const CurvatureVariable& v, double length) {
  if (v.step == CurvatureStep::linear) return length;
  return v.step == CurvatureStep::power ? std::pow(length, v.power) : 1.0;
}

class Spline {
 public:
  Spline(const SplineProblem& problem, SplineState& state) : problem_(problem), state_(state) {
    refresh();
  }

  double size() const { return size_; }
  bool step();

 private:
  std::size_t after(std::size_t span) const {
    return problem_.closed && span + 1 == problem_.spans() ? 0 : span + 1;
  }
  bool start_split(std::size_t span) const {
    return !problem_.closed && span == 0 && problem_.start.both();
  }
  bool end_split(std::size_t span) const {
    return !problem_.closed && span + 1 == problem_.spans() && problem_.end.both();
  }
  void refresh();
  void choose_variables();
  CurvatureVariable variable_of(std::size_t slot) const;
  SpanValue value_of(std::size_t span) const;
  SpanValue value_of_split(std::size_t span) const;
  void fill_misses();
  double end_miss(bool at_start) const;
  void assemble();
  void assemble_point(std::size_t slot);
  void assemble_end(std::size_t slot);
  void put_angle(std::size_t slot, std::size_t unknown, double value);
  bool find_direction();
  double allowed_share() const;
  void move(const SplineState& from, double share);

  const SplineProblem& problem_;
  SplineState& state_;
  std::vector<CurvatureVariable> variables_;
  std::vector<SpanValue> spans_;
  std::vector<double> angle_miss_;  // per slot
  double size_ = 0;
  PentadiagonalSystem system_;
  // Row of the first slot: its own unknown, the two after it, and (closed) the two before it.
  double corner_ = 0;
  std::array<double, 2> corner_next_{};
  std::array<double, 2> corner_last_{};
  std::vector<double> slot_step_;
  std::vector<double> length_step_;
};

CurvatureVariable Spline::variable_of(std::size_t slot) const {
  const std::size_t n = problem_.spans();
  const bool first = !problem_.closed && slot == 0;
  const bool last = !problem_.closed && slot == n;
  const std::size_t right = last ? n - 1 : slot;
  const std::size_t left = first ? 0 : (slot + n - 1) % n;
  const double a = problem_.alpha[left];
  const double b = problem_.alpha[right];
  if (a >= 0 || b >= 0) return {CurvatureStep::logarithm, 1};
  if (a != b || a == -1) return {};
  const double own = std::abs(state_.curvature[slot]);
  const double beside =
      std::max(std::abs(state_.curvature[left]), std::abs(state_.curvature[after(right)]));
  return own < 0.3 * beside ? CurvatureVariable{CurvatureStep::power, -a} : CurvatureVariable{};
}

void Spline::choose_variables() {
  variables_.resize(problem_.slots());
  for (std::size_t i = 0; i < variables_.size(); ++i) variables_[i] = variable_of(i);
}

SpanValue Spline::value_of(std::size_t i) const {
  if (start_split(i) || end_split(i)) return value_of_split(i);
  const std::size_t j = after(i);
  const double length = state_.length[i];
  const PieceShape shape = piece_shape(problem_.alpha[i], state_.curvature[i] * length,
                                       state_.curvature[j] * length, variables_[i], variables_[j]);
  const double s0 = scale_of(variables_[i], length);
  const double s1 = scale_of(variables_[j], length);
  return span_value(shape.chord, shape.turning,
                    {s0 * shape.chord_by[0], s1 * shape.chord_by[1], shape.chord_by_length},
                    {s0 * shape.turning_by[0], s1 * shape.turning_by[1], shape.turning},
                    length / problem_.chord[i]);
}

/// A span with a joint in the middle: the slot at that end holds the joint's curvature, the end's
/// is given. Both halves are walked in the frame of the span's start.
SpanValue Spline::value_of_split(std::size_t i) const {
  const bool at_start = start_split(i);
  const double given = problem_.fold * *(at_start ? problem_.start : problem_.end).curvature;
  const double half = 0.5 * state_.length[i];
  const double k0 = state_.curvature[i];
  const double k1 = state_.curvature[i + 1];
  const CurvatureVariable& v0 = variables_[i];
  const CurvatureVariable& v1 = variables_[i + 1];
  const double alpha = problem_.alpha[i];
  const PieceShape a = at_start ? piece_shape(alpha, given * half, k0 * half, kFixed, v0)
                                : piece_shape(alpha, k0 * half, k1 * half, v0, v1);
  const PieceShape b = at_start ? piece_shape(alpha, k0 * half, k1 * half, v0, v1)
                                : piece_shape(alpha, k1 * half, given * half, v1, kFixed);
  const Vector2 second = core::rotate_ccw(b.chord, a.turning);
  const auto later = [&](Vector2 by, double turned) {
    return core::rotate_ccw(by, a.turning) + turned * core::perpendicular_left(second);
  };
  const int a_of_0 = at_start ? 1 : 0;
  const double s0 = 0.5 * scale_of(v0, half);
  const double s1 = 0.5 * scale_of(v1, half);
  Vector2 by0 = a.chord_by[a_of_0] + later({}, a.turning_by[a_of_0]);
  Vector2 by1 = later(b.chord_by[at_start ? 1 : 0], 0);
  double turning0 = a.turning_by[a_of_0];
  double turning1 = b.turning_by[at_start ? 1 : 0];
  if (at_start) {
    by0 = by0 + later(b.chord_by[0], 0);
    turning0 += b.turning_by[0];
  } else {
    by1 = by1 + a.chord_by[1] + later({}, a.turning_by[1]);
    turning1 += a.turning_by[1];
  }
  const Vector2 by_length = a.chord_by_length + later(b.chord_by_length, a.turning);
  return span_value(0.5 * (a.chord + second), a.turning + b.turning,
                    {s0 * by0, s1 * by1, 0.5 * by_length},
                    {2 * s0 * turning0, 2 * s1 * turning1, a.turning + b.turning},
                    state_.length[i] / problem_.chord[i]);
}

void Spline::refresh() {
  choose_variables();
  spans_.resize(problem_.spans());
  size_ = 1e300;
  for (std::size_t i = 0; i < spans_.size(); ++i) {
    const double k = std::max(std::abs(state_.curvature[i]), std::abs(state_.curvature[after(i)]));
    if (!(k * state_.length[i] < largest_bend(problem_.alpha[i]))) return;
  }
  for (std::size_t i = 0; i < spans_.size(); ++i) spans_[i] = value_of(i);
  fill_misses();
}

/// Miss of an end's rule, see assemble_end.
double Spline::end_miss(bool at_start) const {
  const std::size_t n = problem_.spans();
  const SplineEndRule& rule = at_start ? problem_.start : problem_.end;
  const std::size_t span = at_start ? 0 : n - 1;
  const std::size_t slot = at_start ? 0 : n;
  if (rule.angle) return problem_.fold * *rule.angle - spans_[span].value[at_start ? 0 : 1];
  const double other =
      rule.curvature ? problem_.fold * *rule.curvature : state_.curvature[at_start ? 1 : n - 1];
  return problem_.chord[span] * (other - state_.curvature[slot]);
}

void Spline::fill_misses() {
  const std::size_t n = problem_.spans();
  angle_miss_.resize(problem_.slots());
  for (std::size_t i = 0; i < angle_miss_.size(); ++i) {
    if (!problem_.closed && (i == 0 || i == n)) {
      angle_miss_[i] = end_miss(i == 0);
    } else {
      angle_miss_[i] =
          problem_.fold * problem_.turn[i] - spans_[(i + n - 1) % n].value[1] - spans_[i].value[0];
    }
  }
  double sum = 0;
  for (const double miss : angle_miss_) sum += miss * miss;
  for (const SpanValue& span : spans_) sum += span.value[2] * span.value[2];
  size_ = std::isfinite(sum) ? std::sqrt(sum) : 1e300;
}

/// Unknowns: the first slot's curvature stands apart (the border); then length 0, slot 1, length 1,
/// … Rows in the same order: chord 0, angle 1, chord 1, …; the angle of slot 0 is the border row.
/// `unknown` counts slot 0, length 0, slot 1, …: curvature of slot i is 2i, length i is 2i + 1.
void Spline::put_angle(std::size_t slot, std::size_t unknown, double value) {
  if (slot != 0) {
    const std::size_t row = 2 * slot - 1;
    if (unknown == 0) {
      system_.sides(row)[1] += value;
    } else {
      system_.at(row, unknown - 1) += value;
    }
    return;
  }
  const std::size_t all = system_.size() + 1;
  if (unknown == 0) {
    corner_ += value;
  } else if (unknown <= 2) {
    corner_next_[unknown - 1] += value;
  } else {
    corner_last_[unknown + 2 - all] += value;
  }
}

void Spline::assemble_point(std::size_t slot) {
  const std::size_t n = problem_.spans();
  const std::size_t before = (slot + n - 1) % n;
  const SpanValue& a = spans_[before];
  const SpanValue& b = spans_[slot];
  put_angle(slot, 2 * before, a.by[1][0]);
  put_angle(slot, 2 * before + 1, a.by[1][2]);
  put_angle(slot, 2 * slot, a.by[1][1] + b.by[0][0]);
  put_angle(slot, 2 * slot + 1, b.by[0][2]);
  put_angle(slot, 2 * after(slot), b.by[0][1]);
}

void Spline::assemble_end(std::size_t slot) {
  const bool at_start = slot == 0;
  const SplineEndRule& rule = at_start ? problem_.start : problem_.end;
  const std::size_t span = at_start ? 0 : slot - 1;
  const std::size_t other = at_start ? 1 : slot - 1;
  if (rule.angle) {
    const auto& by = spans_[span].by[at_start ? 0 : 1];
    put_angle(slot, 2 * span, by[0]);
    put_angle(slot, 2 * span + 1, by[2]);
    put_angle(slot, 2 * (span + 1), by[1]);
    return;
  }
  const auto rate = [&](std::size_t i) {
    const double k = state_.curvature[i];
    if (variables_[i].step == CurvatureStep::linear) return 1.0;
    if (variables_[i].step == CurvatureStep::logarithm) return k;
    const double p = variables_[i].power;
    return std::min(1e12, std::pow(std::abs(k) + 1e-12, 1 - p) / p);
  };
  put_angle(slot, 2 * slot, problem_.chord[span] * rate(slot));
  if (!rule.curvature) put_angle(slot, 2 * other, -problem_.chord[span] * rate(other));
}

void Spline::assemble() {
  const std::size_t n = problem_.spans();
  const std::size_t slots = problem_.slots();
  system_.reset(n + slots - 1);
  corner_ = 0;
  corner_next_ = corner_last_ = {};
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t row = 2 * i;
    const std::size_t j = after(i);
    system_.sides(row)[0] = -spans_[i].value[2];
    (i == 0 ? system_.sides(row)[1] : system_.at(row, 2 * i - 1)) += spans_[i].by[2][0];
    system_.at(row, 2 * i) += spans_[i].by[2][2];
    (j == 0 ? system_.sides(row)[1] : system_.at(row, 2 * j - 1)) += spans_[i].by[2][1];
  }
  for (std::size_t slot = 0; slot < slots; ++slot) {
    if (slot > 0) system_.sides(2 * slot - 1)[0] = angle_miss_[slot];
    const bool at_end = !problem_.closed && (slot == 0 || slot == n);
    at_end ? assemble_end(slot) : assemble_point(slot);
  }
}

/// Newton's direction in slot_step_ and length_step_.
bool Spline::find_direction() {
  assemble();
  if (!system_.solve()) return false;
  const std::size_t m = system_.size();
  double miss = angle_miss_[0];
  double slope = corner_;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& next = system_.sides(std::min(i, m - 1));
    miss -= corner_next_[i] * next[0];
    slope -= corner_next_[i] * next[1];
    const auto& last = system_.sides(m >= 2 ? m - 2 + i : 0);
    miss -= corner_last_[i] * last[0];
    slope -= corner_last_[i] * last[1];
  }
  const double first = miss / slope;
  if (!std::isfinite(first)) return false;
  slot_step_.assign(problem_.slots(), first);
  length_step_.resize(problem_.spans());
  for (std::size_t k = 0; k < m; ++k) {
    const double value = system_.sides(k)[0] - first * system_.sides(k)[1];
    (k % 2 == 0 ? length_step_[k / 2] : slot_step_[(k + 1) / 2]) = value;
  }
  return true;
}

double Spline::allowed_share() const {
  double share = 1;
  const auto bound = [&](double value, double limit) {
    if (std::abs(value) > limit) share = std::min(share, limit / std::abs(value));
  };
  for (std::size_t i = 0; i < slot_step_.size(); ++i) {
    const double chord = problem_.chord[std::min(i, problem_.spans() - 1)];
    if (variables_[i].step == CurvatureStep::linear) bound(slot_step_[i] * chord, 2);
    if (variables_[i].step == CurvatureStep::logarithm) bound(slot_step_[i], 0.8);
  }
  for (const double step : length_step_) bound(step, 0.5);
  return share;
}

void Spline::move(const SplineState& from, double share) {
  for (std::size_t i = 0; i < slot_step_.size(); ++i) {
    state_.curvature[i] = stepped(from.curvature[i], share * slot_step_[i], variables_[i]);
  }
  for (std::size_t i = 0; i < length_step_.size(); ++i) {
    state_.length[i] = from.length[i] * std::exp(share * length_step_[i]);
  }
}

/// One damped step; false where none makes the misses smaller.
bool Spline::step() {
  if (!find_direction()) return false;
  const SplineState from = state_;
  const auto variables = variables_;
  const double before = size_;
  double share = allowed_share();
  const int tries = before < 1e-11 ? 1 : 8;  // down at rounding a shorter step gains nothing
  for (int halving = 0; halving < tries; ++halving, share *= 0.5) {
    variables_ = variables;
    move(from, share);
    refresh();
    if (size_ < (1 - 0.1 * share) * before) return true;
  }
  state_ = from;
  refresh();
  return false;
}

}  // namespace

bool solve_spline_newton(const SplineProblem& problem, SplineState& state, int& iterations) {
  Spline spline(problem, state);
  const double rounding = 1e-15 * std::sqrt(4.0 * static_cast<double>(problem.slots()));
  if (spline.size() >= 1e300) return false;
  for (int i = 0; i < kSteps && spline.size() > rounding; ++i) {
    ++iterations;
    if (!spline.step()) break;
  }
  return spline.size() <= std::max(kAccepted, 4 * rounding);
}

}  // namespace keyline::lac::detail
