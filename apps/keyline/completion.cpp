#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "manual.h"
#include "words.h"

namespace keyline::app {
namespace {

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

bool is_command(const std::vector<Manual>& manuals, const std::string& word) {
  return std::ranges::find(manuals, word, &Manual::command) != manuals.end();
}

/// The room of an operation where its name may stand in two words: "library" of "library.find".
/// Empty of others, and where the room's name is a command of its own ("sketch").
std::string room_of(const std::vector<Manual>& manuals, const Manual& manual) {
  const std::size_t dot = manual.command.find('.');
  const std::string room = dot == std::string::npos ? "" : manual.command.substr(0, dot);
  return is_command(manuals, room) ? "" : room;
}

/// What stands behind a first word whose second is no file.
std::map<std::string, std::vector<std::string>> second_words(const std::vector<Manual>& manuals) {
  std::map<std::string, std::vector<std::string>> words{{"completion", {"bash", "zsh", "fish"}}};
  for (const Manual& manual : manuals) {
    for (const char* first : {"help", "man"}) words[first].push_back(manual.command);
    if (manual.command.find('.') == std::string::npos) continue;
    for (const char* first : {"operations", "perform"}) words[first].push_back(manual.command);
    if (const std::string room = room_of(manuals, manual); !room.empty())
      words[room].push_back(manual.command.substr(room.size() + 1));
  }
  return words;
}

/// The rooms, as a pattern of the shells: "curve|lac".
std::string rooms(const std::vector<Manual>& manuals, const char* between) {
  std::set<std::string> all;
  for (const Manual& manual : manuals) all.insert(room_of(manuals, manual));
  all.erase("");
  return fmt::format("{}", fmt::join(all, between));
}

std::string bash(const std::vector<Manual>& manuals) {
  std::string options;
  std::string choices;
  for (const Manual& manual : manuals) {
    options +=
        fmt::format("    {}) words=\"{}\" ;;\n", manual.command, joined(option_names(manual)));
    for (const OptionTexts& group : manual.groups)
      for (const OptionText& option : group.options)
        if (!option.choices.empty())
          choices += fmt::format("    \"{} {}\") words=\"{}\" ;;\n", manual.command, option.name,
                                 joined(option.choices));
  }
  std::string second;
  for (const auto& [first, words] : second_words(manuals))
    second += fmt::format("    \"{} 2\") words=\"{}\" ;;\n", first, joined(words));
  return "_keyline() {\n  local words=\"\" now=\"${COMP_WORDS[COMP_CWORD]}\"\n"
         "  local first=\"${COMP_WORDS[1]}\"\n  local command=\"$first\"\n"
         "  case \"$first\" in\n    perform) command=\"${COMP_WORDS[2]}\" ;;\n    " +
         rooms(manuals, "|") +
         ") command=\"$first.${COMP_WORDS[2]}\" ;;\n  esac\n  case \"$command\" in\n" + options +
         "  esac\n  [[ \"$now\" == -* ]] || words=\"\"\n" +
         "  [[ \"$now\" == -* ]] || case \"$first $COMP_CWORD\" in\n" + second +
         "  esac\n  case \"$command ${COMP_WORDS[COMP_CWORD-1]}\" in\n" + choices +
         "  esac\n  [ \"$COMP_CWORD\" -eq 1 ] && words=\"" + joined(first_words(manuals)) +
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
  for (const std::string& word : first_words(manuals))
    if (!is_command(manuals, word)) names += "    " + word + "\n";
  std::string second;
  for (const auto& [first, words] : second_words(manuals))
    second += fmt::format("      {}) compadd -- {}; return ;;\n", first, joined(words));
  return "#compdef keyline\n_keyline() {\n  local -a commands options\n"
         "  local command=$words[2]\n  commands=(\n" +
         names +
         "  )\n  if (( CURRENT == 2 )); then\n    _describe command commands\n    return\n  fi\n"
         "  if (( CURRENT == 3 )) && [[ $words[3] != -* ]]; then\n    case $words[2] in\n" +
         second + "    esac\n  fi\n  case $words[2] in\n    perform) command=$words[3] ;;\n    " +
         rooms(manuals, "|") + ") command=$words[2].$words[3] ;;\n  esac\n  case $command in\n" +
         cases +
         "  esac\n  shift words\n  (( CURRENT-- ))\n  _arguments -S $options '*:file:_files'\n}\n"
         "if [ \"$funcstack[1]\" = _keyline ]; then _keyline \"$@\"; else compdef _keyline "
         "keyline; fi\n";
}

/// What the rest of fish's script asks: which command it is, and whether its second word is wanted.
std::string fish_questions(const std::vector<Manual>& manuals) {
  return "function __keyline_is\n  set -l words (commandline -opc) '' ''\n"
         "  set -l command \"$words[2]\"\n  switch $command\n    case perform\n"
         "      set command \"$words[3]\"\n    case " +
         rooms(manuals, " ") +
         "\n      set command \"$words[2].$words[3]\"\n  end\n  test \"$command\" = $argv[1]\nend\n"
         "function __keyline_second\n  set -l words (commandline -opc)\n"
         "  test (count $words) -eq 2; and test $words[2] = $argv[1]\nend\n";
}

std::string fish(const std::vector<Manual>& manuals) {
  std::string text = fish_questions(manuals);
  for (const Manual& manual : manuals)
    text += fmt::format("complete -c keyline -n __fish_use_subcommand -f -a {} -d {}\n",
                        manual.command, quoted(first_line(manual.text)));
  for (const std::string& word : first_words(manuals))
    if (!is_command(manuals, word))
      text += fmt::format("complete -c keyline -n __fish_use_subcommand -f -a {}\n", word);
  for (const auto& [first, words] : second_words(manuals))
    text += fmt::format("complete -c keyline -n '__keyline_second {}' -f -a {}\n", first,
                        quoted(joined(words)));
  for (const Manual& manual : manuals)
    for (const OptionTexts& group : manual.groups)
      for (const OptionText& option : group.options) {
        text += fmt::format("complete -c keyline -n '__keyline_is {}' -l {} -d {}", manual.command,
                            option.name.substr(2), quoted(option.text));
        if (!option.value.empty()) text += option.file ? " -r" : " -x";
        if (!option.choices.empty()) text += " -a " + quoted(joined(option.choices));
        text += "\n";
      }
  return text;
}

}  // namespace

std::vector<std::string> first_words(const std::vector<Manual>& manuals) {
  std::vector<std::string> words;
  for (const Manual& manual : manuals) words.push_back(manual.command);
  for (const auto& [word, behind] : second_words(manuals))
    if (!is_command(manuals, word)) words.push_back(word);
  return words;
}

core::Result<std::string> completion(const std::string& shell) {
  if (shell == "bash") return bash(manuals());
  if (shell == "zsh") return zsh(manuals());
  if (shell == "fish") return fish(manuals());
  return core::fail(core::ErrorCode::bad_input, "there is no completion for \"" + shell + "\"",
                    "ask for bash, zsh or fish", "completion");
}

}  // namespace keyline::app
