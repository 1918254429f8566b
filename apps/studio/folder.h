#pragma once

#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "keyline/core/error.h"
#include "keyline/operations/operation.h"

/// The one folder whose files the studio reads and writes.
namespace keyline::studio {

class Folder {
 public:
  /// `named`: files given at the start, allowed wherever they lie.
  Folder(const std::filesystem::path& root, const std::vector<std::string>& named);

  /// Where the name leads, links followed. Fails: bad_input where that is outside.
  core::Result<std::string> place_of(const std::string& name) const;

  /// Whether the file was named at the start or allowed since. Any thread.
  bool is_named(const std::filesystem::path& place) const;

  /// The request with every file in it at its place. An operation that reads or writes files names
  /// them in "file" and "library". Fails as place_of; unsupported where it would use a file of its
  /// own choice.
  core::Result<void> confine(const operations::Operation& operation, nlohmann::json& request) const;

  /// One more file that may be used wherever it lies. Any thread, like place_of.
  void allow(const std::filesystem::path& file);

  const std::filesystem::path& root() const { return root_; }

 private:
  std::filesystem::path root_;
  mutable std::mutex mutex_;
  std::vector<std::filesystem::path> named_;
};

/// A folder of its own that nobody else reads, gone with it.
class Scratch {
 public:
  Scratch();
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  std::filesystem::path file(const std::string& name) const { return folder_ / name; }

 private:
  std::filesystem::path folder_;
};

/// The last part of a name from outside, fit to be a file's: no folder, nothing hidden.
std::string plain_name(const std::string& name);

std::string contents(const std::filesystem::path& file);

}  // namespace keyline::studio
