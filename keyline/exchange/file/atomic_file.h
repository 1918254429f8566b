#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "keyline/core/error.h"

namespace keyline::exchange {

/// Files that appear together or not at all.
///
/// Every one is written beside its target under a name nobody can guess (O_EXCL, readable to its
/// owner alone until it has the rights of what it replaces), synced, and takes its place by
/// renaming when all are there: a target holds what it held before or the whole new content,
/// whatever ends the program. What a killed run left beside a target is swept by the next one that
/// writes there; a lock tells what belongs to a run that still lives. A target that is no regular
/// file (a pipe, a terminal) is written directly, behind the others; so is standard output ("-",
/// or "svg:-").
class OutputFiles {
 public:
  OutputFiles() = default;
  OutputFiles(const OutputFiles&) = delete;
  OutputFiles& operator=(const OutputFiles&) = delete;
  /// What is not in place yet is dropped.
  ~OutputFiles();

  /// Puts the content beside `path`. Fails: io with the system's reason.
  core::Result<void> add(const std::filesystem::path& path, std::string_view content);
  /// Puts all in place. Fails: io; then every target holds what it held before.
  core::Result<void> commit();

 private:
  struct File {
    std::filesystem::path named;   ///< as it was asked for
    std::filesystem::path target;  ///< what a link leads to
    std::filesystem::path beside;  ///< empty: written directly
    std::filesystem::path backup;  ///< what the target held; empty: nothing
    std::string content;           ///< of what is written directly
    int lock = -1;
    int backup_lock = -1;
    bool standard = false;  ///< goes to standard output
    bool fresh = false;     ///< there was no target
    bool placed = false;
  };
  core::Result<void> place(File& file);
  void put_back();

  std::vector<File> files_;
};

/// io where `path` cannot be written: a folder, no folder around it, no right to. Nothing is
/// written.
core::Result<void> check_writable(const std::filesystem::path& path);

/// A new file of ours beside the system's temporary ones, locked while `lock` is open and swept by
/// the next run where this one is killed. Fails: io.
struct TemporaryFile {
  std::filesystem::path path;
  int lock = -1;
};
core::Result<TemporaryFile> temporary_file(const std::string& extension);

/// The whole content to an open file; false with errno.
bool write_all(int file, std::string_view content);

/// One file, in place at once.
core::Result<void> write_atomically(const std::filesystem::path& path, std::string_view content);

}  // namespace keyline::exchange
