#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "keyline/core/error.h"
#include "keyline/document/document.h"

/// Documents as JSON: one value of the public interface, or
///
/// {"unit":"mm", "curves":[{"name":…, "layer":…, "color":"#rrggbb", "stroke_width":w, "curve":{…}},
///  …], "surfaces":[{"name":…, "surface":{…}, "trims":n}, …], "skipped":["…"]}
///
/// with everything but one of the lists optional. A surface of the list may stand by itself, as a
/// curve may. Things of a list may name the unit too; all that name one name the same. An array of
/// curves and surfaces, as they stand in either list, is read too, and so are the answer of an
/// operation that returns one (`{"curve":{…}}`, `{"surface":{…}}`) and an offset table
/// (hull_table.h). docs/formats/document.schema.json states it as JSON Schema.
namespace keyline::exchange {

/// A document of one planar curve or surface without layer is its value, with name, colour and
/// unit as further fields; anything else the form above. Reads back to the same doubles.
nlohmann::json to_json(const document::Document& document);

/// Its text, dump(indent) of to_json(), without the tree of its long lists of points: ten times
/// their room. `further`: members added to the whole, if any.
std::string json_text(const document::Document& document, int indent,
                      const nlohmann::json& further);
std::string json_text(const document::Document& document, int indent);

/// Fails: bad_input with the place of the mistake within the value, for example
/// "curves[2].curve.points[0]".
core::Result<document::Document> document_from_json(const nlohmann::json& j);

/// The same from text; for what is no JSON the path is "line N".
core::Result<document::Document> read_json(std::string_view text);

}  // namespace keyline::exchange
