#include "keyline/fairing/sideways.h"

#include <algorithm>

namespace keyline::fairing::detail {

std::vector<CellMean> means_of(const DenseCurve& curve, int first, int last) {
  const int count = static_cast<int>(curve.joints.size()) - 1;
  std::vector<CellMean> cells;
  for (int i = first; i < last; ++i) {
    const int c = (i + count) % count;
    const double sum = curve.joints[c].curvature + curve.joints[c + 1].curvature;
    cells.push_back({sum / 2, curve.at[c + 1] - curve.at[c]});
  }
  return cells;
}

double sideways(std::span<const CellMean> cells, double curvature) {
  std::vector<double> off{0}, place{0};
  double turn = 0;
  for (const CellMean& cell : cells) {
    const double bend = cell.curvature - curvature;
    off.push_back(off.back() + cell.width * (turn + cell.width * bend / 2));
    place.push_back(place.back() + cell.width);
    turn += cell.width * bend;
  }
  double low = 0, high = 0;
  for (std::size_t i = 0; i < off.size(); ++i) {
    const double from_chord = off[i] - off.back() * place[i] / place.back();
    low = std::min(low, from_chord);
    high = std::max(high, from_chord);
  }
  return (high - low) / 2;
}

}  // namespace keyline::fairing::detail
