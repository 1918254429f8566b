#include "terminal.h"

#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <mutex>

#include <unistd.h>

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

std::atomic<bool> bar_shown{false};
std::mutex bar_mutex;

void draw_bar(double fraction, std::string_view doing) {
  constexpr int kWidth = 28;
  const int full = static_cast<int>(std::lround(fraction * kWidth));
  std::string bar;
  for (int i = 0; i < kWidth; ++i) bar += i < full ? '#' : '.';
  const std::scoped_lock lock(bar_mutex);
  std::fprintf(stderr, "\r[%s] %3d %%  %.*s\x1b[K", bar.c_str(), static_cast<int>(100 * fraction),
               static_cast<int>(std::min<std::size_t>(doing.size(), 40)),
               std::string(doing).c_str());
  std::fflush(stderr);
  bar_shown = true;
}

/// Line breaks and control characters of a message would break the one-line rule.
std::string one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  return text;
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
  std::fprintf(stderr, "%s\n", one_line(std::move(line)).c_str());
  return exit_of(failure.code);
}

void say(bool quiet, const std::string& text) {
  if (quiet) return;
  end_progress();
  std::fprintf(stderr, "keyline: %s\n", one_line(text).c_str());
}

core::Progress interactive_progress(bool quiet) {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  core::Progress progress;
  progress.cancellation = interrupt_token();
  if (!quiet && isatty(STDERR_FILENO)) progress.sink = draw_bar;
  return progress;
}

void end_progress() {
  if (!bar_shown.exchange(false)) return;
  const std::scoped_lock lock(bar_mutex);
  std::fprintf(stderr, "\r\x1b[K");
  std::fflush(stderr);
}

}  // namespace keyline::app
