// SPDX-License-Identifier: Apache-2.0
#include "panels/font_finder.h"

#include <dlfcn.h>

#include <array>
#include <string_view>
#include <utility>

#include "core/enumerators.h"
#include "core/own_folder.h"
#include "core/whole_file.h"

namespace afm::render {
namespace {

struct FaceRow {
  FontFace face;
  const char* file;
  const char* family;
  const char* weight;  // word in fontconfig's patterns
};

constexpr std::array<FaceRow, kFontFaces> kFaces{
    {{FontFace::InterMedium, "Inter-Medium.otf", "Inter", "medium"},
     {FontFace::InterSemiBold, "Inter-SemiBold.otf", "Inter", "semibold"},
     {FontFace::DejaVu, "DejaVuSans.ttf", "DejaVu Sans", "regular"},
     {FontFace::DejaVuBold, "DejaVuSans-Bold.ttf", "DejaVu Sans", "bold"}}};
static_assert(core::has_row_for_each(kFaces, &FaceRow::face));

const FaceRow& row_of(FontFace face) { return kFaces[static_cast<std::size_t>(face)]; }

// True for a file with an OpenType signature; ImGui ends the program for any other.
bool is_font(const std::string& bytes) {
  using namespace std::string_view_literals;
  return bytes.starts_with("OTTO"sv) || bytes.starts_with("\0\1\0\0"sv);
}

std::optional<std::string> read_font(const std::string& path) {
  auto bytes = core::read_file(path);
  if (!bytes || !is_font(*bytes)) return std::nullopt;
  return std::move(*bytes);
}

}  // namespace

// Interface to the system's fonts through its library (fontconfig/fontconfig.h), which may be missing.
class Fontconfig {
 public:
  Fontconfig() : library_(::dlopen("libfontconfig.so.1", RTLD_NOW | RTLD_LOCAL)) {  // never closed: it keeps caches
    if (library_ == nullptr) return;
    const bool whole = bind("FcInitLoadConfigAndFonts", load_) && bind("FcConfigDestroy", destroy_config_) &&
                       bind("FcNameParse", parse_) && bind("FcConfigSubstitute", substitute_) &&
                       bind("FcDefaultSubstitute", complete_) && bind("FcFontMatch", match_) &&
                       bind("FcPatternGetString", text_of_) && bind("FcPatternDestroy", destroy_pattern_);
    if (whole) config_ = load_();
  }
  Fontconfig(const Fontconfig&) = delete;
  Fontconfig& operator=(const Fontconfig&) = delete;
  ~Fontconfig() {
    if (config_ != nullptr) destroy_config_(config_);
  }

  // Path of the font that fits best; empty if there is none, or if it is of another family than `family`, where that is
  // not empty.
  std::string file_of(const std::string& pattern, const std::string& family) const {
    if (config_ == nullptr) return {};
    void* const wanted = parse_(reinterpret_cast<const unsigned char*>(pattern.c_str()));
    if (wanted == nullptr) return {};
    substitute_(config_, wanted, kMatchPattern);
    complete_(wanted);
    int result = 0;
    void* const found = match_(config_, wanted, &result);
    destroy_pattern_(wanted);
    if (found == nullptr) return {};
    std::string file = text(found, "file", 0);
    bool fits = family.empty();
    for (int name = 0; !fits && !text(found, "family", name).empty(); ++name) {
      fits = text(found, "family", name) == family;
    }
    destroy_pattern_(found);
    return fits ? file : std::string();
  }

 private:
  static constexpr int kMatchPattern = 0;  // value of FcMatchPattern

  template <class Function>
  bool bind(const char* name, Function& function) {
    function = reinterpret_cast<Function>(::dlsym(library_, name));
    return function != nullptr;
  }

  // Empty if the pattern has no such entry.
  std::string text(void* pattern, const char* object, int number) const {
    unsigned char* value = nullptr;
    if (text_of_(pattern, object, number, &value) != 0) return {};
    return reinterpret_cast<const char*>(value);
  }

  void* library_ = nullptr;
  void* config_ = nullptr;  // null: no answers available
  void* (*load_)() = nullptr;
  void (*destroy_config_)(void*) = nullptr;
  void* (*parse_)(const unsigned char*) = nullptr;
  int (*substitute_)(void*, void*, int) = nullptr;
  void (*complete_)(void*) = nullptr;
  void* (*match_)(void*, void*, int*) = nullptr;
  int (*text_of_)(const void*, const char*, int, unsigned char**) = nullptr;
  void (*destroy_pattern_)(void*) = nullptr;
};

FontFinder::FontFinder(std::vector<std::string> folders) : folders_(std::move(folders)) {}
FontFinder::~FontFinder() = default;

std::optional<std::string> FontFinder::ask(const std::string& family, FontFace face, bool any_family) {
  if (!fontconfig_) fontconfig_ = std::make_unique<Fontconfig>();
  const std::string file = fontconfig_->file_of(family + ":" + row_of(face).weight, any_family ? "" : family);
  return file.empty() ? std::nullopt : read_font(file);
}

std::optional<std::string> FontFinder::read(FontFace face) {
  for (const std::string& folder : folders_) {
    if (auto bytes = read_font(folder + "/" + row_of(face).file)) return bytes;
  }
  return ask(row_of(face).family, face, false);
}

std::optional<std::string> FontFinder::read_similar(FontFace face) { return ask("sans-serif", face, true); }

std::vector<std::string> font_folders() {
  return {(core::assets_of(core::own_program()) / "fonts").string(), "/usr/share/fonts/opentype/inter",
          "/usr/share/fonts/truetype/dejavu"};
}

}  // namespace afm::render
