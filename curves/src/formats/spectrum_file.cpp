// SPDX-License-Identifier: Apache-2.0
#include "curves/spectrum_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>

#include "bytes/text_table.h"
#include "core/printable.h"
#include "curves/curve_error.h"
#include "curves/unread_kinds.h"
#include "formats/format_table.h"

namespace afm::curves {

namespace {

// Unit in UTF-8 and, for the micro sign and the square, Latin-1, as programs of Windows write them.
struct SignalUnit {
  std::string_view symbol;
  double si;
  bool volts;
};
constexpr std::array kSignalUnits{
    SignalUnit{"V", 1.0, true},         SignalUnit{"mV", 1e-3, true},      SignalUnit{"uV", 1e-6, true},
    SignalUnit{"\u00b5V", 1e-6, true},  SignalUnit{"\u03bcV", 1e-6, true}, SignalUnit{"\xb5V", 1e-6, true},
    SignalUnit{"m", 1.0, false},        SignalUnit{"um", 1e-6, false},     SignalUnit{"\u00b5m", 1e-6, false},
    SignalUnit{"\u03bcm", 1e-6, false}, SignalUnit{"\xb5m", 1e-6, false},  SignalUnit{"nm", 1e-9, false},
    SignalUnit{"pm", 1e-12, false},     SignalUnit{"fm", 1e-15, false}};

// Text after the signal's unit.
struct DensityForm {
  std::string_view text;
  bool amplitude;
};
constexpr std::array kDensityForms{
    DensityForm{"2/Hz", false},     DensityForm{"^2/Hz", false},      DensityForm{"\u00b2/Hz", false},
    DensityForm{"\xb2/Hz", false},  DensityForm{"**2/Hz", false},     DensityForm{"/sqrt(Hz)", true},
    DensityForm{"/\u221aHz", true}, DensityForm{"/\u221a(Hz)", true}, DensityForm{"/rtHz", true},
    DensityForm{"/Hz^0.5", true},   DensityForm{"/Hz^(1/2)", true},   DensityForm{"/Hz^1/2", true}};

struct FrequencyUnit {
  std::string_view symbol;
  double hz;
};
constexpr std::array kFrequencyNames{FrequencyUnit{"Hz", 1.0}, FrequencyUnit{"kHz", 1e3}, FrequencyUnit{"MHz", 1e6}};

constexpr const char* kUnitsWanted =
    "name the units of frequency and density in its heading or with --units, such as --units \"kHz, V2/Hz\"";

struct ColumnUnits {
  double hz = 1.0;
  double signal = 1.0;
  bool volts = false;
  bool amplitude = false;
  bool operator==(const ColumnUnits&) const = default;
};

// True for letters, digits and bytes beyond ASCII: the micro sign before "m".
bool is_part_of_word(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte >= 0x80 || std::isalnum(byte) != 0;
}

// True if a symbol of `size` bytes at `at` is a word by itself.
bool is_word(std::string_view text, std::size_t at, std::size_t size) {
  const bool begins = at == 0 || !is_part_of_word(text[at - 1]);
  return begins && (at + size >= text.size() || !is_part_of_word(text[at + size]));
}

// Removes every density from the text. Empty if there is none; throws CurveError for two that differ.
std::optional<ColumnUnits> take_density(std::string& text) {
  std::optional<ColumnUnits> found;
  for (const SignalUnit& signal : kSignalUnits) {
    for (const DensityForm& form : kDensityForms) {
      const std::string whole = std::string(signal.symbol) + std::string(form.text);
      for (std::size_t at = text.find(whole); at != std::string::npos; at = text.find(whole, at + 1)) {
        if (!is_word(text, at, whole.size())) continue;
        const ColumnUnits units{1.0, signal.si, signal.volts, form.amplitude};
        if (found && *found != units) throw CurveError("its heading has several units of density; choose with --units");
        found = units;
        text.replace(at, whole.size(), whole.size(), ' ');
      }
    }
  }
  return found;
}

// Units named in a heading; empty without a density.
std::optional<ColumnUnits> units_in(std::string_view heading) {
  std::string text(heading);
  for (const std::string_view blank : {" /", "/ "}) {
    for (std::size_t at = text.find(blank); at != std::string::npos; at = text.find(blank)) text.replace(at, 2, "/");
  }
  auto units = take_density(text);
  if (!units) return std::nullopt;
  // the first, since the frequency's is the first column
  std::size_t first = std::string::npos;
  for (const FrequencyUnit& frequency : kFrequencyNames) {
    for (std::size_t at = text.find(frequency.symbol); at < first; at = text.find(frequency.symbol, at + 1)) {
      if (!is_word(text, at, frequency.symbol.size())) continue;
      units->hz = frequency.hz;
      first = at;
    }
  }
  if (first != std::string::npos) return units;
  throw CurveError(fmt::format("it has no unit of the frequency; {}", kUnitsWanted));
}

void split_columns(std::string_view line, std::vector<std::string_view>& fields) {
  for (const char separator : {'\t', ';', ','}) {
    if (line.find(separator) == std::string_view::npos) continue;
    split(line, separator, fields);
    return;
  }
  split(line, ' ', fields);
  std::erase_if(fields, [](std::string_view field) { return field.empty(); });
}

bool is_digit_of_row(char c) { return c >= '0' && c <= '9'; }

// A row of numbers with decimal commas between tabs, semicolons or blanks, with points instead; any other line as it
// is.
std::string_view with_decimal_points(std::string_view line, std::string& row) {
  if (line.empty() || !(is_digit_of_row(line.front()) || line.front() == '-' || line.front() == '+') ||
      line.find('.') != std::string_view::npos || line.find(',') == std::string_view::npos) {
    return line;
  }
  bool blank = false, all_decimal = true;
  for (std::size_t i = 1; i < line.size(); ++i) {
    blank = blank || line[i] == ' ';
    const bool between_digits =
        line[i] == ',' && i + 1 < line.size() && is_digit_of_row(line[i - 1]) && is_digit_of_row(line[i + 1]);
    all_decimal = all_decimal && (line[i] != ',' || between_digits);
  }
  if (!all_decimal || !(blank || line.find_first_of("\t;") != std::string_view::npos)) return line;
  row = line;
  std::replace(row.begin(), row.end(), ',', '.');
  return row;
}

bool is_decimal(std::string_view field) {
  field = trimmed(field);
  return take_decimal(field) && field.empty();
}

bool is_comment(std::string_view line) { return line.starts_with('#') || line.starts_with('%'); }

void add_spectrum_row(const std::vector<std::string_view>& fields, const SpectrumReading& reading,
                      const ColumnUnits& units, const Lines& lines, Spectrum& spectrum) {
  if (fields.size() < std::max(reading.column, std::size_t{2})) {
    throw CurveError(fmt::format("line {}: it has {} of {} columns", lines.number(), fields.size(), reading.column));
  }
  const double frequency_hz = units.hz * number_in(fields.front(), "the frequency", lines);
  const double value = units.signal * number_in(fields[reading.column - 1], "the density", lines);
  if (frequency_hz <= 0.0) return;
  if (!spectrum.rows.empty() && !(frequency_hz > spectrum.rows.back().frequency_hz)) {
    throw CurveError(fmt::format("line {}: the frequency does not rise", lines.number()));
  }
  if (value < 0.0)
    throw CurveError(fmt::format("line {}: the density is negative; is it in decibels?", lines.number()));
  if (spectrum.rows.size() >= kMostSpectrumRows) {
    throw CurveError(fmt::format("it has more than {} rows", kMostSpectrumRows));
  }
  const double density = units.amplitude ? value * value : value * units.signal;
  if (!std::isfinite(frequency_hz) || !std::isfinite(density)) {
    throw CurveError(fmt::format("line {}: a number is out of range", lines.number()));
  }
  spectrum.rows.push_back({frequency_hz, density});
}

Spectrum read_spectrum(std::string_view text, const SpectrumReading& reading) {
  if (text.find('\0') != std::string_view::npos) refuse_no_text(text);
  std::optional<ColumnUnits> units;
  if (!reading.units.empty()) {
    units = units_in(reading.units);
    if (!units) throw CurveError(fmt::format("--units {} has no density, such as V2/Hz", reading.units));
  }
  Spectrum spectrum;
  std::vector<std::string_view> fields;
  std::string row;
  bool in_table = false, has_fractions = false, has_commas = false;
  Lines lines(text.substr(0, text.find_last_of("\r\n") + 1));
  for (std::string_view line; lines.next(line);) {
    line = with_decimal_points(trimmed(line), row);
    if (line.empty() || (in_table && is_comment(line))) continue;
    split_columns(line, fields);
    in_table = in_table || is_decimal(fields.front());
    if (!in_table) {
      if (!reading.units.empty()) continue;
      if (const auto in_heading = units_in(line)) units = in_heading;
      continue;
    }
    if (!units) throw CurveError(fmt::format("it has no unit of the density; {}", kUnitsWanted));
    add_spectrum_row(fields, reading, *units, lines, spectrum);
    has_commas = has_commas || (fields.size() > 2 && line.find(',') != std::string_view::npos);
    has_fractions = has_fractions || fields[reading.column - 1].find_first_of(".eE") != std::string_view::npos;
  }
  if (spectrum.rows.empty()) throw CurveError("it has no whole row of numbers, with a decimal point, above 0 Hz");
  // "1000,5,0,0021": a density is hardly ever a whole number
  if (has_commas && !has_fractions) {
    throw CurveError(
        "its densities have no decimal point: are the commas between its columns decimal ones? Write decimal points, "
        "or separate the columns by tabs or semicolons");
  }
  spectrum.in_volts = units->volts;
  return spectrum;
}

}  // namespace

core::Result<Spectrum> load_spectrum(const std::string& path, const SpectrumReading& reading) {
  const auto bytes = bytes_of_file(path);
  if (!bytes) return tl::unexpected(bytes.error());
  return parse_spectrum(*bytes, path, reading);
}

core::Result<Spectrum> parse_spectrum(std::string_view bytes, const std::string& name, const SpectrumReading& reading) {
  try {
    return read_spectrum(without_byte_order_mark(bytes), reading);
  } catch (...) {
    return core::failure(
        core::ErrorCategory::BadInputFile,
        core::printable_line(fmt::format("cannot read the spectrum {}: {}", name, reason_of_failure())));
  }
}

}  // namespace afm::curves
