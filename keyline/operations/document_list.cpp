#include <algorithm>
#include <cmath>

#include "keyline/core/extent.h"
#include "keyline/core/polygon.h"
#include "keyline/curve/bounding_box.h"
#include "keyline/curve/length.h"
#include "keyline/operations/document_read.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

using core::ErrorCode;
using core::fail;
using core::Point3;
using core::Result;

struct Box : core::Box3 {
  static constexpr auto describe() {
    return core::fields(core::field<&Box::low>("least coordinates"),
                        core::field<&Box::high>("largest coordinates"));
  }
};

enum class ThingKind { curve, space_curve, surface, points };
constexpr auto choices(const ThingKind*) {
  return core::words<ThingKind>({{ThingKind::curve, "curve"},
                                 {ThingKind::space_curve, "space-curve"},
                                 {ThingKind::surface, "surface"},
                                 {ThingKind::points, "points"}});
}

struct Thing {
  ThingKind kind = ThingKind::curve;
  std::string name;
  std::string layer;
  std::string type;
  std::optional<bool> closed;
  std::optional<double> length;
  std::optional<std::size_t> count;
  Box box;
  static constexpr auto describe() {
    return core::fields(core::field<&Thing::kind>("what it is"),
                        core::field<&Thing::name>("may be empty"),
                        core::field<&Thing::layer>("may be empty"),
                        core::field<&Thing::type>("of its value, members of a path by number"),
                        core::field<&Thing::closed>("of a planar curve or points"),
                        core::field<&Thing::length>("of a curve or points").in("length"),
                        core::field<&Thing::count>("points, or control points of a surface"),
                        core::field<&Thing::box>("around points of it").in("length"));
  }
};

struct ListAnswer {
  std::string unit;
  std::vector<Thing> things;
  std::vector<std::string> notes;
  std::vector<std::string> skipped;
  std::vector<std::string> unused;
  static constexpr auto describe() {
    return core::fields(core::field<&ListAnswer::unit>("of all lengths; empty: none given"),
                        core::field<&ListAnswer::things>("in the order that \"select\" counts"),
                        core::field<&ListAnswer::notes>("how it was read, in words"),
                        core::field<&ListAnswer::skipped>("what the file holds beside, in words"),
                        core::field<&ListAnswer::unused>(kUnusedText));
  }
};

struct TypeName {
  std::string operator()(const curve::Polyline2& c) const { return polyline(c.points.size()); }
  std::string operator()(const curve::Polyline3& c) const { return polyline(c.points.size()); }
  template <class P>
  std::string operator()(const curve::Bezier<P>& c) const {
    return "bezier of degree " + std::to_string(c.control.size() - 1);
  }
  template <class P>
  std::string operator()(const curve::BSpline<P>& c) const {
    return "bspline of degree " + std::to_string(c.degree);
  }
  std::string operator()(const lac::Chain& c) const {
    return "log-aesthetic, " + std::to_string(c.pieces.size()) +
           (c.pieces.size() == 1 ? " piece" : " pieces");
  }
  std::string operator()(const lac::SpaceChain&) const { return "log-aesthetic-space"; }

 private:
  static std::string polyline(std::size_t n) { return "polyline of " + std::to_string(n); }
};

/// Of the length: what is printed, and more; curves by the ten thousand are measured.
constexpr double kLengthTolerance = 1e-9;

/// The box around a curve and its length, added to those of others.
struct Measure {
  Box& box;
  double& length;

  template <class C>
  void operator()(const C& c) const {
    const curve::Box2 around = curve::bounding_box(c);
    box.take(around.low);
    box.take(around.high);
    length += curve::arc_length(c, 0, 1, kLengthTolerance);
  }
  void operator()(const lac::Chain& c) const {
    const curve::Box2 around = curve::bounding_box(c);
    box.take(around.low);
    box.take(around.high);
    length += lac::arc_length(c);
  }
};

void describe_path(const document::Path& path, Thing& thing) {
  thing.type = path.curves.size() == 1 ? std::visit(TypeName{}, path.curves[0].value)
                                       : "path of " + std::to_string(path.curves.size());
  thing.closed = path.closed;
  double length = 0;
  for (const document::PlanarCurve& c : path.curves)
    std::visit(Measure{thing.box, length}, c.value);
  thing.length = length;
}

curve::Polyline2 shadow(const curve::Polyline3& c, auto along) {
  curve::Polyline2 flat;
  for (const Point3 p : c.points) flat.points.push_back(along(p));
  return flat;
}
curve::Bezier2 shadow(const curve::Bezier3& c, auto along) {
  curve::Bezier2 flat{{}, c.weights};
  for (const Point3 p : c.control) flat.control.push_back(along(p));
  return flat;
}
curve::BSpline2 shadow(const curve::BSpline3& c, auto along) {
  curve::BSpline2 flat{c.degree, c.knots, {}, c.weights};
  for (const Point3 p : c.control) flat.control.push_back(along(p));
  return flat;
}

/// The box of a space curve, by those of its shadows in the plane, and its length, added to those
/// of others.
struct SpaceMeasure {
  Box& box;
  double& length;

  template <class C>
  void operator()(const C& c) const {
    const auto plan =
        curve::bounding_box(shadow(c, [](Point3 p) { return core::Point2{p.x, p.y}; }));
    const auto side =
        curve::bounding_box(shadow(c, [](Point3 p) { return core::Point2{p.x, p.z}; }));
    box.take(Point3{plan.low.x, plan.low.y, side.low.y});
    box.take(Point3{plan.high.x, plan.high.y, side.high.y});
    length += curve::arc_length(c, 0, 1, kLengthTolerance);
  }
  void operator()(const lac::SpaceChain& c) const {
    constexpr int kPlaces = 257;
    for (int i = 0; i < kPlaces; ++i) box.take(evaluate(c, static_cast<double>(i) / (kPlaces - 1)));
    length += lac::arc_length(c);
  }
};

void describe_space(const document::SpaceCurve& c, Thing& thing) {
  thing.kind = ThingKind::space_curve;
  thing.type = std::visit(TypeName{}, c.value);
  double length = 0;
  std::visit(SpaceMeasure{thing.box, length}, c.value);
  thing.length = length;
}

void describe_line(const acquire::KeyLine& line, Thing& thing) {
  thing.kind = ThingKind::points;
  thing.type = "points";
  thing.closed = line.closed;
  thing.length = line.length;
  thing.count = line.points.size();
  for (const core::Point2 p : line.points) thing.box.take(p);
}

Thing thing_of(const NamedCurve& named) {
  Thing thing;
  thing.name = named.name;
  thing.layer = named.layer;
  if (named.line) {
    describe_line(*named.line, thing);
  } else if (const auto path = planar_path(*named.curve)) {
    describe_path(*path, thing);
  } else if (const auto* space = std::get_if<document::SpaceCurve>(&*named.curve)) {
    describe_space(*space, thing);
  }
  return thing;
}

Thing thing_of(const NamedSurfaceValue& named) {
  constexpr int kGrid = 33;
  Thing thing;
  thing.kind = ThingKind::surface;
  thing.name = named.name;
  thing.layer = named.layer;
  thing.type = std::holds_alternative<surface::BezierSurface>(named.surface) ? "bezier-surface"
                                                                             : "bspline-surface";
  const surface::Net& net = surface::net_of(named.surface);
  thing.count = static_cast<std::size_t>(net.rows) * static_cast<std::size_t>(net.columns);
  for (int i = 0; i < kGrid; ++i)
    for (int j = 0; j < kGrid; ++j)
      thing.box.take(evaluate(named.surface, i / (kGrid - 1.0), j / (kGrid - 1.0)));
  return thing;
}

Result<ListAnswer> run(const InputRequest& request, const Context& context) {
  const auto read = read_input(request, context.progress);
  if (!read) return std::unexpected(read.error());
  ListAnswer answer{read->unit, {}, read->notes, read->skipped, read->unused};
  for (std::size_t i = 0; i < read->curves.size(); ++i) {
    if (context.progress.stop_requested()) return fail(ErrorCode::cancelled, "cancelled");
    context.progress.report(static_cast<double>(i) / static_cast<double>(read->curves.size()),
                            "measuring curves");
    answer.things.push_back(thing_of(read->curves[i]));
  }
  for (const NamedSurfaceValue& s : read->surfaces) answer.things.push_back(thing_of(s));
  return answer;
}

}  // namespace

Operation document_list_operation() {
  return declare<run>(
      {.name = "document.list",
       .summary = "What a file holds, by name, layer, type, length and bounding box.",
       .examples = {R"({"file":"examples/clothoid.csv"})"},
       .long_running = true,
       .reads_files = true});
}

}  // namespace keyline::operations
