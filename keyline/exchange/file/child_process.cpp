#include "keyline/exchange/file/child_process.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "keyline/core/sanitized.h"

namespace keyline::exchange {
namespace {

using Clock = std::chrono::steady_clock;

constexpr long kPatience = 100;  // ms between looks at the caller's wish

/// A file descriptor that is closed once.
class Descriptor {
 public:
  explicit Descriptor(int value = -1) : value_(value) {}
  Descriptor(Descriptor&& other) noexcept : value_(std::exchange(other.value_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(value_, other.value_);
    return *this;
  }
  ~Descriptor() { close(); }
  void close() {
    if (value_ >= 0) ::close(value_);
    value_ = -1;
  }
  int get() const { return value_; }
  bool open() const { return value_ >= 0; }

 private:
  int value_;
};

struct Pipe {
  Descriptor read;
  Descriptor write;
};

bool make(Pipe& made) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return false;
  made = {Descriptor(ends[0]), Descriptor(ends[1])};
  return true;
}

/// For the child's standard input: unlike a pipe it can be written to without raising SIGPIPE.
bool make_socket(Pipe& made) {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) return false;
  made = {Descriptor(ends[0]), Descriptor(ends[1])};
  return true;
}

core::Result<ChildResult> not_started(const std::filesystem::path& program, int error) {
  return core::fail(core::ErrorCode::io,
                    "cannot be started: " + std::generic_category().message(error),
                    "check the installation", program.string());
}

void limit(int resource, std::size_t most) {
  const rlimit value{most, most};
  ::setrlimit(static_cast<__rlimit_resource>(resource), &value);
}

/// In the child: only async-signal-safe calls from here on.
[[noreturn]] void become(const char* program, char* const* arguments,
                         const std::array<int, 3>& ends, const ChildLimits& limits) {
  for (int i = 0; i < 3; ++i)
    if (::dup2(ends[static_cast<std::size_t>(i)], i) < 0) ::_exit(127);
#ifndef KEYLINE_SHADOWED
  limit(RLIMIT_AS, limits.memory);
#endif
  limit(RLIMIT_CORE, 0);
#ifdef __linux__
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  for (const int asked_to_end : {SIGINT, SIGTERM}) ::signal(asked_to_end, SIG_IGN);
  limit(RLIMIT_CPU, static_cast<std::size_t>(limits.seconds) + 2);
  ::execv(program, arguments);
  ::_exit(127);
}

/// Feeds and empties the child's pipes until it is done or its time is over.
class Talk {
 public:
  Talk(Pipe& in, Pipe& out, Pipe& err, std::string_view input, const ChildLimits& limits,
       const core::CancellationToken& cancellation)
      : in_(in.write),
        out_(out.read),
        err_(err.read),
        input_(input),
        limits_(limits),
        cancellation_(cancellation) {}

  /// False where the child has to be killed.
  bool run(ChildResult& result) {
    const auto end = Clock::now() + std::chrono::duration<double>(limits_.seconds);
    if (input_.empty()) in_.close();
    while (out_.open() || err_.open()) {
      result.cancelled = cancellation_.stop_requested();
      if (result.cancelled) return false;
      const auto left =
          std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
      if (left <= 0) {
        result.out_of_time = true;
        return false;
      }
      std::array<pollfd, 3> polled = {
          {{in_.get(), POLLOUT, 0}, {out_.get(), POLLIN, 0}, {err_.get(), POLLIN, 0}}};
      if (::poll(polled.data(), polled.size(), static_cast<int>(std::min(left, kPatience))) < 0 &&
          errno != EINTR)
        return false;
      if (polled[0].revents != 0) feed();
      if (polled[1].revents != 0) take(out_, result.output, limits_.output);
      if (polled[2].revents != 0) take(err_, result.errors, std::size_t{64} << 10);
      if (result.output.size() > limits_.output) return false;
    }
    return true;
  }

 private:
  void feed() {
    const auto done =
        ::send(in_.get(), input_.data(), std::min<std::size_t>(input_.size(), 65536), MSG_NOSIGNAL);
    if (done > 0) input_.remove_prefix(static_cast<std::size_t>(done));
    if (input_.empty() || (done < 0 && errno != EAGAIN && errno != EINTR)) in_.close();
  }

  static void take(Descriptor& from, std::string& text, std::size_t most) {
    std::array<char, 65536> chunk;
    const auto count = ::read(from.get(), chunk.data(), chunk.size());
    if (count == 0 || (count < 0 && errno != EINTR && errno != EAGAIN)) from.close();
    if (count > 0 && text.size() <= most)
      text.append(chunk.data(), static_cast<std::size_t>(count));
  }

  Descriptor& in_;
  Descriptor& out_;
  Descriptor& err_;
  std::string_view input_;
  ChildLimits limits_;
  core::CancellationToken cancellation_;
};

}  // namespace

core::Result<ChildResult> run_child(const std::filesystem::path& program,
                                    const std::vector<std::string>& arguments,
                                    std::string_view input, const ChildLimits& limits,
                                    const core::CancellationToken& cancellation) {
  Pipe in;
  Pipe out;
  Pipe err;
  if (!make_socket(in) || !make(out) || !make(err)) return not_started(program, errno);
  const std::string name = program.string();
  std::vector<char*> list{const_cast<char*>(name.c_str())};
  for (const std::string& argument : arguments) list.push_back(const_cast<char*>(argument.c_str()));
  list.push_back(nullptr);
  const pid_t child = ::fork();
  if (child < 0) return not_started(program, errno);
  if (child == 0)
    become(name.c_str(), list.data(), {in.read.get(), out.write.get(), err.write.get()}, limits);
  in.read.close();
  out.write.close();
  err.write.close();
  ::fcntl(in.write.get(), F_SETFL, O_NONBLOCK);
  ChildResult result;
  if (!Talk(in, out, err, input, limits, cancellation).run(result)) ::kill(child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  result.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return result;
}

}  // namespace keyline::exchange
