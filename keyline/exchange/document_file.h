#pragma once

#include <filesystem>
#include <string>

#include "keyline/core/error.h"
#include "keyline/core/progress.h"
#include "keyline/document/document.h"
#include "keyline/exchange/file/read_file.h"
#include "keyline/exchange/file/written.h"
#include "keyline/exchange/format/format.h"

/// Files of every format to documents and back.
namespace keyline::exchange {

struct ReadOptions {
  std::string glyphs;  ///< of a font; see read_font()
  core::CancellationToken cancellation = {};
};

/// Everything a file holds, in its own unit, transforms applied. The format is that of the
/// extension, or, where it says nothing, of the content. Tables of points become polylines; nothing
/// is sorted or dropped (room acquire does that).
/// Returns: a document that holds something; `skipped` lists what it does not hold.
/// Fails: io for files that cannot be read, bad_input with "file:line" or "file: place" for
///        contents; bad_input where there is nothing in it to read; cancelled.
core::Result<document::Document> read_document(const std::filesystem::path& file,
                                               const ReadOptions& options = {});

struct WriteOptions {
  double tolerance = 0;    ///< largest deviation; 0: 1e-5 of the longest thing in the document
  int samples = 1001;      ///< rows per curve of a table
  bool polylines = false;  ///< dxf: polylines in place of splines
  bool grid = false;       ///< glif: whole numbers
  core::CancellationToken cancellation = {};
};

/// The document in the format of `extension` (with its dot, of written_extensions(), or ".pdf": the
/// planar curves in real size).
/// Exact curves stay exact where the format has them; the deviation of the rest is in the answer.
/// Fails: bad_input for other extensions and for what the format's writer refuses; cancelled.
core::Result<Written> format_document(const document::Document& document,
                                      const std::string& extension,
                                      const WriteOptions& options = {});

/// The same into a file, which is written whole or not at all; `content` of the answer is empty.
core::Result<Written> write_document(const document::Document& document,
                                     const std::filesystem::path& file,
                                     const WriteOptions& options = {});

/// Diagonal of the box around control points and samples of everything in the document; 0 for
/// nothing.
double extent(const document::Document& document);

}  // namespace keyline::exchange
