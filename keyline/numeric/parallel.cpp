#include "keyline/numeric/parallel.h"

#include <algorithm>
#include <atomic>
#include <thread>

#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace keyline::numeric {

int thread_count(int requested) {
  if (requested > 0) return requested;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

namespace detail {

void run_parallel(std::size_t count, int threads,
                  const std::function<void(std::size_t, int)>& body) {
  // What the caller wrote is handed to the bodies, and what they wrote handed back, in sight of
  // ThreadSanitizer too, which does not see what TBB does for it.
  std::atomic<std::size_t> handed = 0;
  handed.store(1, std::memory_order_release);
  // More than the machine has would only make TBB complain.
  tbb::task_arena arena(std::min(threads, tbb::info::default_concurrency()));
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                        (void)handed.load(std::memory_order_acquire);
                        const int worker = tbb::this_task_arena::current_thread_index();
                        for (std::size_t i = range.begin(); i != range.end(); ++i) body(i, worker);
                        handed.fetch_add(1, std::memory_order_acq_rel);
                      });
  });
  (void)handed.load(std::memory_order_acquire);
}

}  // namespace detail
}  // namespace keyline::numeric
