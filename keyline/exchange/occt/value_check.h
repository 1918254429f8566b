#pragma once

#include <string>
#include <string_view>

namespace keyline::exchange::occt {

/// What a file holds; empty where it cannot be read, which OCCT says better.
std::string text_of(const std::string& file);

/// What the values of a STEP file are: what stands for a number or a name among the parameters of
/// the DATA sections (ISO 10303-21, 6.4); what else may be wrong is OCCT's.
struct StepCheck {
  /// The first value that is written like none, as "line 12: \"abc\" is no value", which OCCT takes
  /// for 0; empty where there is none.
  std::string bad;
  /// The text with numbers like 1e-3 as the standard has them, 1.E-3; empty where all are so.
  std::string mended;
};
StepCheck check_step_values(std::string_view text);

/// The first value that is written like none in an IGES file's directory and the parameters of its
/// geometry (types 100 to 199; IGES 5.3, 2.2.2 and 2.2.4.4), and entities whose count of parameters
/// is known that have more than theirs, as decimal commas make them.
std::string bad_iges_value(std::string_view text);

/// The first line of an IGES file that belongs to no section, as one with a column more or less
/// does (IGES 5.3, 2.2.1), as what is not read of it; empty where there is none.
std::string odd_iges_line(std::string_view text);

/// The first line of an IGES file whose number is not the next of its section (IGES 5.3, 2.2.1):
/// one before it is lost, stands twice or elsewhere; empty where there is none. Lines without a
/// number are taken as they come.
std::string unordered_iges_line(std::string_view text);

/// What an IGES file lacks at its end, in words: its last line, or parameter lines that the last
/// one counts (IGES 5.3, 2.2.4.6); empty where it is whole. OCCT reads what is there.
std::string missing_iges_end(std::string_view text);

/// What is not read of an IGES file's lines without one end or both (IGES 5.3, 4.13: forms 1 and 2
/// of type 110), whose forms OCCT drops; empty where there are none.
std::string endless_iges_lines(std::string_view text);

}  // namespace keyline::exchange::occt
