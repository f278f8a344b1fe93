// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

// Reading of power spectra of a free lever from text: columns of numbers with their units in a heading. docs/lever.md
// describes the contents. Any thread.
namespace afm::curves {

struct SpectrumRow {
  double frequency_hz = 0;  // frequency above zero, rising from row to row
  double density = 0;       // one-sided power density, V^2/Hz or m^2/Hz; not negative
};

struct Spectrum {
  std::vector<SpectrumRow> rows;
  bool in_volts = false;  // true: volts of the detector; false: metres of deflection
};

struct SpectrumReading {
  std::string units;       // units in place of the heading's, "kHz, nm2/Hz"; empty: the heading's
  std::size_t column = 2;  // column of the densities, from 1; column 1 contains the frequencies
};

inline constexpr std::size_t kMostSpectrumRows = 500'000;
inline constexpr std::size_t kMostSpectrumColumns = 64;

// BadInputFile, in one line that names the file and the line, for anything else than at least one row above 0 Hz: no
// text, units missing or unknown, a field that is no number, frequencies that do not rise, a negative density, more
// than kMostSpectrumRows. Densities of amplitudes, "V/sqrt(Hz)", are squared. Rows up to 0 Hz are left out, and a last
// line without a line end, which may have lost digits.
core::Result<Spectrum> load_spectrum(const std::string& path, const SpectrumReading& reading = {});

// Reads the bytes of a file called `name`, as load_spectrum() does.
core::Result<Spectrum> parse_spectrum(std::string_view bytes, const std::string& name,
                                      const SpectrumReading& reading = {});

}  // namespace afm::curves
