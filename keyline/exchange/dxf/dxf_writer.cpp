#include "keyline/exchange/dxf/dxf_writer.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "keyline/core/angle.h"
#include "keyline/core/text.h"
#include "keyline/curve/conversion.h"
#include "keyline/document/color.h"
#include "keyline/exchange/cad/cad_parts.h"
#include "keyline/exchange/cad/flat_points.h"
#include "keyline/exchange/dxf/dxf_color.h"
#include "keyline/exchange/dxf/dxf_frame.h"
#include "keyline/exchange/dxf/dxf_names.h"
#include "keyline/exchange/dxf/dxf_units.h"
#include "keyline/lac/space/space.h"

namespace keyline::exchange {
namespace {

using core::Point2;
using core::Point3;
using core::Result;
using detail::DxfText;
using detail::lifted;
using document::Document;
using document::Label;

double degrees(double radians) {
  const double d = radians * 180 / core::kPi;
  return d < 0 ? d + 360 : d;
}

/// Curves in space do not say whether they are closed: those are whose ends differ by rounding.
bool comes_back(const curve::BSpline3& c) {
  double size = 0;
  for (const Point3 p : c.control) size = std::max(size, norm(p - Point3{}));
  return distance(evaluate(c, 0), evaluate(c, 1)) <= detail::kFlat * size;
}

class DxfWriter {
 public:
  explicit DxfWriter(const DxfWriteOptions& options) : options_(options) {}

  Result<Written> write(const Document& document) {
    if (document.paths.empty() && document.space_curves.empty() && !document.surfaces.empty())
      return core::fail(core::ErrorCode::bad_input, "DXF holds no surfaces", kHoldSurfaces);
    layers_ = detail::dxf_layers(document);
    for (const auto& named : document.paths)
      if (auto done = add(named); !done) return std::unexpected(done.error());
    for (const auto& named : document.space_curves) add(named);
    note(document);
    written_.content = detail::dxf_file(body_, used_layers_, detail::dxf_unit(document.unit));
    return std::move(written_);
  }

 private:
  void note(const Document& document) {
    if (!document.surfaces.empty())
      written_.notes.push_back(
          core::counted(document.surfaces.size(), "surface is", "surfaces are") +
          " not in the file: DXF holds none");
    for (std::string& line : detail::changed_names(document, layers_))
      written_.notes.push_back(std::move(line));
  }

  Result<void> add(const document::NamedPath& named) {
    // Half the tolerance is for what is made of the parts: polylines, or one spline of a chain.
    const double share = options_.tolerance / 2;
    auto parts = cad_parts(named.path, share);
    if (!parts) return std::unexpected(parts.error());
    const bool chain = is_chain(*parts);
    if (options_.polylines || (chain && is_bulged(*parts))) {
      const BulgedPolyline line = bulged_polyline(*parts, named.path.closed, share);
      written_.deviation = std::max(written_.deviation, line.deviation);
      if (line.vertices.size() >= 2) light_polyline(named.label, line);
      return {};
    }
    if (chain) {
      ChainSpline whole = chain_spline(*parts, share);
      written_.deviation = std::max(written_.deviation, whole.deviation);
      add_spline(named, whole.curve, share);
      return {};
    }
    written_.deviation = std::max(written_.deviation, parts->deviation);
    auto* const alone =
        parts->parts.size() == 1 ? std::get_if<curve::BSpline2>(&parts->parts[0]) : nullptr;
    if (alone) {
      add_spline(named, *alone, share);
      return {};
    }
    for (const CadPart& part : parts->parts)
      std::visit([&](const auto& p) { add_part(named.label, p); }, part);
    return {};
  }

  /// The whole of a path. Of a closed one, whose end other formats leave a rounding off its start,
  /// both are the same point.
  void add_spline(const document::NamedPath& named, curve::BSpline2 c, double share) {
    const double gap = distance(evaluate(c, 0), evaluate(c, 1));
    const bool closed = named.path.closed && gap <= share;
    if (closed && gap > 0) {
      c = curve::clamp_ends(c);
      c.control.back() = c.control.front();
      written_.deviation = std::max(written_.deviation, gap);
    }
    spline(named.label, {c.degree, c.knots, lifted(c.control), c.weights}, true, closed);
  }

  void add_part(const Label& label, const CadLine& line) {
    start("LINE", label, "AcDbLine");
    body_.point(10, lifted(line.from));
    body_.point(11, lifted(line.to));
    end(label);
  }

  void add_part(const Label& label, const document::Arc& arc) {
    const bool whole = std::abs(arc.turn) >= 2 * core::kPi * (1 - 1e-12);
    start(whole ? "CIRCLE" : "ARC", label, "AcDbCircle");
    body_.point(10, lifted(arc.center));
    body_.real(40, arc.radius);
    if (!whole) {
      const double to = core::wrap_angle(arc.start + arc.turn);
      const double from = core::wrap_angle(arc.start);
      body_.text(100, "AcDbArc");
      body_.real(50, degrees(arc.turn > 0 ? from : to));
      body_.real(51, degrees(arc.turn > 0 ? to : from));
    }
    end(label);
  }

  void add_part(const Label& label, const curve::Polyline2& line) {
    BulgedPolyline vertices;
    vertices.closed = line.points.size() > 3 && line.points.front() == line.points.back();
    for (const Point2 p : line.points) vertices.vertices.push_back({p, 0});
    if (vertices.closed) vertices.vertices.pop_back();
    light_polyline(label, vertices);
  }

  void add_part(const Label& label, const curve::BSpline2& c) {
    spline(label, {c.degree, c.knots, lifted(c.control), c.weights}, true, false);
  }

  void light_polyline(const Label& label, const BulgedPolyline& line) {
    start("LWPOLYLINE", label, "AcDbPolyline");
    body_.whole(90, static_cast<long>(line.vertices.size()));
    body_.whole(70, line.closed ? 1 : 0);
    for (const auto& vertex : line.vertices) {
      body_.real(10, vertex.point.x);
      body_.real(20, vertex.point.y);
      if (vertex.bulge != 0) body_.real(42, vertex.bulge);
    }
    end(label);
  }

  void spline(const Label& label, const curve::BSpline3& c, bool planar, bool closed) {
    start("SPLINE", label, "AcDbSpline");
    if (planar) body_.point(210, {0, 0, 1});
    body_.whole(70, (closed ? 1 : 0) + (c.weights.empty() ? 0 : 4) + (planar ? 8 : 0));
    body_.whole(71, c.degree);
    body_.whole(72, static_cast<long>(c.knots.size()));
    body_.whole(73, static_cast<long>(c.control.size()));
    body_.whole(74, 0);
    for (const double knot : c.knots) body_.real(40, knot);
    for (const double weight : c.weights) body_.real(41, weight);
    for (const Point3 p : c.control) body_.point(10, p);
    end(label);
  }

  void add(const document::NamedSpaceCurve& named) {
    const auto& value = named.curve.value;
    if (const auto* line = std::get_if<curve::Polyline3>(&value)) return add(named.label, *line);
    if (const auto* c = std::get_if<curve::BSpline3>(&value))
      return spline(named.label, *c, false, comes_back(*c));
    if (const auto* c = std::get_if<curve::Bezier3>(&value)) return add(named.label, *c);
    const auto quintics =
        lac::approximate_by_quintics(std::get<lac::SpaceChain>(value), options_.tolerance);
    written_.deviation = std::max(written_.deviation, quintics.deviation);
    const auto whole = curve::to_bspline(quintics.pieces, 0).value();
    spline(named.label, whole, false, comes_back(whole));
  }

  void add(const Label& label, const curve::Bezier3& c) {
    std::vector<double> knots(2 * c.control.size(), 0);
    std::fill(knots.begin() + static_cast<std::ptrdiff_t>(c.control.size()), knots.end(), 1);
    const curve::BSpline3 whole{degree(c), knots, c.control, c.weights};
    spline(label, whole, false, comes_back(whole));
  }

  void add(const Label& label, const curve::Polyline3& line) {
    if (line.points.size() == 2) {
      start("LINE", label, "AcDbLine");
      body_.point(10, line.points[0]);
      body_.point(11, line.points[1]);
      return end(label);
    }
    start("POLYLINE", label, "AcDb3dPolyline");
    body_.whole(66, 1);
    body_.point(10, {});
    body_.whole(70, 8);
    end(label);
    for (const Point3 p : line.points) {
      start("VERTEX", label, "AcDbVertex");
      body_.text(100, "AcDb3dPolylineVertex");
      body_.point(10, p);
      body_.whole(70, 32);
    }
    body_.text(0, "SEQEND");
    body_.handle(5);
    body_.text(100, "AcDbEntity");
    body_.text(8, layer_of(label));
  }

  std::string layer_of(const Label& label) {
    const std::string& layer = layers_.at(label.layer);
    used_layers_.insert(layer);
    return layer;
  }

  void start(const char* type, const Label& label, const char* subclass) {
    body_.text(0, type);
    body_.handle(5);
    body_.text(100, "AcDbEntity");
    body_.text(8, layer_of(label));
    if (const int color = document::color_value(label.color); color >= 0) {
      body_.whole(62, detail::nearest_aci(color));  // for readers older than true colours
      body_.whole(420, color);
    }
    body_.text(100, subclass);
  }

  void end(const Label& label) {
    if (label.name.empty()) return;
    body_.text(1001, "KEYLINE");
    body_.text(1000, detail::dxf_text(label.name));
  }

  DxfWriteOptions options_;
  Written written_;
  DxfText body_;
  std::map<std::string, std::string> layers_;  ///< names in the file by those in the document
  std::set<std::string> used_layers_{"0"};
};

}  // namespace

Result<Written> write_dxf(const Document& document, const DxfWriteOptions& options) {
  return DxfWriter(options).write(document);
}

}  // namespace keyline::exchange
