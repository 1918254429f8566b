#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "keyline/exchange/points/airfoil_points.h"
#include "keyline/exchange/points/points_table.h"

/// Several curves of one table: two sides in its columns, blocks and elements in its rows.
namespace keyline::exchange::detail {

using acquire::RawCurve;

/// Names of which no row shares one with another are those of points, which make one curve: told.
void PointsTable::join_named_points() {
  const auto single = [](const RawCurve& curve) { return curve.points.size() == 1; };
  const bool found = columns_.id != PointsColumns::kNone && options_.id_column.empty();
  if (!found || columns_.two() || curves_.size() < 2 || !std::ranges::all_of(curves_, single))
    return;
  RawCurve all;
  all.has_z = curves_.front().has_z;
  const auto append = [](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  for (const RawCurve& curve : curves_) {
    append(all.points, curve.points);
    append(all.weights, curve.weights);
    append(all.source_lines, curve.source_lines);
  }
  curves_ = {std::move(all)};
  const std::string column = std::to_string(columns_.id + 1);
  left_out_.insert(left_out_.begin(), "column " + column +
                                          ", which names the points (--id-column " + column +
                                          " takes it for names of curves)");
}

/// The columns of two curves, unless others are asked for.
void PointsTable::take_sides() {
  if (!sides_ || !options_.columns.empty()) return;
  columns_.x = sides_->first.x;
  columns_.y = sides_->first.y;
  columns_.x2 = sides_->second.x;
  columns_.y2 = sides_->second.y;
  columns_.z = PointsColumns::kNone;
}

/// The point of the second curve; none where the row ends before its columns.
core::Result<core::Point3> PointsTable::second_of(const Fields& fields,
                                                  const std::string& place) const {
  const auto begin = static_cast<std::size_t>(std::min(columns_.x2, columns_.y2));
  if (columns_.own_x() && style_.separator != ' ' && fields.size() <= begin) {
    constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
    return core::Point3{kMissing, kMissing, 0};
  }
  const auto x = number_in(fields, columns_.x2, place);
  if (!x) return std::unexpected(x.error());
  const auto y = number_in(fields, columns_.y2, place);
  if (!y) return std::unexpected(y.error());
  return core::Point3{*x, *y, 0};
}

/// Appends a row's point; of sides that have an x each the shorter one has neither number there.
void PointsTable::put(RawCurve& curve, core::Point3 p, double weight, int number) const {
  if (columns_.own_x() && std::isnan(p.x) && std::isnan(p.y)) return;
  curve.points.push_back(p);
  curve.source_lines.push_back(number);
  if (columns_.weight != PointsColumns::kNone) curve.weights.push_back(weight);
}

void PointsTable::meet_blank(int number) {
  if (!started_) return;
  const bool next = !blanks_.empty() && blanks_.back().first + blanks_.back().count == number;
  if (next)
    ++blanks_.back().count;
  else
    blanks_.push_back({number, 1});
}

/// A curve for each side, named after its column behind the name of both.
void PointsTable::part_sides() {
  Curves all;
  for (std::size_t i = 0; i < curves_.size(); ++i) {
    const std::string head = curves_[i].id.empty() ? "" : curves_[i].id + "/";
    seconds_[i].notes = curves_[i].notes;
    curves_[i].id = head + sides_->first.name;
    seconds_[i].id = head + sides_->second.name;
    for (RawCurve* side : {&curves_[i], &seconds_[i]})
      if (!side->points.empty()) all.push_back(std::move(*side));
  }
  curves_ = std::move(all);
}

/// Of every curve so far the airfoil, the elements or the blocks that it is.
void PointsTable::part_curves() {
  Curves all;
  for (RawCurve& curve : curves_) {
    const bool airfoil = names_.empty() && unfold_lednicer(curve, left_out_);
    Curves parts;
    parts.push_back(std::move(curve));
    if (names_.empty() && curves_.size() == 1) part_elements(parts);
    if (!airfoil && parts.size() == 1 && columns_.id == PointsColumns::kNone &&
        options_.blank_lines_part)
      part_blocks(parts, blanks_, left_out_);
    for (RawCurve& part : parts) all.push_back(std::move(part));
  }
  curves_ = std::move(all);
}

}  // namespace keyline::exchange::detail
