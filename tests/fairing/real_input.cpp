#include "real_input.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "keyline/acquire/acquire.h"
#include "keyline/acquire/section.h"
#include "keyline/exchange/points/points_reader.h"
#include "keyline/operations/subject.h"

namespace keyline::fairing::testing {
namespace {

using nlohmann::json;

const std::filesystem::path kFolder = KEYLINE_SHARED_DATA;

json read_json(const std::filesystem::path& path) {
  std::ifstream in(path);
  return json::parse(in);
}

std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder,
                                            const std::string& prefix = "") {
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().filename().string().starts_with(prefix)) found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

void add(std::vector<RealLine>& lines, const std::string& name, const acquire::RawCurve& raw) {
  auto line = acquire::acquire_key_line(raw);
  if (line)
    lines.push_back({name, std::move(*line)});
  else
    ADD_FAILURE() << name << ": " << line.error().message;
}

void add_file(std::vector<RealLine>& lines, const std::filesystem::path& path) {
  const auto curves = exchange::read_points(path);
  if (!curves) {
    ADD_FAILURE() << path << ": " << curves.error().message;
    return;
  }
  for (const acquire::RawCurve& raw : *curves)
    add(lines, path.stem().string() + (curves->size() > 1 ? " " + raw.id : ""), raw);
}

/// The curve among `rest` with an end nearest to `at`, taken out of it and turned to start there.
curve::Bezier2 take_nearest(std::vector<curve::Bezier2>& rest, core::Point2 at) {
  std::size_t best = 0;
  bool turned = false;
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    for (const bool other : {false, true}) {
      const auto& control = rest[i].control;
      const double gap = core::distance(other ? control.back() : control.front(), at);
      if (gap >= least) continue;
      least = gap;
      best = i;
      turned = other;
    }
  }
  curve::Bezier2 found = rest[best];
  rest.erase(rest.begin() + static_cast<long>(best));
  if (turned) std::reverse(found.control.begin(), found.control.end());
  return found;
}

/// An end that no other curve comes near, where the string must begin; else the first.
core::Point2 loose_end(const std::vector<curve::Bezier2>& all, double reach) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (const core::Point2 end : {all[i].control.front(), all[i].control.back()}) {
      bool met = false;
      for (std::size_t k = 0; k < all.size(); ++k)
        met = met || (k != i && (core::distance(all[k].control.front(), end) < reach ||
                                 core::distance(all[k].control.back(), end) < reach));
      if (!met) return end;
    }
  }
  return all.front().control.front();
}

document::Path string_together(std::vector<curve::Bezier2> rest, double reach) {
  core::Point2 at = loose_end(rest, reach);
  const core::Point2 start = at;
  document::Path path;
  while (!rest.empty()) {
    curve::Bezier2 next = take_nearest(rest, at);
    if (!path.curves.empty()) next.control.front() = at;  // gaps of hand-placed curves
    at = next.control.back();
    path.curves.push_back({next});
  }
  if (core::distance(at, start) < reach) {
    path.closed = true;
    std::get<curve::Bezier2>(path.curves.back().value).control.back() = start;
  }
  return path;
}

}  // namespace

bool real_files_present() { return std::filesystem::is_directory(kFolder / "1_profiles"); }

std::vector<RealLine> profiles(const std::string& folder) {
  std::vector<RealLine> lines;
  for (const auto& path : files_in(kFolder / "1_profiles" / folder)) add_file(lines, path);
  return lines;
}

RealLine profile(const std::string& file, const std::string& id, std::size_t every) {
  const auto curves = exchange::read_points(kFolder / "1_profiles" / file).value();
  acquire::RawCurve raw = curves.front();
  for (const acquire::RawCurve& curve : curves)
    if (curve.id == id) raw = curve;
  acquire::RawCurve thin;
  thin.id = raw.id;
  for (std::size_t i = 0; i < raw.points.size(); i += every) thin.points.push_back(raw.points[i]);
  return {file, acquire::acquire_key_line(thin).value()};
}

std::vector<RealLine> bezier_cars() {
  std::vector<RealLine> lines;
  for (const auto& path : files_in(kFolder / "1_profiles" / "carbezier")) {
    std::vector<curve::Bezier2> curves;
    const json car = read_json(path);
    for (const json& segment : car["segments"]) {
      curve::Bezier2 c;
      for (const json& p : segment["control_points"])
        c.control.push_back({p[0].get<double>(), p[1].get<double>()});
      curves.push_back(c);
    }
    auto line = operations::sampled_line(string_together(curves, 0.05));
    if (line) lines.push_back({path.stem().string(), std::move(*line)});
    if (!line) ADD_FAILURE() << path << ": " << line.error().message;
  }
  return lines;
}

std::vector<RealLine> hull_stations() {
  const json ship = read_json(kFolder / "1_profiles" / "hull" / "gunnerus.json");
  const json& hull = ship["structure"]["hull"];
  const json& table = hull["halfBreadths"]["table"];
  const json& heights = hull["halfBreadths"]["waterlines"];
  const double breadth = 0.5 * hull["attributes"]["BOA"].get<double>();
  const double depth = hull["attributes"]["Depth"].get<double>();
  std::vector<RealLine> lines;
  for (std::size_t s = 0; s < table[0].size(); ++s) {
    acquire::RawCurve raw;
    for (std::size_t w = 0; w < table.size(); ++w) {
      const json& value = table[w][s];
      if (!value.is_number()) continue;
      // Zeros stand for "not there yet": only the last before the hull begins is on it.
      if (value.get<double>() == 0 && !raw.points.empty() && raw.points.back().x == 0)
        raw.points.pop_back();
      raw.points.push_back({breadth * value.get<double>(), depth * heights[w].get<double>(), 0});
    }
    if (raw.points.size() >= 3) add(lines, "station " + std::to_string(s), raw);
  }
  return lines;
}

std::vector<RealLine> car_sections() {
  std::vector<RealLine> lines;
  for (const auto& path : files_in(kFolder / "5_car3d", "drivaernet")) {
    const auto cloud = exchange::read_points(path);
    const auto band = acquire::section_plane(cloud.value().front(), acquire::Axis::y, 0, 0.03);
    add(lines, path.stem().string(), band.value());
  }
  return lines;
}

}  // namespace keyline::fairing::testing
