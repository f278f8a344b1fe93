// SPDX-License-Identifier: Apache-2.0
#include "physics/quantity_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <clocale>
#include <cmath>
#include <random>

namespace afm::physics {
namespace quantity_text_test {

using testing::HasSubstr;
using testing::Not;

template <class Q>
double parsed(std::string_view text, const UnitList<Q>& list, Infinity infinity = Infinity::Refused) {
  const auto result = parse_quantity(text, list, infinity);
  EXPECT_TRUE(result.value.has_value()) << result.error;
  return result.value.value_or(Q(std::nan(""))).si;
}

template <class Q>
std::string refused(std::string_view text, const UnitList<Q>& list, Infinity infinity = Infinity::Refused) {
  const auto result = parse_quantity(text, list, infinity);
  EXPECT_FALSE(result.value.has_value()) << text;
  return result.error;
}

TEST(QuantityText, ReadsANumberAndItsUnit) {
  EXPECT_DOUBLE_EQ(parsed("50nm", kLengthUnits), 50e-9);
  EXPECT_DOUBLE_EQ(parsed(" 24.5 zJ ", kEnergyUnits), 2.45e-20);
  EXPECT_DOUBLE_EQ(parsed("0.1N/m", kStiffnessUnits), 0.1);
  EXPECT_DOUBLE_EQ(parsed("2.228mJ/m2", kSurfaceEnergyUnits), 2.228e-3);
  EXPECT_DOUBLE_EQ(parsed("2.228 mJ/m^2", kSurfaceEnergyUnits), 2.228e-3);
  EXPECT_DOUBLE_EQ(parsed("2.228 mN/m", kSurfaceEnergyUnits), 2.228e-3);
  EXPECT_DOUBLE_EQ(parsed("-5nm", kLengthUnits), -5e-9);
  EXPECT_DOUBLE_EQ(parsed("+5 \u00b5m", kLengthUnits), 5e-6);
  EXPECT_DOUBLE_EQ(parsed("1e-9 m", kLengthUnits), 1e-9);
  EXPECT_DOUBLE_EQ(parsed(".5um", kLengthUnits), 5e-7);
}

TEST(QuantityText, ReadsAndShowsNumbersWithoutAUnit) {
  const auto read = [](std::string_view text) {
    return parse_si(text, kPlainNumber.sort, kPlainNumber.units, Infinity::Refused);
  };
  EXPECT_EQ(std::get<double>(read(" 0.25 ")), 0.25);
  EXPECT_THAT(std::get<std::string>(read("3nm")), testing::EndsWith("\"nm\" is not its unit; write a number"));
  EXPECT_EQ(format_si(0.3, kPlainNumber.units), "0.3");
  EXPECT_EQ(range_text(2.0, 4096.0, kPlainNumber), "2 to 4096");
  EXPECT_DOUBLE_EQ(parsed("250us", kTimeUnits), 250e-6);
  EXPECT_EQ(format_quantity(Time(2e-3), kTimeUnits), "2 ms");
}

TEST(QuantityText, ShowsAnEndOfZeroInTheUnitOfTheOtherEnd) {
  EXPECT_EQ(range_text(0.0, 1e-7, kLengthUnits), "0 nm to 100 nm");
  EXPECT_EQ(range_text(-1e-6, 0.0, kLengthUnits), "-1 um to 0 um");
  EXPECT_EQ(range_text(0.0, 0.0, kLengthUnits), "0 m to 0 m");
  EXPECT_EQ(range_text(1e-9, 1e-3, kLengthUnits), "1 nm to 1 mm");
  EXPECT_EQ(range_text(0.0, 10.0, kPlainNumber), "0 to 10");
}

TEST(QuantityText, ReadsTheUnitsOfOtherPrograms) {
  EXPECT_DOUBLE_EQ(parsed("10pN/nm", kStiffnessUnits), 0.01);
  EXPECT_DOUBLE_EQ(parsed("3 \u00c5", kLengthUnits), 3e-10);
  EXPECT_DOUBLE_EQ(parsed("3 \u212b", kLengthUnits), 3e-10);  // character for the unit
  EXPECT_DOUBLE_EQ(parsed("3A", kLengthUnits), 3e-10);
  EXPECT_DOUBLE_EQ(parsed("3 Angstrom", kLengthUnits), 3e-10);
  EXPECT_DOUBLE_EQ(parsed("150 meV", kEnergyUnits), 0.15 * 1.602176634e-19);
  EXPECT_DOUBLE_EQ(parsed("500nm/s", kVelocityUnits), 5e-7);
  EXPECT_DOUBLE_EQ(parsed("25 C", kTemperatureUnits), 298.15);
  EXPECT_DOUBLE_EQ(parsed("25 \u2103", kTemperatureUnits), 298.15);  // character for the unit
  EXPECT_DOUBLE_EQ(parsed("0.15 eV", kEnergyUnits), 0.15 * 1.602176634e-19);
  EXPECT_DOUBLE_EQ(parsed("25 \u00b0C", kTemperatureUnits), 298.15);
  EXPECT_DOUBLE_EQ(parsed("-5degC", kTemperatureUnits), 268.15);
  EXPECT_EQ(format_quantity(Temperature(298.15), kTemperatureUnits), "298.15 K");
}

TEST(QuantityText, ReadsLargeUnitsExactly) {
  EXPECT_EQ(parsed("169 GPa", kPressureUnits), 1.69e11);
  EXPECT_EQ(parsed("1.2 TPa", kPressureUnits), 1.2e12);
  EXPECT_EQ(parsed("2.6 MPa", kPressureUnits), 2.6e6);
  EXPECT_EQ(parsed("3 kPa", kPressureUnits), 3e3);
  EXPECT_EQ(parsed("12.3 kHz", kFrequencyUnits), 12300.0);
  EXPECT_EQ(parsed("298.15 K", kTemperatureUnits), 298.15);
  EXPECT_EQ(parsed("2329 kg/m^3", kDensityUnits), 2329.0);
  EXPECT_EQ(format_quantity(Pressure(5.15e10), kPressureUnits), "51.5 GPa");
  EXPECT_EQ(format_quantity(Frequency(12000.0), kFrequencyUnits), "12 kHz");
}

TEST(QuantityText, RefusesABareNumberAndListsTheUnits) {
  EXPECT_EQ(refused("50", kLengthUnits),
            "cannot read \"50\" as a length: it has no unit; write a number and one of the units m, mm, um, nm, pm");
}

TEST(QuantityText, NamesASingleUnitAsOne) {
  EXPECT_THAT(refused("50", kDensityUnits), testing::EndsWith("write a number and the unit kg/m3"));
}

TEST(QuantityText, RefusesAnotherDimension) {
  EXPECT_THAT(refused("50nN", kLengthUnits), HasSubstr("\"nN\" is not its unit"));
  EXPECT_THAT(refused("0,5nm", kLengthUnits), HasSubstr("write a decimal point, and no separator of thousands"));
  EXPECT_THAT(refused("5 mJ/m2", kStiffnessUnits), HasSubstr("one of the units N/m, mN/m"));
}

TEST(QuantityText, ReadsBlanksAndSignsOfTypesetText) {
  // no-break, narrow no-break, thin and ideographic space, as copied from a web page or a paper
  for (const std::string_view blank : {"\u00a0", "\u202f", "\u2009", "\u3000"}) {
    EXPECT_DOUBLE_EQ(parsed("20" + std::string(blank) + "nm", kLengthUnits), 2e-8);
    EXPECT_DOUBLE_EQ(parsed(std::string(blank) + "20 nm" + std::string(blank), kLengthUnits), 2e-8);
  }
  EXPECT_DOUBLE_EQ(parsed("\u22125 nm", kLengthUnits), -5e-9);  // minus
  EXPECT_DOUBLE_EQ(parsed("2e\u22128 m", kLengthUnits), 2e-8);
  EXPECT_THAT(refused("-\u22125 nm", kLengthUnits), HasSubstr("it does not begin with a number"));
}

// A decimal point in place of the comma of "1,000 nm" would make it 1 nm.
TEST(QuantityText, CallsNoSeparatorOfThousandsADecimalComma) {
  const std::string advice = "write a decimal point, and no separator of thousands";
  for (const std::string_view text :
       {"1,000nm", "1,000.5 nm", "1.000,5 nm", "1'000nm", "1_000 nm", "1 000 nm", "1\u00a0000 nm", "1\u2019000 nm"}) {
    EXPECT_THAT(refused(text, kLengthUnits), HasSubstr(advice)) << text;
  }
  EXPECT_THAT(refused("1 nm", kForceUnits), Not(HasSubstr(advice)));
}

TEST(QuantityText, QuotesWholeCharacters) {
  const std::string error = refused(std::string(39, 'a') + "\u00b5\u00b5", kLengthUnits);
  EXPECT_THAT(error, HasSubstr("\"" + std::string(39, 'a') + "...\""));
}

TEST(QuantityText, TakesInfinityOnlyWhereAllowedAndWithItsUnit) {
  EXPECT_TRUE(std::isinf(parsed("inf N/m", kStiffnessUnits, Infinity::Allowed)));
  EXPECT_THAT(refused("inf N/m", kStiffnessUnits), HasSubstr("it may not be infinite"));
  EXPECT_THAT(refused("inf", kStiffnessUnits, Infinity::Allowed), HasSubstr("it has no unit"));
  EXPECT_THAT(refused("nan N/m", kStiffnessUnits, Infinity::Allowed), HasSubstr("it is not a number"));
}

TEST(QuantityText, RefusesWhatIsNotOneQuantity) {
  constexpr std::array<std::string_view, 12> kBad{"",      " ",      "nm",     "five nm", "5 nm 6", "0x10nm",
                                                  "1,5nm", "--5 nm", "+-5 nm", "5 NM",    "1e999m", "1e-999m"};
  for (const std::string_view text : kBad) EXPECT_THAT(refused(text, kLengthUnits), HasSubstr("cannot read"));
}

TEST(QuantityText, KeepsItsMessagesOnOneShortLine) {
  const std::string error = refused("5\nnm\x1b[2J" + std::string(5000, 'x'), kLengthUnits);
  EXPECT_THAT(error, Not(HasSubstr("\n")));
  EXPECT_THAT(error, Not(HasSubstr("\x1b")));
  EXPECT_LT(error.size(), 300U);
}

TEST(QuantityText, IsTotalOverAllStrings) {
  constexpr std::string_view kAlphabet = "0123456789.+-einfa nmuJNz/^2\u00b5\n\u00a0\u2212";
  std::mt19937 random(20240501);
  std::uniform_int_distribution<std::size_t> length(0, 12);
  std::uniform_int_distribution<std::size_t> pick(0, kAlphabet.size() - 1);
  int values = 0;
  for (int i = 0; i < 200'000; ++i) {
    std::string text;
    for (std::size_t n = length(random); n > 0; --n) text += kAlphabet[pick(random)];
    const auto result = parse_quantity(text, kLengthUnits);
    ASSERT_NE(result.value.has_value(), !result.error.empty()) << text;
    if (result.value) {
      ++values;
      ASSERT_TRUE(isfinite(*result.value)) << text;
    }
  }
  EXPECT_GT(values, 100);
}

TEST(QuantityText, ShowsAFittingPrefix) {
  EXPECT_EQ(format_quantity(Length(1.39989368644e-8), kLengthUnits), "13.999 nm");
  EXPECT_EQ(format_quantity(Length(-5e-9), kLengthUnits), "-5 nm");
  EXPECT_EQ(format_quantity(Force(2.39752348708e-10), kForceUnits), "239.75 pN");
  EXPECT_EQ(format_quantity(Energy(2.45e-20), kEnergyUnits), "24.5 zJ");
  EXPECT_EQ(format_quantity(Stiffness(0.1), kStiffnessUnits), "100 mN/m");
  EXPECT_EQ(format_quantity(Stiffness(HUGE_VAL), kStiffnessUnits), "inf N/m");
  EXPECT_EQ(format_quantity(Length(), kLengthUnits), "0 m");
  EXPECT_EQ(format_quantity(Pressure(), kPressureUnits), "0 Pa");
  EXPECT_EQ(format_quantity(Frequency(), kFrequencyUnits), "0 Hz");
  EXPECT_EQ(format_quantity(Length(1e-15), kLengthUnits), "0.001 pm");
}

TEST(QuantityText, RoundsIntoTheNextPrefix) {
  EXPECT_EQ(format_quantity(Length(999.9e-9), kLengthUnits, 3), "1 um");
  EXPECT_EQ(format_quantity(Length(999.4e-9), kLengthUnits, 3), "999 nm");
}

TEST(QuantityText, ReadsBackWhatItShows) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> exponent(-14.0, 0.0);
  for (int i = 0; i < 10'000; ++i) {
    const Length length(std::pow(10.0, exponent(random)));
    const auto text = format_quantity(length, kLengthUnits, 17);
    EXPECT_NEAR(parsed(text, kLengthUnits) / length.si, 1.0, 1e-15) << text;
  }
}

TEST(QuantityText, DoesNotFollowTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  // without that locale, the default one is tested once more
  std::setlocale(LC_ALL, "de_DE.UTF-8");
  EXPECT_DOUBLE_EQ(parsed("0.5nm", kLengthUnits), 5e-10);
  EXPECT_EQ(format_quantity(Length(1.5e-9), kLengthUnits), "1.5 nm");
  std::setlocale(LC_ALL, before.c_str());
}

}  // namespace quantity_text_test
}  // namespace afm::physics
