#pragma once

#include <cstddef>
#include <string_view>

#include "keyline/core/error.h"
#include "keyline/document/document.h"

namespace keyline::exchange {

/// Bounds that keep hostile files from using up the machine.
struct DxfReadLimits {
  int depth = 16;                  ///< of inserts within blocks
  std::size_t points = 400'000;    ///< made by inserts beyond one for every two bytes of the file
  std::size_t curves = 4'000'000;  ///< in all
};

/// Reads the curves of a DXF file, R12 to 2018, ASCII or binary: LINE, ARC, CIRCLE, ELLIPSE,
/// LWPOLYLINE and POLYLINE (bulges; polygon and polyface meshes are skipped), SPLINE and HELIX
/// (rational; from fit points where there are no control points, as AutoCAD interpolates them) and
/// INSERT with nested blocks, arrays, any scale and extrusion.
///
/// Names:   those our own writer stored, else of an insert that of its block ("wheel/hub"); others
///          have none.
/// Layers:  of the entity; of the insert for what lies on layer 0 of a block. Colours by entity,
///          layer or block, from AutoCAD's palette or true colour.
/// Exact:   arcs and circles in the plane become one log-aesthetic piece, bulges and ellipses
///          rational quadratics, splines what they are. What does not lie in z = 0 is a space
///          curve.
/// Unit:    $INSUNITS.
/// Skipped: other entities, counted by type, and what stands in paper space. Frozen layers and
///          layers switched off are read all the same.
///          An entity with a number that cannot be read, and the one a file without EOF stops in,
///          are left out and named with their line.
/// Fails:   bad_input with "line N" or "byte N" where the file stops being DXF before anything was
///          read; after that the rest is reported as skipped.
core::Result<document::Document> read_dxf(std::string_view bytes, const DxfReadLimits& limits = {});

}  // namespace keyline::exchange
