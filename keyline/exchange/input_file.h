#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "keyline/core/error.h"
#include "keyline/core/progress.h"

namespace keyline::exchange {

/// A file that can be opened again and again, whatever was named.
///
/// Readers look at a file's start, then read it, some twice; a pipe is empty after the first look.
/// What comes in once ("-", the standard input; a named pipe; /dev/fd/63 of a shell) is therefore
/// copied beside other temporary files first, under the extension its content tells, and the copy
/// is taken away with this object (by the next run, where this one is killed). A regular file is
/// taken as it is.
class InputFile {
 public:
  /// Waits for what a pipe brings, and gives up where progress asks to.
  /// Fails: io where it cannot be opened, read or copied; cancelled; bad_input for devices
  ///        (/dev/zero has no end), for more than 4 GB and for nothing at all.
  static core::Result<InputFile> open(const std::filesystem::path& named,
                                      const core::Progress& progress = {});

  InputFile(InputFile&& other) noexcept;
  InputFile& operator=(InputFile&&) = delete;
  ~InputFile();

  /// The file that readers should open.
  const std::filesystem::path& path() const { return path_; }
  /// A failure of a reader, with the name that the user gave in place of that file's.
  core::Failure as_named(core::Failure failure) const;

 private:
  explicit InputFile(std::filesystem::path named);
  core::Result<void> copy(int from, const core::Progress& progress);
  core::Result<void> begin_copy(std::string_view head);
  std::unexpected<core::Failure> uncopied() const;

  std::string named_;  ///< for people: "standard input" for "-"
  std::filesystem::path path_;
  int lock_ = -1;  ///< of the copy; -1: there is none
};

}  // namespace keyline::exchange
