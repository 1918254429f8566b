#include "keyline/exchange/file/standard_stream.h"

#include <algorithm>
#include <cctype>

namespace keyline::exchange {

bool is_standard_stream(const std::filesystem::path& file) {
  const std::string& name = file.native();
  return name == "-" || (name.ends_with(":-") && name.find('/') == std::string::npos);
}

std::string extension_of(const std::filesystem::path& file) {
  const std::string& name = file.native();
  if (name == "-") return ".json";
  std::string extension =
      is_standard_stream(file) ? "." + name.substr(0, name.size() - 2) : file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return c < 0x80 ? std::tolower(c) : c; });
  return extension;
}

}  // namespace keyline::exchange
