// SPDX-License-Identifier: Apache-2.0
#include "study/report_page.h"

#include <fmt/format.h>

#include <cmath>

#include "curves/html_page.h"

namespace afm::study {

namespace {

using curves::html_figure;
using curves::html_fitting;
using curves::html_head;
using curves::html_heading;
using curves::html_scrolled;
using curves::html_table_head;
using curves::html_text;

// Escapes bars, which would end the cell.
std::string markdown_cell(const std::string& text) {
  std::string cell;
  for (const char c : text) cell += c == '|' ? std::string("\\|") : std::string(1, c);
  return cell;
}

struct MarkdownBlock {
  std::string operator()(const PageHeading& heading) const {
    return std::string(static_cast<std::size_t>(heading.level), '#') + " " + heading.text + "\n\n";
  }
  std::string operator()(const PageText& text) const { return text.text + "\n\n"; }
  std::string operator()(const PageList& list) const {
    std::string lines;
    for (const std::string& item : list.items) lines += "- " + item + "\n";
    return lines + "\n";
  }
  std::string operator()(const PageTable& table) const {
    std::string lines = "|", rule = "|";
    for (const std::string& column : table.columns) {
      lines += " " + markdown_cell(column) + " |";
      rule += rule.size() == 1 ? "---|" : "---:|";
    }
    lines += "\n" + rule + "\n";
    for (const auto& row : table.rows) {
      lines += "|";
      for (const std::string& cell : row) lines += " " + markdown_cell(cell) + " |";
      lines += "\n";
    }
    return lines + "\n";
  }
  std::string operator()(const PageFigure& figure) const {
    return fmt::format("![{}]({})\n\n", figure.caption, figure.file);
  }
};

struct HtmlBlock {
  std::string operator()(const PageHeading& heading) const {
    if (heading.level == 2) return html_heading(heading.text);
    return "<h3>" + html_text(heading.text) + "</h3>\n";
  }
  std::string operator()(const PageText& text) const { return "<p>" + html_text(text.text) + "</p>\n"; }
  std::string operator()(const PageList& list) const {
    std::string html = "<ul>\n";
    for (const std::string& item : list.items) html += "<li>" + html_text(item) + "</li>\n";
    return html + "</ul>\n";
  }
  std::string operator()(const PageTable& table) const {
    std::string html = html_table_head(table.columns);
    for (const auto& row : table.rows) {
      html += "<tr>";
      for (const std::string& cell : row) html += "<td>" + html_text(cell) + "</td>";
      html += "</tr>\n";
    }
    return html_scrolled(html + "</table>") + "\n";
  }
  std::string operator()(const PageFigure& figure) const {
    return html_fitting(html_figure(figure.svg, figure.caption));
  }
};

}  // namespace

std::string page_markdown(std::span<const PageBlock> blocks) {
  std::string text;
  for (const PageBlock& block : blocks) text += std::visit(MarkdownBlock{}, block);
  return text;
}

std::string page_html(const std::string& title, std::span<const PageBlock> blocks) {
  std::string html = html_head("en", title) + "<h1>" + html_text(title) + "</h1>\n";
  for (const PageBlock& block : blocks) html += std::visit(HtmlBlock{}, block);
  return html + "</body></html>\n";
}

std::string number_text(double value, int decimals) {
  if (std::isnan(value)) return "n/a";
  if (std::isinf(value)) return value < 0.0 ? "-\u221e" : "\u221e";
  std::string text = fmt::format("{:.{}f}", value, decimals);
  // no minus sign on zero
  const bool zero = text.starts_with('-') && text.find_first_not_of("-0.") == std::string::npos;
  return zero ? text.substr(1) : text;
}

std::string interval_text(const Interval& interval, int decimals) {
  if (std::isnan(interval.low) && std::isnan(interval.high)) return "[n/a]";
  return fmt::format("[{}, {}]", number_text(interval.low, decimals), number_text(interval.high, decimals));
}

std::string estimate_text(const Estimate& estimate, int decimals) {
  if (std::isnan(estimate.value)) return "n/a";
  return number_text(estimate.value, decimals) + " " + interval_text(estimate.interval, decimals);
}

std::string p_text(double p) {
  if (std::isnan(p)) return "p n/a";
  if (p < 0.001) return "p < 0.001";
  return fmt::format("p = {:.{}f}", p, p < 0.1 ? 3 : 2);
}

std::string test_text(const TestResult& test) {
  if (std::isnan(test.p)) return test.name + ": too few values, or no spread";
  std::string text = fmt::format("{}: {}, {}; {} = {}", test.name, test.statistic, p_text(test.p), test.effect_name,
                                 estimate_text(test.effect, 2));
  if (!std::isnan(test.holm_p)) text += "; after Holm's correction " + p_text(test.holm_p);
  return text;
}

}  // namespace afm::study
