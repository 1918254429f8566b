#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string_view>

namespace keyline::core {

/// Asks long work to stop. Copies share one flag; a default-made token can never be cancelled.
class CancellationToken {
 public:
  CancellationToken() = default;

  /// A token that request_stop() on it or any copy of it cancels.
  static CancellationToken make() {
    CancellationToken token;
    token.flag_ = std::make_shared<std::atomic<bool>>(false);
    return token;
  }

  /// No effect on a default-made token. Safe from another thread.
  void request_stop() const {
    if (flag_) flag_->store(true, std::memory_order_relaxed);
  }

  bool stop_requested() const { return flag_ && flag_->load(std::memory_order_relaxed); }

 private:
  std::shared_ptr<std::atomic<bool>> flag_;
};

/// Receives (fraction in [0, 1], what is being done). Called from one thread at a time.
using ProgressSink = std::function<void(double fraction, std::string_view doing)>;

/// How long work talks to its caller; all members optional.
struct Progress {
  ProgressSink sink;
  CancellationToken cancellation;

  void report(double fraction, std::string_view doing) const {
    if (sink) sink(fraction, doing);
  }
  bool stop_requested() const { return cancellation.stop_requested(); }
};

/// Part [from, to] of a longer piece of work, passed on to a step of it.
inline Progress part_of(const Progress& whole, double from, double to) {
  Progress part{nullptr, whole.cancellation};
  if (whole.sink) {
    part.sink = [sink = whole.sink, from, to](double fraction, std::string_view doing) {
      sink(from + (to - from) * fraction, doing);
    };
  }
  return part;
}

}  // namespace keyline::core
