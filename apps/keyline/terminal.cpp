#include "terminal.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <mutex>
#include <stop_token>
#include <thread>

#include <unistd.h>

#include <fmt/format.h>

#include "keyline/core/text.h"

namespace keyline::app {
namespace {

core::CancellationToken& interrupt_token() {
  static core::CancellationToken token = core::CancellationToken::make();
  return token;
}

extern "C" void on_interrupt(int) {
  if (interrupt_token().stop_requested()) _exit(kCancelled);
  interrupt_token().request_stop();
}

/// A line on a terminal that tells what goes on. Reports only leave a note; a thread draws it, from
/// a third of a second on, so that many short pieces of work look like one and a long silent one is
/// seen to live.
class Bar {
 public:
  void note(double fraction, std::string_view doing) {
    const std::scoped_lock lock(mutex_);
    fraction_ = fraction;
    doing_ = doing;
    if (!drawer_.joinable()) {
      began_ = Clock::now();
      drawer_ = std::jthread([this](const std::stop_token& stop) { draw_until(stop); });
    }
  }

  void clear() {
    std::jthread drawer;
    {
      const std::scoped_lock lock(mutex_);
      drawer = std::move(drawer_);
    }
    drawer.request_stop();
    if (drawer.joinable()) drawer.join();
  }

 private:
  using Clock = std::chrono::steady_clock;

  void draw_until(const std::stop_token& stop) {
    constexpr auto kFirst = std::chrono::milliseconds(300);
    constexpr auto kNext = std::chrono::milliseconds(150);
    bool drawn = false;
    std::unique_lock lock(mutex_);
    while (!wake_.wait_for(lock, stop, drawn ? kNext : kFirst, [] { return false; }) &&
           !stop.stop_requested()) {
      std::fputs(line().c_str(), stderr);
      std::fflush(stderr);
      drawn = true;
    }
    if (drawn) std::fputs("\r\x1b[K", stderr);
    std::fflush(stderr);
  }

  std::string line() const {
    constexpr int kWidth = 28;
    constexpr std::size_t kWords = 48;
    const double seconds = std::chrono::duration<double>(Clock::now() - began_).count();
    std::string text = "\r[";
    for (int i = 0; i < kWidth; ++i) text += i < std::lround(fraction_ * kWidth) ? '#' : '.';
    text += fmt::format("] {:3d} %  {}", static_cast<int>(100 * fraction_),
                        doing_.substr(0, std::min(doing_.size(), kWords)));
    constexpr double kTelling = 0.02;  // of the work: before, what is left is anybody's guess
    const double left = fraction_ > kTelling ? seconds * (1 - fraction_) / fraction_ : 0;
    text += fraction_ > kTelling && left >= 1 ? fmt::format(", {} left", duration(left))
                                              : fmt::format(", {}", duration(seconds));
    return text + "\x1b[K";
  }

  static std::string duration(double seconds) {
    const auto whole = static_cast<long>(std::lround(seconds));
    return whole < 120 ? fmt::format("{} s", whole) : fmt::format("{} min", (whole + 30) / 60);
  }

  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::jthread drawer_;
  Clock::time_point began_;
  double fraction_ = 0;
  std::string doing_;
};

Bar& bar() {
  static Bar one;
  return one;
}

}  // namespace

int exit_of(core::ErrorCode code) {
  switch (code) {
    case core::ErrorCode::bad_input:
    case core::ErrorCode::unsupported:
      return kBadInput;
    case core::ErrorCode::undrawable:
    case core::ErrorCode::not_converged:
    case core::ErrorCode::internal:
      return kNoAnswer;
    case core::ErrorCode::cancelled:
      return kCancelled;
    case core::ErrorCode::io:
      break;
  }
  return kIo;
}

int report_failure(const core::Failure& failure, const std::string& subject) {
  end_progress();
  std::string line = "keyline: ";
  if (!subject.empty()) line += subject + ": ";
  if (!failure.path.empty() && failure.path != subject) line += failure.path + ": ";
  line += failure.message;
  if (!failure.hint.empty()) line += "; " + failure.hint;
  std::fprintf(stderr, "%s\n", core::on_one_line(line).c_str());
  return exit_of(failure.code);
}

void say(bool quiet, const std::string& text) {
  if (quiet) return;
  end_progress();
  std::fprintf(stderr, "keyline: %s\n", core::on_one_line(text).c_str());
}

void say_some(bool quiet, const std::string& lead, const std::vector<std::string>& lines,
              const std::string& rest) {
  constexpr std::size_t kMost = 10;
  for (std::size_t i = 0; i < std::min(kMost, lines.size()); ++i) say(quiet, lead + lines[i]);
  if (lines.size() > kMost)
    say(quiet, fmt::format("{}{} more{}", lead, lines.size() - kMost, rest));
}

core::Progress interactive_progress(bool quiet) {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  core::Progress progress;
  progress.cancellation = interrupt_token();
  if (!quiet && isatty(STDERR_FILENO))
    progress.sink = [](double fraction, std::string_view doing) { bar().note(fraction, doing); };
  return progress;
}

void leave_standard_output() { stdout = stderr; }

void end_progress() { bar().clear(); }

core::Progress one_of_many(const core::Progress& whole, std::size_t index, std::size_t count) {
  const auto n = static_cast<double>(std::max<std::size_t>(count, 1));
  core::Progress part =
      core::part_of(whole, static_cast<double>(index) / n, static_cast<double>(index + 1) / n);
  if (!part.sink || count < 2) return part;
  part.sink = [sink = part.sink, index, count](double fraction, std::string_view doing) {
    sink(fraction, fmt::format("{} of {}: {}", index + 1, count, doing));
  };
  part.report(0, "");
  return part;
}

core::Failure told_how_far(core::Failure failure, std::size_t done, std::size_t wanted) {
  if (failure.code == core::ErrorCode::cancelled && wanted > 1)
    failure.message = fmt::format("cancelled, {} of {} done", done, wanted);
  return failure;
}

}  // namespace keyline::app
