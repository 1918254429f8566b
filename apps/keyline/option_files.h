#pragma once

#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "keyline/core/error.h"
#include "keyline/operations/common_unit.h"
#include "keyline/operations/perform.h"

/// Curves and surfaces that stand in options as the name of a file.
namespace keyline::app {

/// A curve of document.read as a request for one curve has it.
nlohmann::json curve_of(const nlohmann::json& thing);

/// FILE or FILE#NAME.
struct FileWord {
  std::string file;
  std::string thing;  ///< empty: any
};

/// What stands behind a # is a name, unless a file is called so; both may hold more of them.
FileWord parted(const std::string& word);

class OptionFiles {
 public:
  enum class Kind { curves, surfaces };

  /// All curves or surfaces of FILE, or of FILE#NAME what document.read selects by that; at least
  /// one. A file is read once. Fails: as document.read does; bad_input where there is none, or
  /// where it is in another unit than the files before. `option` is the one it stands in.
  core::Result<std::vector<nlohmann::json>> all(const std::string& word, Kind kind,
                                                const std::string& option);
  /// The first of them; where there are more, that is noted.
  core::Result<nlohmann::json> first(const std::string& word, Kind kind, const std::string& option);

  /// What was read, for what it tells, and which of several was taken.
  const std::map<std::string, operations::Outcome>& read() const { return read_; }
  const std::vector<std::string>& notes() const { return notes_; }
  /// Of all of them; empty where none tells one.
  const std::string& unit() const { return unit_.name(); }

 private:
  core::Result<const operations::Outcome*> outcome_of(const std::string& word);

  std::map<std::string, operations::Outcome> read_;  ///< by word
  std::vector<std::string> notes_;
  operations::CommonUnit unit_;
};

}  // namespace keyline::app
