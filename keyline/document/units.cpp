#include "keyline/document/units.h"

#include <utility>
#include <variant>

namespace keyline::document {
namespace {

core::Point3 scaled(core::Point3 p, double factor) {
  return {factor * p.x, factor * p.y, factor * p.z};
}

void scale(curve::Polyline3& c, double factor) {
  for (core::Point3& p : c.points) p = scaled(p, factor);
}

template <class C>
void scale(C& c, double factor) {
  for (core::Point3& p : c.control) p = scaled(p, factor);
}

void scale(lac::SpaceChain& c, double factor) {
  c.start.position = scaled(c.start.position, factor);
  for (lac::SpacePiece& piece : c.pieces) {
    piece.length *= factor;
    for (double* rate :
         {&piece.curvature_start, &piece.curvature_end, &piece.torsion_start, &piece.torsion_end})
      *rate /= factor;
  }
}

void scale(SpaceCurve& c, double factor) {
  std::visit([factor](auto& value) { scale(value, factor); }, c.value);
}

}  // namespace

Document scaled(Document document, double factor) {
  for (NamedPath& named : document.paths) {
    named.path = transform(named.path, core::Similarity2{factor, 0, {}});
    named.stroke_width *= factor;
  }
  for (NamedSpaceCurve& named : document.space_curves) scale(named.curve, factor);
  for (NamedSurface& named : document.surfaces) {
    std::visit(
        [factor](auto& surface) {
          for (core::Point3& p : surface.net.points) p = scaled(p, factor);
        },
        named.surface);
    for (auto& loop : named.trim_loops)
      for (SpaceCurve& c : loop) scale(c, factor);
  }
  if (document.page)
    for (core::Point2* corner : {&document.page->low, &document.page->high})
      *corner = {factor * corner->x, factor * corner->y};
  return document;
}

Document in_unit(Document document, const std::string& unit) {
  const double from = millimetres(document.unit);
  const double to = millimetres(unit);
  if (!(from > 0) || !(to > 0)) return document;
  if (from != to) document = scaled(std::move(document), from / to);
  document.unit = unit;
  return document;
}

}  // namespace keyline::document
