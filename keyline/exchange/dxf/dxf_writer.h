#pragma once

#include "keyline/core/error.h"
#include "keyline/document/document.h"
#include "keyline/exchange/file/written.h"

namespace keyline::exchange {

struct DxfWriteOptions {
  double tolerance = 1e-4;  ///< of log-aesthetic pieces that are neither line nor arc; > 0
  bool polylines = false;   ///< one LWPOLYLINE per path, arcs as bulges, in place of splines
};

/// A document as an ASCII DXF file of AutoCAD 2000 (AC1015): LINE, ARC, CIRCLE, LWPOLYLINE, SPLINE
/// with weights, and for space curves LINE, POLYLINE and SPLINE; layers, true colours, $INSUNITS,
/// and each name as extended data of application KEYLINE, which read_dxf() takes up. Numbers are
/// printed so that they read back to the same double.
/// Notes:  surfaces, names and layers that a reader finds otherwise, and a unit DXF has no code
/// for, which the file does not hold. Fails:  as cad_parts().
core::Result<Written> write_dxf(const document::Document& document, const DxfWriteOptions& options);

}  // namespace keyline::exchange
