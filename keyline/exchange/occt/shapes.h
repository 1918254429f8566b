#pragma once

#include "keyline/document/document.h"

class TopoDS_Shape;

/// Keyline's curves and surfaces as OCCT's, exactly.
namespace keyline::exchange::occt {

/// A path of curves cad_parts() gives, as an edge or, of several, a wire of edges in their order; a
/// face of a whole surface. Throws std::runtime_error for what has no extent.
TopoDS_Shape shape_of(const document::Path& path);
TopoDS_Shape edge_of(const document::SpaceCurve& curve);
TopoDS_Shape face_of(const surface::Surface& surface);

}  // namespace keyline::exchange::occt
