// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
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
  std::string_view name;                           // name of the block, "Ciao image list"
  std::map<std::string, std::string_view> values;  // values by key in lower case, "@2:z scale"

  const std::string_view* find(const std::string& key) const {
    const auto found = values.find(key);
    return found != values.end() ? &found->second : nullptr;
  }
};

// Keys and names of blocks are compared in lower case.
std::string lower_key(std::string_view text);

std::vector<NanoscopeBlock> nanoscope_blocks(std::string_view bytes);

// False for a file that is cut off in its header.
bool nanoscope_header_ends(std::string_view bytes);
inline constexpr const char* kNoHeaderEnd = "its header has no end";  // part missing in such a file

// The name "Deflection Error" in S [DeflectionError] "Deflection Error"; empty if there is none.
std::string_view nanoscope_channel(const NanoscopeBlock& channel);

// Version of the program, such as 0x09300201; 0 if no block has it.
std::uint32_t nanoscope_version(const std::vector<NanoscopeBlock>& blocks);

// Date and time YYYY-MM-DD and HH:MM:SS of "04:42:34 PM Tue Sep 11 2007"; empty for any other text.
struct NanoscopeTime {
  std::string day, clock;
};
NanoscopeTime nanoscope_time(std::string_view text);

// The number at the front of a value. Throws CurveError if there is none.
double nanoscope_number(const NanoscopeBlock& block, const std::string& key);

// Spring constant in N/m, the unit that Nanoscope omits; other programs may write another one. Throws CurveError for a
// unit of anything else.
double nanoscope_spring_constant(const NanoscopeBlock& channel);

// Offset of a channel's data. Throws CurveError if it is not in the file after the header.
std::size_t nanoscope_data_offset(const NanoscopeBlock& channel, std::string_view bytes);

// Takes the number at the front of the text.
std::optional<double> take_number(std::string_view& text);

// Scale "V [Sens. Zsens] (0.0067 V/LSB) 440 V": an integer times `per_lsb` is the value, `value` that of all integers.
struct HardScale {
  std::string_view soft_name;  // name in the brackets, "Sens. Zsens", or empty
  std::optional<double> per_lsb;
  std::string_view per_lsb_unit;  // unit of per_lsb; empty if the bracket has none
  std::optional<double> value;
  std::string_view unit;
};
// Scale of a text; empty if it does not begin with "V".
std::optional<HardScale> hard_scale(const std::string_view* text);

struct SoftScale {
  double factor = 1.0;
  std::string unit;
};

// Scale "V 12.5 nm/V" of "@Sens. Zsens", or "V 1 log(Pa)/log(Arb)", from any block. `per` is the unit after the slash.
std::optional<SoftScale> soft_scale(const std::vector<NanoscopeBlock>& blocks, std::string_view name,
                                    std::string_view per);

// Name of the block of a ramp.
inline constexpr std::string_view kNanoscopeForceList = "ciao force list";

// The value of one integer of a force channel, before any sensitivity. The header prints it rounded, and its full range
// exactly, which in older files is that of the screen. Throws CurveError without a scale.
double nanoscope_value_per_integer(const NanoscopeBlock& channel, std::size_t integer_size);

// Metres per volt by the sensitivity of that name; empty if the file has none.
std::optional<double> nanoscope_metres_per_volt(const std::vector<NanoscopeBlock>& blocks, std::string_view name);

// The length of the ramp: "@4:Ramp size" of the channel, or an older key of the force list. Throws CurveError without
// one.
double nanoscope_ramp_m(const NanoscopeBlock& channel, const std::vector<NanoscopeBlock>& blocks);

}  // namespace afm::curves
