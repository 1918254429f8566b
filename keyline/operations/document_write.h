#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "keyline/exchange/document_file.h"
#include "keyline/operations/document_read.h"

/// Documents into files: document.write, document.convert.
namespace keyline::operations {

/// How a format takes what it cannot hold as it is.
struct FormatOptions {
  double tolerance = 0;
  bool polylines = false;
  bool grid = false;
  std::optional<int> samples;
  /// Formats that ask.
  static constexpr unsigned kDxf = 1;
  static constexpr unsigned kGlif = 2;
  static constexpr unsigned kCsv = 4;
  static constexpr auto uses() {
    return std::array{use<&FormatOptions::polylines>(kDxf), use<&FormatOptions::grid>(kGlif),
                      use<&FormatOptions::samples>(kCsv)};
  }
  static constexpr auto describe() {
    using Options = FormatOptions;
    return core::fields(
        core::field<&Options::tolerance>(
            "largest deviation where a format cannot hold a curve as it is; 1e-5 of the longest "
            "curve unless given")
            .in("length")
            .within(core::kPositive),
        core::field<&Options::polylines>("for dxf: write polylines in place of splines"),
        core::field<&Options::grid>("for glif: put nodes and handles on whole numbers"),
        core::field<&Options::samples>(
            "for csv: points of every curve that is no polyline, more where it has more corners; "
            "1001 unless given")
            .within(core::from_to(2, 10'000'000)));
  }
};

struct WriteRequest {
  std::vector<std::string> file;
  std::string unit;
  std::vector<NamedCurve> curves;
  std::vector<NamedSurfaceValue> surfaces;
  std::optional<Page> page;
  bool on_page = false;
  FormatOptions format;
  static constexpr auto describe() {
    using Request = WriteRequest;
    return core::fields(
        core::field<&Request::file>("to write; the extension chooses the format: svg, json, csv, "
                                    "dxf, step, iges, glif, pdf")
            .count(1)
            .or_bare_item()
            .needed(),
        core::field<&Request::unit>("of all lengths; empty: none"),
        core::field<&Request::curves>("in the plane or in space"),
        core::field<&Request::surfaces>("Bezier or B-spline"),
        core::field<&Request::page>("what a drawing shows; else tight around the curves"),
        core::field<&Request::on_page>(
            "svg: coordinates count from the page's upper left corner, as pixels of a picture do"),
        core::flattened<&Request::format>());
  }
};

struct WrittenFile {
  std::string file;
  double deviation = 0;
  std::vector<std::string> notes;
  static constexpr auto describe() {
    return core::fields(
        core::field<&WrittenFile::file>("as asked for"),
        core::field<&WrittenFile::deviation>("of what is not exact in it").in("length"),
        core::field<&WrittenFile::notes>("what the format could not hold, in words"));
  }
};

struct WriteAnswer {
  std::vector<WrittenFile> written;
  std::vector<std::string> unused;
  static constexpr auto describe() {
    return core::fields(core::field<&WriteAnswer::written>("one for each file"),
                        core::field<&WriteAnswer::unused>(
                            "fields given that have no use for these formats, or for the input"));
  }
};

/// Which were given and have no use for any of the files.
std::vector<std::string> unused_of(const FormatOptions& options,
                                   const std::vector<std::string>& files);

/// What a request writes, as a document.
document::Document document_of(const WriteRequest& request);

/// What was read as a document; measured points as polylines.
document::Document document_of(const ReadAnswer& read);

/// The document in the format of `extension`. Formats of the plane (svg, glif, pdf) show, where
/// there is no planar curve, space curves in the coordinates of their own planes, and say so.
/// Fails: as exchange::format_document().
core::Result<exchange::Written> formatted(const document::Document& document,
                                          const std::string& extension,
                                          const FormatOptions& options, bool on_page = false,
                                          const core::CancellationToken& cancellation = {});

/// The formats there are, as extensions with their dot.
std::vector<std::string> document_extensions();

}  // namespace keyline::operations
