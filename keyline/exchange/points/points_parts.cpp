#include "keyline/exchange/points/points_parts.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "keyline/exchange/points/airfoil_points.h"

namespace keyline::exchange::detail {

using acquire::RawCurve;
using Curves = std::vector<RawCurve>;

void join_named_points(Curves& curves, int column, std::vector<std::string>& left_out) {
  const auto single = [](const RawCurve& curve) { return curve.points.size() == 1; };
  if (curves.size() < 2 || !std::ranges::all_of(curves, single)) return;
  RawCurve all;
  all.has_z = curves.front().has_z;
  const auto append = [](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  for (const RawCurve& curve : curves) {
    append(all.points, curve.points);
    append(all.weights, curve.weights);
    append(all.source_lines, curve.source_lines);
  }
  curves = {std::move(all)};
  const std::string number = std::to_string(column + 1);
  left_out.insert(left_out.begin(), "column " + number + ", which names the points (--id-column " +
                                        number + " takes it for names of curves)");
}

Curves sides_of(Curves first, Curves second, const Sides& sides) {
  Curves all;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const std::string head = first[i].id.empty() ? "" : first[i].id + "/";
    second[i].notes = first[i].notes;
    first[i].id = head + sides.first.name;
    second[i].id = head + sides.second.name;
    for (RawCurve* side : {&first[i], &second[i]})
      if (!side->points.empty()) all.push_back(std::move(*side));
  }
  return all;
}

Curves parts_of(Curves curves, bool by_shape, const std::vector<BlankLines>& blanks,
                std::vector<std::string>& left_out) {
  Curves all;
  for (RawCurve& curve : curves) {
    const bool airfoil = by_shape && unfold_lednicer(curve, left_out);
    Curves parts;
    parts.push_back(std::move(curve));
    if (by_shape && curves.size() == 1) part_elements(parts);
    if (!airfoil && parts.size() == 1 && !blanks.empty()) part_blocks(parts, blanks, left_out);
    for (RawCurve& part : parts) all.push_back(std::move(part));
  }
  return all;
}

}  // namespace keyline::exchange::detail
