#include "keyline/exchange/input_file.h"

#include <cerrno>
#include <cstdint>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include "keyline/exchange/file/atomic_file.h"
#include "keyline/exchange/file/read_file.h"
#include "keyline/exchange/format/format.h"

namespace keyline::exchange {
namespace {

namespace fs = std::filesystem;
using core::ErrorCode;
using core::fail;
using core::Result;

constexpr std::uintmax_t kMost = std::uintmax_t{4} << 30;  // as read_mesh(), the largest there is
constexpr int kPatience = 100;                             // ms between looks at progress

std::string reason() { return std::generic_category().message(errno); }

/// Of the file descriptor while it lives.
class Closing {
 public:
  explicit Closing(int file) : file_(file) {}
  Closing(const Closing&) = delete;
  Closing& operator=(const Closing&) = delete;
  ~Closing() {
    if (file_ > STDERR_FILENO) ::close(file_);
  }
  int get() const { return file_; }

 private:
  int file_;
};

/// Whether there is something to read (or the end); false where progress asks to stop.
bool wait_for(int file, const core::Progress& progress) {
  pollfd one{file, POLLIN, 0};
  while (!progress.stop_requested())
    if (::poll(&one, 1, kPatience) > 0) return true;
  return false;
}

std::unexpected<core::Failure> unreadable(const std::string& named, const std::string& why) {
  return fail(ErrorCode::io, "cannot be read: " + why, "check the name and the rights", named);
}

}  // namespace

InputFile::InputFile(fs::path named)
    : named_(is_standard_stream(named) ? "standard input" : named.string()),
      path_(std::move(named)) {}

InputFile::InputFile(InputFile&& other) noexcept
    : named_(std::move(other.named_)),
      path_(std::move(other.path_)),
      lock_(std::exchange(other.lock_, -1)) {}

InputFile::~InputFile() {
  if (lock_ < 0) return;
  ::unlink(path_.c_str());
  ::close(lock_);
}

core::Failure InputFile::as_named(core::Failure failure) const {
  if (lock_ < 0) return failure;
  const std::string copy = path_.string();
  for (std::string* text : {&failure.path, &failure.message})
    for (std::size_t at = text->find(copy); at != std::string::npos; at = text->find(copy, at))
      text->replace(at, copy.size(), named_);
  return failure;
}

Result<void> InputFile::copy(int from, const core::Progress& progress) {
  std::string chunk(std::size_t{1} << 16, '\0');
  std::string start;
  std::uintmax_t size = 0;
  for (ssize_t got = 1; got != 0;) {
    if (!wait_for(from, progress))
      return fail(ErrorCode::cancelled, "cancelled while waiting for the input", "", named_);
    got = ::read(from, chunk.data(), chunk.size());
    if (got < 0 && errno != EINTR && errno != EAGAIN) return unreadable(named_, reason());
    if (got < 0) continue;
    std::string_view part(chunk.data(), static_cast<std::size_t>(got));
    size += part.size();
    if (size > kMost)
      return fail(ErrorCode::bad_input, "is larger than 4 GB", "give a smaller part", named_);
    if (lock_ < 0) {
      start += part;
      if (start.size() < kHead && got > 0) continue;
      if (start.empty()) break;
      if (auto begun = begin_copy(start); !begun) return begun;
      part = start;
    }
    if (!write_all(lock_, part)) return uncopied();
    progress.report(0, "reading " + named_);
  }
  if (size == 0) return fail(ErrorCode::bad_input, "is empty", "give a file with curves", named_);
  return {};
}

Result<void> InputFile::begin_copy(std::string_view head) {
  auto made = temporary_file(telling_extension(path_, head));
  if (!made) return std::unexpected(made.error());
  path_ = std::move(made->path);
  lock_ = made->lock;
  return {};
}

std::unexpected<core::Failure> InputFile::uncopied() const {
  return fail(ErrorCode::io, "cannot be copied to " + path_.string() + ": " + reason(),
              "set TMPDIR to a folder with room, or name a file", named_);
}

Result<InputFile> InputFile::open(const fs::path& named, const core::Progress& progress) {
  InputFile file(named);
  const bool standard = is_standard_stream(named);
  struct stat status{};
  if ((standard ? ::fstat(STDIN_FILENO, &status) : ::stat(named.c_str(), &status)) != 0)
    return standard ? Result<InputFile>(unreadable(file.named_, reason())) : std::move(file);
  const bool terminal = standard && ::isatty(STDIN_FILENO) != 0;
  if (S_ISBLK(status.st_mode) || (S_ISCHR(status.st_mode) && !terminal))
    return fail(ErrorCode::bad_input, "is a device, which has no end", "name a file", file.named_);
  if (!standard && !S_ISFIFO(status.st_mode) && !S_ISSOCK(status.st_mode)) return file;
  // without waiting for whoever writes: copy() waits, and can be told to stop
  const Closing from(standard ? STDIN_FILENO
                              : ::open(named.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  if (from.get() < 0) return unreadable(file.named_, reason());
  if (auto done = file.copy(from.get(), progress); !done) return std::unexpected(done.error());
  return file;
}

}  // namespace keyline::exchange
