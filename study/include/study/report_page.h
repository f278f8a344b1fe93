// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <variant>
#include <vector>

#include "study/interval.h"

namespace afm::study {

// A report as a list of blocks, converted to Markdown and HTML. Texts are plain.
struct PageHeading {
  int level;  // level of the heading, 2 or 3; 1 is the page's title
  std::string text;
};
struct PageText {
  std::string text;
};
struct PageList {
  std::vector<std::string> items;
};
struct PageTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};
struct PageFigure {
  std::string file;  // name of the figure's file, "table3.svg"
  std::string svg;
  std::string caption;
};
using PageBlock = std::variant<PageHeading, PageText, PageList, PageTable, PageFigure>;

// Report as Markdown, with links to the figures' files.
std::string page_markdown(std::span<const PageBlock> blocks);
// Report as one self-contained HTML file with the figures.
std::string page_html(const std::string& title, std::span<const PageBlock> blocks);

// Number as text: "0.65", "n/a" for a missing value, "unbounded".
std::string number_text(double value, int decimals);
std::string interval_text(const Interval& interval, int decimals);  // interval as text, "[0.52, 0.77]"
std::string estimate_text(const Estimate& estimate, int decimals);  // estimate as text, "0.65 [0.52, 0.77]"

// Test as text: "paired t: t(19) = 2.18, p = 0.042; d_z = 0.49 [0.02, 0.95]".
std::string test_text(const TestResult& test);
// Text of a p value, "p = 0.042" or "p < 0.001". Use it only next to a test_text().
std::string p_text(double p);

}  // namespace afm::study
