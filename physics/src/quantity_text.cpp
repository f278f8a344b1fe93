// SPDX-License-Identifier: Apache-2.0
#include "physics/quantity_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <system_error>

namespace afm::physics {
namespace {

constexpr std::array kLengths{Unit{"m", 1.0, true},   Unit{"cm", 1e2, false},        Unit{"mm", 1e3, true},
                              Unit{"um", 1e6, true},  Unit{"\u00b5m", 1e6, false},   Unit{"\u03bcm", 1e6, false},
                              Unit{"nm", 1e9, true},  Unit{"\u00c5", 1e10, false},   Unit{"\u212b", 1e10, false},
                              Unit{"A", 1e10, false}, Unit{"Angstrom", 1e10, false}, Unit{"angstrom", 1e10, false},
                              Unit{"pm", 1e12, true}};
constexpr std::array kForces{Unit{"N", 1.0, true},        Unit{"mN", 1e3, true},       Unit{"uN", 1e6, true},
                             Unit{"\u00b5N", 1e6, false}, Unit{"\u03bcN", 1e6, false}, Unit{"nN", 1e9, true},
                             Unit{"pN", 1e12, true}};
constexpr std::array kVelocities{Unit{"m/s", 1.0, true},        Unit{"mm/s", 1e3, true},
                                 Unit{"um/s", 1e6, true},       Unit{"\u00b5m/s", 1e6, false},
                                 Unit{"\u03bcm/s", 1e6, false}, Unit{"nm/s", 1e9, false}};
// SI brochure, 9th edition: exact.
constexpr double kJoulesPerElectronvolt = 1.602176634e-19;
constexpr std::array kEnergies{Unit{"J", 1.0, true}, Unit{"aJ", 1e18, true},
                               Unit{"eV", 1.0 / kJoulesPerElectronvolt, false},
                               Unit{"meV", 1e3 / kJoulesPerElectronvolt, false}, Unit{"zJ", 1e21, true}};
constexpr std::array kStiffnesses{
    Unit{"N/m", 1.0, true},    Unit{"mN/m", 1e3, true},        Unit{"nN/nm", 1.0, false},     Unit{"pN/nm", 1e3, false},
    Unit{"nN/um", 1e3, false}, Unit{"nN/\u00b5m", 1e3, false}, Unit{"nN/\u03bcm", 1e3, false}};
constexpr std::array kSurfaceEnergies{Unit{"J/m2", 1.0, true}, Unit{"J/m^2", 1.0, false}, Unit{"J/m\u00b2", 1.0, false},
                                      Unit{"mJ/m2", 1e3, true}, Unit{"mJ/m^2", 1e3, false},
                                      Unit{"mJ/m\u00b2", 1e3, false},
                                      // usual unit of surface tension
                                      Unit{"N/m", 1.0, false}, Unit{"mN/m", 1e3, false}};
constexpr std::array kPressures{Unit{"TPa", 1e-12, true}, Unit{"GPa", 1e-9, true}, Unit{"MPa", 1e-6, true},
                                Unit{"kPa", 1e-3, true}, Unit{"Pa", 1.0, true}};
constexpr std::array kNumbers{Unit{"", 1.0, true}};
constexpr std::array kTimes{Unit{"s", 1.0, true}, Unit{"ms", 1e3, true}, Unit{"us", 1e6, true},
                            Unit{"\u00b5s", 1e6, false}, Unit{"\u03bcs", 1e6, false}};
constexpr std::array kFrequencies{Unit{"MHz", 1e-6, true}, Unit{"kHz", 1e-3, true}, Unit{"Hz", 1.0, true}};
constexpr std::array kTemperatures{Unit{"K", 1.0, true}, Unit{"\u00b0C", 1.0, false, 273.15},
                                   Unit{"\u2103", 1.0, false, 273.15}, Unit{"degC", 1.0, false, 273.15},
                                   Unit{"C", 1.0, false, 273.15}};
constexpr std::array kDensities{Unit{"kg/m3", 1.0, true}, Unit{"kg/m^3", 1.0, false}, Unit{"kg/m\u00b3", 1.0, false}};

// Divides by a power of ten above one, which is exact in a double up to 1e22, unlike the small factor.
double in_si(double number, double per_si) {
  return per_si >= 1.0 ? number / per_si : number * std::round(1.0 / per_si);
}

std::string_view trim(std::string_view text) {
  constexpr std::string_view kBlanks = " \t";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

// A character of typeset text and the one that a keyboard has in its place.
struct Typeset {
  std::string_view character, plain;
};
constexpr std::array kTypeset{Typeset{"\u00a0", " "}, Typeset{"\u202f", " "},   // no-break spaces
                              Typeset{"\u2009", " "}, Typeset{"\u3000", " "},   // thin and ideographic space
                              Typeset{"\u2212", "-"}, Typeset{"\u2019", "'"}};  // minus, apostrophe

std::string with_plain_characters(std::string_view text) {
  std::string plain(text);
  for (const Typeset& each : kTypeset) {
    for (std::size_t at = plain.find(each.character); at != std::string::npos; at = plain.find(each.character, at)) {
      plain.replace(at, each.character.size(), each.plain);
    }
  }
  return plain;
}

// True for ",5nm" and "'000 nm" behind a number: its decimal comma, or a separator of thousands.
bool goes_on_with_digits(std::string_view behind) {
  if (behind.size() < 2 || std::string_view(",.'_ ").find(behind[0]) == std::string_view::npos) return false;
  return behind[1] >= '0' && behind[1] <= '9';
}

// Quotes a text for a message: one line, of limited length, in whole characters of UTF-8.
std::string quoted(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::size_t end = std::min(text.size(), kLongest);
  const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
  while (end > 0 && end < text.size() && continues(text[end])) --end;
  std::string result = "\"" + std::string(text.substr(0, end)) + (end < text.size() ? "...\"" : "\"");
  std::replace_if(
      result.begin(), result.end(), [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; }, '?');
  return result;
}

std::string refusal(std::string_view text, std::string_view sort, std::span<const Unit> units, std::string_view why) {
  const auto shown = std::count_if(units.begin(), units.end(), [](const Unit& unit) { return unit.shown; });
  const char* const wanted = units.front().symbol.empty() ? "; write a number"
                             : shown == 1                 ? "; write a number and the unit "
                                                          : "; write a number and one of the units ";
  return "cannot read " + quoted(text) + " as " + std::string(sort) + ": " + std::string(why) + wanted +
         list_units(units);
}

}  // namespace

constinit const UnitList<Length> kLengthUnits{{"a length", kLengths}};
constinit const UnitList<Force> kForceUnits{{"a force", kForces}};
constinit const UnitList<Velocity> kVelocityUnits{{"a velocity", kVelocities}};
constinit const UnitList<Energy> kEnergyUnits{{"an energy", kEnergies}};
constinit const UnitList<Stiffness> kStiffnessUnits{{"a stiffness", kStiffnesses}};
constinit const UnitList<SurfaceEnergy> kSurfaceEnergyUnits{{"a surface energy", kSurfaceEnergies}};
constinit const UnitList<Pressure> kPressureUnits{{"a pressure", kPressures}};
constinit const Units kPlainNumber{"a number", kNumbers};
constinit const UnitList<Time> kTimeUnits{{"a time", kTimes}};
constinit const UnitList<Frequency> kFrequencyUnits{{"a frequency", kFrequencies}};
constinit const UnitList<Temperature> kTemperatureUnits{{"a temperature", kTemperatures}};
constinit const UnitList<Density> kDensityUnits{{"a density", kDensities}};

std::string list_units(std::span<const Unit> units) {
  std::string list;
  for (const Unit& unit : units) {
    if (!unit.shown) continue;
    if (!list.empty()) list += ", ";
    list += unit.symbol;
  }
  return list;
}

std::variant<double, std::string> parse_si(std::string_view text, std::string_view sort, std::span<const Unit> units,
                                           Infinity infinity) {
  const std::string plain = with_plain_characters(text);
  std::string_view rest = trim(plain);
  // from_chars accepts a minus but no plus
  if (rest.size() > 1 && rest[0] == '+' && rest[1] != '-') rest.remove_prefix(1);

  double number = 0.0;
  const auto [end, status] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  if (status == std::errc::invalid_argument) return refusal(text, sort, units, "it does not begin with a number");
  const std::string_view behind = rest.substr(static_cast<std::size_t>(end - rest.data())), symbol = trim(behind);
  const auto unit = std::find_if(units.begin(), units.end(), [&](const Unit& u) { return u.symbol == symbol; });
  if (goes_on_with_digits(behind)) {
    return refusal(text, sort, units, "write a decimal point, and no separator of thousands");
  }
  if (unit == units.end() && symbol.empty()) return refusal(text, sort, units, "it has no unit");
  if (unit == units.end()) return refusal(text, sort, units, quoted(symbol) + " is not its unit");
  if (status == std::errc::result_out_of_range) return refusal(text, sort, units, "the number is out of range");
  if (std::isnan(number)) return refusal(text, sort, units, "it is not a number");
  if (std::isinf(number) && infinity == Infinity::Refused) {
    return refusal(text, sort, units, "it may not be infinite");
  }
  return in_si(number, unit->per_si) + unit->zero_si;
}

namespace {

// The largest unit in which the rounded number is at least 1, or the smallest; that of the SI for zero.
const Unit& shown_unit(double si, std::span<const Unit> units, int precision) {
  const double rounds_to_one = 1.0 - 0.5 * std::pow(10.0, -precision);
  const Unit* chosen = nullptr;
  for (const Unit& unit : units) {
    if (!unit.shown) continue;
    const bool closer =
        si != 0.0 ? chosen != nullptr && std::abs(si) * chosen->per_si < rounds_to_one : unit.per_si == 1.0;
    if (chosen == nullptr || closer) chosen = &unit;
  }
  return *chosen;
}

std::string text_in(double si, const Unit& unit, int precision) {
  std::array<char, 64> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), si * unit.per_si,
                                    std::chars_format::general, precision);
  return std::string(buffer.data(), result.ptr) + (unit.symbol.empty() ? "" : " ") + std::string(unit.symbol);
}

}  // namespace

std::string format_si(double si, std::span<const Unit> units, int digits) {
  const int precision = std::clamp(digits, 1, 17);
  return text_in(si, shown_unit(si, units, precision), precision);
}

std::array<std::string, 2> range_ends(double smallest, double largest, std::span<const Unit> units, int digits) {
  const int precision = std::clamp(digits, 1, 17);
  const auto end = [&](double si, double other) {
    return text_in(si, shown_unit(si != 0.0 ? si : other, units, precision), precision);
  };
  return {end(smallest, largest), end(largest, smallest)};
}

std::string range_text(double smallest, double largest, const Units& units) {
  const auto [least, most] = range_ends(smallest, largest, units.units);
  return least + " to " + most;
}

}  // namespace afm::physics
