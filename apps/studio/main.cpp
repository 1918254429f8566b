// keyline-studio: Keyline Studio's server; `keyline studio` executes it.
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>

#include "guard.h"
#include "server.h"
#include "studio.h"

namespace keyline::studio {
namespace {

constexpr int kDone = 0;
constexpr int kBadInput = 2;
constexpr int kFileTrouble = 3;
constexpr auto kLastWorks = std::chrono::seconds(5);  // to end in, after they were told to

struct Options {
  std::vector<std::string> files;
  std::string address = "127.0.0.1";
  unsigned short port = 0;
  std::string token;
  std::vector<std::string> hosts;
  bool no_browser = false;
  bool quiet = false;
};

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

int parse(int argc, char** argv, Options& options) {
  CLI::App app{"Keyline Studio: draw, see the curvature, fair it, take it home.", "keyline studio"};
  app.set_version_flag("--version", "keyline " KEYLINE_VERSION);
  app.add_option("FILE", options.files, "to open: points, curves, drawings, surfaces")
      ->type_name("FILE");
  app.add_option("--port", options.port, "0: any that is free")->capture_default_str();
  app.add_option("--listen", options.address, "address for others to reach; needs --token")
      ->capture_default_str();
  app.add_option("--token", options.token, "what a browser must know; else one is made")
      ->check([](const std::string& token) {
        const bool plain = token.find_first_not_of(
                               "0123456789abcdefghijklmnopqrstuvwxyz"
                               "ABCDEFGHIJKLMNOPQRSTUVWXYZ-_") == std::string::npos;
        return token.size() >= 16 && plain ? std::string()
                                           : "a token has 16 or more letters, digits, - or _";
      });
  app.add_option("--host", options.hosts, "name the server goes by, with --listen; may be repeated")
      ->allow_extra_args(false);
  app.add_flag("--no-browser", options.no_browser, "print the address, open nothing");
  app.add_flag("--quiet", options.quiet, "no messages but errors");
  app.footer(
      "Example: keyline studio examples/bonnet-scan.csv\n"
      "Files are read and written in the folder it is started in, and nowhere else.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp& e) {
    app.exit(e);
    return kDone;
  } catch (const CLI::CallForVersion& e) {
    app.exit(e);
    return kDone;
  } catch (const CLI::ParseError& e) {
    return report(e.what(), "see keyline studio --help", kBadInput);
  }
  return -1;
}

bool is_loopback(const std::string& address) {
  return address.starts_with("127.") || address == "::1";
}

/// Blocks the signals that end the program in every thread; one waits for them.
sigset_t ending_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  return signals;
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
  sigset_t signals = ending_signals();
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
    int signal = 0;
    sigwait(&signals, &signal);
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

int run(int argc, char** argv) {
  Options options;
  if (const int status = parse(argc, argv, options); status >= 0) return status;
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
    return keyline::studio::run(argc, argv);
  } catch (const std::exception& e) {
    return keyline::studio::report(e.what(), "please report this", 1);
  }
}
