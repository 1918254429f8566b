#include <fmt/format.h>

#include "manual.h"

namespace keyline::app {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : " ") + word;
  return all;
}

/// The text with `escape` before each character that the shell would take for its own.
std::string escaped(const std::string& text, std::string_view special, const char* escape) {
  std::string all;
  for (const char c : text) {
    if (special.find(c) != std::string_view::npos) all += escape;
    all += c;
  }
  return all;
}

/// In single quotes, where a quote is written '\''.
std::string quoted(const std::string& text) {
  std::string all = "'";
  for (const char c : text) all += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return all + "'";
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

std::string bash(const std::vector<Manual>& manuals) {
  std::string names;
  std::string options;
  std::string choices;
  for (const Manual& manual : manuals) {
    names += manual.command + " ";
    options +=
        fmt::format("    {}) words=\"{}\" ;;\n", manual.command, joined(option_names(manual)));
    for (const OptionTexts& group : manual.groups)
      for (const OptionText& option : group.options)
        if (!option.choices.empty())
          choices += fmt::format("    \"{} {}\") words=\"{}\" ;;\n", manual.command, option.name,
                                 joined(option.choices));
  }
  return "_keyline() {\n  local words=\"\" now=\"${COMP_WORDS[COMP_CWORD]}\"\n"
         "  case \"${COMP_WORDS[1]}\" in\n" +
         options + "  esac\n  [[ \"$now\" == -* ]] || words=\"\"\n" +
         "  case \"${COMP_WORDS[1]} ${COMP_WORDS[COMP_CWORD-1]}\" in\n" + choices +
         "  esac\n  [ \"$COMP_CWORD\" -eq 1 ] && words=\"" + names +
         "\"\n  COMPREPLY=($(compgen -W \"$words\" -- \"$now\"))\n}\n"
         "complete -o default -F _keyline keyline\n";
}

/// What comes after an option: "", ":N:", ":a|b:(a b)", ":FILE:_files".
std::string zsh_value(const OptionText& option) {
  if (option.value.empty()) return "";
  const std::string value = ":" + escaped(option.value, ":[]\\", "\\") + ":";
  if (option.file) return value + "_files";
  return option.choices.empty() ? value + " " : value + "(" + joined(option.choices) + ")";
}

std::string zsh(const std::vector<Manual>& manuals) {
  std::string names;
  std::string cases;
  for (const Manual& manual : manuals) {
    names += "    " + quoted(manual.command + ":" + first_line(manual.text)) + "\n";
    cases += "    " + manual.command + ") options=(\n";
    for (const OptionTexts& group : manual.groups)
      for (const OptionText& option : group.options)
        cases += "      " +
                 quoted("*" + option.name + "[" + escaped(option.text, "[]:\\", "\\") + "]" +
                        zsh_value(option)) +
                 "\n";
    cases += "    ) ;;\n";
  }
  return "#compdef keyline\n_keyline() {\n  local -a commands options\n  commands=(\n" + names +
         "  )\n  if (( CURRENT == 2 )); then\n    _describe command commands\n    return\n  fi\n"
         "  case $words[2] in\n" +
         cases +
         "  esac\n  shift words\n  (( CURRENT-- ))\n  _arguments -S $options '*:file:_files'\n}\n"
         "if [ \"$funcstack[1]\" = _keyline ]; then _keyline \"$@\"; else compdef _keyline "
         "keyline; fi\n";
}

std::string fish(const std::vector<Manual>& manuals) {
  std::string text;
  for (const Manual& manual : manuals)
    text += fmt::format("complete -c keyline -n __fish_use_subcommand -f -a {} -d {}\n",
                        manual.command, quoted(first_line(manual.text)));
  for (const Manual& manual : manuals)
    for (const OptionTexts& group : manual.groups)
      for (const OptionText& option : group.options) {
        text += fmt::format("complete -c keyline -n '__fish_seen_subcommand_from {}' -l {} -d {}",
                            manual.command, option.name.substr(2), quoted(option.text));
        if (!option.value.empty()) text += option.file ? " -r" : " -x";
        if (!option.choices.empty()) text += " -a " + quoted(joined(option.choices));
        text += "\n";
      }
  return text;
}

}  // namespace

core::Result<std::string> completion(const std::string& shell) {
  if (shell == "bash") return bash(manuals());
  if (shell == "zsh") return zsh(manuals());
  if (shell == "fish") return fish(manuals());
  return core::fail(core::ErrorCode::bad_input, "there is no completion for \"" + shell + "\"",
                    "ask for bash, zsh or fish", "completion");
}

}  // namespace keyline::app
