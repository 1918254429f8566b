#include "keyline/exchange/file/atomic_file.h"

#include <cerrno>
#include <cstdint>
#include <random>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "keyline/exchange/file/standard_stream.h"

namespace keyline::exchange {
namespace {

namespace fs = std::filesystem;
using core::Result;

constexpr std::string_view kStart = ".keyline-";
constexpr std::string_view kEnd = ".part";

std::unexpected<core::Failure> unwritable(const fs::path& path, const std::string& reason) {
  return core::fail(core::ErrorCode::io, "cannot be written: " + reason,
                    "check that the folder exists, is writable and has room", path.string());
}

std::string reason_of(int error) {
  return error == 0 ? "unknown reason" : std::generic_category().message(error);
}

fs::path folder_of(const fs::path& target) {
  return target.has_parent_path() ? target.parent_path() : fs::path(".");
}

/// A name of 128 bits of chance, short enough wherever the target's own name fits.
std::string name_by_chance() {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::random_device chance;
  std::string name(kStart);
  for (int word = 0; word < 4; ++word) {
    const std::uint32_t bits = chance();
    for (int shift = 28; shift >= 0; shift -= 4) name += kDigits[bits >> shift & 15];
  }
  return name.append(kEnd);
}

fs::path name_beside(const fs::path& target) { return folder_of(target) / name_by_chance(); }

/// What a link leads to, there already or not; a link where they lead round in circles.
fs::path target_of(fs::path path) {
  constexpr int kMost = 40;  // as Linux follows
  std::error_code error;
  for (int i = 0; i < kMost && fs::is_symlink(fs::symlink_status(path, error)); ++i) {
    const fs::path link = fs::read_symlink(path, error);
    if (error) break;
    path = folder_of(path) / link;  // that alone where it is absolute
  }
  return path;
}

/// Takes away what killed runs left in a folder: files named like ours that are ours and that
/// nobody holds locked.
void sweep(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    const fs::path stem = at->path().filename().stem();
    if (!name.starts_with(kStart.substr(0, 8)) ||
        !(name.ends_with(kEnd) || stem.extension() == kEnd))
      continue;
    const int file = ::open(at->path().c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) continue;
    struct stat status{};
    const bool ours = ::fstat(file, &status) == 0 && S_ISREG(status.st_mode) &&
                      status.st_uid == ::geteuid() && ::flock(file, LOCK_EX | LOCK_NB) == 0;
    if (ours) ::unlink(at->path().c_str());
    ::close(file);
  }
}

/// A new file, locked; -1 with errno. Another run may sweep it between the two: then once more.
int create_locked(const fs::path& path) {
  for (int attempt = 0; attempt < 100; ++attempt) {
    const int file =
        ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
    if (file < 0) return -1;
    struct stat status{};
    if (::flock(file, LOCK_EX) == 0 && ::fstat(file, &status) == 0 && status.st_nlink == 1)
      return file;
    ::close(file);
  }
  errno = EBUSY;
  return -1;
}

/// The rights of a new file, or those of the one it replaces.
mode_t rights_of(const fs::path& target) {
  struct stat status{};
  if (::stat(target.c_str(), &status) == 0) return status.st_mode & 07777;
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return 0666 & ~mask;
}

Result<void> write_to_standard_output(std::string_view content) {
  return write_all(STDOUT_FILENO, content) ? Result<void>()
                                           : unwritable("standard output", reason_of(errno));
}

Result<void> write_directly(const fs::path& path, std::string_view content) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (file < 0) return unwritable(path, reason_of(errno));
  const bool written = write_all(file, content);
  const int error = errno;
  if (::close(file) != 0 || !written) return unwritable(path, reason_of(written ? errno : error));
  return {};
}

/// Makes the names in a folder last; what cannot is no failure, the files are whole.
void sync_folder(const fs::path& folder) {
  const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return;
  (void)::fsync(file);
  ::close(file);
}

}  // namespace

bool write_all(int file, std::string_view content) {
  while (!content.empty()) {
    const ssize_t done = ::write(file, content.data(), content.size());
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) return false;
    content.remove_prefix(static_cast<std::size_t>(done));
  }
  return true;
}

Result<TemporaryFile> temporary_file(const std::string& extension) {
  std::error_code error;
  const fs::path folder = fs::temp_directory_path(error);
  if (error) return unwritable("the folder of temporary files", error.message());
  sweep(folder);
  TemporaryFile file{folder / (name_by_chance() + extension)};
  file.lock = create_locked(file.path);
  if (file.lock < 0) return unwritable(file.path, reason_of(errno));
  return file;
}

Result<void> check_writable(const fs::path& path) {
  if (is_standard_stream(path)) return {};
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) return unwritable(path, "it is a folder");
  if (fs::exists(status))
    return ::access(path.c_str(), W_OK) == 0 ? Result<void>() : unwritable(path, reason_of(errno));
  if (const bool unresolved = error && status.type() != fs::file_type::not_found; unresolved)
    return unwritable(path, error.message());
  const fs::path folder = folder_of(target_of(path));
  if (::access((folder / "").c_str(), W_OK | X_OK) != 0) return unwritable(path, reason_of(errno));
  return {};
}

OutputFiles::~OutputFiles() {
  put_back();
  for (File& file : files_) {
    if (!file.beside.empty() && !file.placed) ::unlink(file.beside.c_str());
    for (const int lock : {file.lock, file.backup_lock})
      if (lock >= 0) ::close(lock);
  }
}

Result<void> OutputFiles::add(const fs::path& path, std::string_view content) {
  if (auto can = check_writable(path); !can) return can;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  File file;
  file.named = file.target = path;
  file.fresh = !fs::exists(status);
  file.standard = is_standard_stream(path);
  if (file.standard || (fs::exists(status) && !fs::is_regular_file(status))) {
    file.content = content;
    files_.push_back(std::move(file));
    return {};
  }
  // A link keeps pointing where it did: the file it names is the one replaced or made.
  file.target = target_of(path);
  sweep(folder_of(file.target));
  file.beside = name_beside(file.target);
  file.lock = create_locked(file.beside);
  if (file.lock < 0) return unwritable(path, reason_of(errno));
  files_.push_back(std::move(file));
  const File& made = files_.back();
  if (!write_all(made.lock, content) || ::fchmod(made.lock, rights_of(made.target)) != 0 ||
      ::fsync(made.lock) != 0)
    return unwritable(path, reason_of(errno));
  return {};
}

Result<void> OutputFiles::place(File& file) {
  // What the target holds keeps a second name until all are in place.
  const fs::path backup = name_beside(file.target);
  if (files_.size() > 1 && ::link(file.target.c_str(), backup.c_str()) == 0) {
    file.backup = backup;
    file.backup_lock = ::open(backup.c_str(), O_RDONLY | O_CLOEXEC);
    if (file.backup_lock >= 0) (void)::flock(file.backup_lock, LOCK_SH);
  }
  if (::rename(file.beside.c_str(), file.target.c_str()) != 0)
    return unwritable(file.named, reason_of(errno));
  file.placed = true;
  return {};
}

/// As it was before commit().
void OutputFiles::put_back() {
  for (File& file : files_) {
    if (file.placed && file.fresh) ::unlink(file.target.c_str());
    if (file.placed && !file.backup.empty()) ::rename(file.backup.c_str(), file.target.c_str());
    if (!file.placed && !file.backup.empty()) ::unlink(file.backup.c_str());
    file.backup.clear();
  }
}

Result<void> OutputFiles::commit() {
  Result<void> done;
  for (File& file : files_)
    if (done && !file.beside.empty()) done = place(file);
  for (File& file : files_)
    if (done && file.beside.empty())
      done = file.standard ? write_to_standard_output(file.content)
                           : write_directly(file.target, file.content);
  if (!done) return done;  // the destructor puts back what was
  for (File& file : files_) {
    if (!file.backup.empty()) ::unlink(file.backup.c_str());
    if (!file.beside.empty()) sync_folder(folder_of(file.target));
    for (const int lock : {file.lock, file.backup_lock})
      if (lock >= 0) ::close(lock);
  }
  files_.clear();
  return done;
}

Result<void> write_atomically(const fs::path& path, std::string_view content) {
  OutputFiles files;
  if (auto added = files.add(path, content); !added) return added;
  return files.commit();
}

}  // namespace keyline::exchange
