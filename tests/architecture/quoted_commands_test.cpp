// SPDX-License-Identifier: Apache-2.0
// Invariant: every command that a page or a help text quotes exists, with every option that is quoted with it
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "app/options/command.h"
#include "app/program.h"
#include "core/whole_file.h"
#include "support/places.h"

namespace afm {
namespace quoted_commands_test {

using app::CommandDescription;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::string_view kProgram = "touchafm ";

struct Quotation {
  std::string where;
  std::string text;  // text from "touchafm" on
};

// A command in text ends with the quotation, a pipe, or a comment.
std::string command_at(std::string_view text, std::size_t begin) {
  return std::string(text.substr(begin, text.find_first_of("`\n|;&#", begin) - begin));
}

// Commands in backticks, and those with which a line of a block begins, behind a prompt or a path too.
std::vector<Quotation> quotations_of(const std::string& where, const std::string& page) {
  std::vector<Quotation> found;
  std::istringstream lines(page);
  bool in_block = false;
  std::string open;  // command whose line ends with a backslash
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) in_block = !in_block;
    if (!open.empty()) {
      line.insert(0, open);
      open.clear();
    }
    for (std::size_t at = 0; (at = line.find(kProgram, at)) != std::string::npos; at += kProgram.size()) {
      const bool quoted = at > 0 && line[at - 1] == '`';
      // the first word of a line of a block, with its path or behind a prompt
      const std::size_t blank = line.find_last_of(' ', at);
      const std::size_t word = blank == std::string::npos ? 0 : blank + 1;
      const bool begins =
          in_block && (word == 0 || (word == 2 && line[0] == '$')) && (at == word || line[at - 1] == '/');
      if (!quoted && !begins) continue;
      if (begins && line.ends_with('\\')) {
        open = line.substr(0, line.size() - 1);
        break;
      }
      found.push_back({where, command_at(line, at)});
    }
  }
  return found;
}

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  std::string word;
  char quote = 0;
  for (const char c : text + " ") {
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == ' ') {
      if (!word.empty()) words.push_back(word);
      word.clear();
      continue;
    }
    word += c;
  }
  return words;
}

bool has_option(const CommandDescription& command, std::string_view name) {
  if (name == "--help" || name == "--version") return true;
  const auto is_it = [name](const app::OptionDescription& option) {
    std::istringstream names(option.name);
    for (std::string each; std::getline(names, each, ',');) {
      if (each == name) return true;
    }
    return false;
  };
  return std::any_of(command.options.begin(), command.options.end(), is_it) ||
         std::any_of(command.alternatives.begin(), command.alternatives.end(),
                     [&](const auto& group) { return std::any_of(group.options.begin(), group.options.end(), is_it); });
}

// Fault of a quoted command; empty: none.
std::string fault_of(const CommandDescription& program, const Quotation& quotation) {
  const std::vector<std::string> words = words_of(quotation.text);
  const CommandDescription* command = &program;
  for (std::size_t i = 1; i < words.size(); ++i) {
    const auto next = std::find_if(command->commands.begin(), command->commands.end(),
                                   [&](const CommandDescription& each) { return each.name == words[i]; });
    if (next != command->commands.end()) {
      command = &*next;
      continue;
    }
    if (!command->commands.empty() && !words[i].starts_with("-")) {
      // a placeholder such as COMMAND means any
      const bool is_placeholder = std::isupper(static_cast<unsigned char>(words[i].front())) != 0;
      return is_placeholder ? "" : fmt::format("{}: {}: no command {}", quotation.where, quotation.text, words[i]);
    }
    if (!words[i].starts_with("--")) continue;
    std::string name = words[i].substr(0, words[i].find_first_of("=[],.:)*"));
    if (name == "--" || has_option(*command, name)) continue;
    return fmt::format("{}: {}: {} has no {}", quotation.where, quotation.text, command->name, name);
  }
  return {};
}

CommandDescription program() {
  const app::CommandContext context{.assets_dir = "assets", .program_path = {}};
  app::CommandLine command_line("touchafm", "0", app::kProgramHelp);
  app::add_commands(command_line, context);
  return command_line.describe();
}

void add_footers(const CommandDescription& command, std::vector<Quotation>& all) {
  std::istringstream lines(command.footer);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find(kProgram);
    if (line.starts_with("example: ") && at != std::string::npos) {
      all.push_back({"help of " + command.name, command_at(line, at)});
    }
  }
  for (const CommandDescription& each : command.commands) add_footers(each, all);
}

TEST(QuotedCommands, ExistWithTheirOptions) {
  const CommandDescription all = program();
  std::vector<Quotation> quotations;
  add_footers(all, quotations);
  EXPECT_GT(quotations.size(), 15U);
  std::size_t pages = 0;
  const auto add_page = [&](const std::filesystem::path& path) {
    ++pages;
    const auto found = quotations_of(path.filename().string(), core::read_file(path.string()).value());
    quotations.insert(quotations.end(), found.begin(), found.end());
  };
  for (const char* page : {"README.md", "CONTRIBUTING.md", "ARCHITECTURE.md"}) add_page(support::source(page));
  for (const auto& entry : std::filesystem::recursive_directory_iterator(support::source("docs"))) {
    if (entry.path().extension() == ".md") add_page(entry.path());
  }
  EXPECT_GT(pages, 60U);
  EXPECT_GT(quotations.size(), 300U);
  std::vector<std::string> faults;
  for (const Quotation& quotation : quotations) {
    if (const std::string fault = fault_of(all, quotation); !fault.empty()) faults.push_back(fault);
  }
  std::sort(faults.begin(), faults.end());
  EXPECT_THAT(faults, IsEmpty());
}

TEST(QuotedCommands, NoticeWhatDoesNotExist) {
  const CommandDescription all = program();
  const auto faults = [&](const std::string& page) {
    std::vector<std::string> found;
    for (const Quotation& quotation : quotations_of("page", page)) {
      if (const std::string fault = fault_of(all, quotation); !fault.empty()) found.push_back(fault);
    }
    return found;
  };
  EXPECT_THAT(faults("Use `touchafm curve --law dmt`.\n"),
              ElementsAre("page: touchafm curve --law dmt: curve has no --law"));
  EXPECT_THAT(faults("```sh\ntouchafm feel gold\n```\n"), ElementsAre("page: touchafm feel gold: no command feel"));
  EXPECT_THAT(faults("```sh\n$ touchafm curve --model dmt \\\n    --bend 3\n```\n"), testing::SizeIs(1));
  EXPECT_THAT(faults("`touchafm generate curve --radius 5um --out \"a --b.h5\"`, `touchafm COMMAND --help`\n"),
              IsEmpty());
}

}  // namespace quoted_commands_test
}  // namespace afm
