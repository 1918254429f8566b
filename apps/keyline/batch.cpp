#include "batch.h"

#include <algorithm>
#include <cerrno>
#include <optional>
#include <system_error>

#include <poll.h>
#include <unistd.h>

namespace keyline::app {
namespace {

using core::Result;

constexpr std::size_t kLongestLine = 256u << 20;
constexpr std::size_t kMostHeld = 64u << 20;  // bytes of lines and answers
constexpr std::size_t kMostQueued = 4096;     // lines waiting for a worker
constexpr std::size_t kReadAtOnce = 1u << 18;
constexpr int kTick = 200;  // milliseconds between looks at token and clock

bool is_blank(const std::string& line) {
  return line.find_first_not_of(" \t\r") == std::string::npos;
}

class Batch {
 public:
  Batch(int in, int out, const WorkerMain& main, const BatchAnswers& answers,
        const BatchOptions& options)
      : in_(in), out_(out), main_(main), answers_(answers), options_(options) {
    next_number_ = next_written_ = options.skip;
    to_skip_ = options.skip;
  }

  Result<BatchReport> run() {
    const double began = now();
    while (!finished()) {
      if (options_.progress.stop_requested()) {
        report_.cancelled = true;
        break;
      }
      give_out();
      wait();
      if (failed_) return std::unexpected(*failed_);
    }
    report_.lines = next_written_ - options_.skip;
    report_.seconds = now() - began;
    return report_;
  }

 private:
  /// A line on its way, in the order of the input.
  struct Slot {
    std::size_t line_size = 0;
    std::string answer;
    bool answered = false;
  };

  bool finished() const { return ended_ && queue_.empty() && next_written_ == next_number_; }

  bool may_read() const { return !ended_ && held_ < kMostHeld && queue_.size() < kMostQueued; }

  /// Lines to idle workers; more workers while there is more to do than they can.
  void give_out() {
    for (Worker& worker : workers_)
      if (worker.idle() && !queue_.empty()) give_to(worker);
    while (!queue_.empty() && workers_.size() < static_cast<std::size_t>(options_.workers)) {
      workers_.emplace_back(main_);
      give_to(workers_.back());
    }
  }

  void give_to(Worker& worker) {
    worker.take(queue_);
    worker.write_some();
  }

  void wait() {
    std::vector<pollfd> watched;
    if (may_read()) watched.push_back({in_, POLLIN, 0});
    const std::size_t first = watched.size();
    for (const Worker& worker : workers_) {
      watched.push_back({worker.output(), POLLIN, 0});
      watched.push_back({worker.wants_to_write() ? worker.input() : -1, POLLOUT, 0});
    }
    if (::poll(watched.data(), watched.size(), kTick) < 0) return;  // interrupted: the token tells
    if (first > 0 && watched[0].revents != 0) read_input();
    std::vector<std::size_t> gone;
    for (std::size_t i = 0; i < workers_.size(); ++i) {
      Worker& worker = workers_[i];
      bool alive = true;
      if (watched[first + 2 * i + 1].revents != 0) alive = worker.write_some();
      if (watched[first + 2 * i].revents != 0)
        alive = worker.read_some(
            [this](std::uint64_t number, std::string answer) { keep(number, std::move(answer)); });
      const bool late =
          options_.time_limit > 0 && !worker.idle() && worker.waiting() > options_.time_limit;
      if (late) expire(worker);
      if (!alive && !late) ask_again(worker.unanswered());
      if (!alive || late) gone.push_back(i);
    }
    for (auto i = gone.rbegin(); i != gone.rend(); ++i) replace(*i);
    write_ready();
  }

  /// Its worker is gone: a new one is made when there is something to do.
  void replace(std::size_t index) {
    std::vector<Worker> left;
    for (std::size_t i = 0; i < workers_.size(); ++i)
      if (i != index) left.push_back(std::move(workers_[i]));
    workers_.swap(left);
  }

  /// The first line of a worker that died is to blame only if it was alone.
  void ask_again(std::vector<NumberedLine> lines) {
    if (lines.size() == 1 && lines.front().alone) {
      ++report_.crashed;
      keep(lines.front().number, answers_.crashed(lines.front().text));
      return;
    }
    for (auto line = lines.rbegin(); line != lines.rend(); ++line) {
      line->alone = true;
      queue_.push_front(std::move(*line));
    }
  }

  void expire(Worker& worker) {
    std::vector<NumberedLine> lines = worker.unanswered();
    if (lines.empty()) return;
    ++report_.expired;
    keep(lines.front().number, answers_.expired(lines.front().text, options_.time_limit));
    for (std::size_t i = lines.size(); i-- > 1;) queue_.push_front(std::move(lines[i]));
  }

  void read_input() {
    char bytes[kReadAtOnce];
    const ssize_t n = ::read(in_, bytes, sizeof bytes);
    if (n < 0 && (errno == EINTR || errno == EAGAIN)) return;
    const char* at = bytes;
    const char* const end = bytes + std::max<ssize_t>(n, 0);
    for (const char* line = line_end(at, end); line != end; line = line_end(at, end)) {
      extend(at, line);
      at = line + 1;
      line_ends();
    }
    extend(at, end);
    if (n > 0) return;
    ended_ = true;
    if (!partial_.empty() || cut_) line_ends();
  }

  void extend(const char* from, const char* to) {
    const auto count = static_cast<std::size_t>(to - from);
    cut_ = cut_ || partial_.size() + count > kLongestLine;
    if (!cut_) partial_.append(from, to);
  }

  void line_ends() {
    std::string line = std::exchange(partial_, {});
    const bool cut = std::exchange(cut_, false);
    if (!cut && is_blank(line)) return;
    if (to_skip_ > 0) {
      --to_skip_;
      return;
    }
    held_ += line.size();
    slots_.push_back({line.size(), {}, false});
    if (cut)
      keep(next_number_++, answers_.too_long());
    else
      queue_.push_back({next_number_++, std::move(line)});
  }

  void keep(std::uint64_t number, std::string answer) {
    held_ += answer.size();
    Slot& slot = slots_[number - next_written_];
    slot.answer = std::move(answer);
    slot.answered = true;
  }

  /// Everything that is next in order, in one go.
  void write_ready() {
    std::string text;
    for (; !slots_.empty() && slots_.front().answered; slots_.pop_front(), ++next_written_) {
      text += slots_.front().answer;
      text += '\n';
      held_ -= slots_.front().answer.size() + slots_.front().line_size;
    }
    write_all(text);
  }

  void write_all(const std::string& text) {
    const char* at = text.data();
    for (std::size_t left = text.size(); left > 0;) {
      const ssize_t n = ::write(out_, at, left);
      if (n < 0 && errno == EINTR) continue;
      if (n < 0 && errno == EAGAIN) {
        pollfd ready{out_, POLLOUT, 0};
        ::poll(&ready, 1, kTick);
        continue;
      }
      if (n < 0) {
        failed_ = core::Failure{
            core::ErrorCode::io,
            std::string("the answers cannot be written: ") + std::generic_category().message(errno),
            "check where they go to", ""};
        return;
      }
      at += n;
      left -= static_cast<std::size_t>(n);
    }
  }

  int in_;
  int out_;
  const WorkerMain& main_;
  const BatchAnswers& answers_;
  const BatchOptions& options_;
  std::vector<Worker> workers_;
  std::deque<NumberedLine> queue_;
  std::deque<Slot> slots_;  ///< of the lines from next_written_ on
  std::string partial_;
  bool cut_ = false;
  bool ended_ = false;
  std::uint64_t to_skip_ = 0;
  std::uint64_t next_number_ = 0;
  std::uint64_t next_written_ = 0;
  std::size_t held_ = 0;
  std::optional<core::Failure> failed_;
  BatchReport report_;
};

}  // namespace

Result<BatchReport> run_lines(int in, int out, const WorkerMain& main, const BatchAnswers& answers,
                              const BatchOptions& options) {
  return Batch(in, out, main, answers, options).run();
}

}  // namespace keyline::app
