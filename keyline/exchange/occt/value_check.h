#pragma once

#include <string>
#include <string_view>

namespace keyline::exchange::occt {

/// What a file holds; empty where it cannot be read, which OCCT says better.
std::string text_of(const std::string& file);

/// The first value of a STEP file that is written like none, as "line 12: \"abc\" is no value";
/// empty where there is none. OCCT takes such for 0. Looked at: what stands for a number or a name
/// among the parameters of the DATA sections (ISO 10303-21, 6.4); what else may be wrong is OCCT's.
std::string bad_step_value(std::string_view text);

/// The same for an IGES file's directory and the parameters of its geometry (types 100 to 199; IGES
/// 5.3, 2.2.2 and 2.2.4.4), and arcs, lines, points and lists of points that have more than theirs,
/// as decimal commas make them.
std::string bad_iges_value(std::string_view text);

/// The first line of an IGES file that belongs to no section, as one with a column more or less
/// does (IGES 5.3, 2.2.1), as what is not read of it; empty where there is none.
std::string odd_iges_line(std::string_view text);

/// What an IGES file lacks at its end, in words: its last line, or parameter lines that the last
/// one counts (IGES 5.3, 2.2.4.6); empty where it is whole. OCCT reads what is there.
std::string missing_iges_end(std::string_view text);

}  // namespace keyline::exchange::occt
