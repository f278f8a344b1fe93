// SPDX-License-Identifier: Apache-2.0
// Words that make a text read as if it had been translated occur nowhere in what a person reads.
// Invariant: help, messages, documents, guidance, comments and names of tests use no word that makes a text read like a
// translation
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "app/options/command.h"
#include "app/program.h"
#include "architecture/production.h"
#include "architecture/prose.h"
#include "core/whole_file.h"
#include "support/places.h"

namespace afm {
namespace plain_english_test {

using support::comments_of;
using support::lines_with;
using support::messages_of;
using support::page_of;
using support::Prose;
using support::test_names_of;
using testing::ElementsAre;
using testing::IsEmpty;

struct Word {
  std::string_view foreign;
  std::string_view native;
};

// Names that the field has another word for, and expressions that no native writer uses for what is meant.
constexpr std::array kWords{
    Word{"besides", "also, in addition"},
    Word{"tells", "says, prints, reports"},
    Word{"told", "asked, sent, reported"},
    Word{"for ever", "continuous, indefinitely"},
    Word{"forever", "continuous, indefinitely"},
    Word{"stands", "is, lies, means"},
    Word{"comes to", "is, reaches"},
    Word{"mend", "fix"},
    Word{"mends", "fixes"},
    Word{"mended", "fixed"},
    Word{"mending", "fixing"},
    Word{"take away", "remove"},
    Word{"takes away", "removes"},
    Word{"took away", "removed"},
    Word{"taken away", "removed"},
    Word{"whoever", "anyone who"},
    Word{"of its own", "own, separate"},
    Word{"speak with", "communicate with"},
    Word{"speaks with", "communicates with"},
    Word{"spoken with", "communicated with"},
    Word{"log into", "log in to"},
    Word{"has patience", "the limit is"},
    Word{"stay awake", "busy-wait"},
    Word{"give again", "reproduce"},
    Word{"gives again", "reproduces"},
    Word{"made felt", "the contact model"},
    Word{"what becomes of", "the predicted"},
    Word{"no lever's", "outside the range of a lever"},
    Word{"encounter", "contact model"},
    Word{"encounters", "contact models"},
    Word{"ledger", "passivity observer"},
    Word{"haze", "fog"},
    Word{"veil", "fade"},
    Word{"phrase book", "message catalogue"},
    Word{"jitter", "scheduling latency"},
    Word{"news", "update"},
};

std::string in_tree(const std::filesystem::path& path) {
  return std::filesystem::relative(path, support::source()).string();
}

// "where:line: word (better)" for each that a text holds.
std::vector<std::string> faults_of(const std::string& where, const Prose& prose) {
  std::vector<std::string> faults;
  for (const Word& word : kWords) {
    for (const int line : lines_with(prose, word.foreign)) {
      faults.push_back(fmt::format("{}:{}: \"{}\" ({})", where, line, word.foreign, word.native));
    }
  }
  return faults;
}

std::vector<std::filesystem::path> files_below(const std::string& folder,
                                               std::initializer_list<std::string_view> endings) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(support::source(folder))) {
    const std::string ending = entry.path().extension().string();
    if (entry.is_regular_file() && std::find(endings.begin(), endings.end(), ending) != endings.end()) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

void append(std::vector<std::string>& all, const std::vector<std::string>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

std::vector<std::string> faults_of_page(const std::string& path) {
  return faults_of(path, page_of(core::read_file(support::source(path)).value()));
}

std::vector<std::string> faults_of_help(const std::string& command, const app::CommandDescription& description) {
  std::vector<std::string> faults;
  const auto check = [&](const std::string& what, const std::string& text) {
    Prose prose;
    prose.add(text, 1);
    append(faults, faults_of(what, prose));
  };
  check(command, description.help);
  check(command, description.footer);
  for (const app::OptionDescription& option : description.options) {
    check(command + " " + option.name, fmt::format("{} {} {}", option.help, option.rules, option.fallback));
  }
  for (const auto& group : description.alternatives) {
    check(command, group.title);
    for (const app::OptionDescription& option : group.options) check(command + " " + option.name, option.help);
  }
  for (const app::CommandDescription& below : description.commands) {
    append(faults, faults_of_help(command + " " + below.name, below));
  }
  return faults;
}

TEST(Prose, IsEveryLiteralOfMoreThanOneWord) {
  const auto messages = messages_of(
      "#include \"no message.h\"\n"
      "// \"no message either\"\n"
      "const auto a = \"the servo \"  // which\n"
      "               \"waits\\nfor you\";\n"
      "const int b = 10'000, c = '\"', d = '\\'';  /* \"nor this\" */\n"
      "json[\"mend\"] = R\"x(a \"raw\" text)x\";\n");
  ASSERT_EQ(messages.size(), 2U);
  EXPECT_EQ(messages[0].text, "the servo waits for you");
  EXPECT_THAT(lines_with(messages[0], "SERVO WAITS"), ElementsAre(3));
  EXPECT_THAT(lines_with(messages[0], "for"), ElementsAre(4));
  EXPECT_EQ(messages[1].text, "a \"raw\" text");
  EXPECT_THAT(lines_with(messages[1], "raw"), ElementsAre(6));
}

TEST(Prose, FindsWholeWordsAcrossTheEndOfALine) {
  const Prose page = page_of("It runs for\never, and mends_nothing.\nThe key `mend` stays.\nMend it, amend it.\n");
  EXPECT_THAT(lines_with(page, "for ever"), ElementsAre(1));
  EXPECT_THAT(lines_with(page, "mend"), ElementsAre(4));
  EXPECT_THAT(lines_with(page, "mends"), IsEmpty());
}

TEST(PlainEnglish, IsWhatEveryMessageUses) {
  std::vector<std::string> faults;
  std::size_t files = 0, messages = 0;
  std::set<std::string> folders = support::production_folders();
  folders.insert("docs/reference");
  for (const std::string& folder : folders) {
    for (const auto& path : files_below(folder, {".cpp", ".h"})) {
      ++files;
      for (const Prose& message : messages_of(core::read_file(path.string()).value())) {
        ++messages;
        append(faults, faults_of(in_tree(path), message));
      }
    }
  }
  EXPECT_GT(files, 600U);
  EXPECT_GT(messages, 1500U);
  EXPECT_THAT(faults, IsEmpty());
}

TEST(Prose, IsEveryCommentAcrossItsLines) {
  const auto comments = comments_of(
      "int a;  // waits for\n"
      "        // ever\n"
      "const char* b = \"// no comment\";\n"
      "  // the servo\n"
      "  // tells it\n");
  ASSERT_EQ(comments.size(), 2U);
  EXPECT_THAT(lines_with(comments[0], "for ever"), ElementsAre(1));
  EXPECT_THAT(lines_with(comments[1], "tells"), ElementsAre(5));
}

TEST(Prose, IsTheNameOfEveryTest) {
  const auto names = test_names_of("int a;\nTEST_P(GridSheet, TellsAColour) {}\n  TEST(No, Test)\nTEST(B,\n     C) {}");
  ASSERT_EQ(names.size(), 2U);
  EXPECT_EQ(names[0].text, " Grid Sheet: Tells A Colour");
  EXPECT_THAT(lines_with(names[0], "tells"), ElementsAre(2));
  EXPECT_EQ(names[1].text, " B: C");
}

TEST(PlainEnglish, IsWhatCommentsAndNamesOfTestsUse) {
  std::vector<std::string> faults;
  std::size_t comments = 0, names = 0;
  std::set<std::string> folders = support::production_folders();
  folders.insert({"assets", "docs/reference", "shaders", "tests"});
  for (const std::string& folder : folders) {
    for (const auto& path : files_below(folder, {".cpp", ".h", ".glsl", ".vert", ".frag", ".comp"})) {
      const std::string source = core::read_file(path.string()).value();
      for (const Prose& comment : comments_of(source)) {
        ++comments;
        append(faults, faults_of(in_tree(path), comment));
      }
      for (const Prose& name : test_names_of(source)) {
        ++names;
        append(faults, faults_of(in_tree(path), name));
      }
    }
  }
  EXPECT_GT(comments, 15000U);
  EXPECT_GT(names, 3000U);
  EXPECT_THAT(faults, IsEmpty());
}

TEST(PlainEnglish, IsWhatEveryHelpTextUses) {
  const app::CommandContext context{.assets_dir = "assets", .program_path = {}};
  app::CommandLine command_line("touchafm", "0", app::kProgramHelp);
  app::add_commands(command_line, context);
  EXPECT_THAT(faults_of_help("touchafm", command_line.describe()), IsEmpty());
}

TEST(PlainEnglish, IsWhatTheDocumentsAndTheWallUse) {
  std::vector<std::string> faults;
  for (const char* page : {"README.md", "ARCHITECTURE.md", "CONTRIBUTING.md"}) append(faults, faults_of_page(page));
  const auto pages = files_below("docs", {".md"});
  EXPECT_GE(pages.size(), 70U);
  for (const auto& path : pages) {
    const bool is_german = path.stem().extension() == ".de";
    if (!is_german) append(faults, faults_of_page(in_tree(path)));
  }
  const auto guidance = files_below("assets/guidance", {".toml"});
  EXPECT_GE(guidance.size(), 2U);
  for (const auto& path : guidance) append(faults, faults_of_page(in_tree(path)));
  EXPECT_THAT(faults, IsEmpty());
}

}  // namespace plain_english_test
}  // namespace afm
