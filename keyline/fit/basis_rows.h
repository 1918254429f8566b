#pragma once

#include <array>
#include <cstddef>
#include <span>

/// B-splines at many data at once.
namespace keyline::fit::detail {

inline constexpr std::size_t kLanes = 4;  // rows are padded to a multiple, so that loops vectorise

constexpr std::size_t padded(std::size_t n) { return (n + kLanes - 1) / kLanes * kLanes; }

/// Calls call.template operator()<order>() for an order from 2 to 8.
template <class Call>
auto with_order(int order, Call call) {
  switch (order) {
    case 2:
      return call.template operator()<2>();
    case 3:
      return call.template operator()<3>();
    case 4:
      return call.template operator()<4>();
    case 5:
      return call.template operator()<5>();
    case 6:
      return call.template operator()<6>();
    case 7:
      return call.template operator()<7>();
    default:
      return call.template operator()<8>();
  }
}

/// Rows of the observation matrix for the data at `x`, all in one knot span, times their weights (a
/// null pointer: 1): column c from out + c * stride on, padded with zeros. The divided differences
/// of knots are the same for all of them.
template <int order>
void basis_rows(const double* knots, std::size_t span, std::span<const double> x,
                const double* weights, double* out, std::size_t stride) {
  std::array<std::array<double, order>, order> inverse{};
  for (int r = 1; r < order; ++r) {
    for (int j = 0; j < r; ++j) {
      const std::size_t right = span + 1 + static_cast<std::size_t>(j);
      inverse[r][j] = 1 / (knots[right] - knots[right - static_cast<std::size_t>(r)]);
    }
  }
  for (std::size_t i = 0; i < x.size(); i += kLanes) {
    double value[order][kLanes];
    double at[kLanes];
    for (std::size_t l = 0; l < kLanes; ++l) {
      const bool inside = i + l < x.size();
      at[l] = inside ? x.data()[i + l] : knots[span];
      value[0][l] = inside ? (weights ? weights[i + l] : 1.0) : 0.0;
    }
    for (int r = 1; r < order; ++r) {
      double saved[kLanes] = {};
      for (int j = 0; j < r; ++j) {
        const std::size_t right = span + 1 + static_cast<std::size_t>(j);
        const double t1 = knots[right];
        const double t0 = knots[right - static_cast<std::size_t>(r)];
        for (std::size_t l = 0; l < kLanes; ++l) {
          const double part = value[j][l] * inverse[r][j];
          value[j][l] = saved[l] + (t1 - at[l]) * part;
          saved[l] = (at[l] - t0) * part;
        }
      }
      for (std::size_t l = 0; l < kLanes; ++l) value[r][l] = saved[l];
    }
    for (int c = 0; c < order; ++c) {
      for (std::size_t l = 0; l < kLanes; ++l)
        out[static_cast<std::size_t>(c) * stride + i + l] = value[c][l];
    }
  }
}

}  // namespace keyline::fit::detail
