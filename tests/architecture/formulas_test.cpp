// SPDX-License-Identifier: Apache-2.0
// Invariant: each formula of docs/physics.md and docs/fits.md has its source and its case
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "core/whole_file.h"
#include "support/places.h"

namespace afm {
namespace formulas_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string text_of(const std::string& path) { return core::read_file(support::source(path)).value(); }

// A paragraph, a displayed formula or a row of a table with its header.
struct Block {
  std::string text;
  std::size_t line = 0;
  std::vector<std::string> header, cells;  // cells of a row

  const std::string* cell(std::string_view column) const {
    for (std::size_t i = 0; i < header.size() && i < cells.size(); ++i) {
      if (header[i] == column) return &cells[i];
    }
    return nullptr;
  }
};

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(' '), end = text.find_last_not_of(' ');
  return begin == std::string::npos ? std::string() : text.substr(begin, end - begin + 1);
}

std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells;
  std::istringstream rest(row.substr(1));
  for (std::string cell; std::getline(rest, cell, '|');) cells.push_back(trimmed(cell));
  return cells;
}

std::vector<Block> blocks_of(const std::string& page) {
  std::vector<Block> blocks;
  std::vector<std::string> header;
  std::istringstream lines(page);
  bool goes_on = false, shown = false;
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const bool row = line.starts_with("|"), display = line.starts_with("    ");
    if (!row) header.clear();
    if (line.empty() || line.starts_with("#")) {
      goes_on = false;
    } else if (row && header.empty()) {
      header = cells_of(line);
      for (std::string& column : header) {
        std::transform(column.begin(), column.end(), column.begin(), [](unsigned char c) { return std::tolower(c); });
      }
      goes_on = false;
    } else if (row) {
      if (!line.starts_with("|---")) blocks.push_back({line, number, header, cells_of(line)});
      goes_on = false;
    } else if (goes_on && display == shown && !std::regex_search(line, std::regex("^(-|[0-9]+\\.) "))) {
      blocks.back().text += " " + trimmed(line);
    } else {
      blocks.push_back({trimmed(line), number, {}, {}});
      goes_on = true;
    }
    shown = display;
  }
  return blocks;
}

// An equation that says more than the value of a symbol, "T = 0" or "k_c = 0.1 N/m"; or a root, an integral and the
// like.
bool is_formula(const std::string& text) {
  static const std::regex kValue(
      R"(^[-+]?[0-9][0-9.,]*( (nm|um|µm|pN|nN|N|N/m|Pa|kPa|MPa|GPa|Hz|kHz|K|J|zJ|mm|pm|%))?($|[.,;:|)`]|\s))"),
      kOperand(R"(^[-+]?[0-9]([0-9.,]*[0-9])? (pi|sqrt|cbrt|cos|sin|tan|exp|π|√|[A-Za-z]([_0-9(/*\\]|$| |[^A-Za-z])))"),
      kUnit(R"(^[-+]?[0-9][0-9.,]* (N|K|J)\b)");
  for (const std::string_view sign : {"sqrt(", "cbrt(", "asinh(", "exp(", "√", "∫", "∮"}) {
    if (text.find(sign) != std::string::npos) return true;
  }
  constexpr std::string_view kEquals = " = ";
  for (std::size_t at = text.find(kEquals); at != std::string::npos; at = text.find(kEquals, at + 1)) {
    const std::string right = text.substr(at + kEquals.size());
    const bool value =
        std::regex_search(right, kValue) && (!std::regex_search(right, kOperand) || std::regex_search(right, kUnit));
    if (!value) return true;
  }
  return false;
}

std::vector<std::string> labels_in(const std::string& text) {
  static const std::regex kLabel(R"(\(([0-9]\.[0-9]+|[FP][0-9]+)[,)])");
  std::vector<std::string> labels;
  for (std::sregex_iterator found(text.begin(), text.end(), kLabel), end; found != end; ++found) {
    labels.push_back((*found)[1]);
  }
  return labels;
}

std::set<std::string> reference_cases() {
  std::set<std::string> ids;
  std::istringstream rows(text_of("tests/physics/data/physics_cases.csv"));
  for (std::string row; std::getline(rows, row);) ids.insert(row.substr(0, row.find(',')));
  return ids;
}

// A row of the reference cases, or a test: architecture.EveryTestThatADocumentNamesExists looks for those.
bool names_a_case(const std::string& cell, const std::set<std::string>& cases) {
  static const std::regex kCode("`([^`]+)`"), kTest("[A-Z][A-Za-z0-9]+\\.[A-Z][A-Za-z0-9]+");
  bool named = false;
  for (std::sregex_iterator found(cell.begin(), cell.end(), kCode), end; found != end; ++found) {
    const std::string name = (*found)[1];
    if (std::regex_match(name, kTest) || cases.contains(name)) {
      named = true;
    } else if (std::regex_match(name, std::regex("[a-z]+_C?[0-9]+t?"))) {
      return false;  // a case that was renamed
    }
  }
  return named;
}

std::vector<std::string> faults_of(const std::string& page, const std::set<std::string>& cases) {
  const std::vector<Block> blocks = blocks_of(page);
  std::vector<std::string> faults;
  std::set<std::string> known, used;
  const auto fault = [&](const Block& block, std::string_view what) {
    faults.push_back(fmt::format("line {}: {}: {}", block.line, what, block.text.substr(0, 70)));
  };
  for (const Block& block : blocks) {
    const std::string *source = block.cell("source"), *named = block.cell("case"), *listed = block.cell("formula");
    if (source == nullptr || named == nullptr) continue;
    std::string formula;
    for (const std::string& cell : block.cells) {
      if (&cell != source && &cell != named) formula += cell + " ";
    }
    const std::vector<std::string> labels = labels_in(formula);
    known.insert(labels.begin(), labels.end());
    if (listed == nullptr && !is_formula(formula)) continue;
    if (source->empty()) fault(block, "no source");
    if (!names_a_case(*named, cases)) fault(block, "no case");
  }
  for (const Block& block : blocks) {
    if (block.cell("formula") != nullptr || block.cell("symbol") != nullptr) continue;
    const std::vector<std::string> labels = labels_in(block.text);
    used.insert(labels.begin(), labels.end());
    if (block.cell("source") != nullptr && block.cell("case") != nullptr) continue;
    if (!is_formula(block.text)) continue;
    if (labels.empty()) fault(block, "no number");
    for (const std::string& label : labels) {
      if (!known.contains(label)) fault(block, fmt::format("({}) has no row with source and case", label));
    }
  }
  for (const std::string& label : known) {
    if (!used.contains(label)) faults.push_back(fmt::format("({}) is listed, but no formula has it", label));
  }
  return faults;
}

TEST(Formulas, HaveTheirSourceAndTheirCase) {
  const std::set<std::string> cases = reference_cases();
  for (const char* page : {"docs/physics.md", "docs/fits.md"}) {
    const std::string text = text_of(page);
    EXPECT_THAT(faults_of(text, cases), IsEmpty()) << page;
    const std::vector<Block> blocks = blocks_of(text);
    EXPECT_GT(std::count_if(blocks.begin(), blocks.end(), [](const Block& block) { return is_formula(block.text); }),
              15)
        << page;
  }
}

TEST(Formulas, AreEquationsRootsAndIntegralsButNoValues) {
  for (const char* formula : {"F = -k' Z", "h0 = W/sigma0 = 0.974 z0", "along y = 0 the sine of E0 = 4 U", "∮F dh",
                              "K = 4 E\\*/3", "sigma0 = 16 W/(9 z0)", "4 pi: x = 2 pi² a", "w0 = 2 pi f_0"}) {
    EXPECT_TRUE(is_formula(formula)) << formula;
  }
  for (const char* value : {"at T = 0 it is of second order", "R = 50 nm, k_c = 0.1 N/m", "`z = 0` is its surface",
                            "Q = 2.5, only 0.030 of", "E\\* = 4 kPa", "with Z = 0 20 mm lower", "| F = 0 |"}) {
    EXPECT_FALSE(is_formula(value)) << value;
  }
}

TEST(Formulas, WithoutNumberSourceOrCaseAreFound) {
  const std::set<std::string> cases{"paper_01"};
  const auto faults = [&](const std::string& page) { return faults_of(page, cases); };
  const std::string list = "\n| formula | source | case |\n|---|---|---|\n";
  EXPECT_THAT(faults("With F = k x (P1), the lever\nbends.\n" + list + "| (P1) | Hooke | `paper_01` |\n"), IsEmpty());
  EXPECT_THAT(faults("With F = k x, the lever bends.\n"), ElementsAre(HasSubstr("no number")));
  EXPECT_THAT(faults("- F = k x\n- the next (P1)\n" + list + "| (P1) | Hooke | `Ab.Cd` |\n"),
              ElementsAre(HasSubstr("line 1: no number")));
  EXPECT_THAT(faults("    F = k x   (P1)\n"), ElementsAre(HasSubstr("no row")));
  EXPECT_THAT(faults("F = k x (P1)\n" + list + "| (P1) | | `paper_01` |\n"), ElementsAre(HasSubstr("no source")));
  EXPECT_THAT(faults("F = k x (P1)\n" + list + "| (P1) | Hooke | by hand |\n"), ElementsAre(HasSubstr("no case")));
  EXPECT_THAT(faults("F = k x (P1)\n" + list + "| (P1) | Hooke | `Ab.Cd`, `paper_09` |\n"),
              ElementsAre(HasSubstr("no case")));
  EXPECT_THAT(faults("Nothing.\n" + list + "| (P1) | Hooke | `Ab.Cd` |\n"), ElementsAre(HasSubstr("no formula")));
  EXPECT_THAT(faults("| law | Source | Case |\n|---|---|---|\n| F = k x | Hooke | |\n| words | | |\n"),
              ElementsAre(HasSubstr("line 3: no case")));
}

}  // namespace formulas_test
}  // namespace afm
