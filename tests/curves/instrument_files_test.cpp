// SPDX-License-Identifier: Apache-2.0
// The instruments' own binary formats, from files that are put together here as JPK's and Asylum Research's are.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <string>

#include "curves/curve_file.h"
#include "support/archives/stored_zip.h"

namespace afm::curves {
namespace instrument_files_test {

using testing::HasSubstr;

std::string error_of(std::string_view bytes, const CurveReading& reading = {}) {
  const auto curve = parse_curve(bytes, "curve.x", reading);
  if (curve) return "accepted";
  EXPECT_EQ(curve.error().category, core::ErrorCategory::BadInputFile);
  return curve.error().message;
}

// Read in this process, where a sanitizer sees each byte: for many bytes, a child each would take a minute.
std::string error_here(std::string_view bytes) {
  CurveReading here;
  here.confined = false;
  return error_of(bytes, here);
}

std::string big_endian_shorts(const std::vector<int>& values) {
  std::string bytes;
  for (const int value : values) {
    bytes.push_back(static_cast<char>(value >> 8));
    bytes.push_back(static_cast<char>(value));
  }
  return bytes;
}

constexpr double kSensitivity = 70e-9, kSpringConstant = 0.04;

// volts -> metres -> newtons; volts = 0.0003 n - 0.007
std::string deflection_properties(bool calibrated) {
  const std::string set = "channel.vDeflection.conversion-set.conversion";
  return fmt::format(
      "channel.vDeflection.data.encoder.type=signedshort\n"
      "channel.vDeflection.data.encoder.scaling.offset=-0.007\n"
      "channel.vDeflection.data.encoder.scaling.multiplier=3.0E-4\n"
      "channel.vDeflection.conversion-set.conversions.base=volts\n"
      "{0}.distance.defined={1}\n{0}.distance.base-calibration-slot=volts\n"
      "{0}.distance.scaling.offset=0.0\n{0}.distance.scaling.multiplier={2}\n"
      "{0}.force.defined={1}\n{0}.force.base-calibration-slot=distance\n"
      "{0}.force.scaling.offset=0.0\n{0}.force.scaling.multiplier={3}\n",
      set, calibrated, kSensitivity, kSpringConstant);
}

// The height's description is in shared-data, as in newer files.
std::map<std::string, std::string> jpk_entries(bool calibrated = true) {
  std::vector<int> down, up, force;
  for (int i = 0; i < 20; ++i) {
    down.push_back(-1000 * i);
    up.push_back(-20000 + 1000 * i);
    force.push_back(i < 10 ? 0 : 100 * (i - 10));
  }
  const auto segment = [&](const char* style) {
    return fmt::format(
        "# JPK\nforce-segment-header.settings.segment-settings.style={}\n"
        "force-segment-header.time-stamp=2016-03-31 17\\:51\\:14.543 +0200\n"
        "channel.measuredHeight.lcd-info.*=3\n{}",
        style, deflection_properties(calibrated));
  };
  return {
      {"header.properties", "force-scan-series.description.instrument=NanoWizard\n"},
      {"shared-data/header.properties",
       "lcd-info.3.encoder.type=signedshort-limited\nlcd-info.3.encoder.scaling.offset=0\n"
       "lcd-info.3.encoder.scaling.multiplier=1\nlcd-info.3.conversion-set.conversions.base=volts\n"
       "lcd-info.3.conversion-set.conversion.nominal.defined=true\n"
       "lcd-info.3.conversion-set.conversion.nominal.base-calibration-slot=volts\n"
       "lcd-info.3.conversion-set.conversion.nominal.scaling.offset=1.0E-4\n"
       "lcd-info.3.conversion-set.conversion.nominal.scaling.multiplier=1.0E-10\n"
       "lcd-info.30.encoder.type=signedlong\n"},
      {"segments/0/segment-header.properties", segment("extend")},
      {"segments/0/channels/measuredHeight.dat", big_endian_shorts(down)},
      {"segments/0/channels/vDeflection.dat", big_endian_shorts(force)},
      {"segments/1/segment-header.properties", segment("pause")},
      {"segments/2/segment-header.properties", segment("retract")},
      {"segments/2/channels/measuredHeight.dat", big_endian_shorts(up)},
      {"segments/2/channels/vDeflection.dat", big_endian_shorts(force)},
  };
}

TEST(JpkFile, IsDecodedThroughItsChainOfConversions) {
  const auto curve = parse_curve(test::stored_zip(jpk_entries()), "a.jpk-force");
  ASSERT_TRUE(curve.has_value()) << curve.error().message;
  ASSERT_EQ(curve->points.size(), 40U);
  EXPECT_DOUBLE_EQ(curve->points[1].z.si, 1e-4 - 1000 * 1e-10);
  EXPECT_DOUBLE_EQ(curve->points[15].force.si, (500 * 3e-4 - 0.007) * kSensitivity * kSpringConstant);
  EXPECT_EQ(curve->points[19].branch, physics::Branch::Approach);
  EXPECT_EQ(curve->points[20].branch, physics::Branch::Retract);
  EXPECT_DOUBLE_EQ(curve->metadata.spring_constant->si, kSpringConstant);
  EXPECT_DOUBLE_EQ(*curve->metadata.sensitivity_m_per_v, kSensitivity);
  EXPECT_EQ(curve->metadata.instrument, "NanoWizard");
  EXPECT_EQ(curve->metadata.date, "2016-03-31");
  EXPECT_EQ(curve->metadata.time, "17:51:14.543");
}

TEST(JpkFile, TakesACalibrationThatItDoesNotHold) {
  const std::string bytes = test::stored_zip(jpk_entries(false));
  EXPECT_THAT(error_of(bytes), HasSubstr("its lever is not calibrated; give --spring-constant and --sensitivity"));
  EXPECT_THAT(error_of(bytes, {.spring_constant = physics::Stiffness(0.1), .sensitivity_m_per_v = {}}),
              HasSubstr("give --sensitivity"));
  const auto curve =
      parse_curve(bytes, "a", {.spring_constant = physics::Stiffness(0.1), .sensitivity_m_per_v = 50e-9});
  ASSERT_TRUE(curve.has_value()) << curve.error().message;
  EXPECT_DOUBLE_EQ(curve->points[15].force.si, (500 * 3e-4 - 0.007) * 50e-9 * 0.1);
}

// Forces of zero would follow.
TEST(JpkFile, IsNotCalibratedByZeros) {
  for (const auto& [slot, option] :
       {std::pair("force", "give --spring-constant"), std::pair("distance", "give --sensitivity")}) {
    auto entries = jpk_entries();
    for (const char* segment : {"segments/0/segment-header.properties", "segments/1/segment-header.properties"}) {
      entries[segment] += fmt::format("channel.vDeflection.conversion-set.conversion.{}.scaling.multiplier=0\n", slot);
    }
    EXPECT_THAT(error_of(test::stored_zip(entries)), testing::EndsWith(option));
  }
}

TEST(JpkFile, RefusesWhatItDoesNotUnderstand) {
  const auto refusal = [](const std::string& entry, const std::string& text) {
    auto entries = jpk_entries();
    entries[entry] = text;
    return error_of(test::stored_zip(entries));
  };
  EXPECT_THAT(refusal("segments/0/channels/vDeflection.dat", "odd"), HasSubstr("\"vDeflection\" is cut short"));
  EXPECT_THAT(refusal("segments/0/channels/vDeflection.dat", "even"), HasSubstr("differ in length"));
  EXPECT_THAT(refusal("segments/0/segment-header.properties", ""), HasSubstr("whether it extends or retracts"));
  EXPECT_THAT(refusal("segments/0/segment-header.properties", jpk_entries()["segments/0/segment-header.properties"] +
                                                                  "channel.vDeflection.data.encoder.type=float\n"),
              HasSubstr("encoded as \"float\", which is not understood"));
  EXPECT_THAT(refusal("segments/0/segment-header.properties",
                      jpk_entries()["segments/0/segment-header.properties"] +
                          "channel.vDeflection.conversion-set.conversion.distance.base-calibration-slot=force\n"),
              HasSubstr("its conversions lead nowhere"));
  EXPECT_THAT(error_of(test::stored_zip({{"a.txt", "text"}})), HasSubstr("a zip archive, but not one of JPK's"));
  EXPECT_THAT(error_of(test::stored_zip({{"[Content_Types].xml", "<Types/>"}})),
              HasSubstr("it is a file of Excel or another Office program; save its table as .csv"));
}

// A corrected curve as written by JPK's own program, and a height that older instruments did not measure.
TEST(JpkFile, HasNumbersWithoutAnEncoderAndThoseOfARule) {
  auto entries = jpk_entries();
  const std::string stored = entries["segments/0/channels/vDeflection.dat"];
  std::string real;
  for (std::size_t i = 0; i < stored.size(); i += 2) {
    const auto bits = std::bit_cast<std::uint32_t>(i < 20 ? 0.0F : 0.25F);
    for (const unsigned shift : {24U, 16U, 8U, 0U}) real.push_back(static_cast<char>(bits >> shift));
  }
  for (const char* segment : {"segments/0/", "segments/2/"}) {
    std::string& properties = entries[std::string(segment) + "segment-header.properties"];
    const std::size_t encoder = properties.find("channel.vDeflection.data.encoder.type=");
    ASSERT_NE(encoder, std::string::npos);
    properties.erase(encoder, properties.find('\n', encoder) - encoder);
    properties +=
        "channel.vDeflection.data.type=float-data\nchannel.height.data.type=raster-data\n"
        "channel.height.data.num-points=20\nchannel.height.data.step=";
    properties +=
        segment[9] == '0' ? "-1e-8\nchannel.height.data.start=1e-6\n" : "1e-8\nchannel.height.data.start=8e-7\n";
    properties += "channel.height.conversion-set.conversions.base=calibrated\n";
    entries[std::string(segment) + "channels/vDeflection.dat"] = real;
    entries.erase(std::string(segment) + "channels/measuredHeight.dat");
  }
  const auto curve = parse_curve(test::stored_zip(entries), "a.jpk-force");
  ASSERT_TRUE(curve.has_value()) << curve.error().message;
  ASSERT_EQ(curve->points.size(), 40U);
  EXPECT_DOUBLE_EQ(curve->points[3].z.si, 1e-6 - 3e-8);
  EXPECT_DOUBLE_EQ(curve->points[23].z.si, 8e-7 + 3e-8);
  EXPECT_DOUBLE_EQ(curve->points[15].force.si, 0.25 * kSensitivity * kSpringConstant);
  entries["segments/0/segment-header.properties"] += "channel.height.data.num-points=-1\n";
  EXPECT_THAT(error_of(test::stored_zip(entries)), HasSubstr("\"height\" is said to be raster-data, but not of which"));
}

TEST(JpkFile, ThatBeginsInContactIsTheSame) {
  auto entries = jpk_entries();
  for (const char* of : {"segment-header.properties", "channels/measuredHeight.dat", "channels/vDeflection.dat"}) {
    std::swap(entries[std::string("segments/0/") + of], entries[std::string("segments/2/") + of]);
  }
  const auto usual = parse_curve(test::stored_zip(jpk_entries()), "a.jpk-force");
  const auto turned = parse_curve(test::stored_zip(entries), "a.jpk-force");
  ASSERT_TRUE(turned.has_value()) << turned.error().message;
  ASSERT_EQ(turned->points.size(), usual->points.size());
  for (std::size_t i = 0; i < usual->points.size(); ++i) {
    EXPECT_EQ(turned->points[i].z, usual->points[i].z);
    EXPECT_EQ(turned->points[i].branch, usual->points[i].branch);
  }
  EXPECT_THAT(turned->metadata.remarks, testing::Contains(HasSubstr("its first part leads away from the sample")));
}

// Contact times of cells and ligands are as long as those of creep and relaxation, and in the same segments.
TEST(JpkFile, LeavesOutARestOfAnyLengthAndSaysIt) {
  const auto with_pause = [](const char* seconds, const char* type) {
    auto entries = jpk_entries();
    entries["segments/0/segment-header.properties"] += "force-segment-header.duration=3.0\n";
    entries["segments/1/segment-header.properties"] += fmt::format(
        "force-segment-header.duration={}\nforce-segment-header.settings.segment-settings.type={}\n", seconds, type);
    return parse_curve(test::stored_zip(entries), "a.jpk-force");
  };
  const auto creep = with_pause("3.0", "constant-force-pause"),
             relaxation = with_pause("30.0", "constant-height-pause");
  ASSERT_TRUE(creep.has_value() && relaxation.has_value());
  EXPECT_EQ(creep->points.size(), 40U);
  EXPECT_THAT(creep->metadata.remarks, testing::ElementsAre(HasSubstr("rests at constant force for 3 s")));
  EXPECT_THAT(relaxation->metadata.remarks, testing::ElementsAre(HasSubstr("rests at constant height for 30 s")));
  EXPECT_TRUE(with_pause("0", "constant-force-pause")->metadata.remarks.empty());
}

// The height of jpk_entries() under another name, with the conversion that the instrument shows.
std::string with_height(const std::string& channel, const std::string& shown) {
  std::map<std::string, std::string> renamed;
  const auto rename = [&](std::string text) {
    constexpr std::string_view kOwn = "measuredHeight";
    for (auto at = text.find(kOwn); at != std::string::npos; at = text.find(kOwn))
      text.replace(at, kOwn.size(), channel);
    return text;
  };
  for (const auto& [name, content] : jpk_entries()) renamed[rename(name)] = rename(content);
  for (const char* segment : {"segments/0/segment-header.properties", "segments/2/segment-header.properties"}) {
    renamed[segment] += fmt::format("channels.list=vDeflection {}\n", channel);
  }
  renamed["shared-data/header.properties"] += fmt::format("lcd-info.3.conversion-set.conversions.default={}\n", shown);
  return test::stored_zip(renamed);
}

TEST(JpkFile, TakesTheStageOfACellHesionWithoutAnotherHeight) {
  for (const char* channel : {"cellhesion-height", "height", "combinedHeight"}) {
    const auto curve = parse_curve(with_height(channel, "nominal"), "a.jpk-force");
    ASSERT_TRUE(curve.has_value()) << curve.error().message;
    EXPECT_DOUBLE_EQ(curve->points[1].z.si, 1e-4 - 1000 * 1e-10);
    // volts are no height
    EXPECT_THAT(error_of(with_height(channel, "volts")), HasSubstr("how to convert to \"calibrated\""));
  }
  EXPECT_THAT(error_of(with_height("xPosition", "nominal")), HasSubstr("its channels are \"vDeflection xPosition\""));
}

TEST(JpkFile, RefusesEveryCutAndAnEntryThatClaimsToBeHuge) {
  const std::string bytes = test::stored_zip(jpk_entries());
  constexpr std::size_t kEnd = 22;  // size of the archive's last record
  for (std::size_t size = 4; size < bytes.size(); size += 97) {
    const std::string error = error_here(std::string_view(bytes).substr(0, size));
    EXPECT_THAT(error, HasSubstr("; copy the file again from where it was saved")) << size;
    if (size + kEnd > bytes.size()) continue;
    EXPECT_THAT(error, HasSubstr("it is cut short: its zip archive has no end")) << size;
  }
  EXPECT_THAT(error_of(test::stored_zip(jpk_entries(), 0xF0000000U)), HasSubstr("in its archive is"));
}

// Version 5, three channels of floats.
class IgorWave {
 public:
  explicit IgorWave(std::size_t rows) : rows_(rows), bytes_(384 + rows * 3 * sizeof(float), '\0') {
    put<std::int16_t>(0, 5);
    put<std::int32_t>(4, static_cast<std::int32_t>(320 + rows * 3 * sizeof(float)));
    put<std::int16_t>(80, 2);
    put<std::int32_t>(132, static_cast<std::int32_t>(rows));
    put<std::int32_t>(136, 3);
    const std::string note =
        "ImagingMode:Contact\rSpringConstant: 1.1841\rInvOLS: 4.499e-08\rMicroscopeModel:MFP3D\rDate:2020-02-05\r";
    put<std::int32_t>(12, static_cast<std::int32_t>(note.size()));
    put<std::int32_t>(40, 4 * 32);
    bytes_ += note;
    for (const char* label : {"", "Raw", "Defl", "ZSnsr"})
      bytes_ += std::string(label) + std::string(32 - std::strlen(label), '\0');
  }

  template <class T>
  IgorWave& put(std::size_t offset, T value) {
    std::memcpy(bytes_.data() + offset, &value, sizeof(T));
    return *this;
  }

  IgorWave& set(std::size_t row, float deflection, float sensor) {
    put(384 + (rows_ + row) * sizeof(float), deflection);
    return put(384 + (2 * rows_ + row) * sizeof(float), sensor);
  }

  std::string bytes() {
    put<std::uint16_t>(2, 0);
    std::uint16_t sum = 0;
    for (std::size_t i = 0; i < 384; i += 2) {
      std::uint16_t word = 0;
      std::memcpy(&word, bytes_.data() + i, sizeof(word));
      sum = static_cast<std::uint16_t>(sum + word);
    }
    return put<std::uint16_t>(2, static_cast<std::uint16_t>(-sum)).bytes_;
  }

 private:
  std::size_t rows_;
  std::string bytes_;
};

IgorWave igor_cycle() {
  IgorWave wave(41);
  for (std::size_t i = 0; i < 40; ++i) {
    const float depth = static_cast<float>(i < 20 ? i : 39 - i) * 1e-9F;
    wave.set(i, 0.5F * depth, depth + static_cast<float>(i == 19) * 1e-10F);
  }
  return wave.set(40, std::numeric_limits<float>::quiet_NaN(), 0.0F);
}

TEST(IgorFile, IsTurnedAtItsDeepestPointAndScaledByItsNote) {
  const auto curve = parse_curve(igor_cycle().bytes(), "a.ibw");
  ASSERT_TRUE(curve.has_value()) << curve.error().message;
  ASSERT_EQ(curve->points.size(), 40U);  // without the NaN
  EXPECT_EQ(curve->points[19].branch, physics::Branch::Approach);
  EXPECT_EQ(curve->points[20].branch, physics::Branch::Retract);
  EXPECT_NEAR(curve->points[10].z.si / -10e-9, 1.0, 1e-6);
  EXPECT_NEAR(curve->points[10].force.si / (5e-9 * 1.1841), 1.0, 1e-6);
  EXPECT_EQ(curve->metadata.instrument, "MFP3D");
  EXPECT_EQ(curve->metadata.date, "2020-02-05");
  EXPECT_DOUBLE_EQ(*curve->metadata.sensitivity_m_per_v, 4.499e-08);
}

TEST(IgorFile, SaysThatPointsWithinItWereNotRecorded) {
  EXPECT_THAT(parse_curve(igor_cycle().bytes(), "a.ibw")->metadata.remarks, testing::IsEmpty()) << "filled up";
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  const auto gap = parse_curve(igor_cycle().set(5, kNaN, 0.0F).set(6, 0.0F, kNaN).bytes(), "a.ibw");
  ASSERT_TRUE(gap.has_value());
  EXPECT_EQ(gap->points.size(), 38U);
  EXPECT_THAT(gap->metadata.remarks, testing::Contains(HasSubstr("2 of its 40 points were not recorded")));
}

// Asylum's own additions contain no number of the curve, but a file without its end was not copied whole.
TEST(IgorFile, RefusesATrailerThatIsCut) {
  const std::string whole = igor_cycle().bytes() + "ForceDist:5e-06;IsForce:1; 0292 Force";
  EXPECT_TRUE(parse_curve(whole, "a.ibw").has_value());
  for (const std::size_t missing : {5U, 7U, 20U}) {
    EXPECT_THAT(error_of(std::string_view(whole).substr(0, whole.size() - missing)), HasSubstr("it is cut short"))
        << missing;
  }
}

TEST(IgorFile, RefusesOtherVersionsDamageAndEveryCut) {
  const std::string bytes = igor_cycle().bytes();
  for (std::size_t size = 2; size < bytes.size(); size += 31) {
    EXPECT_THAT(error_here(std::string_view(bytes).substr(0, size)), HasSubstr("cannot read the curve"));
  }
  EXPECT_THAT(error_of(igor_cycle().put<std::int16_t>(0, 2).bytes()),
              HasSubstr("an Igor wave of version 2, which holds one row"));
  std::string damaged = bytes;
  damaged[100] = 'x';
  EXPECT_THAT(error_of(damaged), HasSubstr("the checksum of its header is wrong"));
  EXPECT_THAT(error_of(igor_cycle().put<std::int32_t>(132, 1 << 30).bytes()), HasSubstr("cut short"));
  EXPECT_THAT(error_of(igor_cycle().put<std::int32_t>(12, -1).bytes()), HasSubstr("negative"));
  EXPECT_THAT(error_of(igor_cycle().put<std::int32_t>(140, 7).bytes()), HasSubstr("not a table of channels"));
  EXPECT_THAT(error_of(igor_cycle().put<std::int16_t>(80, 16).bytes()), HasSubstr("neither 32-bit nor 64-bit"));
  EXPECT_THAT(error_of(igor_cycle().put<std::int32_t>(40, 0).bytes()),
              HasSubstr("not a table of channels with labels"));
}

}  // namespace instrument_files_test
}  // namespace afm::curves
