// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// The text header of Bruker's Nanoscope files, up to a byte 0x1A: blocks that begin with "\*NAME", with lines
// "\KEY: VALUE". Everything refers to the file's bytes.
namespace afm::curves {

struct NanoscopeBlock {
  std::string_view name;                           // "Ciao image list"
  std::map<std::string, std::string_view> values;  // keys in lower case, "@2:z scale"

  const std::string_view* find(const std::string& key) const {
    const auto found = values.find(key);
    return found != values.end() ? &found->second : nullptr;
  }
};

// Keys and names of blocks are compared in lower case.
std::string lower_key(std::string_view text);

std::vector<NanoscopeBlock> nanoscope_blocks(std::string_view bytes);

// The name "Deflection Error" in S [DeflectionError] "Deflection Error"; empty without one.
std::string_view nanoscope_channel(const NanoscopeBlock& channel);

// Version, such as 0x09300201; 0 if no block has it.
std::uint32_t nanoscope_version(const std::vector<NanoscopeBlock>& blocks);

// "04:42:34 PM Tue Sep 11 2007" as YYYY-MM-DD and HH:MM:SS; empty for any other text.
struct NanoscopeTime {
  std::string day, clock;
};
NanoscopeTime nanoscope_time(std::string_view text);

// The number at the front of a value. Throws CurveError if there is none.
double nanoscope_number(const NanoscopeBlock& block, const std::string& key);

// Takes the number at the front of the text.
std::optional<double> take_number(std::string_view& text);

// "V [Sens. Zsens] (0.0067 V/LSB) 440 V": an integer times `per_lsb` is the value, and `value` that of all integers.
struct HardScale {
  std::string_view soft_name;  // "Sens. Zsens", or empty
  std::optional<double> per_lsb;
  std::optional<double> value;
  std::string_view unit;
};
// Empty if the text does not begin with "V".
std::optional<HardScale> hard_scale(const std::string_view* text);

struct SoftScale {
  double factor = 1.0;
  std::string unit;
};

// "V 12.5 nm/V" of "@Sens. Zsens", or "V 1 log(Pa)/log(Arb)", from any block. `per` is the unit behind the stroke.
std::optional<SoftScale> soft_scale(const std::vector<NanoscopeBlock>& blocks, std::string_view name,
                                    std::string_view per);

}  // namespace afm::curves
