#include "keyline/surface/conditions.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/text.h"

namespace keyline::surface {

using core::ErrorCode;
using core::fail;
using core::Interval;
using core::number_text;

namespace {

constexpr double kMet = 1e-6;
constexpr Interval kScales{0.01, 100};

std::string interval_text(const Interval& i) {
  return "[" + number_text(i.low, 6) + ", " + number_text(i.high, 6) + "]";
}

bool ordered_within(const Interval& i, const Interval& bounds) {
  return i.low >= bounds.low && i.low <= i.high && i.high <= bounds.high;
}

core::Result<void> check(const CurveCondition& c, double alpha_max, const std::string& where) {
  if (c.alpha && !ordered_within(*c.alpha, {0, alpha_max}))
    return fail(ErrorCode::bad_input, "the range of alpha is empty or outside [0, alpha_max]",
                "give [low, high] within " + interval_text({0, alpha_max}), where + ".alpha");
  if (c.s && !ordered_within(*c.s, kScales))
    return fail(ErrorCode::bad_input, "the range of s is empty or outside [0.01, 100]",
                "give [low, high], for example [1.1, 1.4]", where + ".s");
  if (c.end_tolerance && !(*c.end_tolerance >= 0 && std::isfinite(*c.end_tolerance)))
    return fail(ErrorCode::bad_input, "the end tolerance is negative or not finite",
                "give a length of 0 or more", where + ".end_tolerance");
  return {};
}

/// Closed curves have no minimum to end anywhere.
core::Result<void> check_end(const CurveCondition& c, const NetworkCurve& curve,
                             const std::string& where) {
  const double chord = distance(curve.control.front(), curve.control.back());
  if (!c.end_tolerance || *c.end_tolerance < chord || chord == 0) return {};
  return fail(ErrorCode::bad_input,
              curve.name + ": the end tolerance is not smaller than the chord",
              "give less than " + number_text(chord, 6), where + ".end_tolerance");
}

/// What stands outside of its range and on which side; empty within.
std::optional<std::string> outside(const char* name, double value,
                                   const std::optional<Interval>& range) {
  if (!range || (value >= range->low - kMet && value <= range->high + kMet)) return std::nullopt;
  const bool below = value < range->low;
  return std::string(name) + " is " + number_text(value, 6) + (below ? ", below " : ", above ") +
         number_text(below ? range->low : range->high, 6);
}

bool tangent_kept(const NetworkCurve& a, const NetworkCurve& b) {
  const auto u = a.control[1] - a.control[0];
  const auto v = b.control[1] - b.control[0];
  return dot(u, v) > 0 && norm(cross(u, v)) <= kMet * norm(u) * norm(v);
}

}  // namespace

core::Result<void> validate(std::span<const CurveCondition> conditions, const Net& net,
                            double alpha_max) {
  const auto curves = network_curves(net);
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    const std::string where = "conditions[" + std::to_string(i) + "]";
    const auto& name = conditions[i].curve;
    const bool known = name.empty() || std::any_of(curves.begin(), curves.end(),
                                                   [&](const auto& c) { return c.name == name; });
    if (!known)
      return fail(ErrorCode::bad_input, "there is no network curve \"" + name + "\"",
                  "the patch has A1 to " + curves.back().name, where + ".curve");
    for (std::size_t k = 0; k < i; ++k)
      if (conditions[k].curve == name)
        return fail(ErrorCode::bad_input,
                    (name.empty() ? "every curve" : name) + " has two conditions",
                    "put both into one", where + ".curve");
    if (auto sound = check(conditions[i], alpha_max, where); !sound) return sound;
    for (const NetworkCurve& curve : curves)
      if (name.empty() || name == curve.name)
        if (auto sound = check_end(conditions[i], curve, where); !sound) return sound;
  }
  return {};
}

std::vector<CurveCondition> conditions_by_curve(std::span<const CurveCondition> conditions,
                                                const Net& net) {
  CurveCondition general;
  for (const CurveCondition& c : conditions)
    if (c.curve.empty()) general = c;
  std::vector<CurveCondition> all;
  for (const NetworkCurve& curve : network_curves(net)) {
    CurveCondition own = general;
    own.curve = curve.name;
    for (const CurveCondition& c : conditions) {
      if (c.curve != curve.name) continue;
      if (c.alpha) own.alpha = c.alpha;
      if (c.s) own.s = c.s;
      if (c.end_tolerance) own.end_tolerance = c.end_tolerance;
      if (c.branch) own.branch = c.branch;
      if (c.tangent) own.tangent = c.tangent;
    }
    all.push_back(std::move(own));
  }
  return all;
}

classa::CavOptions cav_options(const CurveCondition& condition, classa::CavOptions general) {
  constexpr double kRoom = 1e-9;  // a curve at the end of a range is within it
  if (condition.alpha)
    general.alpha = Interval{std::max(condition.alpha->low - kRoom, 0.0),
                             std::min(condition.alpha->high + kRoom, 1.5707)};
  if (condition.s) general.s = {condition.s->low * (1 - kRoom), condition.s->high * (1 + kRoom)};
  if (condition.end_tolerance) general.end_tolerance = condition.end_tolerance;
  if (condition.branch) {
    general.direction = classa::Direction::as_given;
    general.branch = condition.branch;
  }
  return general;
}

std::optional<std::string> unmet(const NetworkCurve& curve, const NetworkCurve& given,
                                 const CurveCondition& condition, double alpha_max) {
  if (condition.tangent.value_or(false) && !tangent_kept(curve, given))
    return "the direction of its first edge changed";
  if (!condition.alpha && !condition.s && !condition.branch) return std::nullopt;
  classa::CavOptions plain;
  plain.alpha_max = alpha_max;
  if (condition.branch) plain.direction = classa::Direction::as_given;
  const auto value = classa::cav(std::span<const core::Point3>(curve.control), plain);
  if (!value || !value->matrix)
    return std::string(value && value->type == 4 ? "it has several matrices" : "it has no matrix");
  if (auto why = outside("alpha", value->matrix->alpha, condition.alpha)) return why;
  if (auto why = outside("s", value->matrix->s, condition.s)) return why;
  const bool growing = condition.branch == classa::Branch::growing;
  if (condition.branch && (growing ? value->matrix->s < 1 - kMet : value->matrix->s > 1 + kMet))
    return std::string(growing ? "its edges fall" : "its edges grow");
  return std::nullopt;
}

std::string ranges_text(const CurveCondition& c) {
  std::string text;
  if (c.alpha) text += "alpha in " + interval_text(*c.alpha);
  if (c.s) text += (text.empty() ? "s in " : " and s in ") + interval_text(*c.s);
  if (c.branch) {
    if (!text.empty()) text += ", ";
    text += *c.branch == classa::Branch::growing ? "edges that grow" : "edges that fall";
  }
  return text;
}

}  // namespace keyline::surface
