#pragma once

#include <cstddef>
#include <functional>
#include <type_traits>

namespace keyline::numeric {

/// Threads meant by an option: the given count, or all of the machine's where it is <= 0.
int thread_count(int requested);

namespace detail {
void run_parallel(std::size_t count, int threads,
                  const std::function<void(std::size_t, int)>& body);
}

/// Calls body(i, worker) once for every i in [0, count), on up to `threads` threads
/// (<= 0: all of the machine's). `worker` is below thread_count(threads) and no two calls with
/// the same worker overlap, so that it may index scratch space. The order of calls is unspecified:
/// write results by index and they do not depend on the thread count. An exception thrown by
/// body ends the loop early and comes out here.
template <class Body>
void parallel_for(std::size_t count, int threads, Body&& body) {
  const int used = thread_count(threads);
  if (used == 1 || count < 2) {
    for (std::size_t i = 0; i < count; ++i) {
      if constexpr (std::is_invocable_v<Body&, std::size_t, int>) {
        body(i, 0);
      } else {
        body(i);
      }
    }
    return;
  }
  detail::run_parallel(count, used, [&body](std::size_t i, [[maybe_unused]] int worker) {
    if constexpr (std::is_invocable_v<Body&, std::size_t, int>) {
      body(i, worker);
    } else {
      body(i);
    }
  });
}

}  // namespace keyline::numeric
