#include "keyline/operations/curve_edit.h"

#include <algorithm>
#include <span>
#include <type_traits>

#include "keyline/classa/deviation.h"
#include "keyline/core/text.h"
#include "keyline/curve/part_bound.h"
#include "keyline/operations/ends.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

using core::Result;

constexpr double kSharp = 0.01;  ///< of the way that control points go: how sharp departures are

template <class Bezier>
double departure_of(const Bezier& given, const Bezier& edited) {
  const double most = curve::difference_bound(given, edited);
  if constexpr (std::is_same_v<Bezier, curve::Bezier2>)
    return std::min(most, classa::deviation_bound(std::span(&given, 1), edited, kSharp * most));
  else
    return std::min(most, classa::deviation_bound(given, edited, kSharp * most));
}

/// Of the ends, at most one moves.
template <class Bezier>
double end_moved(const Bezier& given, const Bezier& edited) {
  return std::max(core::distance(given.control.front(), edited.control.front()),
                  core::distance(given.control.back(), edited.control.back()));
}

/// A curve of one matrix that ends where it starts is a point, or turns by more than the plane of
/// alpha and s holds.
template <class Bezier>
Result<void> check_open(const Bezier& c) {
  double way = 0;
  for (std::size_t i = 1; i < c.control.size(); ++i)
    way += core::distance(c.control[i - 1], c.control[i]);
  if (!meet(c.control.front(), c.control.back(), way, kOneHeldEnd)) return {};
  return core::fail(core::ErrorCode::undrawable,
                    "the curve ends where it starts: no Class A curve does",
                    "cut it, as with keyline split --at 0.5, and edit its parts", "curve");
}

Result<CurveEditAnswer> edit_in_space(const curve::Bezier3& c, const classa::EditOptions& options) {
  if (auto open = check_open(c); !open) return std::unexpected(open.error());
  const auto edited = classa::edit(c, options);
  if (!edited) return std::unexpected(edited.error());
  CurveEditAnswer answer;
  answer.curve.curve = document::SpaceCurve{edited->curve};
  answer.before.value = shown(edited->flat.before);
  answer.after.value = shown(edited->flat.after);
  answer.target = {edited->flat.target.alpha, edited->flat.target.s};
  answer.departure = departure_of(c, edited->curve);
  answer.end_moved = end_moved(c, edited->curve);
  return answer;
}

Result<CurveEditAnswer> run(const CurveEditRequest& request, const Context&) {
  const classa::EditOptions options = edit_options(request);
  const auto subject = class_a_subject(request.curve);
  if (!subject) return std::unexpected(subject.error());
  if (subject->space) return edit_in_space(*subject->space, options);
  if (auto open = check_open(subject->planar->curve); !open) return std::unexpected(open.error());
  auto edited = classa::edit(subject->planar->curve, options);
  if (!edited) return std::unexpected(edited.error());
  const auto before = classa::evaluate_curve(*subject->planar, options.cav);
  if (!before) return std::unexpected(before.error());
  classa::CavOptions again = options.cav;
  again.minimum = edited->before.minimum;
  const auto after = classa::evaluate_curve({edited->curve, true}, again);
  if (!after) return std::unexpected(after.error());
  CurveEditAnswer answer;
  answer.curve = made({edited->curve});
  answer.before = shown(*before);
  answer.after = shown(*after);
  answer.target = {edited->target.alpha, edited->target.s};
  answer.departure =
      subject->planar->deviation + departure_of(subject->planar->curve, edited->curve);
  answer.end_moved = end_moved(subject->planar->curve, edited->curve);
  answer.path.emplace();
  for (const core::Point2& p : edited->path) answer.path->push_back({p.x, p.y});
  answer.given = *subject->planar;
  answer.edited = std::move(*edited);
  return answer;
}

}  // namespace

Result<PlaneTarget> PlaneTarget::from_text(std::string_view text) {
  const std::size_t comma = std::min(text.find(','), text.size());
  const auto alpha = core::parse_number(text.substr(0, comma));
  const auto s = comma < text.size() ? core::parse_number(text.substr(comma + 1)) : std::nullopt;
  if (alpha && s) return PlaneTarget{*alpha, *s};
  return core::fail(core::ErrorCode::bad_input,
                    "\"" + std::string(text) + "\" is no place of the plane",
                    "give alpha,s: two numbers");
}

classa::EditOptions edit_options(const CurveEditRequest& request) {
  classa::EditOptions options{.cav = cav_options(request.curve.options)};
  options.amount = request.amount;
  options.hold = request.hold;
  if (request.target)
    options.target = classa::ControlMatrix{request.target->alpha, request.target->s};
  return options;
}

Operation curve_edit_operation() {
  return declare<run>(
      {.name = "curve.edit",
       .summary = "Slides a curve to its minimum-energy point or to a given place of the alpha-s "
                  "plane; start point and start tangent stay, and the end: on the way to the "
                  "minimum within end_tolerance. A curve may be read from its end.",
       .examples = {R"({"curve":{"type":"bezier","points":[[0,0],[1,2],[0,4],[-2,5]]},
                        "amount":0.5})"}});
}

}  // namespace keyline::operations
