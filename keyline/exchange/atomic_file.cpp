#include "keyline/exchange/atomic_file.h"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>

#include <unistd.h>

namespace keyline::exchange {
namespace {

namespace fs = std::filesystem;

/// Removes the file beside the target unless it was renamed.
class Leftover {
 public:
  explicit Leftover(fs::path path) : path_(std::move(path)) {}
  Leftover(const Leftover&) = delete;
  Leftover& operator=(const Leftover&) = delete;
  ~Leftover() {
    std::error_code ignored;
    if (!kept_) fs::remove(path_, ignored);
  }
  void keep() { kept_ = true; }

 private:
  fs::path path_;
  bool kept_ = false;
};

core::Result<void> unwritable(const fs::path& path, const std::string& reason) {
  return core::fail(core::ErrorCode::io, "cannot be written: " + reason,
                    "check that the folder exists, is writable and has room", path.string());
}

std::string reason_of(int error) {
  return error == 0 ? "unknown reason" : std::generic_category().message(error);
}

core::Result<void> write_to(const fs::path& target, const fs::path& named,
                            const std::function<core::Result<void>(std::ostream&)>& write) {
  errno = 0;
  std::ofstream out(target, std::ios::binary | std::ios::trunc);
  if (!out) return unwritable(named, reason_of(errno));
  if (auto written = write(out); !written) return written;
  out.flush();
  const int error = errno;
  out.close();
  if (!out) return unwritable(named, reason_of(error));
  return {};
}

}  // namespace

core::Result<void> write_atomically(const fs::path& path,
                                    const std::function<core::Result<void>(std::ostream&)>& write) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) return unwritable(path, "it is a folder");
  if (fs::exists(status) && !fs::is_regular_file(status)) return write_to(path, path, write);
  // A link keeps pointing where it did: the file it names is the one replaced.
  const fs::path target = fs::is_symlink(fs::symlink_status(path, error)) && fs::exists(status)
                              ? fs::canonical(path, error)
                              : path;
  if (fs::exists(status) && ::access(target.c_str(), W_OK) != 0) {
    return unwritable(path, reason_of(errno));
  }
  static std::atomic<unsigned> serial{0};
  // Short, so that it fits wherever the target's own name does.
  const fs::path beside = target.parent_path() / (".keyline" + std::to_string(::getpid()) + "-" +
                                                  std::to_string(serial++) + ".part");
  Leftover leftover(beside);
  if (auto written = write_to(beside, path, write); !written) return written;
  if (fs::exists(status)) fs::permissions(beside, status.permissions(), error);
  fs::rename(beside, target, error);
  if (error) return unwritable(path, error.message());
  leftover.keep();
  return {};
}

core::Result<void> write_atomically(const fs::path& path, std::string_view content) {
  return write_atomically(path, [content](std::ostream& out) -> core::Result<void> {
    out.write(content.data(), static_cast<std::streamsize>(content.size()));
    return {};
  });
}

}  // namespace keyline::exchange
