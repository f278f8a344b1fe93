// SPDX-License-Identifier: Apache-2.0
#include "app/analyse/fit_page.h"

#include <fmt/format.h>

#include "core/base64.h"
#include "core/printable.h"
#include "core/written_by.h"
#include "curves/html_page.h"
#include "curves/modulus_statistics.h"
#include "physics/quantity_text.h"

namespace afm::app {

namespace {

std::string table_row(const std::vector<std::string>& cells) {
  std::string html = "<tr>";
  for (const std::string& cell : cells) html += "<td>" + curves::html_text(cell) + "</td>";
  return html + "</tr>\n";
}

std::string table(const std::string& heading, const std::vector<std::string>& names, const std::string& rows) {
  return curves::html_heading(heading) + curves::html_scrolled(curves::html_table_head(names) + rows + "</table>") +
         "\n";
}

// Note on the rows left out; empty if the list is complete.
std::string rest_note(std::size_t shown, std::size_t all) {
  return shown < all ? curves::html_note(fmt::format("{} more are in fits.tsv.", all - shown)) : std::string();
}

}  // namespace

void FitPage::begin(const std::string& file) {
  if (files_begun_++ > 0 && files_.size() < kMostRows) files_.push_back(with_median());
  current_ = {};
  current_.name = core::printable_line(file);
  moduli_pa_.clear();
}

void FitPage::add(const curves::FittedCurve& fitted) {
  ++curves_;
  const std::size_t index = current_.curves++;
  if (!fitted.fit) {
    ++current_.unread;
    ++unread_;
    if (unfitted_.size() < kMostRows) unfitted_.push_back({current_.name, index, core::printable_line(fitted.why)});
    return;
  }
  ++current_.trusts.at(static_cast<std::size_t>(fitted.fit->trust));
  if (fitted.fit->trust != fits::Trust::No) moduli_pa_.push_back(fitted.fit->modulus_pa);
  for (const fits::Found& found : fitted.fit->doubts) ++doubts_[found.doubt];
}

void FitPage::add_map(std::string png) {
  if (maps_.size() < kMostMaps) maps_.push_back({current_.name, std::move(png)});
}

FitPage::FileRow FitPage::with_median() const {
  FileRow row = current_;
  if (!moduli_pa_.empty()) row.median_pa = curves::modulus_figures(moduli_pa_).median_pa;
  return row;
}

std::string FitPage::files_html() const {
  std::vector<FileRow> rows = files_;
  if (files_begun_ > 0 && rows.size() < kMostRows) rows.push_back(with_median());
  std::string html;
  for (const FileRow& row : rows) {
    const std::string median =
        row.median_pa > 0.0 ? physics::format_quantity(physics::Pressure(row.median_pa), physics::kPressureUnits, 4)
                            : "";
    html +=
        table_row({row.name, fmt::format("{}", row.curves), median, fmt::format("{}", row.trusts[0]),
                   fmt::format("{}", row.trusts[1]), fmt::format("{}", row.trusts[2]), fmt::format("{}", row.unread)});
  }
  return table("Files",
               {"file", "curves", "median of the modulus", "trusted", "doubtful", "not trusted", "without a fit"},
               html) +
         rest_note(rows.size(), files_begun_);
}

std::string FitPage::doubts_html() const {
  if (doubts_.empty()) return {};
  std::string html;
  for (const auto& [doubt, count] : doubts_) {
    const fits::DoubtRow& row = fits::row_of(doubt);
    html += table_row({std::string(row.name), fmt::format("{:g}", row.limit), row.fatal ? "no" : "doubtful",
                       fmt::format("{}", count)});
  }
  return table("Doubts", {"figure", "limit", "verdict", "curves"}, html);
}

std::string FitPage::unfitted_html() const {
  if (unfitted_.empty()) return {};
  std::string html;
  for (const Unfitted& each : unfitted_) html += table_row({each.file, fmt::format("{}", each.index), each.why});
  return table("Curves without a fit", {"file", "curve", "reason"}, html) + rest_note(unfitted_.size(), unread_);
}

std::string FitPage::html(const std::vector<std::string>& results, const Texts& settings,
                          const std::string& histograms) const {
  const std::string title = fmt::format("Fits of {} curves", curves_);
  std::string html =
      curves::html_head("en", title) + "<h1>" + curves::html_text(title) + "</h1>\n<ul class=\"results\">";
  for (const std::string& line : results) html += "<li>" + curves::html_text(line) + "</li>\n";
  html += "</ul>\n";
  if (!histograms.empty()) {
    html += curves::html_fitting(
        curves::html_figure(histograms.substr(histograms.find("<svg")),
                            "Moduli of the trusted and the doubtful fits; the line is the median"));
  }
  for (const Picture& map : maps_) {
    html += curves::html_figure(
        fmt::format("<img alt=\"modulus of a map\" src=\"data:image/png;base64,{}\">", core::base64(map.png)),
        fmt::format("Modulus of {}; fits that are not trusted are striped", map.file));
  }
  html += files_html() + doubts_html() + unfitted_html();
  std::string rows;
  for (const auto& [name, value] : settings) rows += table_row({name, value});
  html += table("Settings", {"setting", "value"}, rows);
  return html + curves::html_note(curves::html_text(core::written_by())) + "</body></html>\n";
}

}  // namespace afm::app
