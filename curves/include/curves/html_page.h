// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace afm::curves {

// Parts of a report in one self-contained HTML file for any width. Arguments are plain text unless they are named html
// or svg.

// Text with HTML's special characters escaped; "F_ad" gets a subscript, as on the wall.
std::string html_text(const std::string& text);

// The beginning of the page, including <body>.
std::string html_head(const std::string& language, const std::string& title);

std::string html_heading(const std::string& text);
std::string html_note(const std::string& html);

// The beginning of a table with its head; close it with "</table>".
std::string html_table_head(const std::vector<std::string>& names);

// A box that scrolls, also by keyboard, if the browser is narrower than its content.
std::string html_scrolled(const std::string& html);

// A figure with its caption, in a scrolling box.
std::string html_figure(const std::string& html, const std::string& caption);

// A stereo pair of PNG bytes, embedded in the page.
std::string html_picture(const std::string& png, const std::string& caption);

// The left eye's half of a stereo pair of this many pixels: it fits every browser.
std::string html_one_eye(const std::string& png, const std::string& caption, std::uint32_t width, std::uint32_t height);

// A figure with a plot that shrinks with the browser instead of scrolling.
std::string html_fitting(const std::string& figure);

}  // namespace afm::curves
