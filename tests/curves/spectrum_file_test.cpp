// SPDX-License-Identifier: Apache-2.0
#include "curves/spectrum_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace afm::curves {
namespace spectrum_file_test {

using testing::HasSubstr;

Spectrum read(const std::string& text, const SpectrumReading& reading = {}) {
  const auto spectrum = parse_spectrum(text, "x", reading);
  EXPECT_TRUE(spectrum) << spectrum.error().message;
  return spectrum.value_or(Spectrum{});
}

void expect_refused(const std::string& text, const std::string& why, const SpectrumReading& reading = {}) {
  const auto spectrum = parse_spectrum(text, "x.txt", reading);
  ASSERT_FALSE(spectrum) << text;
  EXPECT_EQ(spectrum.error().category, core::ErrorCategory::BadInputFile);
  EXPECT_THAT(spectrum.error().message, HasSubstr("x.txt"));
  EXPECT_THAT(spectrum.error().message, HasSubstr(why));
  EXPECT_EQ(spectrum.error().message.find('\n'), std::string::npos);
}

TEST(SpectrumFile, HasTheUnitsOfItsHeading) {
  struct Row {
    const char* heading;
    double hz, density;
    bool volts;
  };
  for (const Row& row :
       {Row{"Frequency (Hz)\tPSD (V^2/Hz)", 2.0, 3.0, true}, Row{"# f [kHz]  S [mV\u00b2/Hz]", 2e3, 3e-6, true},
        Row{"% 4 averages\n% frequency / MHz  density / pm2/Hz", 2e6, 3e-24, false},
        Row{"Hz nm^2 / Hz", 2.0, 3e-18, false}, Row{"f (kHz), S (V2/Hz), level (dB/Hz)", 2e3, 3.0, true},
        Row{"Hz; \u00b5m2/Hz", 2.0, 3e-12, false}, Row{"Hz, m2/Hz", 2.0, 3.0, false},
        Row{"Hz, V/sqrt(Hz)", 2.0, 9.0, true}, Row{"Hz, fm/\u221aHz", 2.0, 9e-30, false},
        Row{"kHz fit (nm2/Hz) psd (nm2/Hz)", 2e3, 3e-18, false},
        Row{"\xEF\xBB\xBF"
            "Hz V2/Hz",
            2.0, 3.0, true}}) {
    for (const char* separator : {"\t", " ", ", ", ";"}) {
      const Spectrum spectrum = read(std::string(row.heading) + "\r\n0" + separator + "7\r\n2" + separator + "3\r\n");
      ASSERT_EQ(spectrum.rows.size(), 1U) << row.heading;
      EXPECT_DOUBLE_EQ(spectrum.rows[0].frequency_hz, row.hz) << row.heading;
      EXPECT_NEAR(spectrum.rows[0].density, row.density, 1e-12 * row.density) << row.heading;
      EXPECT_EQ(spectrum.in_volts, row.volts) << row.heading;
    }
  }
}

TEST(SpectrumFile, TakesUnitsAndColumnOfTheCommandLine) {
  const Spectrum spectrum = read("1 2 3\n2 3 4\n", {.units = "kHz, nm2/Hz", .column = 3});
  ASSERT_EQ(spectrum.rows.size(), 2U);
  EXPECT_DOUBLE_EQ(spectrum.rows[1].frequency_hz, 2e3);
  EXPECT_NEAR(spectrum.rows[1].density, 4e-18, 1e-30);
  // over the heading's
  EXPECT_TRUE(read("Hz m2/Hz\n1 2\n", {.units = "Hz V2/Hz"}).in_volts);
}

TEST(SpectrumFile, IsRefusedWithDecimalCommasBetweenCommas) {
  expect_refused("Hz, V2/Hz\n1000,5,0,0021\n1001,5,0,0022\n", "are the commas between its columns decimal ones?");
  expect_refused("Hz, V2/Hz\n1000,0,0021\n", "are the commas between its columns decimal ones?");
  EXPECT_EQ(read("Hz, V2/Hz, fit\n1000,2e-3,7\n1001,0.5,7\n").rows.size(), 2U);
}

TEST(SpectrumFile, HasDecimalCommasBetweenOtherSeparators) {
  for (const char* separator : {"\t", ";", " ", " ; "}) {
    const std::string gap = separator;
    const Spectrum spectrum = read("Hz;V2/Hz\n1000" + gap + "1,5e-3\n1000,5" + gap + "0,0025\n");
    ASSERT_EQ(spectrum.rows.size(), 2U) << separator;
    EXPECT_DOUBLE_EQ(spectrum.rows[1].frequency_hz, 1000.5) << separator;
    EXPECT_DOUBLE_EQ(spectrum.rows[1].density, 0.0025) << separator;
  }
  expect_refused("Hz;V2/Hz\n1.000,5;2,5\n", "decimal point");
  expect_refused("Hz, V2/Hz\n1000, 5 7\n", "line 2");
}

TEST(SpectrumFile, MayHaveSigns) {
  const Spectrum spectrum = read("Hz V2/Hz\n+1 +2e-12\n+2 +3e-12\n");
  ASSERT_EQ(spectrum.rows.size(), 2U);
  EXPECT_DOUBLE_EQ(spectrum.rows[0].density, 2e-12);
  expect_refused("Hz V2/Hz\n1 +-2\n", "line 2");
}

TEST(SpectrumFile, HasUnitsInLatin1) {
  EXPECT_NEAR(read("Hz \xb5V\xb2/Hz\n1 2\n").rows.at(0).density, 2e-12, 1e-24);
  EXPECT_NEAR(read("Hz \xb5m/sqrt(Hz)\n1 2\n").rows.at(0).density, 4e-12, 1e-24);
}

// Such a line may have lost the exponent of its number.
TEST(SpectrumFile, LeavesOutALastLineWithoutItsEnd) { EXPECT_EQ(read("Hz V2/Hz\n1 2e-12\n2 2e-1").rows.size(), 1U); }

TEST(SpectrumFile, IsRefusedInOneLine) {
  expect_refused("", "no whole row");
  expect_refused("Hz V2/Hz\n", "no whole row");
  expect_refused("1 2\n2 3\n", "no unit of the density");
  expect_refused("frequency psd\n1 2\n2 3\n", "--units");
  expect_refused("psd (V2/Hz)\n1 2\n", "no unit of the frequency");
  expect_refused("Hz V2/Hz nm2/Hz\n1 2 3\n", "several units");
  expect_refused("Hz V2/Hz\n1 2\n2 nan\n", "line 3");
  expect_refused("Hz V2/Hz\n1 2\n2 1e999\n", "line 3");
  expect_refused("Hz V2/Hz\n1 2\n2\n", "line 3: it has 1 of 2 columns");
  expect_refused("Hz V2/Hz\n1 2\nend\n", "line 3");
  expect_refused("Hz V2/Hz\n2 2\n2 3\n", "line 3: the frequency does not rise");
  expect_refused("Hz V2/Hz\n1 -80\n", "decibels");
  expect_refused(std::string("Hz V2/Hz\n1 2\n\0 3\n", 17), "UTF-16");
  expect_refused("1 2\n", "has no density", {.units = "Hz"});
  std::string many = "Hz V2/Hz\n";
  for (std::size_t i = 1; i <= kMostSpectrumRows + 1; ++i) many += std::to_string(i) + " 1\n";
  expect_refused(many, "more than 500000 rows");
}

}  // namespace spectrum_file_test
}  // namespace afm::curves
