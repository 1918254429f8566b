#include "recovery.h"

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include "folder.h"

namespace keyline::studio {

namespace fs = std::filesystem;
using core::Result;

namespace {

std::unexpected<core::Failure> unkept(const fs::path& file) {
  return core::fail(core::ErrorCode::io,
                    "the work cannot be kept: " + std::generic_category().message(errno),
                    "free space or give the folder rights", file.string());
}

bool write_synced(const fs::path& file, const std::string& text) {
  constexpr mode_t kOwnerOnly = 0600;
  const int out = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, kOwnerOnly);
  if (out < 0) return false;
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t n = ::write(out, text.data() + done, text.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) break;
    done += static_cast<std::size_t>(n);
  }
  const bool synced = done == text.size() && ::fsync(out) == 0;
  return ::close(out) == 0 && synced;
}

/// FNV-1a: the same folder, the same file, in every run.
std::uint64_t hash_of(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

}  // namespace

Result<void> Recovery::keep(const std::string& text) {
  const std::scoped_lock lock(mutex_);
  std::error_code ignored;
  fs::create_directories(file_.parent_path(), ignored);
  const fs::path beside = file_.string() + ".new";
  if (!write_synced(beside, text)) return unkept(beside);
  if (std::rename(beside.c_str(), file_.c_str()) != 0) return unkept(file_);
  return {};
}

std::string Recovery::kept() const {
  const std::scoped_lock lock(mutex_);
  return contents(file_);
}

fs::path recovery_file(const fs::path& root) {
  const char* state = std::getenv("XDG_STATE_HOME");
  const char* home = std::getenv("HOME");
  fs::path folder = fs::temp_directory_path();
  if (state != nullptr && *state != '\0')
    folder = state;
  else if (home != nullptr && *home != '\0')
    folder = fs::path(home) / ".local/state";
  char name[32];
  std::snprintf(name, sizeof name, "%016llx.json",
                static_cast<unsigned long long>(hash_of(root.string())));
  return folder / "keyline/studio" / name;
}

}  // namespace keyline::studio
