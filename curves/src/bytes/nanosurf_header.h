// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Nanosurf's files (.nid, .ezd): sections of "key=value" in Latin-1, then "#!" and the numbers of every channel in the
// order of the groups: integers of 8, 16 or 32 bits, line by line. Their lowest value is Dim2Min, their full range
// Dim2Range. Everything refers to the file's bytes. Throws CurveError.
namespace afm::curves {

inline constexpr std::string_view kNanosurfMagic = "[DataSet]";

// Returns whether the first group has curves; an image may come before them.
bool is_nanosurf_spectroscopy(std::string_view bytes);

// Returns whether any group has curves.
bool has_nanosurf_spectroscopy(std::string_view bytes);

struct NanosurfSection {
  std::map<std::string_view, std::string_view> values;

  std::optional<std::string_view> text(std::string_view key) const;
  std::optional<double> number(std::string_view key) const;  // finite number of a key; empty: none
  double needed(std::string_view key) const;                 // finite number of a key; throws without it
};

struct NanosurfChannel {
  std::string_view group;  // name of the group, "Scan forward"
  const NanosurfSection* section = nullptr;
  std::string_view numbers;
};

struct NanosurfFile {
  std::map<std::string_view, NanosurfSection> sections;
  std::vector<NanosurfChannel> channels;
  std::vector<std::pair<std::string, std::string>> infos;  // information of the file, in its order

  NanosurfFile() = default;
  NanosurfFile(NanosurfFile&&) = default;
  NanosurfFile(const NanosurfFile&) = delete;
  NanosurfFile& operator=(const NanosurfFile&) = delete;

  // Section of that name; null if there is none.
  const NanosurfSection* section(std::string_view name) const;
};

// The end of a file that is cut short: refused, or its channels have the numbers that are there.
enum class NanosurfEnd { Needed, MayLack };
NanosurfFile nanosurf_file(std::string_view bytes, std::size_t most_infos, NanosurfEnd end = NanosurfEnd::Needed);

// Integers of a channel, as the file stores them.
struct NanosurfIntegers {
  std::size_t size = 0;
  bool is_signed = true;
  std::endian order = std::endian::little;
};
NanosurfIntegers nanosurf_integers(const NanosurfSection& channel);

// An integer of a channel as 0 to 1 over the whole range of its kind.
double nanosurf_share(std::string_view numbers, std::size_t index, const NanosurfIntegers& integers);

}  // namespace afm::curves
