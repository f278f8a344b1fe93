// SPDX-License-Identifier: Apache-2.0
#include "bash_completion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace afm::reference {
namespace {

// Completions as assignments of the script's variables, each with the patterns of its "case".
using Cases = std::map<std::string, std::vector<std::string>>;

// bash makes a word of the = in --option=value.
constexpr const char* kBeginning =
    R"(# bash completion for touchafm, written by the build from the program's own command line
_touchafm() {
  local current=${COMP_WORDS[COMP_CWORD]} option=${COMP_WORDS[COMP_CWORD - 1]} command='' kind='' words='' options='' word
  if [ "$current" = = ]; then
    current=''
  elif [ "$option" = = ]; then
    option=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  for word in "${COMP_WORDS[@]:1:COMP_CWORD - 1}"; do
    case "$command $word" in
)";
constexpr const char* kAfterCommands = R"(    esac
  done
  case "$command $option" in
)";
constexpr const char* kAfterValues = R"(    *)
      case "$command" in
)";
constexpr const char* kEnd = R"(      esac
      if [[ -z $kind || $current == -* ]]; then
        kind=words words=$options
      fi
      ;;
  esac
  case $kind in
    file | directory)
      mapfile -t COMPREPLY < <(compgen "-${kind:0:1}" -- "$current")
      compopt -o filenames 2>/dev/null
      ;;
    *) mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current") ;;
  esac
}
complete -F _touchafm touchafm
)";

std::string joined(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, " ")); }

// The assignments for a value of that name.
std::string completion_of(const std::string& value, const ValueWords& known) {
  if (const std::size_t brace = value.find('{'); brace != std::string::npos) {
    std::string words = value.substr(brace + 1, value.find('}') - brace - 1);
    std::replace(words.begin(), words.end(), ',', ' ');
    return fmt::format("kind=words words='{}'", words);
  }
  if (const auto row = known.find(value); row != known.end()) {
    return fmt::format("kind=words words='{}'", joined(row->second));
  }
  if (value.find("FILE") != std::string::npos || value == "SESSION") return "kind='file'";
  if (value.starts_with("DIR")) return "kind=directory";
  return "kind=words";
}

std::string all_options(const app::CommandDescription& command) {
  std::vector<std::string> names;
  const auto add = [&names](const std::vector<app::OptionDescription>& options) {
    for (const app::OptionDescription& option : options) {
      if (!option.argument) names.push_back(option.name.substr(option.name.find("--")));
    }
  };
  for (const app::AlternativesDescription& group : command.alternatives) add(group.options);
  add(command.options);
  return joined(names);
}

struct Script {
  Cases commands;   // before the word that is typed
  Cases values;     // behind an option that takes a value
  Cases elsewhere;  // options, and arguments or commands
};

std::string quoted(const std::string& pattern) { return fmt::format("\"{}\"", pattern); }

void add_command(Script& script, const std::string& path, const app::CommandDescription& command,
                 const ValueWords& known) {
  std::string arguments;
  const auto add_values = [&](const std::vector<app::OptionDescription>& options) {
    for (const app::OptionDescription& option : options) {
      if (option.argument) {
        arguments = completion_of(option.value, known);
      } else if (!option.value.empty()) {
        script.values[completion_of(option.value, known)].push_back(quoted(path + " " + option.name));
      }
    }
  };
  add_values(command.options);
  for (const app::AlternativesDescription& group : command.alternatives) add_values(group.options);

  std::vector<std::string> names;
  for (const app::CommandDescription& inner : command.commands) {
    const std::string inner_path = path.empty() ? inner.name : path + " " + inner.name;
    names.push_back(inner.name);
    script.commands[fmt::format("command='{}'", inner_path)].push_back(quoted(path + " " + inner.name));
    add_command(script, inner_path, inner, known);
  }
  if (!names.empty()) arguments = fmt::format("kind=words words='{}'", joined(names));
  script.elsewhere[fmt::format("options='{}' {}", all_options(command), arguments)].push_back(quoted(path));
}

std::string text_of(const Cases& cases, const std::string& indent) {
  std::string text;
  for (const auto& [assignments, patterns] : cases) {
    text += fmt::format("{}{}) {} ;;\n", indent, fmt::join(patterns, " | "), assignments);
  }
  return text;
}

}  // namespace

std::string bash_completion(const app::CommandDescription& program, const ValueWords& words) {
  Script script;
  add_command(script, "", program, words);
  return kBeginning + text_of(script.commands, "      ") + kAfterCommands + text_of(script.values, "    ") +
         kAfterValues + text_of(script.elsewhere, "        ") + kEnd;
}

}  // namespace afm::reference
