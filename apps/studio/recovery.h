#pragma once

#include <filesystem>
#include <mutex>
#include <string>

#include "keyline/core/error.h"

/// What is being worked on, kept so that neither a killed browser nor a killed server loses it.
namespace keyline::studio {

class Recovery {
 public:
  explicit Recovery(std::filesystem::path file) : file_(std::move(file)) {}

  /// Replaces what is kept, at once or not at all. Any thread. Fails: io.
  core::Result<void> keep(const std::string& text);
  /// What is kept; empty: nothing.
  std::string kept() const;

 private:
  std::filesystem::path file_;
  mutable std::mutex mutex_;
};

/// The file for what is worked on in that folder: in the user's folder for state
/// (XDG_STATE_HOME, else ~/.local/state, else the folder for temporary files).
std::filesystem::path recovery_file(const std::filesystem::path& root);

}  // namespace keyline::studio
