#include "option_files.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "keyline/operations/document_read.h"

namespace keyline::app {

using core::ErrorCode;
using core::fail;
using core::Result;
using nlohmann::json;
using operations::ReadAnswer;

json curve_of(const json& thing) {
  if (thing.contains("curve")) return thing["curve"];
  json points = thing["line"]["points"];
  if (thing["line"].value("closed", false)) points.push_back(points.front());
  return {{"type", "polyline"}, {"points", std::move(points)}};
}

FileWord parted(const std::string& word) {
  std::error_code absent;
  if (std::filesystem::exists(word, absent)) return {word, ""};
  for (std::size_t hash = word.find('#'); hash != std::string::npos;
       hash = word.find('#', hash + 1))
    if (std::filesystem::exists(word.substr(0, hash), absent))
      return {word.substr(0, hash), word.substr(hash + 1)};
  return {word, ""};
}

Result<const operations::Outcome*> OptionFiles::outcome_of(const std::string& word) {
  if (const auto known = read_.find(word); known != read_.end()) return &known->second;
  const auto [file, thing] = parted(word);
  json request{{"file", file}};
  if (!thing.empty()) request["select"] = thing;
  auto outcome = operations::carry_out("document.read", request, {0, {}, true});
  if (!outcome) return std::unexpected(outcome.error());
  const std::string& unit = outcome->result_as<ReadAnswer>()->unit;
  if (auto same = unit_.take(unit, word); !same) return std::unexpected(same.error());
  return &read_.emplace(word, std::move(*outcome)).first->second;
}

Result<std::vector<json>> OptionFiles::all(const std::string& word, Kind kind,
                                           const std::string& option) {
  const auto outcome = outcome_of(word);
  if (!outcome) return std::unexpected(outcome.error());
  const auto shown = operations::result_json(**outcome);
  if (!shown) return std::unexpected(shown.error());
  std::vector<json> things;
  if (kind == Kind::surfaces)
    for (const json& thing : (*shown)["surfaces"]) things.push_back(thing["surface"]);
  else
    for (const json& thing : (*shown)["curves"]) things.push_back(curve_of(thing));
  if (things.empty())
    return fail(
        ErrorCode::bad_input,
        fmt::format("there is no {} in {}", kind == Kind::surfaces ? "surface" : "curve", word),
        "give a file that holds one", option);
  return things;
}

Result<json> OptionFiles::first(const std::string& word, Kind kind, const std::string& option) {
  auto things = all(word, kind, option);
  if (!things) return std::unexpected(things.error());
  if (things->size() > 1) {
    const std::string file = parted(word).file;
    const std::string note = fmt::format(
        "{}: {} takes the first of {} {}; {}#NAME takes another, keyline list tells them", word,
        option, things->size(), kind == Kind::surfaces ? "surfaces" : "curves", file);
    if (std::ranges::find(notes_, note) == notes_.end()) notes_.push_back(note);
  }
  return std::move(things->front());
}

}  // namespace keyline::app
