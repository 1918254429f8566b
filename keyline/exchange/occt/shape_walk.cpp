#include "keyline/exchange/occt/shape_walk.h"

#include <BRepTools.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <array>
#include <cmath>

#include "keyline/core/text.h"
#include "keyline/document/path_gap.h"
#include "keyline/exchange/occt/geometry.h"

namespace keyline::exchange::occt {
namespace {

using document::Label;

Label merged(const Label& outer, const Label& own) {
  Label label = outer;
  if (!own.name.empty()) label.name = own.name;
  if (!own.layer.empty()) label.layer = own.layer;
  if (!own.color.empty()) label.color = own.color;
  return label;
}

struct Bounds {
  double u1 = 0;
  double u2 = 0;
  double v1 = 0;
  double v2 = 0;
};

/// True for an edge that runs along the border of the parameter box.
bool on_border(const TopoDS_Edge& edge, const TopoDS_Face& face, const Bounds& b) {
  double first = 0;
  double last = 0;
  const Handle(Geom2d_Curve) c = BRep_Tool::CurveOnSurface(edge, face, first, last);
  if (c.IsNull()) return false;
  const double reach_u = 1e-6 * (b.u2 - b.u1);
  const double reach_v = 1e-6 * (b.v2 - b.v1);
  std::array<bool, 4> along = {true, true, true, true};
  for (int i = 0; i <= 4; ++i) {
    const gp_Pnt2d p = c->Value(first + (last - first) * i / 4);
    along[0] = along[0] && std::abs(p.X() - b.u1) <= reach_u;
    along[1] = along[1] && std::abs(p.X() - b.u2) <= reach_u;
    along[2] = along[2] && std::abs(p.Y() - b.v1) <= reach_v;
    along[3] = along[3] && std::abs(p.Y() - b.v2) <= reach_v;
  }
  return std::any_of(along.begin(), along.end(), [](bool yes) { return yes; });
}

/// Border of what surface_of() returns: the whole of a free-form surface, else the face's box.
Bounds bounds_of(const TopoDS_Face& face, const Handle(Geom_Surface) & s) {
  Bounds b;
  const std::string kind = s->DynamicType()->Name();
  if (kind == "Geom_BSplineSurface" || kind == "Geom_BezierSurface")
    s->Bounds(b.u1, b.u2, b.v1, b.v2);
  else
    BRepTools::UVBounds(face, b.u1, b.u2, b.v1, b.v2);
  return b;
}

}  // namespace

void ShapeWalk::skip(const std::string& name, const std::string& why) {
  constexpr std::size_t kMost = 1000;
  if (document_.skipped.size() < kMost) document_.skipped.push_back(name + ": " + why);
}

void ShapeWalk::tell_deviation(const std::string& name, const char* what, double deviation) {
  if (deviation > 0)
    skip(name, "its exact form; " + std::string(what) + " within " +
                   core::number_text(deviation, 2) + " of it is here");
}

void ShapeWalk::add(const TopoDS_Shape& shape) { add(shape, TopLoc_Location(), {}); }

void ShapeWalk::add(const TopoDS_Shape& shape, const TopLoc_Location& location, Outer outer) {
  const Label placement = labels_.of_placement(shape);
  if (outer.color.empty()) outer.color = placement.color;
  outer.label = merged(merged(outer.label, placement), labels_.of_part(shape));
  Label& label = outer.label;
  const auto named = [&] {
    if (!outer.color.empty()) label.color = outer.color;
    return label;
  };
  switch (shape.ShapeType()) {
    case TopAbs_FACE:
      return add_face(shape.Moved(location, false), named());
    case TopAbs_EDGE:
      return add_edge(shape.Moved(location, false), named());
    case TopAbs_WIRE:
      return add_wire(shape.Moved(location, false), named());
    case TopAbs_VERTEX:
      ++points_;
      return;
    default:
      break;
  }
  // A name of several things is none of each.
  const bool single = shape.NbChildren() == 1;
  if (!single && !label.name.empty() && label.name.back() != '/') label.name += '/';
  const TopLoc_Location inner = location * shape.Location();
  for (TopoDS_Iterator part(shape, true, false); part.More(); part.Next())
    add(part.Value(), inner, outer);
}

void ShapeWalk::add_face(const TopoDS_Shape& shape, Label label) {
  ++faces_;
  if (label.name.empty() || label.name.back() == '/')
    label.name += "face-" + std::to_string(faces_);
  try {
    const TopoDS_Face face = TopoDS::Face(shape);
    const Handle(Geom_Surface) s = BRep_Tool::Surface(face);
    if (s.IsNull()) return skip(label.name, "a face without surface");
    const Bounds b = bounds_of(face, s);
    double deviation = 0;
    document::NamedSurface named{label, surface_of(s, b.u1, b.u2, b.v1, b.v2, deviation), 0};
    tell_deviation(label.name, "a surface", deviation);
    if (auto sound = validate(named.surface); !sound)
      return skip(label.name, sound.error().message);
    for (TopExp_Explorer edge(face, TopAbs_EDGE); edge.More(); edge.Next())
      named.trims += !on_border(TopoDS::Edge(edge.Current()), face, b);
    if (named.trims > 0) add_trims(face, named);
    document_.surfaces.push_back(std::move(named));
  } catch (const Standard_Failure& failure) {
    skip(label.name, failure.GetMessageString());
  }
}

/// The whole border, loop by loop, where a part of it is no border of the surface.
void ShapeWalk::add_trims(const TopoDS_Shape& face, document::NamedSurface& named) {
  double deviation = 0;
  for (TopoDS_Iterator part(face); part.More(); part.Next()) {
    if (part.Value().ShapeType() != TopAbs_WIRE) continue;
    std::vector<document::SpaceCurve> loop;
    BRepTools_WireExplorer edge(TopoDS::Wire(part.Value()), TopoDS::Face(face));
    for (; edge.More(); edge.Next()) try {
        double first = 0;
        double last = 0;
        const Handle(Geom_Curve) c = BRep_Tool::Curve(edge.Current(), first, last);
        if (c.IsNull()) continue;
        document::SpaceCurve curve = space_curve_of(c, first, last, deviation);
        const bool back = edge.Current().Orientation() == TopAbs_REVERSED;
        if (validate(curve)) loop.push_back(back ? reverse(curve) : std::move(curve));
      } catch (const Standard_Failure& failure) {  // the surface is there all the same
        skip(named.label.name, "an edge of its border: " + std::string(failure.GetMessageString()));
      }
    if (!loop.empty()) named.trim_loops.push_back(std::move(loop));
  }
  tell_deviation(named.label.name, "a border", deviation);
  skip(named.label.name, "trimmed by " + core::counted(named.trims, "edge") +
                             ": the whole underlying surface is here");
}

void ShapeWalk::add_edge(const TopoDS_Shape& shape, Label label) {
  const std::string name = number_edge(label);
  try {
    double first = 0;
    double last = 0;
    const Handle(Geom_Curve) c = BRep_Tool::Curve(TopoDS::Edge(shape), first, last);
    if (c.IsNull()) return skip(name, "an edge without curve");
    double deviation = 0;
    add_curve(document_, c, first, last, label, deviation);
    tell_deviation(name, "a curve", deviation);
  } catch (const Standard_Failure& failure) {
    skip(name, failure.GetMessageString());
  }
}

std::string ShapeWalk::next_edge(const Label& label) const {
  const bool named = !label.name.empty() && !label.name.ends_with('/');
  return named ? label.name : label.name + "edge-" + std::to_string(edges_ + 1);
}

std::string ShapeWalk::number_edge(Label& label) {
  std::string name = next_edge(label);
  ++edges_;
  if (!label.name.empty()) label.name = name;
  return name;
}

namespace {

/// Curves of one wire in z = 0 as one path where each goes on where the one before ends, to 1e-7 of
/// their size (the precision of CAD files).
/// Fails: undrawable, with the first that does not.
core::Result<document::Path> chained(const document::Document& parts) {
  document::Path path;
  double size = 0;
  const core::Point2 first = evaluate(parts.paths.front().path, 0);
  for (const auto& named : parts.paths)
    for (const double t : {0.5, 1.0})
      size = std::max(size, distance(first, evaluate(named.path, t)));
  const double reach = kMeeting * size;
  core::Point2 last = first;
  for (std::size_t i = 0; i < parts.paths.size(); ++i) {
    const document::Path& part = parts.paths[i].path;
    if (const double width = distance(last, evaluate(part, 0)); width > reach)
      return core::fail(core::ErrorCode::undrawable, "part " + std::to_string(i + 1) +
                                                         " of its chain " +
                                                         in_words(document::PathGap{i, width}));
    last = evaluate(part, 1);
    path.curves.insert(path.curves.end(), part.curves.begin(), part.curves.end());
  }
  path.closed = distance(last, first) <= reach;
  return path;
}

}  // namespace

/// A chain of curves stays one.
void ShapeWalk::add_wire(const TopoDS_Shape& shape, Label label) {
  document::Document parts;
  std::string failed;
  double deviation = 0;
  for (TopoDS_Iterator part(shape); part.More(); part.Next()) try {
      double first = 0;
      double last = 0;
      const TopoDS_Edge edge = TopoDS::Edge(part.Value());
      const Handle(Geom_Curve) c = BRep_Tool::Curve(edge, first, last);
      if (c.IsNull()) continue;
      add_curve(parts, c, first, last, {}, deviation);
      if (edge.Orientation() != TopAbs_REVERSED) continue;
      if (!parts.paths.empty()) parts.paths.back().path = reverse(parts.paths.back().path);
    } catch (const Standard_Failure& failure) {
      failed = failure.GetMessageString();
    }
  const bool flat = parts.space_curves.empty() && !parts.paths.empty();
  if (!failed.empty() || !flat) {
    chains_in_space_ += failed.empty() && parts.paths.size() + parts.space_curves.size() > 1;
    return add_edges(shape, label);
  }
  auto path = chained(parts);
  if (!path) {
    skip(next_edge(label), path.error().message + "; its curves stand by themselves");
    return add_edges(shape, label);
  }
  tell_deviation(number_edge(label), "a chain", deviation);
  document_.paths.push_back({std::move(label), std::move(*path)});
}

void ShapeWalk::add_edges(const TopoDS_Shape& wire, const Label& label) {
  for (TopoDS_Iterator part(wire); part.More(); part.Next()) add_edge(part.Value(), label);
}

void ShapeWalk::finish() {
  if (points_ > 0) document_.skipped.push_back(core::counted(points_, "point"));
  if (chains_in_space_ > 0)
    document_.skipped.push_back(core::counted(chains_in_space_, "chain") +
                                " of curves in space; the curves stand by themselves");
}

}  // namespace keyline::exchange::occt
