#pragma once

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "keyline/core/describe.h"
#include "keyline/core/error.h"

#include "option_files.h"

/// Options of a command line made from described fields: --must-pass 3,8 for must_pass.
namespace keyline::app {

/// The words parted by spaces.
std::string joined(const std::vector<std::string>& words);

/// "must_pass" as "--must-pass".
std::string option_name(std::string_view field);

/// What was typed for a field as the JSON its reader takes: numbers, points 1,2, lists 1,2,3 or
/// several words, ranges a:b, words of a choice; curves and surfaces as the name of a file that
/// holds one, FILE or FILE#NAME, read into `files`; in a list of curves or surfaces a FILE stands
/// for all of its own. JSON itself where it begins with [ or {. No word at all is `true`.
/// Fails: bad_input with the option as path, or as OptionFiles does.
core::Result<nlohmann::json> value_of(const core::Field& field,
                                      const std::vector<std::string>& words, OptionFiles& files);

/// An option as help, completion and manual pages tell it.
struct OptionText {
  std::string name;                       ///< "--alpha"
  std::string value = {};                 ///< "NUMBER"; empty: it takes none
  std::string text = {};                  ///< "slope of … (radian; 0 to 1; default 0.5)"
  std::vector<std::string> choices = {};  ///< words it may take
  bool file = false;                      ///< its value is the name of a file
  bool deniable = false;                  ///< a flag that --no- turns off: on, or found, by itself
};
OptionText option_text(const core::Field& field, const void* member);

/// The name as help shows it: "--[no-]keep-corners" where --no- says something.
std::string shown_name(const OptionText& option);

/// One line of help: "--alpha NUMBER  slope of … (radian; 0 to 1; default 0.5)".
std::string help_line(const OptionText& option);

/// Whether a word can be an item of a list of numbers, points and the like.
bool is_number_like(const core::Type& item, const std::string& word);

/// A failure of the library, its field as the option that was typed, where there is such an option.
core::Failure as_options(core::Failure failure,
                         const std::function<bool(const std::string&)>& is_option);

}  // namespace keyline::app
