#include "keyline/operations/at_once.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "keyline/numeric/parallel.h"

namespace keyline::operations {
namespace {

/// The bars of several things at work as one.
class OneBar {
 public:
  OneBar(const core::Progress& whole, std::size_t count) : whole_(whole), share_(count, 0) {}

  core::Progress of(std::size_t index) {
    if (!whole_.sink || share_.size() < 2) return whole_;
    core::Progress part{nullptr, whole_.cancellation};
    part.sink = [this, index](double fraction, std::string_view doing) {
      report(index, fraction, doing);
    };
    part.report(0, "");
    return part;
  }

  void end(std::size_t index) {
    const std::scoped_lock lock(mutex_);
    share_[index] = 1;
    ++ended_;
  }

 private:
  void report(std::size_t index, double fraction, std::string_view doing) {
    const std::scoped_lock lock(mutex_);
    share_[index] = std::max(share_[index], std::min(fraction, 1.0));
    double sum = 0;
    for (const double share : share_) sum += share;
    whole_.report(sum / static_cast<double>(share_.size()),
                  fmt::format("{} of {}: {}", ended_ + 1, share_.size(), doing));
  }

  const core::Progress& whole_;
  std::mutex mutex_;
  std::vector<double> share_;  ///< of every thing that is done
  std::size_t ended_ = 0;
};

}  // namespace

void work_on_all(const core::Progress& whole, std::size_t count, int threads,
                 const std::function<bool(std::size_t, const core::Progress&)>& work) {
  OneBar bar(whole, count);
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> on = true;
  const std::size_t hands = std::min(count, std::size_t(numeric::thread_count(threads)));
  numeric::parallel_for(hands, threads, [&](std::size_t) {
    while (on.load() && !whole.stop_requested()) {
      const std::size_t i = next.fetch_add(1);
      if (i >= count) return;
      if (!work(i, bar.of(i))) on.store(false);
      bar.end(i);
    }
  });
}

}  // namespace keyline::operations
