#include <cstdlib>

#include "keyline/library/library.h"

namespace keyline::library {
namespace {

std::filesystem::path folder_named(const char* variable) {
  const char* value = std::getenv(variable);
  return value && *value ? std::filesystem::path(value) : std::filesystem::path();
}

}  // namespace

std::filesystem::path default_file() {
  if (auto named = folder_named("KEYLINE_LIBRARY"); !named.empty()) return named;
  std::filesystem::path data = folder_named("XDG_DATA_HOME");
  if (data.empty()) {
    const std::filesystem::path home = folder_named("HOME");
    if (home.empty()) return {};
    data = home / ".local" / "share";
  }
  return data / "keyline" / "library.kl";
}

}  // namespace keyline::library
