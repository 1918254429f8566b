#include "reading.h"

#include <nlohmann/json.hpp>

#include "keyline/operations/perform.h"

#include "typed.h"
#include "words.h"

namespace keyline::app {

using core::Result;
using nlohmann::json;

namespace {

/// What is told of measured points, for reading them and for curves that turn out to be points.
void add_acquiring(const InputOptions& input, json& request) {
  if (input.closed || input.open) request["closed"] = input.closed;
  if (input.noise) request["noise"] = *input.noise;
  request["keep_order"] = input.keep_order;
  request["keep_strays"] = input.keep_strays;
}

json request_of(const InputOptions& input, bool planar) {
  json request{{"file", input.files}, {"planar", planar}};
  const auto set = [&](const char* name, const auto& value) {
    if (!value.empty()) request[name] = value;
  };
  set("columns", input.columns);
  set("weight_column", input.weights);
  set("id_column", input.id);
  set("select", input.select);
  set("section", input.section);
  set("glyphs", input.glyphs);
  set("unit", input.unit);
  if (input.band) request["band"] = *input.band;
  if (input.row) request["row"] = *input.row;
  if (input.column) request["column"] = *input.column;
  add_acquiring(input, request);
  return request;
}

}  // namespace

Result<operations::ReadAnswer> read_files(const InputOptions& input, const core::Progress& progress,
                                          bool planar) {
  auto read = operations::carry_out("document.read", request_of(input, planar), {0, progress});
  if (!read) return std::unexpected(as_options(read.error()));
  return *read->result_as<operations::ReadAnswer>();
}

json subject_of(const operations::NamedCurve& curve, const InputOptions& input) {
  json request = json::object();
  if (curve.line) {
    request["line"] = to_json(*curve.line);
  } else {
    request = to_json(operations::NamedCurve{{}, {}, {}, 0, curve.curve, {}});
    request = {{"curve", request["curve"]}};
  }
  add_acquiring(input, request);
  return request;
}

}  // namespace keyline::app
