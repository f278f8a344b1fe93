// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include "core/check.h"
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

// What has a length in the file: "LENGTH contents".
std::string with_length(const std::string& contents) {
  std::string bytes;
  append_raw(bytes, static_cast<std::uint32_t>(contents.size()));
  return bytes + contents;
}

std::string terminated(const std::string& text) {
  std::string bytes = text.substr(0, text.find('\0'));
  bytes.push_back('\0');
  return bytes;
}

// "Name NUL length components", each component "name NUL type value".
class GwyObject {
 public:
  explicit GwyObject(std::string type) : type_(std::move(type)) {}

  void integer(const std::string& name, std::size_t value) {
    append_raw(component(name, 'i'), static_cast<std::int32_t>(value));
  }
  void real(const std::string& name, double value) { append_raw(component(name, 'd'), value); }
  void text(const std::string& name, const std::string& value) { component(name, 's') += terminated(value); }
  void object(const std::string& name, const GwyObject& value) { component(name, 'o') += value.bytes(); }
  void reals(const std::string& name, const std::vector<double>& values) {
    std::string& bytes = component(name, 'D');
    append_raw(bytes, static_cast<std::uint32_t>(values.size()));
    for (const double value : values) append_raw(bytes, value);
  }

  std::string bytes() const { return terminated(type_) + with_length(components_); }

 private:
  std::string& component(const std::string& name, char type) {
    components_ += terminated(name);
    components_.push_back(type);
    return components_;
  }

  std::string type_;
  std::string components_;
};

GwyObject si_unit(const std::string& unit) {
  GwyObject object("GwySIUnit");
  object.text("unitstr", unit);
  return object;
}

GwyObject data_field(const ScanImage& image, const ImageChannel& channel) {
  GwyObject field("GwyDataField");
  field.integer("xres", image.columns);
  field.integer("yres", image.rows);
  field.real("xreal", image.width_m);
  field.real("yreal", image.height_m);
  field.real("xoff", image.x_offset_m);
  field.real("yoff", image.y_offset_m);
  field.object("si_unit_xy", si_unit("m"));
  field.object("si_unit_z", si_unit(channel.unit));
  field.reals("data", channel.values);
  return field;
}

void check(const ScanImage& image) {
  for (const ImageChannel& channel : image.channels) AFM_CHECK(channel.values.size() == image.columns * image.rows);
}

// A line of a .gsf header; Gwyddion ends a line at a line feed and a name at the first "=".
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
  if (path.ends_with(".gwy")) return ImageFormat::Gwy;
  if (path.ends_with(".gsf")) return ImageFormat::Gsf;
  return std::nullopt;
}

std::string gwy_bytes(const ScanImage& image) {
  check(image);
  GwyObject metadata("GwyContainer");
  for (const auto& [key, value] : image.metadata) metadata.text(key, value);
  GwyObject file("GwyContainer");
  for (std::size_t i = 0; i < image.channels.size(); ++i) {
    const std::string name = fmt::format("/{}/", i);
    file.object(name + "data", data_field(image, image.channels[i]));
    file.text(name + "data/title", image.channels[i].name);
    if (!image.metadata.empty()) file.object(name + "meta", metadata);
  }
  return "GWYP" + file.bytes();
}

std::string gsf_bytes(const ScanImage& image, std::size_t channel) {
  check(image);
  AFM_CHECK(channel < image.channels.size());
  const ImageChannel& chosen = image.channels[channel];
  std::string bytes = "Gwyddion Simple Field 1.0\n";
  bytes += header_line("XRes", std::to_string(image.columns)) + header_line("YRes", std::to_string(image.rows));
  bytes += header_line("XReal", gsf_number(image.width_m)) + header_line("YReal", gsf_number(image.height_m));
  // without a line they are zero
  if (image.x_offset_m != 0.0) bytes += header_line("XOffset", gsf_number(image.x_offset_m));
  if (image.y_offset_m != 0.0) bytes += header_line("YOffset", gsf_number(image.y_offset_m));
  bytes += header_line("XYUnits", "m") + header_line("ZUnits", chosen.unit) + header_line("Title", chosen.name);
  for (const auto& [key, value] : image.metadata) {
    if (std::find(kNamesOfGsf.begin(), kNamesOfGsf.end(), key) == kNamesOfGsf.end()) bytes += header_line(key, value);
  }
  // one to four, so that the values begin at a multiple of four
  constexpr std::size_t kAlignment = 4;
  bytes.append(kAlignment - bytes.size() % kAlignment, '\0');
  for (const double value : chosen.values) append_raw(bytes, static_cast<float>(value));
  return bytes;
}

}  // namespace afm::curves
