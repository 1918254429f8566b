#include <filesystem>
#include <vector>

#include <unistd.h>

#include "../studio/options.h"
#include "commands.h"
#include "terminal.h"

namespace keyline::app {

int run_studio(const Words& arguments) {
  std::error_code failed;
  const auto here = std::filesystem::read_symlink("/proc/self/exe", failed).parent_path();
  const std::string program = here / "keyline-studio";
  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  ::execv(program.c_str(), pointers.data());
  return report_failure({core::ErrorCode::unsupported, "Keyline Studio is not installed",
                         "build it with KEYLINE_STUDIO=ON, beside keyline", program});
}

Manual studio_manual() {
  OptionTexts group{"Options", {}};
  for (const studio::OptionLine& line : studio::option_lines())
    group.options.push_back(
        {.name = line.name, .value = line.value ? line.value : "", .text = line.text});
  return {"studio", "[FILE...] ", studio::help_text(), {group}, studio::help_example()};
}

}  // namespace keyline::app
