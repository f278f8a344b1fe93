// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <utility>

#include "core/check.h"
#include "core/file_names.h"
#include "curves/image_output.h"

namespace afm::curves {
namespace {

using physics::ImageChannel;
using physics::ScanImage;

// Both formats are little-endian.
template <class Number>
void append_raw(std::string& bytes, Number number) {
  static_assert(std::endian::native == std::endian::little);
  std::array<char, sizeof number> raw{};
  std::memcpy(raw.data(), &number, sizeof number);
  bytes.append(raw.data(), raw.size());
}

std::string terminated(const std::string& text) {
  std::string bytes = text.substr(0, text.find('\0'));
  bytes.push_back('\0');
  return bytes;
}

// Writes objects within objects: "Name NUL length components", each component "name NUL type value". Sequential,
// because a large image would not fit into memory several times.
class GwyWriter {
 public:
  explicit GwyWriter(std::size_t expected_size) {
    bytes_.reserve(expected_size);
    bytes_ = "GWYP";
  }

  void integer(const std::string& name, std::size_t value) {
    begin(name, 'i');
    append_raw(bytes_, static_cast<std::int32_t>(value));
  }
  void real(const std::string& name, double value) {
    begin(name, 'd');
    append_raw(bytes_, value);
  }
  void text(const std::string& name, const std::string& value) {
    begin(name, 's');
    bytes_ += terminated(value);
  }
  void reals(const std::string& name, const std::vector<double>& values) {
    begin(name, 'D');
    append_raw(bytes_, static_cast<std::uint32_t>(values.size()));
    static_assert(std::endian::native == std::endian::little);
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double));
  }
  template <class Components>
  void object(const std::string& name, const char* type, const Components& components) {
    begin(name, 'o');
    contents(type, components);
  }

  // Writes an object; `components` writes its contents.
  template <class Components>
  void contents(const char* type, const Components& components) {
    bytes_ += terminated(type);
    const std::size_t length_at = bytes_.size();
    append_raw(bytes_, std::uint32_t{0});
    components();
    const auto length = static_cast<std::uint32_t>(bytes_.size() - length_at - sizeof(std::uint32_t));
    std::memcpy(&bytes_[length_at], &length, sizeof length);
  }

  std::string take() { return std::move(bytes_); }

 private:
  void begin(const std::string& name, char type) {
    bytes_ += terminated(name);
    bytes_.push_back(type);
  }

  std::string bytes_;
};

void write_si_unit(GwyWriter& file, const char* name, const std::string& unit) {
  file.object(name, "GwySIUnit", [&] { file.text("unitstr", unit); });
}

void write_data_field(GwyWriter& file, const std::string& name, const ScanImage& image, const ImageChannel& channel) {
  file.object(name, "GwyDataField", [&] {
    file.integer("xres", image.columns);
    file.integer("yres", image.rows);
    file.real("xreal", image.width_m);
    file.real("yreal", image.height_m);
    file.real("xoff", image.x_offset_m);
    file.real("yoff", image.y_offset_m);
    write_si_unit(file, "si_unit_xy", "m");
    write_si_unit(file, "si_unit_z", channel.unit);
    file.reals("data", channel.values);
  });
}

void check(const ScanImage& image) {
  for (const ImageChannel& channel : image.channels) AFM_CHECK(channel.values.size() == image.columns * image.rows);
}

// A line of a .gsf header. Gwyddion ends a line at a line feed and a name at the first "=".
std::string header_line(std::string name, std::string value) {
  const auto breaks_line = [](char c) { return static_cast<unsigned char>(c) < ' '; };
  std::replace_if(name.begin(), name.end(), [&](char c) { return breaks_line(c) || c == '='; }, ' ');
  std::replace_if(value.begin(), value.end(), breaks_line, ' ');
  return name + " = " + value + "\n";
}

// Gwyddion writes numbers with 14 digits.
std::string gsf_number(double value) { return fmt::format("{:.14g}", value); }

constexpr std::array<std::string_view, 9> kNamesOfGsf{"XRes",    "YRes",    "XReal",  "YReal", "XOffset",
                                                      "YOffset", "XYUnits", "ZUnits", "Title"};

}  // namespace

std::optional<ImageFormat> image_format(std::string_view path) {
  if (core::has_ending(path, ".gwy")) return ImageFormat::Gwy;
  if (core::has_ending(path, ".gsf")) return ImageFormat::Gsf;
  return std::nullopt;
}

std::string gwy_bytes(const ScanImage& image) {
  check(image);
  std::size_t words = 1000;  // size of names, types and units, plus some
  for (const auto& [key, value] : image.metadata) words += key.size() + value.size() + 3;
  GwyWriter file(image.channels.size() * (image.columns * image.rows * sizeof(double) + words));
  file.contents("GwyContainer", [&] {
    for (std::size_t i = 0; i < image.channels.size(); ++i) {
      const std::string name = fmt::format("/{}/", i);
      write_data_field(file, name + "data", image, image.channels[i]);
      file.text(name + "data/title", image.channels[i].name);
      if (image.metadata.empty()) continue;
      file.object(name + "meta", "GwyContainer", [&] {
        for (const auto& [key, value] : image.metadata) file.text(key, value);
      });
    }
  });
  return file.take();
}

std::string gsf_bytes(const ScanImage& image, std::size_t channel) {
  check(image);
  AFM_CHECK(channel < image.channels.size());
  const ImageChannel& chosen = image.channels[channel];
  std::string bytes = "Gwyddion Simple Field 1.0\n";
  bytes += header_line("XRes", std::to_string(image.columns)) + header_line("YRes", std::to_string(image.rows));
  bytes += header_line("XReal", gsf_number(image.width_m)) + header_line("YReal", gsf_number(image.height_m));
  // defaults to zero
  if (image.x_offset_m != 0.0) bytes += header_line("XOffset", gsf_number(image.x_offset_m));
  if (image.y_offset_m != 0.0) bytes += header_line("YOffset", gsf_number(image.y_offset_m));
  bytes += header_line("XYUnits", "m") + header_line("ZUnits", chosen.unit) + header_line("Title", chosen.name);
  for (const auto& [key, value] : image.metadata) {
    if (std::find(kNamesOfGsf.begin(), kNamesOfGsf.end(), key) == kNamesOfGsf.end()) bytes += header_line(key, value);
  }
  // one to four NULs, which align the values to a multiple of four
  constexpr std::size_t kAlignment = 4;
  bytes.append(kAlignment - bytes.size() % kAlignment, '\0');
  for (const double value : chosen.values) append_raw(bytes, static_cast<float>(value));
  return bytes;
}

}  // namespace afm::curves
