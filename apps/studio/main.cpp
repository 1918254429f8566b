// keyline-studio: Keyline Studio's server; `keyline studio` executes it.
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "keyline/core/version.h"

#include "guard.h"
#include "options.h"
#include "server.h"
#include "studio.h"

namespace keyline::studio {
namespace {

constexpr int kDone = 0;
constexpr int kBadInput = 2;
constexpr int kFileTrouble = 3;
constexpr auto kLastWorks = std::chrono::seconds(5);  // to end in, after they were told to

int report(const std::string& message, const std::string& remedy, int status) {
  std::fprintf(stderr, "keyline: %s; %s\n", message.c_str(), remedy.c_str());
  return status;
}

/// Beside the program in a build, in share/ where it is installed.
std::filesystem::path page_folder() {
  namespace fs = std::filesystem;
  if (const char* set = std::getenv("KEYLINE_STUDIO_PAGE")) return set;
  std::error_code failed;
  const fs::path here = fs::read_symlink("/proc/self/exe", failed).parent_path();
  for (const fs::path& folder : {here / "page", here.parent_path() / "share/keyline/studio",
                                 here.parent_path().parent_path() / "share/keyline/studio"})
    if (fs::exists(folder / "index.html", failed)) return folder;
  return {};
}

/// A browser, where there is a screen to show one on; nothing waits for it.
void open_browser(const std::string& url) {
  if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return;
  const pid_t child = ::fork();
  if (child != 0) {
    if (child > 0) ::waitpid(child, nullptr, 0);
    return;
  }
  if (::fork() != 0) ::_exit(0);
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (int stream = 0; stream < 3; ++stream) ::dup2(nowhere, stream);
  ::execlp("xdg-open", "xdg-open", url.c_str(), static_cast<char*>(nullptr));
  ::_exit(1);
}

bool is_loopback(const std::string& address) {
  return address.starts_with("127.") || address == "::1";
}

/// Where signals that end the program leave a byte. Any thread may get them, also one that a
/// library started before main, as OpenBLAS does: masks do not keep them from it.
int told_to_end = -1;

extern "C" void tell_to_end(int) {
  const int kept = errno;
  [[maybe_unused]] const auto written = ::write(told_to_end, "", 1);
  errno = kept;
}

/// What can be read from once a signal asks to end. Those that are ignored, by nohup, stay so.
int ending_signals() {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    throw std::system_error(errno, std::generic_category(), "no pipe for signals");
  told_to_end = ends[1];
  struct sigaction action{};
  action.sa_handler = tell_to_end;
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before{};
    ::sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) ::sigaction(signal, &action, nullptr);
  }
  std::signal(SIGPIPE, SIG_IGN);
  return ends[0];
}

Settings settings_of(const Options& options, const std::filesystem::path& page) {
  const int cores = static_cast<int>(std::max(2u, std::thread::hardware_concurrency()));
  Settings settings;
  settings.root = std::filesystem::current_path();
  settings.page = page;
  settings.recovery = recovery_file(settings.root);
  settings.files = options.files;
  settings.threads = cores - 1;  // one is for the hand
  settings.hands = cores;
  settings.long_works = std::max(2, cores / 2);  // a file opens while another is faired
  return settings;
}

int serve(const Options& options, const std::filesystem::path& page) {
  const int signals = ending_signals();
  Access access;
  access.token = options.token.empty() ? make_token() : options.token;
  std::unique_ptr<Server> server;  // outlives the works that answer through it
  Studio studio(settings_of(options, page));
  Service service;
  service.refuse = [&access](const RequestHead& head) { return refusal(access, head); };
  service.serve = [&studio](const RequestHead& head, std::string body,
                            std::shared_ptr<Responder> back) {
    studio.serve(head, std::move(body), std::move(back));
  };
  service.message = [&studio](std::string line, std::function<void(std::string)> answer) {
    studio.message(std::move(line), std::move(answer));
  };
  service.log = [quiet = options.quiet](const std::string& line) {
    if (!quiet) std::fprintf(stderr, "keyline: %s\n", line.c_str());
  };
  auto listening = Server::listen(options.address, options.port, std::move(service));
  if (!listening) return report(listening.error().message, listening.error().hint, kFileTrouble);
  server = std::move(*listening);
  const unsigned short port = server->port();
  access.hosts = host_names(options.address, port, options.hosts);
  const std::string url = "http://" + access.hosts.front() + "/#token=" + access.token;
  std::printf("Keyline Studio: %s\n", url.c_str());
  std::fflush(stdout);
  if (!options.no_browser) open_browser(url);
  std::jthread ending([&] {
    char byte = 0;
    while (::read(signals, &byte, 1) < 0 && errno == EINTR) continue;
    studio.stop();
    server->stop();
    std::thread([] {
      std::this_thread::sleep_for(kLastWorks);
      std::quick_exit(kDone);
    }).detach();
  });
  server->run();
  return kDone;
}

int run(const std::vector<std::string>& words) {
  const auto read = read_options(words);
  if (!read) return report(read.error().message, read.error().hint, kBadInput);
  const Options& options = *read;
  if (options.help || options.version) {
    if (options.help)
      std::fputs(help().c_str(), stdout);
    else
      std::printf("keyline %s\n", core::version());
    return kDone;
  }
  if (!is_loopback(options.address) && options.token.empty())
    return report("--listen " + options.address + " lets others in", "give a --token as well",
                  kBadInput);
  for (const std::string& file : options.files)
    if (std::error_code failed; !std::filesystem::exists(file, failed))
      return report(file + ": there is no such file", "check the name", kFileTrouble);
  const std::filesystem::path page = page_folder();
  if (page.empty())
    return report("the page of Keyline Studio is not built", "./dev run studio builds it",
                  kFileTrouble);
  return serve(options, page);
}

}  // namespace
}  // namespace keyline::studio

int main(int argc, char** argv) {
  try {
    return keyline::studio::run({argv + 1, argv + argc});
  } catch (const std::exception& e) {
    return keyline::studio::report(e.what(), "please report this", 1);
  }
}
