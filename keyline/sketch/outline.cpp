#include "keyline/sketch/outline.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "keyline/sketch/polyline_tools.h"
#include "keyline/sketch/whittaker.h"

namespace keyline::sketch {
namespace {

using core::Point2;
using core::Vector2;

constexpr double kWavelength = 6;  ///< of the pixels' staircase, which is smoothed away

/// Border pixels of every piece of ink in order, moved out by the half pixel that they reach
/// beyond their centres.
std::vector<std::vector<Point2>> borders(const Binary& ink) {
  cv::Mat mask(ink.height + 2, ink.width + 2, CV_8U, cv::Scalar(0));
  cv::Mat(ink.height, ink.width, CV_8U, const_cast<std::uint8_t*>(ink.data.data()))
      .copyTo(mask(cv::Rect(1, 1, ink.width, ink.height)));
  std::vector<std::vector<cv::Point>> found;
  cv::findContours(mask, found, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  std::vector<std::vector<Point2>> all;
  for (const auto& contour : found) {
    if (contour.size() < 12) continue;
    std::vector<Point2> points;
    for (const cv::Point& p : contour) points.push_back({p.x - 0.5, p.y - 0.5});
    all.push_back(std::move(points));
  }
  return all;
}

double area_of(const std::vector<Point2>& p) {
  double area = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    area += 0.5 * core::cross(p[i] - Point2{}, p[(i + 1) % p.size()] - Point2{});
  return area;
}

}  // namespace

Binary laplacian_edges(const Binary& ink) {
  const cv::Mat mask(ink.height, ink.width, CV_8U, const_cast<std::uint8_t*>(ink.data.data()));
  cv::Mat second;
  cv::Laplacian(mask, second, CV_16S, 1, 1, 0, cv::BORDER_REPLICATE);
  Binary edges(ink.width, ink.height);
  for (int y = 0; y < ink.height; ++y)
    for (int x = 0; x < ink.width; ++x)
      edges.at(x, y) = ink.at(x, y) && second.at<short>(y, x) != 0 ? 1 : 0;
  return edges;
}

std::vector<FineStroke> outlines(const Binary& ink, const Tone& tone) {
  const Refiner refiner(tone);
  std::vector<FineStroke> strokes;
  for (std::vector<Point2>& border : borders(ink)) {
    const std::vector<double> ones(border.size(), 1);
    const double lambda = lambda_of_wavelength(kWavelength);
    std::vector<Point2> line = smooth_points(border, ones, lambda, true);
    const double outward = area_of(line) > 0 ? -1 : 1;  // of the left normal
    const std::size_t n = line.size();
    std::vector<Point2> moved = line;
    for (std::size_t i = 0; i < n; ++i) {
      const Vector2 d = line[(i + 2) % n] - line[(i + n - 2) % n];
      if (!(core::norm(d) > 0)) continue;
      const Vector2 out = outward * core::perpendicular_left(d) / core::norm(d);
      moved[i] = line[i] + refiner.edge_offset(line[i], out) * out;
    }
    line = smooth_points(moved, ones, lambda, true);
    FineStroke stroke;
    stroke.closed = true;
    stroke.wave = kWavelength;
    resample(line, std::vector<double>(n, 0), 1.0, true, stroke.points, stroke.widths);
    strokes.push_back(std::move(stroke));
  }
  return strokes;
}

}  // namespace keyline::sketch
