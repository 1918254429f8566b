#include "tests/library/library_files.h"

#include <sys/wait.h>

namespace keyline::library::testing {

std::string in_child(const std::function<std::string()>& work) {
  int ends[2];
  if (pipe(ends) != 0) return "no pipe";
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    const std::string wrong = work();
    const bool told = write(ends[1], wrong.data(), wrong.size()) >= 0;
    _exit(told ? 0 : 1);
  }
  close(ends[1]);
  std::string wrong;
  char buffer[512];
  for (ssize_t n = 0; (n = read(ends[0], buffer, sizeof buffer)) > 0;)
    wrong.append(buffer, static_cast<std::size_t>(n));
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) return wrong + " (the child ended badly)";
  return wrong;
}

}  // namespace keyline::library::testing
