// SPDX-License-Identifier: Apache-2.0
#include "bytes/nanosurf_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "bytes/file_bytes.h"
#include "bytes/scaled_unit.h"
#include "bytes/text_table.h"
#include "curves/curve_error.h"

namespace afm::curves {

namespace {

constexpr std::string_view kDataMark = "\n#!", kInfo = "DataSet-Info";
constexpr double kMostGroups = 64, kMostChannelNumber = 256;

// True if the first section has this text.
bool names_group(std::string_view bytes, std::string_view text) {
  constexpr std::size_t kFirstSection = 4096;
  return bytes.substr(0, kFirstSection).find(text) != std::string_view::npos;
}

void read_sections(std::string_view text, std::size_t most_infos, NanosurfFile& file) {
  std::string_view line, name;
  for (Lines lines(text); lines.next(line);) {
    if (line.starts_with('[') && line.ends_with(']')) {
      name = line.substr(1, line.size() - 2);
      continue;
    }
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos || equals == 0) continue;
    const std::string_view key = line.substr(0, equals), value = trimmed(line.substr(equals + 1));
    file.sections[name].values.emplace(key, value);
    const bool is_heading = key.starts_with("--");
    if (name == kInfo && !is_heading && file.infos.size() < most_infos) file.infos.emplace_back(key, value);
  }
}

// Number of bytes of a channel, which may be one line.
std::size_t size_of(const NanosurfSection& channel) {
  constexpr double kMostPoints = 1e9;
  const double points = channel.needed("Points") * channel.needed("Lines");
  if (!(points >= 0 && points <= kMostPoints)) throw CurveError("it is damaged: a channel has no number of points");
  return static_cast<std::size_t>(points) * nanosurf_integers(channel).size;
}

}  // namespace

bool is_nanosurf_spectroscopy(std::string_view bytes) {
  return has_nanosurf_spectroscopy(bytes) && names_group(bytes, "Gr0-Name=Spec ");
}

bool has_nanosurf_spectroscopy(std::string_view bytes) {
  return bytes.starts_with(kNanosurfMagic) && names_group(bytes, "-Name=Spec forward");
}

std::optional<std::string_view> NanosurfSection::text(std::string_view key) const {
  const auto found = values.find(key);
  return found == values.end() ? std::nullopt : std::optional(found->second);
}

std::optional<double> NanosurfSection::number(std::string_view key) const {
  const auto found = text(key);
  if (!found) return std::nullopt;
  if (has_decimal_comma(*found)) throw CurveError(decimal_comma_in(fmt::format("its \"{}\"", key), *found));
  std::string_view rest = *found;
  const auto number = take_decimal(rest);
  rest = trimmed(rest);
  if (!number || rest.empty()) return number;
  // "Dim2Range=1.25 um", which other programs write, in the "Dim2Unit"
  constexpr std::size_t kDimension = 4;
  const bool of_dimension = key.starts_with("Dim") && key.size() > kDimension;
  const ScaledUnit unit =
      scaled_unit(of_dimension ? text(fmt::format("{}Unit", key.substr(0, kDimension))).value_or("") : "");
  const ScaledUnit written = scaled_unit(rest);
  if (!of_dimension || written.unit != unit.unit) {
    throw CurveError(fmt::format("its \"{}\" is \"{}\", which is no number{}", key, found->substr(0, 40),
                                 unit.unit.empty() ? "" : fmt::format(" of {}", unit.unit)));
  }
  return *number * written.factor / unit.factor;
}

double NanosurfSection::needed(std::string_view key) const {
  const auto value = number(key);
  if (!value) throw CurveError(fmt::format("it has no number \"{}\"", key));
  return *value;
}

const NanosurfSection* NanosurfFile::section(std::string_view name) const {
  const auto found = sections.find(name);
  return found == sections.end() ? nullptr : &found->second;
}

NanosurfFile nanosurf_file(std::string_view bytes, std::size_t most_infos, NanosurfEnd end) {
  const std::size_t mark = bytes.find(kDataMark);
  if (mark == std::string_view::npos) throw CutShort("it has no data");
  NanosurfFile file;
  read_sections(bytes.substr(0, mark), most_infos, file);
  std::string_view rest = bytes.substr(mark + kDataMark.size());
  const NanosurfSection* set = file.section("DataSet");
  if (set == nullptr) throw CurveError("it has no section [DataSet]");
  const double groups = std::min(set->needed("GroupCount"), kMostGroups);
  for (int group = 0; group < groups; ++group) {
    const std::string_view group_name = set->text(fmt::format("Gr{}-Name", group)).value_or("");
    const double channels = std::min(set->number(fmt::format("Gr{}-Count", group)).value_or(0.0), kMostChannelNumber);
    for (int number = 0; number < channels; ++number) {
      const auto name = set->text(fmt::format("Gr{}-Ch{}", group, number));
      if (!name) continue;  // channel that was counted but not saved
      const NanosurfSection* channel = file.section(*name);
      if (channel == nullptr) throw CurveError(fmt::format("it has no section [{}]", *name));
      const std::size_t size = size_of(*channel);
      if (size > rest.size() && end == NanosurfEnd::Needed) {
        throw CutShort(fmt::format("{} of its channels are whole", file.channels.size()));
      }
      file.channels.push_back({group_name, channel, rest.substr(0, size)});
      rest.remove_prefix(std::min(size, rest.size()));
    }
  }
  return file;
}

NanosurfIntegers nanosurf_integers(const NanosurfSection& channel) {
  const double bits = channel.needed("SaveBits");
  if (bits != 8 && bits != 16 && bits != 32) {
    throw CurveError(fmt::format("its numbers have {:g} bits; 8, 16 and 32 are read", bits));
  }
  if (const auto mode = channel.text("SaveMode").value_or("Binary"); mode != "Binary") {
    throw CurveError(fmt::format("its numbers are saved as \"{}\"; Binary is read", mode.substr(0, 40)));
  }
  return {.size = static_cast<std::size_t>(bits) / 8,
          .is_signed = channel.text("SaveSign").value_or("Signed") != "Unsigned",
          .order = channel.text("SaveOrder").value_or("Intel") == "Motorola" ? std::endian::big : std::endian::little};
}

double nanosurf_share(std::string_view numbers, std::size_t index, const NanosurfIntegers& integers) {
  const std::size_t at = index * integers.size;
  const double range = std::exp2(8.0 * static_cast<double>(integers.size));
  const double unsigned_number = integers.size == 1   ? number_at<std::uint8_t>(numbers, at)
                                 : integers.size == 2 ? number_at<std::uint16_t>(numbers, at, integers.order)
                                                      : number_at<std::uint32_t>(numbers, at, integers.order);
  if (!integers.is_signed) return unsigned_number / range;
  return std::fmod(unsigned_number / range + 0.5, 1.0);  // share above the lowest number of a two's complement
}

}  // namespace afm::curves
