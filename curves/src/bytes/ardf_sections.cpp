// SPDX-License-Identifier: Apache-2.0
#include "bytes/ardf_sections.h"

#include <fmt/format.h>
#include <zlib.h>

#include "core/printable.h"
#include "curves/curve_error.h"

namespace afm::curves {

namespace {

constexpr std::size_t kTableHead = 32;

ArdfSection section_of(std::string_view file, std::uint64_t offset, std::string_view wanted, std::size_t size) {
  const std::string_view head = part(file, offset, kArdfHead);
  ArdfSection section{static_cast<std::size_t>(offset), head.substr(8, 4), part(file, offset, size)};
  if (!wanted.empty() && section.name != wanted) {
    throw CurveError(
        fmt::format("it has a section \"{}\" where \"{}\" should be", core::printable_line(section.name), wanted));
  }
  const std::string_view checked = section.bytes.substr(sizeof(std::uint32_t));
  const auto checksum = ::crc32_z(0, reinterpret_cast<const Bytef*>(checked.data()), checked.size());
  if (number_at<std::uint32_t>(head, 0) != checksum)
    throw CurveError(fmt::format("its section \"{}\" is damaged", core::printable_line(section.name)));
  return section;
}

}  // namespace

ArdfSection ardf_section(std::string_view file, std::uint64_t offset, std::string_view wanted) {
  const std::size_t size = number_at<std::uint32_t>(part(file, offset, kArdfHead), 4);
  if (size < kArdfHead) throw CurveError(fmt::format("a section of it has {} bytes", size));
  return section_of(file, offset, wanted, size);
}

ArdfTable ardf_table(std::string_view file, std::uint64_t offset, std::string_view name, std::size_t stride) {
  const ArdfSection head = ardf_section(file, offset, name);
  if (head.bytes.size() != kTableHead) throw CurveError(fmt::format("its table \"{}\" is damaged", name));
  const auto size = number_at<std::uint64_t>(head.bytes, kArdfHead);
  const std::uint64_t count = number_at<std::uint32_t>(head.bytes, kArdfHead + 8);
  if (number_at<std::uint32_t>(head.bytes, kArdfHead + 12) != stride || size != kTableHead + count * stride) {
    throw CurveError(fmt::format("its table \"{}\" has {} entries in {} bytes, which do not agree", name, count, size));
  }
  const std::string_view whole = part(file, head.offset, size);
  ArdfTable table{{}, head.offset + whole.size()};
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::size_t at = kTableHead + i * stride;
    // the measurement was stopped
    if (number_at<std::uint32_t>(whole, at) == 0) break;
    table.entries.push_back(section_of(file, head.offset + at, {}, stride));
  }
  return table;
}

std::string_view ardf_text(const ArdfSection& section, std::size_t offset, std::size_t size) {
  const std::string_view text = part(section.bytes, offset, size);
  return text.substr(0, text.find('\0'));
}

}  // namespace afm::curves
