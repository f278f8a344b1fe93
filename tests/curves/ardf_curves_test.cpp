// SPDX-License-Identifier: Apache-2.0
// Force maps of Asylum's .ardf, from files that are put together here as published readers describe them.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/whole_file.h"
#include "curves/curve_file.h"
#include "curves/curve_map.h"
#include "curves/curve_series.h"
#include "support/image_files.h"
#include "support/places.h"
#include "support/scratch_folder.h"

namespace afm::curves {
namespace ardf_curves_test {

using test::append_little;
using testing::Contains;
using testing::HasSubstr;

constexpr std::uint32_t kColumns = 3, kRows = 2, kCurves = kColumns * kRows;
constexpr std::uint32_t kExtend = 30, kDwell = 5, kRetract = 25, kPoints = kExtend + kDwell + kRetract;
constexpr double kSpring = 0.05, kStepM = 10e-9, kSlope = 0.25;
constexpr std::uint32_t kUnused = 1 - kPoints;  // beginning of a missing segment

struct Map {
  std::string note = "SpringConstant: 0.05\rInvOLS: 6e-08\rMicroscopeModel: Cypher\rDate: 2026-11-30\r";
  std::string segments = "Ext;Dwell;Ret;", deflection_unit = "m";
  std::uint32_t volumes = 1, lines = kRows;  // those that were measured
  double step_m = 1e-6;
};

// The stage's height towards the sample, and the deflection, which is pushed over the deepest ten points.
float height_at(std::uint32_t curve, std::uint32_t point) {
  const std::uint32_t down = point < kExtend ? point : point < kExtend + kDwell ? kExtend - 1 : kPoints - 1 - point;
  return static_cast<float>(1e-6 + 1e-9 * curve + kStepM * down);
}
float deflection_at(std::uint32_t curve, std::uint32_t point) {
  const double depth_m = static_cast<double>(height_at(curve, point)) - static_cast<double>(height_at(curve, 19));
  return static_cast<float>(depth_m > 0.0 ? kSlope * depth_m : 0.0);
}

class Writer {
 public:
  std::string bytes;
  std::vector<std::size_t> sections;  // places of the sections

  void put(std::string_view name, const std::string& contents) {
    sections.push_back(bytes.size());
    bytes += section(name, contents);
  }
  // Entries have a head each.
  void put_table(std::string_view name, const std::vector<std::pair<std::string, std::string>>& entries,
                 std::uint32_t stride, std::uint32_t unused = 0) {
    const auto count = static_cast<std::uint32_t>(entries.size()) + unused;
    std::string head;
    append_little(head, std::uint64_t{32} + std::uint64_t{count} * stride);
    append_little(head, count);
    append_little(head, stride);
    put(name, head);
    for (const auto& [entry, contents] : entries) put(entry, contents);
    bytes.append(std::size_t{unused} * stride, '\0');
  }
  static std::string section(std::string_view name, const std::string& contents) {
    std::string checked;
    append_little(checked, static_cast<std::uint32_t>(16 + contents.size()));
    checked.append(name).append(4, '\0') += contents;
    std::string whole;
    append_little(whole, checksum(checked));
    return whole + checked;
  }
  static std::uint32_t checksum(std::string_view checked) {
    return static_cast<std::uint32_t>(::crc32_z(0, reinterpret_cast<const Bytef*>(checked.data()), checked.size()));
  }
};

template <class T>
std::string number(T value) {
  std::string text;
  append_little(text, value);
  return text;
}
std::string word(std::string text) {
  text.resize(32, '\0');
  return text;
}

// Places in the file, known after a first assembly.
struct Places {
  std::uint64_t text = 0, volume = 0;
  std::vector<std::uint64_t> sets;
};

void put_curve(std::uint32_t curve, const Map& map, const Places& places, Writer& file) {
  const std::uint32_t line = curve / kColumns, point = curve % kColumns;
  const bool last = curve + 1 == map.lines * kColumns;
  const auto where = number(curve) + number(line) + number(point);
  const std::uint64_t next = last || places.sets.empty() ? 0 : places.sets[curve + 1];
  file.put("VSET", where + number(std::uint32_t{2}) + number(std::uint64_t{0}) + number(next));
  file.put("VNAM", where + word("Force"));
  for (std::uint32_t channel = 0; channel < 3; ++channel) {
    std::string data = where + number(kPoints) + number(channel) + number(std::uint32_t{0}) + number(kExtend) +
                       number(kExtend + kDwell) + number(kUnused) + number(std::uint32_t{0});
    for (std::uint32_t i = 0; i < kPoints; ++i) {
      append_little(data, channel == 0 ? 0.0F : channel == 1 ? deflection_at(curve, i) : height_at(curve, i));
    }
    file.put("VDAT", data);
  }
}

Writer put_together(const Map& map, const Places& places, Places& found) {
  Writer file;
  file.put("ARDF", "");
  std::vector<std::pair<std::string, std::string>> contents{{"IMAG", number(std::uint64_t{0})}};
  contents.resize(1 + map.volumes, {"VOLM", number(places.volume)});
  file.put_table("FTOC", contents, 24, 1);
  file.put_table("TTOC", {{"TOFF", number(std::uint64_t{0}) + number(places.text)}}, 32);
  found.text = file.bytes.size();
  file.put("TEXT", number(std::uint32_t{0}) + number(static_cast<std::uint32_t>(map.note.size())) + map.note + '\0');
  found.volume = file.bytes.size();
  file.put_table("VOLM", {{"NSET", number(std::uint64_t{kCurves})}}, 24);
  file.put_table("TTOC", {}, 32);
  const auto names = static_cast<std::uint64_t>(std::count(map.segments.begin(), map.segments.end(), ';'));
  file.put("VDEF", number(kColumns) + number(kRows) + std::string(24, '\0') + number(map.step_m) + number(map.step_m) +
                       number(1e-4) + word("m") + word("m") + word("s") + word(map.segments) + number(names));
  file.put("VCHN", word("Raw") + word("m"));
  file.put("VCHN", word("Defl") + word(map.deflection_unit));
  file.put("VCHN", word("ZSnsr") + word("m"));
  file.put("XDEF", std::string(80, '\0'));
  std::vector<std::pair<std::string, std::string>> lines;
  for (std::uint32_t line = 0; line < map.lines; ++line) {
    const std::uint64_t set = places.sets.empty() ? 0 : places.sets[line * kColumns];
    lines.emplace_back("VOFF", number(line * kColumns) + number(line) + number(std::uint64_t{0}) + number(set));
  }
  file.put_table("VTOC", lines, 40, kRows - map.lines);
  file.put("MLOV", "");
  for (std::uint32_t curve = 0; curve < map.lines * kColumns; ++curve) {
    found.sets.push_back(file.bytes.size());
    put_curve(curve, map, places, file);
  }
  return file;
}

Writer file_of(const Map& map) {
  Places places, again;
  put_together(map, {}, places);
  return put_together(map, places, again);
}

CurveReading here(std::size_t index) {
  return {.spring_constant = {}, .sensitivity_m_per_v = {}, .index = index, .confined = false};
}

RecordedCurve read(const Map& map, std::size_t index) {
  auto curve = parse_curve(file_of(map).bytes, "a.ardf", here(index));
  EXPECT_TRUE(curve.has_value()) << curve.error().message;
  return curve ? std::move(*curve) : RecordedCurve{std::vector<physics::CurvePoint>(kPoints), {}, {}};
}

std::string refusal(const std::string& bytes, const CurveReading& reading = {}) {
  const auto curve = parse_curve(bytes, "a.ardf", reading);
  return curve ? "accepted" : curve.error().message;
}

TEST(ArdfMap, HasACurveForEachPixelFromTheBottomLeft) {
  for (std::uint32_t index = 0; index < kCurves; ++index) {
    const RecordedCurve curve = read({}, index);
    ASSERT_EQ(curve.points.size(), kExtend + kRetract);
    for (std::uint32_t i = 0; i < curve.points.size(); ++i) {
      const std::uint32_t point = i < kExtend ? i : i + kDwell;
      EXPECT_EQ(curve.points[i].z.si, -static_cast<double>(height_at(index, point)));
      EXPECT_EQ(curve.points[i].force.si, kSpring * static_cast<double>(deflection_at(index, point)));
      EXPECT_EQ(curve.points[i].branch, i < kExtend ? physics::Branch::Approach : physics::Branch::Retract);
    }
    const auto& pixel = curve.metadata.pixel;
    ASSERT_TRUE(pixel);
    EXPECT_EQ(pixel->column, index % kColumns);
    EXPECT_EQ(pixel->row, index / kColumns);
    EXPECT_NEAR(pixel->grid.width_m, 3e-6, 1e-15);
    EXPECT_NEAR(pixel->grid.height_m, 2e-6, 1e-15);
    EXPECT_NEAR(curve.metadata.position->x_m, (static_cast<double>(pixel->column) - 1.0) * 1e-6, 1e-15);
    EXPECT_NEAR(curve.metadata.position->y_m, (static_cast<double>(pixel->row) - 0.5) * 1e-6, 1e-15);
    EXPECT_EQ(curve.metadata.instrument, "Cypher");
    EXPECT_EQ(curve.metadata.spring_constant->si, kSpring);
    EXPECT_THAT(curve.metadata.remarks,
                Contains("between approach and retract the tip rests: 5 points there are left out"));
  }
}

TEST(ArdfMap, IsAForceMap) {
  const support::ScratchFolder folder;
  const std::string path = folder.write("gel.ardf", file_of({}).bytes);
  ASSERT_EQ(curve_count(path).value(), kCurves);
  const auto map = CurveMap::load(path, [](std::size_t, std::size_t) { return true; });
  ASSERT_TRUE(map) << map.error().message;
  EXPECT_EQ(map->pixels_with_curve(), kCurves);
}

// Fast maps have two volumes, and curves without segments.
TEST(ArdfMap, WithoutSegmentsTurnsInTheMiddleAndIsTheWayThere) {
  Map fast;
  fast.segments = "";
  fast.volumes = 2;
  const RecordedCurve curve = read(fast, 4);
  ASSERT_EQ(curve.points.size(), kPoints);
  EXPECT_EQ(curve.points[kPoints / 2 - 1].branch, physics::Branch::Approach);
  EXPECT_EQ(curve.points[kPoints / 2].branch, physics::Branch::Retract);
  EXPECT_THAT(curve.metadata.remarks, Contains(HasSubstr("it has 2 force maps")));
}

TEST(ArdfMap, ThatWasStoppedHasTheCurvesThatWereMeasured) {
  const support::ScratchFolder folder;
  Map stopped;
  stopped.lines = 1;
  EXPECT_EQ(curve_count(folder.write("half.ardf", file_of(stopped).bytes)).value(), kColumns);
  EXPECT_EQ(read(stopped, 2).metadata.pixel->grid.rows, kRows);
  stopped.lines = 0;
  EXPECT_THAT(refusal(file_of(stopped).bytes), HasSubstr("no curve that was measured"));
}

TEST(ArdfMap, IsCalibratedByItsNoteOrItsReader) {
  Map bare;
  bare.note = "SpringConstant: NaN\r";
  EXPECT_THAT(refusal(file_of(bare).bytes), HasSubstr("no valid SpringConstant; give --spring-constant"));
  bare.deflection_unit = "V";
  CurveReading given = here(0);
  given.spring_constant = physics::Stiffness(0.1);
  EXPECT_THAT(refusal(file_of(bare).bytes, given), HasSubstr("no valid InvOLS; give --sensitivity"));
  given.sensitivity_m_per_v = 2.0;
  const auto curve = parse_curve(file_of(bare).bytes, "a.ardf", given);
  ASSERT_TRUE(curve) << curve.error().message;
  EXPECT_NEAR(curve->points[kExtend - 1].force.si, 0.1 * 2.0 * static_cast<double>(deflection_at(0, kExtend - 1)),
              1e-20);
}

TEST(ArdfMap, HasNoPixelsIfItsStepsAreUnknown) {
  Map placeless;
  placeless.step_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(read(placeless, 1).metadata.pixel);
}

TEST(ArdfMap, IsRefusedInOneLineIfItIsNone) {
  Map images;
  images.volumes = 0;
  EXPECT_THAT(refusal(file_of(images).bytes), HasSubstr("no force map: it holds images alone"));
  Map many;
  many.segments = "Ext;Ret;A;B;C;D;";
  EXPECT_THAT(refusal(file_of(many).bytes), HasSubstr("6 segments; at most 5 are read"));
  Map turned;
  turned.segments = "Ret;Dwell;Ext;";
  EXPECT_THAT(refusal(file_of(turned).bytes), HasSubstr("approach comes after its retract"));
  std::string damaged = file_of({}).bytes;
  damaged.back() = '\x7f';
  EXPECT_THAT(refusal(damaged, here(kCurves - 1)), HasSubstr("its section \"VDAT\" is damaged"));
}

TEST(ArdfMap, ThatIsCutHasTheCurvesThatAreThere) {
  const std::string whole = file_of({}).bytes;
  std::size_t most = 0;
  for (std::size_t size = 13; size < whole.size(); size += size < 2000 ? 1 : 7) {
    const std::string cut = whole.substr(0, size);
    std::size_t there = 0;
    while (there < kCurves && parse_curve(cut, "cut.ardf", here(there))) ++there;
    ASSERT_LT(there, kCurves) << size;
    ASSERT_GE(there, most) << size << ": more of the file has fewer curves";
    most = there;
    const auto next = parse_curve(cut, "cut.ardf", here(there));
    EXPECT_THAT(next.error().message, HasSubstr("it is cut short")) << size;
    EXPECT_THAT(next.error().message, HasSubstr("copy the file again from where it was saved"));
    if (there == 0) continue;
    const std::string said = fmt::format("it has {} of at most {} curves", there, kCurves);
    EXPECT_THAT(next.error().message, HasSubstr(said));
    EXPECT_THAT(parse_curve(cut, "cut.ardf", here(0))->metadata.remarks, Contains(HasSubstr(said)));
  }
  EXPECT_EQ(most, kCurves - 1);
}

// Numbers of any size in any place, with the right checksum.
TEST(ArdfMap, SurvivesAnyNumberOfASection) {
  const Writer file = file_of({});
  int accepted = 0;
  for (const std::size_t place : file.sections) {
    std::uint32_t size = 0;
    std::memcpy(&size, file.bytes.data() + place + 4, sizeof(size));
    for (std::size_t at = place + 4; at + 4 <= place + std::min<std::size_t>(size, 232); at += 4) {
      for (const std::uint32_t value : {0U, 1U, 16U, 0x7FFFFFFFU, 0xFFFFFFFFU, 0x7FC00000U}) {
        std::string bytes = file.bytes;
        std::memcpy(bytes.data() + at, &value, sizeof(value));
        const std::uint32_t sum = Writer::checksum(std::string_view(bytes).substr(place + 4, size - 4));
        std::memcpy(bytes.data() + place, &sum, sizeof(sum));
        for (const std::size_t index : {std::size_t{0}, std::size_t{kCurves - 1}}) {
          const auto curve = parse_curve(bytes, "odd.ardf", here(index));
          if (!curve) continue;
          ++accepted;
          for (const auto& point : curve->points) EXPECT_TRUE(isfinite(point.z) && isfinite(point.force));
          const auto& pixel = curve->metadata.pixel;
          EXPECT_TRUE(!pixel || (pixel->column < pixel->grid.columns && pixel->row < pixel->grid.rows));
        }
      }
    }
  }
  EXPECT_GT(accepted, 1000);
}

// A seed for the fuzzer.
TEST(ArdfMap, IsInTheCorpusOfTheFuzzer) {
  const auto seed = core::read_file(support::source("tests/fuzz/corpus/curve_files/map.ardf"));
  ASSERT_TRUE(seed) << seed.error().message;
  EXPECT_TRUE(*seed == file_of({}).bytes);
}

}  // namespace ardf_curves_test
}  // namespace afm::curves
