// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "support/image_files.h"

// Image files of Park Systems and Nanosurf, byte by byte.
namespace afm::test {

// ---- Park Systems ----

// Fields of the header whose values tests change; the others are 0 or empty.
struct ParkHeader {
  std::uint32_t kind = 0, columns = 3, rows = 2, forward = 1, swapped = 0, number_type = 1;
  double width_um = 3, height_um = 2, gain = -0.5, scale = 1, offset = 0;
  std::u16string source = u"Z Height", unit = u"nm";
};

inline std::string park_header_bytes(const ParkHeader& header) {
  std::string bytes(580, '\0');
  const auto put = [&](std::size_t at, const auto& value) { std::memcpy(&bytes[at], &value, sizeof value); };
  const auto put_text = [&](std::size_t at, const std::u16string& text) {
    std::memcpy(&bytes[at], text.data(), 2 * text.size());
  };
  put(0, header.kind);
  put_text(4, header.source);
  put_text(68, u"Tapping");
  put(100, header.columns);
  put(104, header.rows);
  put(128, header.forward);
  put(136, header.swapped);
  put(140, header.width_um);
  put(148, header.height_um);
  put(172, 0.2);
  put(220, header.gain);
  put(228, header.scale);
  put(236, header.offset);
  put_text(244, header.unit);
  put(348, header.number_type);
  return bytes;
}

// A Park image file; the first `numbers` are those of the lowest row.
inline std::string park_image_file(const ParkHeader& header, const std::string& numbers,
                                   std::uint32_t version = 0x01000002) {
  TiffPage page;
  page.number(0x0100, 4, 2);
  page.number(0x0101, 4, 2);
  page.text(0x0131, "SmartScan");
  page.number(0xC500, 4, 0x0E031301);
  page.number(0xC501, 4, version);
  page.raw(0xC502, numbers);
  page.raw(0xC503, park_header_bytes(header));
  std::string file("MM\0*\0\0\0\x08", 8);
  page.append_to(file);
  return file;
}

template <class Number>
std::string little_numbers(const std::vector<Number>& numbers) {
  std::string bytes;
  for (const Number number : numbers) append_little(bytes, number);
  return bytes;
}

// ---- Nanosurf ----

struct NanosurfChannel {
  std::string group = "Scan forward", name = "Z-Axis", unit = "m";
  int columns = 3, rows = 2, last_line = 1;
  std::string range = "6.5536e-05", lowest = "-3.2768e-05";
  std::string save = "SaveMode=Binary\r\nSaveBits=16\r\nSaveSign=Signed\r\nSaveOrder=Intel\r\n";
  std::string numbers = little_numbers<std::int16_t>({1, 2, 3, 10, 20, -30});
};

// Every channel is in a separate group, whose count includes one channel that was not saved. `more` are other sections.
inline std::string nanosurf_file(const std::vector<NanosurfChannel>& channels, const std::string& more = "") {
  std::string set = "[DataSet]\r\nVersion=2\r\nGroupCount=" + std::to_string(channels.size()) + "\r\n";
  std::string sections, data;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const NanosurfChannel& channel = channels[i];
    const std::string group = "Gr" + std::to_string(i), section = "DataSet-" + std::to_string(i) + ":1";
    set += group + "-Name=" + channel.group + "\r\n" + group + "-Count=2\r\n" + group + "-Ch1=" + section + "\r\n";
    sections += "\r\n[" + section + "]\r\nPoints=" + std::to_string(channel.columns) +
                "\r\nLines=" + std::to_string(channel.rows) + "\r\nFrame=" + channel.group +
                "\r\nCurLine=" + std::to_string(channel.last_line) +
                "\r\nDim0Unit=\xb5m\r\nDim0Range=3\r\nDim0Min=0\r\nDim1Unit=m\r\nDim1Range=2e-006\r\nDim1Min=0" +
                "\r\nDim2Name=" + channel.name + "\r\nDim2Unit=" + channel.unit + "\r\nDim2Range=" + channel.range +
                "\r\nDim2Min=" + channel.lowest + "\r\n" + channel.save;
    data += channel.numbers;
  }
  return set + "\r\n[DataSet-Info]\r\n-- Scan --=--------\r\nHead type=EZ2-AFM\r\n" + sections + more + "\r\n\r\n#!" +
         data;
}

}  // namespace afm::test
