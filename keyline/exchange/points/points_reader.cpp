#include "keyline/exchange/points/points_reader.h"

#include <utility>

#include "keyline/exchange/file/read_file.h"
#include "keyline/exchange/points/points_kind.h"
#include "keyline/exchange/points/points_table.h"
#include "keyline/exchange/text/line_reader.h"

namespace keyline::exchange {

namespace {

core::Result<PointsFile> read(std::istream& in, const std::string& name,
                              const PointsOptions& options) {
  LineReader lines(in, name, options.longest_line);
  detail::PointsTable table(options);
  detail::PointsKind kind;
  while (true) {
    bool end = false;
    const auto line = lines.next(end);
    if (!line) return std::unexpected(line.error());
    if (end) break;
    if (auto sound = kind.take(*line, name); !sound) return std::unexpected(sound.error());
    if (auto taken = table.take(*line, lines.number(), lines.place()); !taken) {
      return std::unexpected(taken.error());
    }
  }
  if (lines.ended_early())
    table.cut_off("line " + std::to_string(lines.number()) + ": what follows the end mark (^Z)");
  auto curves = table.finish(name);
  if (!curves) return std::unexpected(curves.error());
  return PointsFile{std::move(*curves), table.unit()};
}

core::Result<std::vector<acquire::RawCurve>> curves_of(core::Result<PointsFile> file) {
  if (!file) return std::unexpected(file.error());
  return std::move(file->curves);
}

}  // namespace

core::Result<std::vector<acquire::RawCurve>> read_points(std::istream& in, const std::string& name,
                                                         const PointsOptions& options) {
  return curves_of(read(in, name, options));
}

core::Result<std::vector<acquire::RawCurve>> read_points(const std::filesystem::path& path,
                                                         const PointsOptions& options) {
  return curves_of(read_points_file(path, options));
}

core::Result<PointsFile> read_points_file(const std::filesystem::path& path,
                                          const PointsOptions& options) {
  auto in = open_file(path);
  if (!in) return std::unexpected(in.error());
  return read(*in, path.string(), options);
}

}  // namespace keyline::exchange
