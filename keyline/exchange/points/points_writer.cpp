#include "keyline/exchange/points/points_writer.h"

#include <array>
#include <charconv>
#include <sstream>

#include "keyline/exchange/file/atomic_file.h"

namespace keyline::exchange {

std::string shortest(double value) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end.ptr};
}

void write_points(std::ostream& out, std::span<const core::Point2> points,
                  std::span<const double> weights) {
  if (!weights.empty() && weights.size() != points.size()) {
    throw core::InvalidInput("write_points needs one weight for each point");
  }
  out << (weights.empty() ? "x,y\n" : "x,y,weight\n");
  for (std::size_t i = 0; i < points.size(); ++i) {
    out << shortest(points[i].x) << ',' << shortest(points[i].y);
    if (!weights.empty()) out << ',' << shortest(weights[i]);
    out << '\n';
  }
}

void write_points(std::ostream& out, std::span<const core::Point3> points) {
  out << "x,y,z\n";
  for (const core::Point3& p : points) {
    out << shortest(p.x) << ',' << shortest(p.y) << ',' << shortest(p.z) << '\n';
  }
}

core::Result<void> write_points(const std::filesystem::path& path,
                                std::span<const core::Point2> points,
                                std::span<const double> weights) {
  std::ostringstream text;
  write_points(text, points, weights);
  return write_atomically(path, text.str());
}

core::Result<void> write_points(const std::filesystem::path& path,
                                std::span<const core::Point3> points) {
  std::ostringstream text;
  write_points(text, points);
  return write_atomically(path, text.str());
}

}  // namespace keyline::exchange
