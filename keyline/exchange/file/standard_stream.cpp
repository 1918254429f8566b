#include "keyline/exchange/file/standard_stream.h"

#include <string>

#include "keyline/exchange/text/ascii.h"

namespace keyline::exchange {

bool is_standard_stream(const std::filesystem::path& file) {
  const std::string& name = file.native();
  return name == "-" || (name.ends_with(":-") && name.find('/') == std::string::npos);
}

std::string extension_of(const std::filesystem::path& file) {
  const std::string& name = file.native();
  if (name == "-") return ".json";
  return detail::lower_case(is_standard_stream(file) ? "." + name.substr(0, name.size() - 2)
                                                     : file.extension().string());
}

}  // namespace keyline::exchange
