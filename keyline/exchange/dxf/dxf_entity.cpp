#include "keyline/exchange/dxf/dxf_entity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "keyline/core/angle.h"
#include "keyline/core/text.h"
#include "keyline/document/path_gap.h"

namespace keyline::exchange::detail {
namespace {

using core::Point3;
using core::Result;
using core::Vector3;
using Tags = std::vector<DxfTag>;

constexpr double kRadians = core::kPi / 180;

std::unexpected<core::Failure> none(std::string why) {
  return core::fail(core::ErrorCode::bad_input, std::move(why));
}

Affine3 frame_of(const Tags& tags) { return extrusion_frame(vector(tags, 210, {0, 0, 1})); }

Result<DxfCurve> line_of(const Tags& tags) {
  const Point3 a = point(tags, 10);
  const Point3 b = point(tags, 11);
  if (a == b) return none("both ends are one point");
  return DxfCurve{curve::Polyline3{{a, b}}, false};
}

/// The turn from one angle on to another, counterclockwise: above 0 and at most a whole one.
double turn_between(double from, double to, double whole) {
  const double turn = std::fmod(to - from, whole);
  const double least = 1e-9 * whole;  // less is what rounding made of a whole one
  return turn > least ? turn : turn + (turn < -least ? whole : whole - turn);
}

Result<DxfCurve> circle_of(const Tags& tags, bool arc) {
  const double radius = real(tags, 40);
  if (!(radius > 0)) return none("its radius is not positive");
  EllipseArc e{point(tags, 10), {radius, 0, 0}, {0, radius, 0}, 0, 2 * core::kPi};
  if (arc) {
    const double from = std::fmod(real(tags, 50), 360);
    e.from = from * kRadians;
    e.to = e.from + turn_between(from, real(tags, 51), 360) * kRadians;
  }
  return DxfCurve{mapped(e, frame_of(tags)), !arc};
}

Result<DxfCurve> ellipse_of(const Tags& tags) {
  EllipseArc e;
  e.center = point(tags, 10);
  e.major = vector(tags, 11);
  const double ratio = real(tags, 40, 1);
  const Vector3 z = frame_of(tags).z;
  if (!(norm(e.major) > 0) || !(std::abs(ratio) > 0)) return none("it has no extent");
  e.minor = ratio * cross(z, e.major);
  e.from = real(tags, 41, 0);
  e.to = real(tags, 42, 2 * core::kPi);
  if (!(std::abs(e.from) < 1e6 && std::abs(e.to) < 1e6)) return none("its angles make no sense");
  e.to = e.from + turn_between(e.from, e.to, 2 * core::kPi);
  return DxfCurve{e, e.to - e.from >= 2 * core::kPi * (1 - 1e-9)};
}

Result<DxfCurve> bent(const std::vector<BulgeVertex>& vertices, bool closed, const Affine3& frame) {
  const DxfShape shape = polyline_shape(vertices, closed);
  if (const auto* line = std::get_if<curve::Polyline3>(&shape); line && line->points.size() < 2)
    return none("it has fewer than two different points");
  return DxfCurve{mapped(shape, frame), closed};
}

/// Why an entity that counts more of a kind, in that group, than it has is none; empty where it
/// does not.
std::string lacks(const Tags& tags, int group, std::size_t there, const char* one,
                  const char* more) {
  const int wanted = integer(tags, group);
  if (wanted <= static_cast<int>(there)) return {};
  return "only " + std::to_string(there) + " of its " +
         core::counted(static_cast<std::size_t>(wanted), one, more) + " there";
}

Result<DxfCurve> light_polyline_of(const Tags& tags) {
  const double elevation = real(tags, 38);
  std::vector<BulgeVertex> vertices;
  for (const DxfTag& tag : tags) {
    const auto value = number_of(tag);
    if (tag.code == 10) vertices.push_back({{value.value_or(0), 0, elevation}, 0});
    if (vertices.empty() || !value) continue;
    if (tag.code == 20) vertices.back().point.y = *value;
    if (tag.code == 42) vertices.back().bulge = *value;
  }
  if (const auto why = lacks(tags, 90, vertices.size(), "vertex is", "vertices are"); !why.empty())
    return none(why);
  return bent(vertices, (integer(tags, 70) & 1) != 0, frame_of(tags));
}

Result<DxfCurve> old_polyline_of(const DxfEntity& entity) {
  const int flags = integer(entity.tags, 70);
  if ((flags & (16 | 64)) != 0) return none("it is a mesh");
  const bool space = (flags & 8) != 0;
  const double elevation = point(entity.tags, 10).z;
  std::vector<BulgeVertex> vertices;
  for (const Tags& tags : entity.vertices) {
    constexpr int kFrameOfSpline = 16;
    if ((integer(tags, 70) & kFrameOfSpline) != 0) continue;
    Point3 p = point(tags, 10);
    if (!space) p.z = elevation;
    vertices.push_back({p, space ? 0 : real(tags, 42)});
  }
  return bent(vertices, (flags & 1) != 0, space ? Affine3{} : frame_of(entity.tags));
}

/// Lists of a SPLINE in their order; a HELIX ends where its own groups start.
struct SplineLists {
  std::vector<double> knots;
  std::vector<double> weights;
  std::vector<Point3> control;
  std::vector<Point3> fit;
};

SplineLists lists_of(const Tags& tags) {
  SplineLists lists;
  for (const DxfTag& tag : tags) {
    if (tag.code == 100 && tag.text == "AcDbHelix") break;
    const double value = number_of(tag).value_or(0);
    const auto set = [value](std::vector<Point3>& points, double Point3::* axis) {
      if (!points.empty()) points.back().*axis = value;
    };
    if (tag.code == 40) lists.knots.push_back(value);
    if (tag.code == 41) lists.weights.push_back(value);
    if (tag.code == 10) lists.control.push_back({value, 0, 0});
    if (tag.code == 20) set(lists.control, &Point3::y);
    if (tag.code == 30) set(lists.control, &Point3::z);
    if (tag.code == 11) lists.fit.push_back({value, 0, 0});
    if (tag.code == 21) set(lists.fit, &Point3::y);
    if (tag.code == 31) set(lists.fit, &Point3::z);
  }
  return lists;
}

/// Knots written with few digits may step back by rounding.
void mend(std::vector<double>& knots) {
  if (knots.empty()) return;
  const double reach = 1e-9 * std::abs(knots.back() - knots.front());
  for (std::size_t i = 1; i < knots.size(); ++i)
    if (knots[i] < knots[i - 1] && knots[i - 1] - knots[i] <= reach) knots[i] = knots[i - 1];
}

Result<DxfCurve> spline_of(const Tags& tags) {
  SplineLists lists = lists_of(tags);
  const bool closed = (integer(tags, 70) & 1) != 0;
  if (lists.control.empty()) {
    auto& fit = lists.fit;
    const auto why = lacks(tags, 74, fit.size(), "fit point is", "fit points are");
    if (!why.empty()) return none(why);
    fit.erase(std::unique(fit.begin(), fit.end()), fit.end());
    if (fit.size() < 2) return none("it has neither control points nor two fit points");
    return DxfCurve{fit_point_spline(fit, vector(tags, 12), vector(tags, 13), closed), closed};
  }
  auto why = lacks(tags, 73, lists.control.size(), "control point is", "control points are");
  if (why.empty()) why = lacks(tags, 72, lists.knots.size(), "knot is", "knots are");
  if (!why.empty()) return none(why);
  mend(lists.knots);
  curve::BSpline3 spline;
  spline.degree = integer(tags, 71, 3);
  spline.knots = std::move(lists.knots);
  spline.control = std::move(lists.control);
  spline.weights = std::move(lists.weights);
  const bool equal = std::all_of(spline.weights.begin(), spline.weights.end(),
                                 [&](double w) { return w == spline.weights.front(); });
  if (equal && !spline.weights.empty() && spline.weights.front() > 0) spline.weights.clear();
  if (auto sound = validate(spline); !sound)
    return none(sound.error().message +
                (sound.error().path.empty() ? "" : " (" + sound.error().path + ")"));
  const bool apart = closed && !document::ends_meet({spline});
  return DxfCurve{std::move(spline), closed && !apart, apart};
}

const DxfTag* find(const Tags& tags, int code) {
  const auto found = std::find_if(tags.begin(), tags.end(),
                                  [code](const DxfTag& tag) { return tag.code == code; });
  return found == tags.end() ? nullptr : &*found;
}

/// True for the codes the readers of this file take numbers from: coordinates, sizes, angles,
/// counts and flags, the direction of extrusion.
bool is_geometry(int code) {
  const auto within = [code](int low, int high) { return code >= low && code <= high; };
  return within(10, 38) || within(40, 47) || within(50, 59) || within(70, 79) || within(90, 99) ||
         within(210, 239);
}

/// Whether the group's number can be taken: counts, flags and degrees are whole ones, which a
/// fraction or a number out of range would turn into others.
bool is_number(const DxfTag& tag) {
  const bool whole = tag.code == 90 || (tag.code >= 70 && tag.code <= 74);
  return whole ? integer_of(tag) && number_of(tag) == integer_of(tag) : number_of(tag).has_value();
}

const DxfTag* unreadable(const Tags& tags) {
  const auto found = std::find_if(tags.begin(), tags.end(), [](const DxfTag& tag) {
    return is_geometry(tag.code) && !is_number(tag);
  });
  return found == tags.end() ? nullptr : &*found;
}

using Codes = std::vector<int>;

/// Groups without which an entity of this type has no place or size.
const Codes& needed_groups(std::string_view type) {
  static const std::map<std::string_view, Codes> kNeeded = {{"LINE", {10, 20, 11, 21}},
                                                            {"ARC", {10, 20, 40, 50, 51}},
                                                            {"CIRCLE", {10, 20, 40}},
                                                            {"ELLIPSE", {10, 20, 11, 21, 40}},
                                                            {"INSERT", {10, 20}}};
  static const Codes kNone;
  const auto found = kNeeded.find(type);
  return found == kNeeded.end() ? kNone : found->second;
}

/// Groups that stand in an entity of this type as often as it has points, knots or weights.
const Codes& listed_groups(std::string_view type) {
  static const Codes kVertices = {10, 20, 40, 41, 42, 91};
  static const Codes kSpline = {10, 20, 30, 11, 21, 31, 40, 41};
  static const Codes kNone;
  if (type == "LWPOLYLINE") return kVertices;
  return type == "SPLINE" || type == "HELIX" ? kSpline : kNone;
}

/// The first group of the geometry, but for those listed, that stands there with two values.
std::optional<int> ambiguous(const Tags& tags, const Codes& listed) {
  std::map<int, double> known;
  for (const DxfTag& tag : tags) {
    if (tag.code == 100 && tag.text == "AcDbHelix") break;
    if (!is_geometry(tag.code) || std::ranges::find(listed, tag.code) != listed.end()) continue;
    const double value = number_of(tag).value_or(0);
    if (known.emplace(tag.code, value).first->second != value) return tag.code;
  }
  return std::nullopt;
}

/// As many second coordinates as first ones, each behind its own.
bool in_pairs(const Tags& tags, int code) {
  bool open = false;
  for (const DxfTag& tag : tags) {
    if (tag.code == 100 && tag.text == "AcDbHelix") break;
    if (tag.code == code && std::exchange(open, true)) return false;
    if (tag.code == code + 10 && !std::exchange(open, false)) return false;
  }
  return !open;
}

/// Third coordinates are those of all points, or of none: then they are 0.
std::optional<int> missing_height(const DxfEntity& entity) {
  const Tags& tags = entity.tags;
  if (entity.type == "LINE" && !find(tags, 30) != !find(tags, 31)) return find(tags, 30) ? 31 : 30;
  if (entity.type != "SPLINE" && entity.type != "HELIX") return std::nullopt;
  const auto count = [&](int code) { return std::ranges::count(tags, code, &DxfTag::code); };
  for (const int code : {30, 31})
    if (count(code) > 0 && count(code) != count(code - 20)) return code;
  return std::nullopt;
}

}  // namespace

const DxfTag* unreadable(const DxfEntity& entity) {
  if (const DxfTag* tag = unreadable(entity.tags)) return tag;
  for (const Tags& vertex : entity.vertices)
    if (const DxfTag* tag = unreadable(vertex)) return tag;
  return nullptr;
}

std::optional<int> missing_group(const DxfEntity& entity) {
  for (const int code : needed_groups(entity.type))
    if (!find(entity.tags, code)) return code;
  if (entity.type == "LWPOLYLINE" || entity.type == "SPLINE" || entity.type == "HELIX")
    for (const int code : {10, 11})
      if (!in_pairs(entity.tags, code)) return code + 10;
  if (const auto height = missing_height(entity)) return height;
  for (const Tags& vertex : entity.vertices)
    for (const int code : {10, 20})
      if (!find(vertex, code)) return code;
  return std::nullopt;
}

std::optional<int> ambiguous_group(const DxfEntity& entity) {
  auto found = ambiguous(entity.tags, listed_groups(entity.type));
  for (const Tags& vertex : entity.vertices)
    if (!found) found = ambiguous(vertex, {});
  return found;
}

double real(const Tags& tags, int code, double fallback) {
  const DxfTag* tag = find(tags, code);
  return tag ? number_of(*tag).value_or(fallback) : fallback;
}

int integer(const Tags& tags, int code, int fallback) {
  const DxfTag* tag = find(tags, code);
  return tag ? integer_of(*tag).value_or(fallback) : fallback;
}

std::string text(const Tags& tags, int code) {
  const DxfTag* tag = find(tags, code);
  return tag ? text_of(*tag) : std::string();
}

Point3 point(const Tags& tags, int code) {
  return {real(tags, code), real(tags, code + 10), real(tags, code + 20)};
}

Vector3 vector(const Tags& tags, int code, Vector3 fallback) {
  return {real(tags, code, fallback.x), real(tags, code + 10, fallback.y),
          real(tags, code + 20, fallback.z)};
}

bool is_dxf_curve(std::string_view type) {
  static constexpr std::array<std::string_view, 8> kTypes = {
      "LINE", "ARC", "CIRCLE", "ELLIPSE", "LWPOLYLINE", "POLYLINE", "SPLINE", "HELIX"};
  return std::find(kTypes.begin(), kTypes.end(), type) != kTypes.end();
}

Result<DxfCurve> dxf_curve_of(const DxfEntity& entity) {
  const auto made = [&]() -> Result<DxfCurve> {
    if (entity.type == "LINE") return line_of(entity.tags);
    if (entity.type == "ARC" || entity.type == "CIRCLE")
      return circle_of(entity.tags, entity.type == "ARC");
    if (entity.type == "ELLIPSE") return ellipse_of(entity.tags);
    if (entity.type == "LWPOLYLINE") return light_polyline_of(entity.tags);
    if (entity.type == "POLYLINE") return old_polyline_of(entity);
    return spline_of(entity.tags);
  }();
  if (made && !is_finite(made->shape)) return none("its numbers are too large");
  return made;
}

}  // namespace keyline::exchange::detail
