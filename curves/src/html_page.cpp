// SPDX-License-Identifier: Apache-2.0
#include "curves/html_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>

#include "core/base64.h"
#include "core/printable.h"

namespace afm::curves {

namespace {

constexpr const char* kStyle = R"(
body { font: 16px/1.5 Inter, "DejaVu Sans", sans-serif; color: #1c2430; background: #f4f5f7; margin: 0 auto; max-width: 1100px; padding: 1.5em; }
h1 { font-size: 1.7em; margin-bottom: 0.2em; } h2 { margin-top: 1.8em; font-size: 1.25em; }
figure { margin: 1em 0; } figure img, figure svg { width: 100%; height: auto; border-radius: 6px; background: #fff; }
figcaption { color: #4a5568; font-size: 0.93em; margin-top: 0.3em; }
table { border-collapse: collapse; width: 100%; font-size: 0.93em; background: #fff; }
th, td { border: 1px solid #d5dae1; padding: 0.35em 0.6em; text-align: right; } th { background: #e8ebf0; }
td:first-child, th:first-child { text-align: left; }
figure img.one { object-fit: cover; object-position: left; }
.results { font-size: 1.15em; padding: 0; list-style: none; }
.note { color: #4a5568; font-size: 0.93em; }
.wide { overflow-x: auto; } .wide:focus { outline: 2px solid #3b82c4; }
@media (max-width: 760px) {
  body { padding: 0.8em; } td, th { white-space: nowrap; }
  .wide img, .wide svg { width: auto; min-width: 900px; } .wide img.pair { min-width: 1400px; }
  .wide img.one, .fits .wide svg { width: 100%; min-width: 0; }
}
)";

bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
bool is_alnum(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

std::string escaped(const std::string& text) {
  std::string html;
  for (const char c : core::printable(text)) {
    if (c == '&') {
      html += "&amp;";
    } else if (c == '<') {
      html += "&lt;";
    } else if (c == '"') {
      html += "&quot;";
    } else {
      html += c;
    }
  }
  return html;
}

}  // namespace

std::string html_text(const std::string& text) {
  std::string html;
  const std::string plain = escaped(text);
  for (std::size_t i = 0; i < plain.size(); ++i) {
    const bool symbol = plain[i] == '_' && i > 0 && is_upper(plain[i - 1]) && (i == 1 || !is_alnum(plain[i - 2]));
    if (!symbol) {
      html += plain[i];
      continue;
    }
    const auto begin = plain.begin() + static_cast<std::ptrdiff_t>(i + 1);
    const auto end = std::find_if_not(begin, plain.end(), is_alnum);
    html += "<sub>" + std::string(begin, end) + "</sub>";
    i += static_cast<std::size_t>(end - begin);
  }
  return html;
}

std::string html_head(const std::string& language, const std::string& title) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"{}\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width, "
      "initial-scale=1\"><title>{}</title><style>{}</style></head>"
      "<body>\n",
      escaped(language), escaped(title), kStyle);
}

std::string html_heading(const std::string& text) { return "<h2>" + html_text(text) + "</h2>\n"; }

std::string html_note(const std::string& html) { return "<p class=\"note\">" + html + "</p>\n"; }

std::string html_table_head(const std::vector<std::string>& names) {
  std::string html = "<table><tr>";
  for (const std::string& name : names) html += "<th>" + html_text(name) + "</th>";
  return html + "</tr>\n";
}

std::string html_scrolled(const std::string& html) { return "<div class=\"wide\" tabindex=\"0\">" + html + "</div>"; }

std::string html_figure(const std::string& html, const std::string& caption) {
  return fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", html_scrolled(html), html_text(caption));
}

std::string html_picture(const std::string& png, const std::string& caption) {
  return fmt::format("<img class=\"pair\" alt=\"{}\" src=\"data:image/png;base64,{}\">", escaped(caption),
                     core::base64(png));
}

std::string html_one_eye(const std::string& png, const std::string& caption, std::uint32_t width,
                         std::uint32_t height) {
  return fmt::format("<img class=\"one\" style=\"aspect-ratio: {} / {}\" alt=\"{}\" src=\"data:image/png;base64,{}\">",
                     width, height, escaped(caption), core::base64(png));
}

std::string html_fitting(const std::string& figure) { return "<div class=\"fits\">" + figure + "</div>\n"; }

}  // namespace afm::curves
