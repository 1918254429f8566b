#pragma once

#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "run_keyline.h"

namespace keyline::app_test {

/// In a child: becomes `keyline ARGUMENTS`, and ends where the test does.
[[noreturn]] inline void become_keyline(std::vector<std::string> arguments) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  arguments.insert(arguments.begin(), "keyline");
  std::vector<char*> words;
  for (std::string& word : arguments) words.push_back(word.data());
  words.push_back(nullptr);
  ::execv(KEYLINE_PROGRAM, words.data());
  std::_Exit(127);
}

/// Starts `keyline ARGUMENTS` with its standard error in a file. Negative where no process is to be
/// had: a signal to -1 would end everything.
inline pid_t start_keyline(const std::vector<std::string>& arguments, const std::string& errors) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  ::dup2(::open(errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644), STDERR_FILENO);
  become_keyline(arguments);
}

/// Whether the process catches a signal: from then on it must end by itself.
inline bool catches(pid_t child, int signal) {
  const std::string text = slurp("/proc/" + std::to_string(child) + "/status");
  const std::size_t at = text.find("SigCgt:");
  return at != std::string::npos &&
         (std::stoull(text.substr(at + 7), nullptr, 16) >> (signal - 1) & 1U) != 0;
}

/// Whether the process has a file open.
inline bool has_open(pid_t child, const std::string& file) {
  std::error_code error;
  for (const auto& entry :
       std::filesystem::directory_iterator("/proc/" + std::to_string(child) + "/fd", error))
    if (std::filesystem::read_symlink(entry, error) == file) return true;
  return false;
}

/// Waits for a sign, two minutes for what takes hundredths of a second. False where it does not
/// come or the process ended first.
template <class Sign>
bool wait_for(pid_t child, Sign sign) {
  const auto last = std::chrono::steady_clock::now() + std::chrono::minutes(2);
  while (!sign()) {
    if (std::chrono::steady_clock::now() > last) return false;
    siginfo_t ended{};
    if (::waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOHANG | WNOWAIT) != 0 ||
        ended.si_pid != 0)
      return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

/// What a process ended with; -1 where a signal ended it.
inline int status_of(pid_t child) {
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace keyline::app_test
