// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace afm::render {

// Fonts of the panels.
enum class FontFace { InterMedium, InterSemiBold, DejaVu, DejaVuBold };
inline constexpr std::size_t kFontFaces = 4;

class Fontconfig;

// Finds font files in TrueType or OpenType format: by name in folders, then by family through fontconfig. Opens
// fontconfig's library only when needed. One thread.
class FontFinder {
 public:
  explicit FontFinder(std::vector<std::string> folders);
  FontFinder(const FontFinder&) = delete;
  FontFinder& operator=(const FontFinder&) = delete;
  ~FontFinder();

  // Contents of this font's file; nothing if it is not installed.
  std::optional<std::string> read(FontFace face);
  // Contents of any font without serifs, of about the same weight; nothing if fontconfig knows none.
  std::optional<std::string> read_similar(FontFace face);

 private:
  std::optional<std::string> ask(const std::string& family, FontFace face, bool any_family);

  std::vector<std::string> folders_;
  std::unique_ptr<Fontconfig> fontconfig_;
};

// The program's own fonts, as a bundle has, before those of Debian's packages.
std::vector<std::string> font_folders();

}  // namespace afm::render
