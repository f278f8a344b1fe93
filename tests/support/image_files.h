// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Image files of AFM programs, byte by byte, in their published layouts.
namespace afm::test {

template <class T>
void append_little(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

template <class T>
void append_big(std::string& bytes, T value) {
  std::string here(reinterpret_cast<const char*>(&value), sizeof(T));
  std::reverse(here.begin(), here.end());
  bytes += here;
}

// ---- Gwyddion simple field ----

inline std::string gsf_file(const std::string& lines, const std::vector<float>& values) {
  std::string bytes = "Gwyddion Simple Field 1.0\n" + lines;
  bytes.append(4 - bytes.size() % 4, '\0');
  for (const float value : values) append_little(bytes, value);
  return bytes;
}

// ---- Gwyddion ----

inline std::string gwy_int(std::string_view name, std::int32_t value) {
  std::string bytes(name);
  bytes += '\0';
  bytes += 'i';
  append_little(bytes, value);
  return bytes;
}

inline std::string gwy_double(std::string_view name, double value) {
  std::string bytes(name);
  bytes += '\0';
  bytes += 'd';
  append_little(bytes, value);
  return bytes;
}

inline std::string gwy_string(std::string_view name, std::string_view value) {
  std::string bytes(name);
  bytes += '\0';
  bytes += 's';
  bytes += value;
  bytes += '\0';
  return bytes;
}

inline std::string gwy_doubles(std::string_view name, const std::vector<double>& values) {
  std::string bytes(name);
  bytes += '\0';
  bytes += 'D';
  append_little(bytes, static_cast<std::uint32_t>(values.size()));
  for (const double value : values) append_little(bytes, value);
  return bytes;
}

inline std::string gwy_object(std::string_view name, std::string_view type, const std::string& components) {
  std::string bytes(name);
  bytes += '\0';
  bytes += 'o';
  bytes += type;
  bytes += '\0';
  append_little(bytes, static_cast<std::uint32_t>(components.size()));
  return bytes + components;
}

inline std::string gwy_field(std::string_view name, std::int32_t columns, std::int32_t rows, double width_m,
                             double height_m, std::string_view unit, const std::vector<double>& values) {
  return gwy_object(name, "GwyDataField",
                    gwy_int("xres", columns) + gwy_int("yres", rows) + gwy_double("xreal", width_m) +
                        gwy_double("yreal", height_m) + gwy_double("xoff", 1e-7) + gwy_double("yoff", -2e-7) +
                        gwy_object("si_unit_xy", "GwySIUnit", gwy_string("unitstr", "m")) +
                        gwy_object("si_unit_z", "GwySIUnit", gwy_string("unitstr", unit)) +
                        gwy_doubles("data", values));
}

inline std::string gwy_file(const std::string& components) {
  std::string bytes = "GWYP";
  const std::string name("GwyContainer", 13);
  bytes += name;
  append_little(bytes, static_cast<std::uint32_t>(components.size()));
  return bytes + components;
}

// ---- Nanoscope ----

struct NanoscopeChannel {
  std::string name = "Height";
  std::string direction = "Trace";
  std::string z_scale = "V [Sens. Zsens] (0.0067 V/LSB) 440 V";
  int bytes_per_pixel = 2;
  int bytes_of_integer = 2;
  int columns = 0, rows = 0;
  std::string scan_size = "1000 500 nm";
  std::vector<std::int64_t> integers;  // numbers in file order: the bottom row first
};

inline std::string nanoscope_file(const std::string& version, const std::vector<NanoscopeChannel>& channels) {
  constexpr std::size_t kHeaderBytes = 4096;
  std::string header =
      "\\*File list\r\n\\Version: " + version +
      "\r\n\\Date: 10:11:12 AM Mon Nov 23 2026\r\n"
      "\\*Equipment list\r\n\\Description: MultiMode\r\n"
      "\\*Scanner list\r\n\\@Sens. Zsens: V 12.5 nm/V\r\n\\@1:Z Limit: V [Sens. Zsens] (0.0067 V/LSB) 440 V\r\n"
      "\\*Ciao scan list\r\n\\Scan Size: 900 nm\r\n\\@Sens. DeflSens: V 40 nm/V\r\n";
  std::string data;
  for (const NanoscopeChannel& channel : channels) {
    std::string numbers;
    for (const std::int64_t integer : channel.integers) {
      for (int i = 0; i < channel.bytes_of_integer; ++i) numbers += static_cast<char>(integer >> (8 * i));
    }
    header += "\\*Ciao image list\r\n\\Data offset: " + std::to_string(kHeaderBytes + data.size()) +
              "\r\n\\Data length: " + std::to_string(numbers.size()) +
              "\r\n\\Bytes/pixel: " + std::to_string(channel.bytes_per_pixel) +
              "\r\n\\Samps/line: " + std::to_string(channel.columns) +
              "\r\n\\Number of lines: " + std::to_string(channel.rows) + "\r\n\\Scan Size: " + channel.scan_size +
              "\r\n\\Line Direction: " + channel.direction + "\r\n\\@2:Z scale: " + channel.z_scale +
              "\r\n\\@2:Image Data: S [Internal] \"" + channel.name + "\"\r\n";
    data += numbers;
  }
  header += "\\*File list end\r\n\x1a";
  header.resize(kHeaderBytes, '\0');
  return header + data;
}

// ---- Igor ----

// An Igor image: without labels a matrix, which has a name. `big`: big-endian.
inline std::string igor_image_file(int columns, int rows, const std::vector<std::string>& labels, double spacing_m,
                                   const std::string& note, const std::vector<float>& values, bool big = false) {
  std::string bytes(384, '\0');
  const auto set = [&bytes, big](std::size_t offset, auto value) {
    std::string number;
    big ? append_big(number, value) : append_little(number, value);
    bytes.replace(offset, number.size(), number);
  };
  const std::size_t label_bytes = labels.empty() ? 0 : 32 * (labels.size() + 1);
  set(0, std::int16_t{5});
  set(4, static_cast<std::int32_t>(320 + values.size() * sizeof(float)));
  set(12, static_cast<std::int32_t>(note.size()));
  set(44, static_cast<std::int32_t>(label_bytes));
  set(76, static_cast<std::int32_t>(values.size()));
  set(80, std::int16_t{2});
  set(132, std::int32_t{columns});
  set(136, std::int32_t{rows});
  set(140, static_cast<std::int32_t>(labels.size()));
  set(148, spacing_m);
  set(156, spacing_m);
  bytes[216] = bytes[220] = 'm';
  bytes.replace(92, 6, "relief");
  std::uint16_t sum = 0;
  for (std::size_t i = 0; i < bytes.size(); i += 2) {
    const auto byte = [&](std::size_t at) { return static_cast<unsigned>(static_cast<unsigned char>(bytes[at])); };
    sum = static_cast<std::uint16_t>(sum + byte(i) * (big ? 256U : 1U) + byte(i + 1) * (big ? 1U : 256U));
  }
  set(2, static_cast<std::uint16_t>(-sum));
  for (const float value : values) big ? append_big(bytes, value) : append_little(bytes, value);
  bytes += note;
  if (!labels.empty()) bytes.append(32, '\0');
  for (const std::string& label : labels) {
    std::string field = label;
    field.resize(32, '\0');
    bytes += field;
  }
  return bytes + "\rVerDate=1234;\r0016 MFP3D";
}

// ---- JPK ----

// Directory of a TIFF, big-endian, each entry by its tag.
class TiffPage {
 public:
  void number(std::uint16_t tag, std::uint16_t type, std::int64_t value) {
    std::string bytes;
    if (type == 3 || type == 8) append_big(bytes, static_cast<std::uint16_t>(value));
    if (type == 4 || type == 9) append_big(bytes, static_cast<std::uint32_t>(value));
    entries_[tag] = {type, 1, bytes};
  }
  void real(std::uint16_t tag, double value) {
    std::string bytes;
    append_big(bytes, value);
    entries_[tag] = {12, 1, bytes};
  }
  void text(std::uint16_t tag, const std::string& value) {
    entries_[tag] = {2, static_cast<std::uint32_t>(value.size() + 1), value + '\0'};
  }
  // Adds the raw bytes of a private tag.
  void raw(std::uint16_t tag, const std::string& bytes) {
    entries_[tag] = {7, static_cast<std::uint32_t>(bytes.size()), bytes};
  }
  // Adds one strip, whose place is known when the file is assembled.
  void pixels(const std::string& bytes) { pixels_ = bytes; }

  // Appends the page to `file`; its link to the next one is 0.
  void append_to(std::string& file) {
    const auto pixels_at = static_cast<std::int64_t>(file.size());
    file += pixels_;
    if (!pixels_.empty()) {
      number(0x0111, 4, pixels_at);
      number(0x0117, 4, static_cast<std::int64_t>(pixels_.size()));
    }
    std::string data;
    const std::size_t at = file.size(), data_at = at + 2 + 12 * entries_.size() + 4;
    append_big(file, static_cast<std::uint16_t>(entries_.size()));
    for (const auto& [tag, entry] : entries_) {
      append_big(file, tag);
      append_big(file, entry.type);
      append_big(file, entry.count);
      std::string field = entry.bytes;
      if (field.size() > 4) {
        field.clear();
        append_big(field, static_cast<std::uint32_t>(data_at + data.size()));
        data += entry.bytes;
      }
      field.resize(4, '\0');
      file += field;
    }
    append_big(file, std::uint32_t{0});
    file += data;
  }
  std::size_t entries() const { return entries_.size() + (pixels_.empty() ? 0 : 2); }
  std::size_t pixel_bytes() const { return pixels_.size(); }

 private:
  struct Entry {
    std::uint16_t type;
    std::uint32_t count;
    std::string bytes;
  };
  std::map<std::uint16_t, Entry> entries_;
  std::string pixels_;
};

struct JpkSlot {
  std::string name, unit;
  double multiplier, offset;
};

inline TiffPage jpk_channel(const std::string& title, bool retrace, int columns, int rows,
                            const std::vector<JpkSlot>& slots, const std::string& default_slot, int bits,
                            const std::vector<std::int64_t>& integers) {
  TiffPage page;
  page.number(0x0100, 4, columns);
  page.number(0x0101, 4, rows);
  page.number(0x0102, 3, bits);
  page.number(0x0103, 3, 1);
  page.number(0x0106, 3, 1);
  page.number(0x0115, 3, 1);
  page.number(0x0116, 4, rows);
  page.number(0x0153, 3, 2);
  page.text(0x8050, title);
  page.number(0x8051, 8, retrace ? 1 : 0);
  page.text(0x8052, title);
  page.number(0x8080, 9, static_cast<std::int64_t>(slots.size()));
  page.text(0x8081, default_slot);
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const auto base = static_cast<std::uint16_t>(0x30 * i);
    const auto tag = [&](int first) { return static_cast<std::uint16_t>(first + base); };
    page.text(tag(0x8090), slots[i].name);
    page.text(tag(0x80A2), slots[i].unit);
    page.text(tag(0x80A3), "LinearScaling");
    page.real(tag(0x80A4), slots[i].multiplier);
    page.real(tag(0x80A5), slots[i].offset);
  }
  std::string pixels;
  for (const std::int64_t integer : integers) {
    if (bits == 16) append_big(pixels, static_cast<std::int16_t>(integer));
    if (bits == 32) append_big(pixels, static_cast<std::int32_t>(integer));
  }
  page.pixels(pixels);
  return page;
}

// A JPK image with a thumbnail before it that has the grid's tags.
inline std::string jpk_image_file(double width_m, double height_m, std::vector<TiffPage> channels) {
  TiffPage thumbnail;
  thumbnail.number(0x0100, 4, 2);
  thumbnail.number(0x0101, 4, 2);
  thumbnail.number(0x0102, 3, 8);
  thumbnail.number(0x0106, 3, 3);
  thumbnail.text(0x8004, "a test");
  thumbnail.real(0x8040, 1e-6);
  thumbnail.real(0x8041, 2e-6);
  thumbnail.real(0x8042, width_m);
  thumbnail.real(0x8043, height_m);
  thumbnail.text(0x8050, "thumbnail");
  channels.insert(channels.begin(), thumbnail);
  std::string file = std::string("MM\0*", 4);
  append_big(file, std::uint32_t{8});
  std::size_t link = 4;
  for (TiffPage& page : channels) {
    const std::size_t directory = file.size() + page.pixel_bytes();
    std::string here;
    append_big(here, static_cast<std::uint32_t>(directory));
    file.replace(link, 4, here);
    link = directory + 2 + 12 * page.entries();
    page.append_to(file);
  }
  return file;
}

}  // namespace afm::test
