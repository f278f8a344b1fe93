// SPDX-License-Identifier: Apache-2.0
#include "man_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace afm::reference {
namespace {

// The text escaped for roff: a backslash, and the characters that roff makes typographic, by their names; no line that
// begins like a request.
std::string roff(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    const bool first_of_line = escaped.empty() || escaped.back() == '\n';
    if (first_of_line && (c == '.' || c == '\'')) escaped += "\\&";
    switch (c) {
      case '\\':
        escaped += "\\e";
        break;
      case '-':
        escaped += "\\-";
        break;
      case '\'':
        escaped += "\\(aq";
        break;
      case '^':
        escaped += "\\(ha";
        break;
      case '~':
        escaped += "\\(ti";
        break;
      case '`':
        escaped += "\\(ga";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

// The value of an option: "{mono,left,right}" may be broken behind a comma.
std::string value_text(const std::string& value) {
  std::string text;
  for (const char c : value) text += c == ',' ? ",\\:" : roff(std::string(1, c));
  return text;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }

// Running text after a title, without the beginning and the end of the help.
std::string trimmed(std::string text) {
  const auto space = [](unsigned char c) { return std::isspace(c) != 0; };
  text.erase(text.begin(), std::find_if_not(text.begin(), text.end(), space));
  text.erase(std::find_if_not(text.rbegin(), text.rend(), space).base(), text.end());
  return text;
}

void print_option(std::string& page, const app::OptionDescription& option) {
  page += fmt::format(".TP\n{}{}\n{}", bold(option.name),
                      option.value.empty() || option.argument ? "" : " " + value_text(option.value), roff(option.help));
  if (!option.fallback.empty()) page += fmt::format(" (default: {})", roff(option.fallback));
  if (!option.rules.empty()) page += fmt::format(" ({})", roff(option.rules));
  page += "\n";
}

// "touchafm curve [options] name", as it is typed.
std::string usage(const std::string& name, const app::CommandDescription& command) {
  std::string text = bold(name);
  if (!command.commands.empty()) return text + " \\fICOMMAND\\fR [\\fIoptions\\fR]";
  for (const app::OptionDescription& option : command.options) {
    if (!option.argument) continue;
    const std::string argument = fmt::format("\\fI{}\\fR", roff(option.name));
    text += option.rules.starts_with("required") ? " " + argument : fmt::format(" [{}]", argument);
  }
  return text + " [\\fIoptions\\fR]";
}

void print_command(std::string& page, const std::string& name, const app::CommandDescription& command) {
  page += fmt::format(".SS {}\n{}\n.P\n{}\n", roff(name), usage(name, command), roff(command.help));
  for (const app::AlternativesDescription& group : command.alternatives) {
    page += fmt::format(".P\nExactly one of these options is required ({}):\n", roff(group.title));
    for (const app::OptionDescription& option : group.options) print_option(page, option);
  }
  if (!command.alternatives.empty()) page += ".P\nOther options:\n";
  for (const app::OptionDescription& option : command.options) {
    if (option.name != "-h,--help") print_option(page, option);
  }
  if (!command.footer.empty()) page += fmt::format(".P\n.nf\n{}\n.fi\n", roff(trimmed(command.footer)));
  for (const app::CommandDescription& below : command.commands) print_command(page, name + " " + below.name, below);
}

}  // namespace

std::string man_page(const app::CommandDescription& program, const Release& release) {
  // "TouchAFM: feel and see ... microscope.\nExit codes: 0 done, ..."
  const std::size_t colon = program.help.find(": ") + 2, end = program.help.find('\n'),
                    codes = program.help.find(": ", end) + 2;
  const std::string purpose = program.help.substr(colon, end - colon - 1);
  std::string page = fmt::format(".TH TOUCHAFM 1 \"{}\" \"TouchAFM {}\" \"User Commands\"\n.nh\n.ad l\n",
                                 roff(release.date), roff(release.version));
  page += fmt::format(".SH NAME\n{} \\- {}\n", program.name, roff(purpose));
  page += ".SH SYNOPSIS\n";
  for (const app::CommandDescription& command : program.commands) {
    page += fmt::format("{}{}\n", usage(program.name + " " + command.name, command),
                        &command == &program.commands.back() ? "" : "\n.br");
  }
  page += ".SH OPTIONS\n";
  for (const app::OptionDescription& option : program.options) print_option(page, option);
  page += ".SH COMMANDS\n";
  for (const app::CommandDescription& command : program.commands) {
    print_command(page, program.name + " " + command.name, command);
  }
  page += fmt::format(".SH EXIT STATUS\n{}\n", roff(program.help.substr(codes)));
  page +=
      ".SH FILES\n"
      "Paths of the Debian package; with another prefix, they are below that prefix instead of /usr.\n"
      ".TP\n\\fI/usr/share/touchafm\\fR\n"
      "materials, probes, models, walls, wands and the languages of wall and report\n"
      ".TP\n\\fI/usr/share/doc/touchafm\\fR\n"
      "the manual, the documents that the help refers to as docs/NAME, and, in\n\\fIexamples\\fR,\n"
      "files to copy and edit\n";
  return page;
}

}  // namespace afm::reference
