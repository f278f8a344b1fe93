// SPDX-License-Identifier: Apache-2.0
#include "app/options/usage_errors.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cctype>
#include <regex>
#include <vector>

#include "app/options/nearest_word.h"

namespace afm::app {

namespace {

std::vector<OptionDescription> options_of(const CommandDescription& command) {
  std::vector<OptionDescription> options = command.options;
  for (const AlternativesDescription& group : command.alternatives) {
    options.insert(options.end(), group.options.begin(), group.options.end());
  }
  return options;
}

std::vector<std::string> commands_of(const CommandDescription& command) {
  std::vector<std::string> names;
  names.reserve(command.commands.size());
  for (const CommandDescription& each : command.commands) names.push_back(each.name);
  return names;
}

// Message about words that fit nothing; empty if there are none.
std::string about_extra(const TypedCommand& typed) {
  if (typed.left.empty()) return "";
  const std::vector<std::string> commands = commands_of(typed.command);
  // options behind it may be those of the command that was meant
  if (!commands.empty() && !typed.left.front().starts_with("-")) {
    return fmt::format("{} has no command \"{}\"{}", typed.words, typed.left.front(),
                       suggestion(typed.left.front(), commands));
  }
  for (const std::string& word : typed.left) {
    if (!word.starts_with("-")) continue;
    const std::string name = word.substr(0, word.find('='));
    std::vector<std::string> names;
    for (const OptionDescription& option : options_of(typed.command)) {
      names.push_back(option.name.substr(option.name.rfind(',') + 1));  // long form of "-h,--help"
      if (names.back() == name) return fmt::format("{} has no use for {}", typed.words, word);
    }
    return fmt::format("{} has no option {}{}", typed.words, name, suggestion(name, names));
  }
  return fmt::format("{} has no use for \"{}\"", typed.words, typed.left.front());
}

// Texts of CLI11 2.1 to 2.4, and their replacements, in which $1 and $2 are their parts.
struct Reworded {
  const char* pattern;
  const char* text;
};

constexpr Reworded kReworded[] = {
    {R"((.+): At Most 1 required but received (\d+))", "$1 was given $2 times; give it once"},
    {R"((.+): At Most (\d+) required but received (\d+))", "$1 was given $3 times; give it $2 times at most"},
    {R"(Exactly 1 option from \[(.+)\] is required and (\d+) were given)", "give only one of $1"},
    {R"(Exactly 1 option from \[(.+)\] is required)", "give one of $1"},
    {R"((.+) excludes (.+))", "$1 cannot be given with $2"},
    {R"((.+) requires (.+))", "$1 needs $2"},
    {R"(Could not convert: (.+) = (.*))", "$1 cannot be \"$2\""},
};

std::string reworded(const CommandDescription& command, const std::string& text) {
  std::smatch match;
  if (std::regex_match(text, match, std::regex(R"(([^- ]+) is required)"))) {
    return fmt::format("the argument {} is missing", match.str(1));
  }
  if (std::regex_match(text, match, std::regex(R"((.+): \d+ required .+ missing)"))) {
    const std::string name = match[1];
    return fmt::format("{} has no value; give {}", name, taken_by(command, name));
  }
  for (const Reworded& each : kReworded) {
    if (std::regex_match(text, match, std::regex(each.pattern))) {
      return std::regex_replace(match.format(each.text), std::regex(",(?=-)"), ", ");
    }
  }
  return text;
}

}  // namespace

std::string taken_by(const CommandDescription& command, const std::string& name) {
  for (const OptionDescription& option : options_of(command)) {
    if (option.name == name) return option.value;
  }
  return "";
}

std::string no_number(const std::string& value, const std::string& written) {
  std::string text = fmt::format("cannot read \"{}\" as a number that it takes", written);
  if (value.empty()) return text;
  const bool comma = written.find(',') != std::string::npos;
  const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  const bool unit = !comma && !written.empty() && !is_letter(written.front()) && is_letter(written.back());
  return text + "; give " + value +
         (comma  ? ", with a decimal point and no separator of thousands"
          : unit ? ", without a unit"
                 : "");
}

std::string usage_text(const TypedCommand& typed, const std::string& text, bool incomplete) {
  std::string said = incomplete ? about_extra(typed) : "";
  const std::vector<std::string> commands = commands_of(typed.command);
  if (said.empty() && text == "A subcommand is required") {
    said = fmt::format("{} needs one of its commands: {}", typed.words, fmt::join(commands, ", "));
  }
  if (said.empty()) said = reworded(typed.command, text);
  return fmt::format("{}; see {} --help", said, typed.words);
}

}  // namespace afm::app
