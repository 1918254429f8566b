#pragma once

#include <string>
#include <utility>
#include <vector>

namespace keyline::presentation {

/// What a report says of the run it tells about.
struct ReportOptions {
  std::string title = {};     ///< empty: the kind of report and the key-line's name
  std::string subtitle = {};  ///< the input file, for example
  std::string unit = {};      ///< of length, "mm"; empty: none stated
  std::string command = {};   ///< command line that repeats the run; may be empty
  std::vector<std::pair<std::string, std::string>> options = {};  ///< in force, name and value
  std::string generator = {};                                     ///< the program and its version
};

}  // namespace keyline::presentation
