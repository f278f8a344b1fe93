// SPDX-License-Identifier: Apache-2.0
#include "curves/image_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "bytes/file_bytes.h"
#include "bytes/igor_wave.h"
#include "bytes/nanosurf_header.h"
#include "bytes/tiff_page.h"
#include "core/enumerators.h"
#include "core/printable.h"
#include "curves/curve_error.h"
#include "curves/curve_file.h"
#include "formats/format_table.h"
#include "images/gsf_image.h"
#include "images/gwy_image.h"
#include "images/igor_image.h"
#include "images/image_pages.h"
#include "images/jpk_image.h"
#include "images/nanoscope_image.h"
#include "images/nanosurf_image.h"
#include "images/nhf_pages.h"
#include "images/park_image.h"

namespace afm::curves {

namespace {

constexpr std::size_t kLongestBeginning = 65536;
constexpr std::size_t kMostTextBytes = 4096;  // limit for a name, a key or a value

struct FormatRow {
  ImageFormat format;
  std::string_view name;
  std::string_view files;  // names and endings, as listed in kImageFiles
  bool (*begins)(std::string_view bytes);
  ImagePages (*read)(std::string_view bytes);
  std::string (*convert)(std::string_view bytes) =
      nullptr;  // converter that runs in a confined program before `read`; null: none
};

constexpr FormatTable kImages{
    "image",
    [](std::string_view b) {
      return begins_like_curve(b) ? std::string_view("a curve, not an image") : std::string_view();
    },
    kImageFiles, kLongestBeginning,
    std::array{
        FormatRow{ImageFormat::Gsf, "Gwyddion simple field", ".gsf",
                  [](std::string_view b) { return b.starts_with(kGsfMagic); }, read_gsf},
        FormatRow{ImageFormat::Gwy, "Gwyddion", "Gwyddion .gwy",
                  [](std::string_view b) { return b.starts_with(kGwyMagic) || b.starts_with(kOldGwyMagic); }, read_gwy},
        FormatRow{ImageFormat::Nanoscope, "Nanoscope", "Nanoscope .spm or .001",
                  [](std::string_view b) {
                    return b.starts_with(kNanoscopeMagic) || b.starts_with(kNanoscopeElectrochemistryMagic);
                  },
                  read_nanoscope},
        FormatRow{ImageFormat::Igor, "Igor", "Igor .ibw",
                  [](std::string_view b) { return looks_like_igor_image(b) || is_old_igor(b); }, read_igor_image},
        FormatRow{ImageFormat::Nanosurf, "Nanosurf", "Nanosurf .nid",
                  [](std::string_view b) { return b.starts_with(kNanosurfMagic) && !is_nanosurf_spectroscopy(b); },
                  read_nanosurf_image},
        FormatRow{ImageFormat::Nhf, "Nanosurf", ".nhf", begins_as_nhf, read_nhf_pages, nhf_as_gwy},
        FormatRow{ImageFormat::Park, "Park", "Park .tiff", looks_like_park, read_park_image},
        FormatRow{ImageFormat::Jpk, "JPK", "JPK .jpk", looks_like_tiff, read_jpk_image}}};
static_assert(core::has_row_for_each(kImages.rows, &FormatRow::format));
static_assert(kImages.names_all(), "kImageFiles names the files of every format");

std::string lower(std::string_view text) {
  std::string small(text);
  std::transform(small.begin(), small.end(), small.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return small;
}

// Numbers repeated names, so that each channel can be selected.
void number_names(std::vector<ImagePage>& pages) {
  for (std::size_t i = 0; i < pages.size(); ++i) {
    const auto same = [&](const ImagePage& page) { return lower(page.name) == lower(pages[i].name); };
    const auto before = std::count_if(pages.begin(), pages.begin() + static_cast<std::ptrdiff_t>(i), same);
    if (before > 0) pages[i].name += fmt::format(" ({})", before + 1);
  }
}

std::string names_of(const std::vector<ImagePage>& pages) {
  std::string names;
  for (const ImagePage& page : pages) names += (names.empty() ? "" : ", ") + page.name;
  return names;
}

// Names that instruments give to a channel in metres: the beginning, in lower case.
enum class Content { Height, Other, NoHeight };
struct NameRow {
  std::string_view beginning;
  Content content;
};
constexpr std::array kNames{NameRow{"height", Content::Height},      NameRow{"topography", Content::Height},
                            NameRow{"z ", Content::Height},          NameRow{"z-axis", Content::Height},
                            NameRow{"zsens", Content::Height},       NameRow{"defl", Content::NoHeight},
                            NameRow{"amplitude", Content::NoHeight}, NameRow{"lock-in", Content::NoHeight},
                            NameRow{"peak force", Content::NoHeight}};

Content content_of(const std::string& name) {
  if (name == "z") return Content::Height;
  const auto* const row =
      std::find_if(kNames.begin(), kNames.end(), [&](const NameRow& each) { return name.starts_with(each.beginning); });
  return row == kNames.end() ? Content::Other : row->content;
}

// Preference as a height: content, then trace before retrace; smaller is better.
int rank_as_height(const ImagePage& page) {
  const std::string name = lower(page.name);
  const Content content = page.unit == "m" ? content_of(name) : Content::NoHeight;
  const bool retrace = content != Content::NoHeight && name.find("retrace") != std::string::npos;
  return 2 * static_cast<int>(content) + (retrace ? 1 : 0);
}

// Throws with the reasons of the channels that cannot be read.
std::size_t chosen_page(const ImagePages& image, const std::string& wanted) {
  const std::vector<ImagePage>& pages = image.pages;
  const auto named = [&](const auto& channel) { return wanted.empty() || lower(channel.name) == lower(wanted); };
  const auto unread = std::find_if(image.unread.begin(), image.unread.end(), named);
  if (pages.empty() && unread == image.unread.end()) throw CurveError("it has no image");
  const auto found = std::find_if(pages.begin(), pages.end(), named);
  if (found == pages.end() && unread != image.unread.end()) {
    throw CurveError(fmt::format("its channel {} cannot be read: {}", unread->name, unread->reason));
  }
  if (!wanted.empty()) {
    if (found == pages.end()) {
      throw CurveError(fmt::format("it has no channel \"{}\"; it has {}", wanted, names_of(pages)));
    }
    return static_cast<std::size_t>(found - pages.begin());
  }
  const auto lower_rank = [](const ImagePage& a, const ImagePage& b) { return rank_as_height(a) < rank_as_height(b); };
  return static_cast<std::size_t>(std::min_element(pages.begin(), pages.end(), lower_rank) - pages.begin());
}

// False for NaN and infinity.
bool is_measured(double value) { return std::abs(value) <= physics::kMostImageValue; }

// True for a height that no microscope measures: numbers of another byte order or unit.
bool is_impossible_height(double value_m) { return is_measured(value_m) && std::abs(value_m) > kLongestSideM; }

bool same_grid(const ImagePage& a, const ImagePage& b) {
  return a.columns == b.columns && a.rows == b.rows && a.width_m == b.width_m && a.height_m == b.height_m;
}

// Values of a channel, with NaN for those that no instrument measures.
std::vector<double> values_of(const ImagePage& page) {
  std::vector<double> values = page.values();
  std::replace_if(
      values.begin(), values.end(), [](double value) { return !is_measured(value); },
      std::numeric_limits<double>::quiet_NaN());
  return values;
}

// Fast scans have lines up to some tens of pixels apart; farther, one side is probably in another unit than the other.
std::string doubt_of_pixels(const physics::ScanImage& image) {
  constexpr double kMostUnequal = 200.0;
  const double ratio =
      image.width_m / static_cast<double>(image.columns) / (image.height_m / static_cast<double>(image.rows));
  if (ratio <= kMostUnequal && ratio >= 1.0 / kMostUnequal) return "";
  return ratio > 1.0
             ? fmt::format("its pixels are {:.4g} times as wide as high: is its width in another unit?", ratio)
             : fmt::format("its pixels are {:.4g} times as high as wide: is its height in another unit?", 1.0 / ratio);
}

LoadedImage assembled(ImagePages found, const std::string& wanted, ImageFormat format) {
  if (found.pages.size() + found.unread.size() > kMostChannels) {
    throw CurveError(fmt::format("it has {} channels", found.pages.size() + found.unread.size()));
  }
  number_names(found.pages);
  const std::size_t chosen = chosen_page(found, wanted);
  const ImagePage& grid = found.pages[chosen];
  LoadedImage loaded{.format = format, .image = {}, .chosen = 0, .left_out = {}, .unread = {}, .remarks = {}};
  physics::ScanImage& image = loaded.image;
  image.columns = grid.columns;
  image.rows = grid.rows;
  image.width_m = grid.width_m;
  image.height_m = grid.height_m;
  image.x_offset_m = std::isfinite(grid.x_offset_m) ? grid.x_offset_m : 0.0;
  image.y_offset_m = std::isfinite(grid.y_offset_m) ? grid.y_offset_m : 0.0;
  image.metadata = std::move(found.metadata);
  const auto on_grid = static_cast<std::size_t>(std::count_if(
      found.pages.begin(), found.pages.end(), [&](const ImagePage& page) { return same_grid(page, grid); }));
  if (on_grid * grid.columns * grid.rows > kMostImageValues) {
    throw CurveError(
        fmt::format("its {} channels of {} x {} points are more than are read", on_grid, grid.columns, grid.rows));
  }
  for (std::size_t i = 0; i < found.pages.size(); ++i) {
    const ImagePage& page = found.pages[i];
    if (!same_grid(page, grid)) {
      loaded.left_out.push_back(page.name);
      continue;
    }
    try {
      image.channels.emplace_back(page.name, page.unit, values_of(page));
      if (i != chosen) continue;
      loaded.chosen = image.channels.size() - 1;
      const std::vector<double>& values = image.channels.back().values;
      const auto odd = std::find_if(values.begin(), values.end(), is_impossible_height);
      if (page.unit == "m" && odd != values.end()) {
        found.remark(fmt::format(
            "a height of {:.3g} m is none of a microscope: is its unit or the order of its bytes another?", *odd));
      }
    } catch (const CutShort&) {
      throw;
    } catch (const CurveError& fault) {
      if (i == chosen) throw;
      found.unread.push_back({page.name, fault.what()});
    }
  }
  if (const std::string doubt = doubt_of_pixels(image); !doubt.empty()) found.remark(doubt);
  loaded.unread = std::move(found.unread);
  loaded.remarks = std::move(found.remarks);
  return loaded;
}

// ---- serialised by the reading child: numbers and texts in sequence, validated like a file ----

template <class T>
void put(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

void put_text(std::string& bytes, std::string_view text) {
  text = text.substr(0, kMostTextBytes);
  put(bytes, std::uint64_t{text.size()});
  bytes += text;
}

std::string handed_over(LoadedImage loaded) {
  physics::ScanImage& image = loaded.image;
  std::string bytes;
  bytes.reserve(image.channels.size() * (image.columns * image.rows * sizeof(double) + 2 * kMostTextBytes));
  put(bytes, static_cast<std::uint64_t>(loaded.format));
  for (const std::size_t count : {loaded.chosen, image.columns, image.rows}) put(bytes, std::uint64_t{count});
  for (const double m : {image.width_m, image.height_m, image.x_offset_m, image.y_offset_m}) put(bytes, m);
  put(bytes, std::uint64_t{image.channels.size()});
  for (physics::ImageChannel& channel : image.channels) {
    put_text(bytes, channel.name);
    put_text(bytes, channel.unit);
    bytes.append(reinterpret_cast<const char*>(channel.values.data()), channel.values.size() * sizeof(double));
    channel.values = {};
  }
  put(bytes, std::uint64_t{image.metadata.size()});
  for (const auto& [key, value] : image.metadata) {
    put_text(bytes, key);
    put_text(bytes, value);
  }
  put(bytes, std::uint64_t{loaded.left_out.size()});
  for (const std::string& name : loaded.left_out) put_text(bytes, name);
  put(bytes, std::uint64_t{loaded.unread.size()});
  for (const UnreadChannel& channel : loaded.unread) {
    put_text(bytes, channel.name);
    put_text(bytes, channel.reason);
  }
  put(bytes, std::uint64_t{loaded.remarks.size()});
  for (const std::string& remark : loaded.remarks) put_text(bytes, remark);
  return bytes;
}

class Taker {
 public:
  explicit Taker(std::string_view bytes) : rest_(bytes) {}

  template <class T>
  T number() {
    return number_at<T>(take(sizeof(T)), 0);
  }

  std::size_t count(std::size_t most) {
    const auto value = number<std::uint64_t>();
    if (value > most) throw CurveError("its reader gave more than an image has");
    return static_cast<std::size_t>(value);
  }

  std::string text() { return std::string(take(count(kMostTextBytes))); }
  std::string_view take(std::size_t size) {
    const std::string_view taken = part(rest_, 0, size);
    rest_.remove_prefix(size);
    return taken;
  }

 private:
  std::string_view rest_;
};

LoadedImage taken_over(std::string_view bytes) {
  Taker taker(bytes);
  LoadedImage loaded;
  physics::ScanImage& image = loaded.image;
  loaded.format = kImages.rows[taker.count(kImages.rows.size() - 1)].format;
  loaded.chosen = taker.count(kMostChannels - 1);
  image.columns = taker.count(kMostImageSide);
  image.rows = taker.count(kMostImageSide);
  for (double* m : {&image.width_m, &image.height_m, &image.x_offset_m, &image.y_offset_m}) *m = taker.number<double>();
  image.channels.resize(taker.count(kMostChannels));
  for (physics::ImageChannel& channel : image.channels) {
    channel.name = taker.text();
    channel.unit = taker.text();
    const std::string_view numbers = taker.take(image.columns * image.rows * sizeof(double));
    channel.values.resize(image.columns * image.rows);
    std::copy(numbers.begin(), numbers.end(), reinterpret_cast<char*>(channel.values.data()));
  }
  image.metadata.resize(taker.count(bytes.size()));
  for (auto& [key, value] : image.metadata) {
    key = taker.text();
    value = taker.text();
  }
  loaded.left_out.resize(taker.count(kMostChannels));
  for (std::string& name : loaded.left_out) name = taker.text();
  loaded.unread.resize(taker.count(kMostChannels));
  for (UnreadChannel& channel : loaded.unread) {
    channel.name = taker.text();
    channel.reason = taker.text();
  }
  loaded.remarks.resize(taker.count(kMostChannels));
  for (std::string& remark : loaded.remarks) remark = taker.text();
  return loaded;
}

// Checks the requirements on any image.
void check_image(const LoadedImage& loaded) {
  const physics::ScanImage& image = loaded.image;
  if (loaded.chosen >= image.channels.size() || image.columns < 2 || image.rows < 2 ||
      !(image.width_m > 0 && image.width_m <= kLongestSideM && image.height_m > 0 && image.height_m <= kLongestSideM)) {
    throw CurveError("its reader gave no image");
  }
  for (const physics::ImageChannel& channel : image.channels) {
    if (std::any_of(channel.values.begin(), channel.values.end(),
                    [](double v) { return !std::isnan(v) && !is_measured(v); })) {
      throw CurveError("its reader gave a number beyond what any instrument measures");
    }
  }
}

// Makes the texts safe for terminals and lines of files.
void make_texts_printable(LoadedImage& loaded) {
  const auto make_printable = [](std::string& text) { text = core::printable_line(text); };
  for (physics::ImageChannel& channel : loaded.image.channels) {
    make_printable(channel.name);
    make_printable(channel.unit);
  }
  for (auto& [key, value] : loaded.image.metadata) {
    make_printable(key);
    make_printable(value);
  }
  std::for_each(loaded.left_out.begin(), loaded.left_out.end(), make_printable);
  for (UnreadChannel& channel : loaded.unread) {
    make_printable(channel.name);
    make_printable(channel.reason);
  }
  std::for_each(loaded.remarks.begin(), loaded.remarks.end(), make_printable);
}

}  // namespace

std::string_view name_of(ImageFormat format) { return kImages.rows[static_cast<std::size_t>(format)].name; }

bool is_image_file(const std::string& path) { return kImages.row_of_file(path) != nullptr; }

bool begins_like_image(std::string_view bytes) { return kImages.row_of(bytes) != nullptr; }

core::Result<LoadedImage> load_image(const std::string& path, const ImageReading& reading) {
  const auto bytes = bytes_of_file(path);
  if (!bytes) return tl::unexpected(bytes.error());
  return parse_image(*bytes, path, reading);
}

core::Result<LoadedImage> parse_image(std::string_view bytes, const std::string& name, const ImageReading& reading) {
  return kImages.parse(bytes, name, [&](const FormatRow& row, std::string_view text) {
    const std::string converted = row.convert != nullptr ? row.convert(text) : std::string();
    const std::string_view readable = row.convert != nullptr ? std::string_view(converted) : text;
    LoadedImage loaded = read_confined(
        reading.confined, [&] { return assembled(row.read(readable), reading.channel, row.format); }, handed_over,
        taken_over);
    check_image(loaded);
    make_texts_printable(loaded);
    return loaded;
  });
}

}  // namespace afm::curves
