#include "workers.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace keyline::app {
namespace {

constexpr std::size_t kMostLines = 512;       // of a block
constexpr std::size_t kMostBytes = 1u << 20;  // of a block of several lines
constexpr double kShort = 0.005;              // seconds: blocks grow until they take longer
constexpr double kLong = 0.05;                // seconds: and shrink again beyond this
constexpr std::size_t kReadAtOnce = 1u << 18;
constexpr int kPipeBytes = 1 << 18;  // a pipe's 64 KB would wake both ends for every other block

struct Pipe {
  int read = -1;
  int write = -1;
};

Pipe make_pipe() {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    throw std::system_error(errno, std::generic_category(), "no pipe to a worker");
  ::fcntl(ends[1], F_SETPIPE_SZ, kPipeBytes);  // where that is too much, it stays as it is
  return {ends[0], ends[1]};
}

}  // namespace

const char* line_end(const char* from, const char* to) {
  const void* const found = std::memchr(from, '\n', static_cast<std::size_t>(to - from));
  return found ? static_cast<const char*>(found) : to;
}

double now() {
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

Worker::Worker(const WorkerMain& main) {
  const Pipe requests = make_pipe();
  const Pipe answers = make_pipe();
  process_ = ::fork();
  if (process_ < 0) throw std::system_error(errno, std::generic_category(), "no process");
  if (process_ == 0) {
    // Ctrl-C is the parent's to handle; without a parent there is no one to answer.
    std::signal(SIGINT, SIG_IGN);
    std::signal(SIGTERM, SIG_DFL);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    // Pipes of the other workers would keep these open after their parent closed them.
    for (int other = 3; other < answers.write; ++other)
      if (other != requests.read) ::close(other);
    main(requests.read, answers.write);
    ::_exit(0);
  }
  ::close(requests.read);
  ::close(answers.write);
  to_ = requests.write;
  from_ = answers.read;
  ::fcntl(to_, F_SETFL, O_NONBLOCK);
  ::fcntl(from_, F_SETFL, O_NONBLOCK);
}

Worker::Worker(Worker&& other) noexcept
    : process_(std::exchange(other.process_, -1)),
      to_(std::exchange(other.to_, -1)),
      from_(std::exchange(other.from_, -1)),
      sent_(std::move(other.sent_)),
      outgoing_(std::move(other.outgoing_)),
      incoming_(std::move(other.incoming_)),
      block_(other.block_),
      began_(other.began_),
      heard_(other.heard_) {}

Worker::~Worker() {
  if (to_ >= 0) ::close(to_);
  if (from_ >= 0) ::close(from_);
  if (process_ < 0) return;
  ::kill(process_, SIGKILL);
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

void Worker::take(std::deque<NumberedLine>& queue) {
  const bool alone = queue.front().alone;
  const std::size_t most = alone ? 1 : block_;
  while (!queue.empty() && sent_.size() < most && outgoing_.size() < kMostBytes) {
    if (queue.front().alone != alone) break;
    outgoing_ += queue.front().text;
    outgoing_ += '\n';
    sent_.push_back(std::move(queue.front()));
    queue.pop_front();
  }
  began_ = heard_ = now();
}

bool Worker::write_some() {
  while (!outgoing_.empty()) {
    const ssize_t n = ::write(to_, outgoing_.data(), outgoing_.size());
    if (n < 0) return errno == EAGAIN || errno == EINTR;
    outgoing_.erase(0, static_cast<std::size_t>(n));
  }
  return true;
}

bool Worker::read_some(const std::function<void(std::uint64_t, std::string)>& answered) {
  char bytes[kReadAtOnce];
  for (;;) {
    const ssize_t n = ::read(from_, bytes, sizeof bytes);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno == EAGAIN;
    if (n == 0) return false;
    const char* at = bytes;
    const char* const end = bytes + n;
    const char* line = line_end(at, end);
    if (line != end) heard_ = now();
    for (; line != end && !sent_.empty(); line = line_end(at, end)) {
      incoming_.append(at, line);
      at = line + 1;
      answered(sent_.front().number, std::exchange(incoming_, {}));
      sent_.pop_front();
    }
    incoming_.append(at, end);
    if (sent_.empty()) adapt();
  }
}

std::vector<NumberedLine> Worker::unanswered() {
  std::vector<NumberedLine> lines(std::make_move_iterator(sent_.begin()),
                                  std::make_move_iterator(sent_.end()));
  sent_.clear();
  outgoing_.clear();
  return lines;
}

double Worker::waiting() const { return now() - heard_; }

void Worker::adapt() {
  const double took = now() - began_;
  if (took < kShort) block_ = std::min(2 * block_, kMostLines);
  if (took > kLong) block_ = std::max<std::size_t>(block_ / 2, 1);
}

}  // namespace keyline::app
