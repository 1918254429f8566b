#include "keyline/operations/open_library.h"

namespace keyline::operations {

core::Result<library::Library> open_library(const std::string& named, library::Mode mode) {
  if (!named.empty()) return library::Library::open(named, mode);
  const std::filesystem::path file = library::default_file();
  if (file.empty())
    return core::fail(core::ErrorCode::bad_input, "no library is named", "name its file",
                      "library");
  std::error_code ignored;  // opening tells what is wrong
  if (mode == library::Mode::write)
    std::filesystem::create_directories(file.parent_path(), ignored);
  return library::Library::open(file, mode);
}

}  // namespace keyline::operations
