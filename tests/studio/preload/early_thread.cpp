// Preloaded before the studio's server: a thread from before main, as numerical libraries start
// some (OpenBLAS does), which takes any signal.
#include <thread>

#include <unistd.h>

namespace {

[[gnu::constructor]] void start_thread() {
  std::thread([] {
    for (;;) ::pause();
  }).detach();
}

}  // namespace
