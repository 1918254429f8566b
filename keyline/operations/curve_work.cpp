#include <algorithm>

#include "keyline/analysis/continuity.h"
#include "keyline/analysis/profile.h"
#include "keyline/document/cusped.h"
#include "keyline/document/join.h"
#include "keyline/document/planar_edit.h"
#include "keyline/operations/ends.h"
#include "keyline/operations/joints_inside.h"
#include "keyline/operations/made_curve.h"
#include "keyline/operations/registry.h"
#include "keyline/operations/subject.h"

/// Work on curves as they stand in files: reverse, mirror, trim, split, offset, join.
namespace keyline::operations {
namespace {

using core::ErrorCode;
using core::Result;

constexpr const char* kAnyPlanar = "any planar curve or path";
constexpr const char* kRibbon = R"({"type":"bezier","points":[[0,0],[1,2],[3,2],[4,0]]})";

std::string on_ribbon(const std::string& more) {
  return std::string(R"({"curve":)") + kRibbon + more + "}";
}

MadeCurve made_path(document::Path path) {
  MadeCurve curve;
  curve.curve = simplest(std::move(path));
  return curve;
}

struct CurveOnly {
  MadeCurve curve;
  static constexpr auto describe() { return core::fields(core::flattened<&CurveOnly::curve>()); }
};

struct ReverseRequest {
  document::Path curve;
  static constexpr auto describe() {
    return core::fields(core::field<&ReverseRequest::curve>(kAnyPlanar).needed());
  }
};

Result<CurveOnly> run_reverse(const ReverseRequest& request, const Context&) {
  return CurveOnly{made_path(document::reverse(request.curve))};
}

struct MirrorRequest {
  document::Path curve;
  core::Point2 point;
  double direction = core::kPi / 2;
  static constexpr auto describe() {
    return core::fields(
        core::field<&MirrorRequest::curve>(kAnyPlanar).needed(),
        core::field<&MirrorRequest::point>("on the mirror line; the origin unless given"),
        core::field<&MirrorRequest::direction>("of the mirror line, from the x axis").in("radian"));
  }
};

Result<CurveOnly> run_mirror(const MirrorRequest& request, const Context&) {
  return CurveOnly{
      made_path(document::mirrored(request.curve, {request.point, request.direction}))};
}

/// Parameters of fractions of the length.
class Places {
 public:
  explicit Places(const document::Path& path) : view_(analysis::view(path)), table_(view_) {}
  double parameter(double fraction) const {
    if (fraction <= 0) return 0;
    return fraction >= 1 ? 1 : table_.parameter_at(fraction * table_.length());
  }
  double length() const { return table_.length(); }
  const analysis::ArcLengthTable& table() const { return table_; }

 private:
  analysis::CurveView view_;
  analysis::ArcLengthTable table_;
};

struct TrimRequest {
  document::Path curve;
  double from = 0;
  double to = 1;
  static constexpr auto describe() {
    return core::fields(core::field<&TrimRequest::curve>(kAnyPlanar).needed(),
                        core::field<&TrimRequest::from>("where the part begins, as a fraction of "
                                                        "the length")
                            .within(core::from_to(0, 1)),
                        core::field<&TrimRequest::to>("where it ends; of a closed curve before "
                                                      "\"from\" where the part runs over its start")
                            .within(core::from_to(0, 1)));
  }
};

/// Whether the curve ends where it begins.
bool comes_back(const document::Path& path, double length) {
  return meet(evaluate(path, 0), evaluate(path, 1), length);
}

Result<CurveOnly> run_trim(const TrimRequest& request, const Context&) {
  const Places places(request.curve);
  const bool over = request.from > request.to && !(request.from == 1 && request.to == 0) &&
                    comes_back(request.curve, places.length());
  if (over)
    return CurveOnly{made_path(document::part_over_seam(
        request.curve, places.parameter(request.from), places.parameter(request.to)))};
  if (!(request.from < request.to))
    return core::fail(ErrorCode::bad_input, "nothing would be left",
                      "give \"from\" less than \"to\"; more only of a closed curve", "to");
  return CurveOnly{made_path(document::part(
      request.curve, {places.parameter(request.from), places.parameter(request.to)}))};
}

struct SplitRequest {
  document::Path curve;
  std::vector<double> at;
  bool corners = false;
  static constexpr auto describe() {
    return core::fields(
        core::field<&SplitRequest::curve>(kAnyPlanar).needed(),
        core::field<&SplitRequest::at>("where, as fractions of the length; a closed curve "
                                       "is cut at its start only where 0 is given")
            .within(core::from_to(0, 1))
            .or_bare_item(),
        core::field<&SplitRequest::corners>("also wherever the direction jumps"));
  }
};

struct SplitResult {
  std::vector<CurveOnly> parts;
  static constexpr auto describe() {
    return core::fields(core::field<&SplitResult::parts>("in order along the curve"));
  }
};

/// Parameters where the direction jumps, of one that comes back also 0 where it does at its start.
std::vector<double> corners_of(const document::Path& path, bool comes_back) {
  std::vector<double> corners;
  for (const analysis::InnerJoint& inside : joints_inside(path))
    if (inside.joint.order <= 0) corners.push_back(inside.t);
  if (!comes_back) return corners;
  const document::CuspedPath cusped(path);
  const analysis::CurveView view(cusped);
  if (analysis::continuity(std::vector{view}, true).back().order <= 0) corners.push_back(0);
  return corners;
}

Result<SplitResult> run_split(const SplitRequest& request, const Context&) {
  const Places places(request.curve);
  const bool ring = comes_back(request.curve, places.length());
  std::vector<double> cuts;
  if (request.corners) cuts = corners_of(request.curve, ring);
  for (const double fraction : request.at) {
    const double at = places.parameter(fraction);
    if (!ring && (at == 0 || at == 1))
      return core::fail(ErrorCode::bad_input, "the curve ends there already",
                        "give fractions between 0 and 1; the ends only of a closed curve", "at");
    cuts.push_back(at == 1 ? 0 : at);
  }
  if (cuts.empty())
    return core::fail(ErrorCode::bad_input, "there is nowhere to split",
                      "give \"at\", or \"corners\" for a curve that has some", "at");
  if (!ring) cuts.insert(cuts.end(), {0, 1});
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  SplitResult result;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
    result.parts.push_back({made_path(document::part(request.curve, {cuts[i], cuts[i + 1]}))});
  if (ring)
    result.parts.push_back(
        {made_path(document::part_over_seam(request.curve, cuts.back(), cuts.front()))});
  return result;
}

struct OffsetRequest {
  document::Path curve;
  double distance = 0;
  std::optional<double> tolerance;
  static constexpr auto describe() {
    return core::fields(
        core::field<&OffsetRequest::curve>(kAnyPlanar).needed(),
        core::field<&OffsetRequest::distance>("to the left; to the right where negative")
            .in("length")
            .needed(),
        core::field<&OffsetRequest::tolerance>(
            "largest deviation from the exact offset; 1e-5 of the length unless given")
            .in("length")
            .within(core::kPositive));
  }
};

struct OffsetResult {
  MadeCurve curve;
  double deviation = 0;
  int arcs = 0;
  static constexpr auto describe() {
    return core::fields(
        core::flattened<&OffsetResult::curve>(),
        core::field<&OffsetResult::deviation>("bound of the distance from the exact offset")
            .in("length"),
        core::field<&OffsetResult::arcs>("put in about corners that open"));
  }
};

Result<OffsetResult> run_offset(const OffsetRequest& request, const Context&) {
  constexpr double kUsual = 1e-5;  // of the length
  if (auto extent = check_extent(request.curve); !extent) return std::unexpected(extent.error());
  const double length = Places(request.curve).length();
  auto made = document::offset(request.curve, request.distance,
                               request.tolerance.value_or(kUsual * length), kOneEnd * length);
  if (!made) return std::unexpected(made.error());
  return OffsetResult{made_path(std::move(made->path)), made->deviation, made->arcs};
}

struct JoinRequest {
  std::vector<document::Path> curves;
  double tolerance = 1e-6;
  static constexpr auto describe() {
    return core::fields(
        core::field<&JoinRequest::curves>("two or more, in any order and direction; the path "
                                          "begins with the first")
            .count(2)
            .needed(),
        core::field<&JoinRequest::tolerance>("largest gap between ends that are one")
            .in("length")
            .within(core::at_least(0)));
  }
};

struct JoinResult {
  MadeCurve curve;
  double gap = 0;
  std::vector<std::size_t> reversed;
  static constexpr auto describe() {
    return core::fields(
        core::flattened<&JoinResult::curve>(),
        core::field<&JoinResult::gap>("largest between neighbours; a line closes one that shows")
            .in("length"),
        core::field<&JoinResult::reversed>("curves that run the other way in it, from 0"));
  }
};

Result<JoinResult> run_join(const JoinRequest& request, const Context&) {
  auto made = document::joined(request.curves, request.tolerance);
  if (!made) return std::unexpected(made.error());
  return JoinResult{made_path(std::move(made->path)), made->gap, std::move(made->reversed)};
}

}  // namespace

Operation curve_reverse_operation() {
  return declare<run_reverse>({.name = "curve.reverse",
                               .summary = "The same curve from its end to its start.",
                               .examples = {on_ribbon("")}});
}

Operation curve_mirror_operation() {
  return declare<run_mirror>({.name = "curve.mirror",
                              .summary = "Mirrors a curve in a line; its type stays.",
                              .examples = {on_ribbon(R"(,"point":[5,0])")}});
}

Operation curve_trim_operation() {
  return declare<run_trim>({.name = "curve.trim",
                            .summary = "Cuts a part out of a curve; its type stays.",
                            .examples = {on_ribbon(R"(,"from":0.25,"to":0.75)")}});
}

Operation curve_split_operation() {
  return declare<run_split>({.name = "curve.split",
                             .summary = "Cuts a curve into parts; its type stays.",
                             .examples = {on_ribbon(R"(,"at":[0.5])")}});
}

Operation curve_offset_operation() {
  return declare<run_offset>(
      {.name = "curve.offset",
       .summary =
           "Offsets a curve by a constant distance: exactly for lines and arcs, otherwise as "
           "cubics within the tolerance, with an arc around every corner that opens.",
       .examples = {on_ribbon(R"(,"distance":0.3)")}});
}

Operation curve_join_operation() {
  return declare<run_join>(
      {.name = "curve.join",
       .summary =
           "Joins curves whose ends meet into one path, reversed and reordered where needed.",
       .examples = {std::string(R"({"curves":[)") + kRibbon +
                    R"(,{"type":"polyline","points":[[6,1],[4,0]]}]})"}});
}

}  // namespace keyline::operations
