// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace afm::curves {

// The pieces of a report in one HTML file that opens anywhere and on any width. Arguments are plain text unless they
// are named html or svg.

// Text with HTML's own characters escaped; "F_ad" gets a subscript, as on the wall.
std::string html_text(const std::string& text);

// Up to and with <body>.
std::string html_head(const std::string& language, const std::string& title);

std::string html_heading(const std::string& text);
std::string html_note(const std::string& html);

// A table's start with its head; "</table>" ends it.
std::string html_table_head(const std::vector<std::string>& names);

// A box that scrolls where a browser is narrower than its content; the keyboard reaches it too.
std::string html_scrolled(const std::string& html);

// A scrolled figure with its caption.
std::string html_figure(const std::string& html, const std::string& caption);

// A stereo pair of PNG bytes inside the page.
std::string html_picture(const std::string& png, const std::string& caption);

}  // namespace afm::curves
