#pragma once

#include "keyline/core/error.h"
#include "keyline/document/document.h"
#include "keyline/exchange/file/written.h"

namespace keyline::exchange {

/// Samples at equal steps of arc length as comma separated text: "x,y,arc_length,curvature", with a
/// first column "id" (the name) where the document holds several curves; a polyline gives its own
/// points instead. Curvature is empty where it is not finite. A document with space curves gives
/// "x,y,z" rows for all, at equal steps of the parameter. The deviation is that of the polygon
/// through the samples, seen at three places between each two.
/// Fails: bad_input where there is nothing to write.
core::Result<Written> write_csv(const document::Document& document, int samples = 1001);

}  // namespace keyline::exchange
