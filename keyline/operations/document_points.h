#pragma once

#include <string>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/core/progress.h"
#include "keyline/document/select.h"
#include "keyline/exchange/file/read_file.h"
#include "keyline/exchange/mesh/section_file.h"
#include "keyline/operations/document_read.h"

/// Internals of document_read.cpp: files of measured points.
namespace keyline::operations {

/// The result; a failure names that file.
template <class T>
core::Result<T> in_file(core::Result<T> result, const std::string& file) {
  if (result) return result;
  return std::unexpected(exchange::in_file(result.error(), file));
}

/// Which of the curves are wanted, by name, name of what they are parts of, or number from 1.
/// Fails: bad_input where none is.
template <class Curve>
core::Result<std::vector<bool>> wanted_of(const std::vector<Curve>& curves,
                                          const std::string& wanted) {
  std::vector<document::Label> labels;
  std::vector<std::string> names;
  for (const Curve& curve : curves) {
    labels.push_back({curve.id, {}, {}});
    names.push_back(curve.id);
  }
  auto keep = document::chosen(labels, wanted);
  if (keep.empty()) return std::unexpected(document::nothing_named(wanted, names));
  return keep;
}

/// The unit that is asked for in place of the file's own. Numbers stay: where the file tells
/// another one, that is told.
inline void take_unit(std::string& own, const std::string& asked, std::vector<std::string>& told) {
  if (asked.empty()) return;
  if (!own.empty() && own != asked)
    told.push_back("the file's own unit, " + own + ": its numbers are taken as " + asked);
  own = asked;
}

/// A key-line in its plane's coordinates.
NamedCurve named_line(acquire::KeyLine line);

/// The requested section of a cloud or mesh.
core::Result<exchange::FileSection> cut_file(const InputRequest& input, const std::string& file);

/// The key-lines of a table, or the one that several files are parts of: in their planes where
/// `planar` is set, else where they lie in space.
core::Result<ReadAnswer> read_points_input(const InputRequest& input,
                                           const core::CancellationToken& cancellation);

}  // namespace keyline::operations
