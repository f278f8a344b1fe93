// SPDX-License-Identifier: Apache-2.0
// Invariant: a client of Nanonis' protocol gets the bytes that the protocol prescribes, or an error text, never silence
#include "instrument/nanonis_door.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "instrument/simulated_instrument.h"
#include "nanonis_bytes.h"
#include "support/places.h"

namespace afm::instrument {
namespace nanonis_door_test {

using testing::HasSubstr;

std::string request(std::string name, const NanonisWriter& body = {}, bool wanted = true) {
  name.resize(32, '\0');
  NanonisWriter rest;
  rest.add_count(body.bytes().size())
      .add(std::uint16_t{wanted ? std::uint16_t{1} : std::uint16_t{0}})
      .add(std::uint16_t{0});
  return name + rest.bytes() + body.bytes();
}

class NanonisDoorTest : public testing::Test {
 protected:
  std::string bytes_for(const std::string& asked) {
    std::string bytes;
    EXPECT_EQ(door_.request_size(asked), asked.size());
    door_.answer(asked, [&](std::string_view sent) {
      bytes += sent;
      return true;
    });
    return bytes;
  }
  // The results, after a check of header and error.
  std::string results_of(const std::string& name, const NanonisWriter& body = {}) {
    const std::string bytes = bytes_for(request(name, body));
    EXPECT_EQ(bytes.substr(0, name.size()), name);
    EXPECT_EQ(NanonisReader(std::string_view(bytes).substr(32)).read<std::uint32_t>(), bytes.size() - 40);
    EXPECT_EQ(bytes.substr(bytes.size() - 8), std::string(8, '\0')) << name << ": " << bytes.substr(40);
    return bytes.substr(40, bytes.size() - 48);
  }
  std::string error_of(const std::string& name, const NanonisWriter& body = {}, std::size_t blank = 0) {
    const std::string bytes = bytes_for(request(name, body));
    NanonisReader in(std::string_view(bytes).substr(40 + blank));
    EXPECT_EQ(in.read<std::uint32_t>(), 1U) << name;
    return std::string(in.text());
  }
  void start_scan(std::uint32_t upwards = 0) {
    results_of("Scan.Action", NanonisWriter().add(std::uint16_t{0}).add(upwards));
  }
  std::vector<float> grab(std::int32_t channel, bool forward) {
    const std::string results =
        results_of("Scan.FrameDataGrab", NanonisWriter().add(channel).add(std::uint32_t{forward ? 1U : 0U}));
    NanonisReader in(results);
    const std::size_t name = in.text().size();
    const auto rows = in.read<std::int32_t>(), columns = in.read<std::int32_t>();
    std::vector<float> values;
    for (std::int32_t i = 0; i < rows * columns; ++i) values.push_back(in.read<float>());
    in.read<std::uint32_t>();
    EXPECT_EQ(results.size(), 4 + name + 4 + 4 + sizeof(float) * values.size() + 4);
    return values;
  }

  SimulatedInstrument instrument_ = std::move(SimulatedInstrument::create(support::source("assets"), 1)).value();
  NanonisDoor door_{instrument_};
};

// case S01: a request without arguments has 40 bytes, the answer's body 12
TEST_F(NanonisDoorTest, HasTheBytesOfTheProtocol) {
  results_of("Bias.Set", NanonisWriter().add(1.5F));
  const std::string asked = request("Bias.Get");
  EXPECT_EQ(asked.size(), 40U);
  const std::string bytes = bytes_for(asked);
  std::string expected = std::string("Bias.Get") + std::string(24, '\0');
  expected += std::string("\0\0\0\x0c\0\0\0\0", 8);             // size of the body, unused
  expected += std::string("\x3f\xc0\0\0\0\0\0\0\0\0\0\0", 12);  // 1.5, no error, no text
  EXPECT_EQ(bytes, expected);
}

TEST_F(NanonisDoorTest, WaitsForAWholeRequest) {
  const std::string whole = request("Bias.Set", NanonisWriter().add(1.0F)) + request("Bias.Get");
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const auto found = door_.request_size(std::string_view(whole).substr(0, size));
    EXPECT_EQ(found.has_value(), size >= 44) << size;
    EXPECT_EQ(found.value_or(44U), 44U);
  }
}

TEST_F(NanonisDoorTest, DoesNotAnswerWhereNoAnswerIsWanted) {
  EXPECT_EQ(bytes_for(request("Bias.Set", NanonisWriter().add(2.0F), false)), "");
  EXPECT_EQ(NanonisReader(results_of("Bias.Get")).read<float>(), 2.0F);
}

// case S03
TEST_F(NanonisDoorTest, ScansAFlatSample) {
  InstrumentSettings settings(instrument_.settings());
  settings.flat = true;
  ASSERT_TRUE(instrument_.change(settings));
  instrument_.approach(NanonisDoor::kApproachSpeedM);
  results_of("Scan.FrameSet", NanonisWriter().add(0.0F).add(0.0F).add(30e-9F).add(30e-9F).add(0.0F));
  results_of("Scan.BufferSet",
             NanonisWriter().add_count(1).add(std::int32_t{30}).add(std::int32_t{64}).add(std::int32_t{64}));
  start_scan();
  const std::string waited = results_of("Scan.WaitEndOfScan", NanonisWriter().add(std::int32_t{-1}));
  EXPECT_EQ(waited, std::string(8, '\0')) << "in time, and without a file";
  const std::vector<float> heights = grab(30, true);
  ASSERT_EQ(heights.size(), 64U * 64U);
  for (const float height_m : heights) ASSERT_NEAR(height_m, 0.0F, 1e-12F);
}

TEST_F(NanonisDoorTest, ShowsTheImageOfTheInstrument) {
  instrument_.approach(NanonisDoor::kApproachSpeedM);
  results_of("Scan.FrameSet", NanonisWriter().add(5e-9F).add(-5e-9F).add(30e-9F).add(15e-9F).add(15.0F));
  results_of("Scan.BufferSet",
             NanonisWriter().add_count(1).add(std::int32_t{30}).add(std::int32_t{32}).add(std::int32_t{8}));
  start_scan(1);
  EXPECT_EQ(grab(30, true).size(), 256U);
  EXPECT_EQ(grab(1, false).size(), 256U);
  EXPECT_EQ(grab(2, true).size(), 256U);
  const std::string frame_bytes = results_of("Scan.FrameGet");
  NanonisReader frame(frame_bytes);
  EXPECT_FLOAT_EQ(frame.read<float>(), 5e-9F);
  EXPECT_FLOAT_EQ(frame.read<float>(), -5e-9F);
  EXPECT_FLOAT_EQ(frame.read<float>(), 30e-9F);
  EXPECT_FLOAT_EQ(frame.read<float>(), 15e-9F);
  EXPECT_FLOAT_EQ(frame.read<float>(), 15.0F);
}

// A tip that was moved to a place of the image is not its middle.
TEST_F(NanonisDoorTest, TakesTheImageOfTheFrameWhereverTheTipIs) {
  InstrumentSettings settings(instrument_.settings());
  settings.scan.noise = physics::Length();
  ASSERT_TRUE(instrument_.change(settings));
  instrument_.approach(NanonisDoor::kApproachSpeedM);
  results_of("Scan.FrameSet", NanonisWriter().add(2e-9F).add(1e-9F).add(20e-9F).add(20e-9F).add(0.0F));
  results_of("Scan.BufferSet",
             NanonisWriter().add_count(1).add(std::int32_t{30}).add(std::int32_t{8}).add(std::int32_t{8}));
  start_scan();
  const std::vector<float> before = grab(30, true);
  results_of("FolMe.XYPosSet", NanonisWriter().add(7e-9).add(-6e-9).add(std::uint32_t{1}));
  const std::string frame_bytes = results_of("Scan.FrameGet");
  EXPECT_FLOAT_EQ(NanonisReader(frame_bytes).read<float>(), 2e-9F);
  start_scan();
  const std::vector<float> after = grab(30, true);
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_NEAR(after.at(i), before[i], 1e-12F) << i;
  results_of("FolMe.XYPosSet", NanonisWriter().add(7e-9).add(-6e-9).add(std::uint32_t{1}));
  constexpr std::uint16_t kGoToCentre = 6;
  results_of("Scan.Action", NanonisWriter().add(kGoToCentre).add(0U));
  EXPECT_NEAR(instrument_.position().x_m, 2e-9, 1e-16);
  EXPECT_NEAR(instrument_.position().y_m, 1e-9, 1e-16);
}

// "positive angle means clockwise rotation"
TEST_F(NanonisDoorTest, TurnsTheFrameClockwise) {
  results_of("Scan.FrameSet", NanonisWriter().add(0.0F).add(0.0F).add(20e-9F).add(20e-9F).add(30.0F));
  EXPECT_NEAR(instrument_.settings().turn_rad, -std::numbers::pi / 6.0, 1e-9) << "counterclockwise";
}

TEST_F(NanonisDoorTest, KeepsTheSpeedOrTheTimeOfALine) {
  const auto speed_set = [](float speed, float time, std::uint16_t kept) {
    return NanonisWriter().add(speed).add(speed).add(time).add(time).add(kept).add(1.0F);
  };
  const auto frame_set = [](float width) {
    return NanonisWriter().add(0.0F).add(0.0F).add(width).add(width).add(0.0F);
  };
  const auto kept_now = [this] {
    const std::string bytes = results_of("Scan.SpeedGet");
    NanonisReader in(bytes);
    for (int i = 0; i < 4; ++i) in.read<float>();
    return in.read<std::uint16_t>();
  };
  results_of("Scan.FrameSet", frame_set(20e-9F));
  results_of("Scan.SpeedSet", speed_set(40e-9F, 0.0F, 1));
  EXPECT_EQ(kept_now(), 0) << "the speed";
  EXPECT_NEAR(instrument_.settings().scan.line_rate.si, 1.0, 1e-6);
  results_of("Scan.FrameSet", frame_set(40e-9F));
  EXPECT_NEAR(instrument_.settings().scan.line_rate.si, 0.5, 1e-6);
  results_of("Scan.SpeedSet", speed_set(20e-9F, 0.1F, 0));
  EXPECT_EQ(kept_now(), 0) << "no change";
  EXPECT_NEAR(instrument_.settings().scan.line_rate.si, 0.25, 1e-6);
  results_of("Scan.SpeedSet", speed_set(20e-9F, 0.1F, 2));
  EXPECT_EQ(kept_now(), 1) << "the time";
  results_of("Scan.FrameSet", frame_set(20e-9F));
  EXPECT_NEAR(instrument_.settings().scan.line_rate.si, 5.0, 1e-5);

  const auto follow_speed = [this] { return NanonisReader(results_of("FolMe.SpeedGet")).read<float>(); };
  EXPECT_FLOAT_EQ(follow_speed(), 200e-9F) << "that of the scan";
  results_of("FolMe.SpeedSet", NanonisWriter().add(3e-6F).add(1U));
  EXPECT_FLOAT_EQ(follow_speed(), 3e-6F);
}

TEST_F(NanonisDoorTest, ApproachesAndWithdraws) {
  EXPECT_THAT(error_of("Scan.Action", NanonisWriter().add(std::uint16_t{0}).add(std::uint32_t{0})),
              HasSubstr("approach"));
  results_of("AutoApproach.Open");
  results_of("AutoApproach.OnOffSet", NanonisWriter().add(std::uint16_t{1}));
  EXPECT_EQ(NanonisReader(results_of("AutoApproach.OnOffGet")).read<std::uint16_t>(), 0);
  EXPECT_TRUE(instrument_.truth().touching);
  EXPECT_EQ(NanonisReader(results_of("ZCtrl.StatusGet")).read<std::uint16_t>(), 2);
  results_of("ZCtrl.Withdraw", NanonisWriter().add(std::uint32_t{1}).add(std::int32_t{-1}));
  EXPECT_FALSE(instrument_.position().engaged);
  EXPECT_EQ(NanonisReader(results_of("ZCtrl.OnOffGet")).read<std::uint32_t>(), 0U);
}

// Calls of clients for a force curve: feedback off, heights one by one, and the signal of the force.
TEST_F(NanonisDoorTest, TakesAForceCurveHeightByHeight) {
  const auto force_at = [this](float z_m) {
    results_of("ZCtrl.ZPosSet", NanonisWriter().add(z_m));
    return NanonisReader(results_of("Signals.ValGet", NanonisWriter().add(std::int32_t{1}).add(1U))).read<float>();
  };
  EXPECT_THAT(error_of("ZCtrl.ZPosSet", NanonisWriter().add(0.0F)), HasSubstr("switch it off"));
  results_of("ZCtrl.OnOffSet", NanonisWriter().add(0U));
  // between both jumps of mica, at 2.4 and 14.4 nm
  const float pushed = force_at(-100e-9F), released = force_at(10e-9F), far = force_at(900e-9F),
              back = force_at(10e-9F);
  EXPECT_GT(pushed, 9e-9F);
  EXPECT_LT(released, -0.5e-9F) << "adhesion";
  EXPECT_NEAR(far, 0.0F, 1e-12F);
  EXPECT_GT(back, 0.1F * released) << "not in contact again";
  EXPECT_EQ(force_at(-100e-9F), pushed);
}

TEST_F(NanonisDoorTest, KeepsWhatIsSet) {
  results_of("ZCtrl.SetpntSet", NanonisWriter().add(1e-9F));
  EXPECT_FLOAT_EQ(NanonisReader(results_of("ZCtrl.SetpntGet")).read<float>(), 1e-9F);
  results_of("Scan.SpeedSet",
             NanonisWriter().add(0.0F).add(0.0F).add(0.05F).add(0.025F).add(std::uint16_t{2}).add(2.0F));
  EXPECT_NEAR(instrument_.settings().scan.line_rate.si, 10.0, 1e-5);
  results_of("FolMe.XYPosSet", NanonisWriter().add(3e-9).add(-4e-9).add(std::uint32_t{1}));
  const std::string at_bytes = results_of("FolMe.XYPosGet", NanonisWriter().add(std::uint32_t{1}));
  NanonisReader at(at_bytes);
  EXPECT_EQ(at.read<double>(), 3e-9);
  EXPECT_EQ(at.read<double>(), -4e-9);
}

// Set counts from 1, with 0 for no change; Get from 0.
TEST_F(NanonisDoorTest, KeepsThePropertiesOfAScan) {
  const auto set = [](std::uint32_t continuous, std::uint32_t bouncing, std::uint32_t autosave) {
    return NanonisWriter().add(continuous).add(bouncing).add(autosave).add_text("series").add_text("words");
  };
  const auto expect = [this](std::uint32_t continuous, std::uint32_t bouncing, std::uint32_t autosave) {
    const std::string bytes = results_of("Scan.PropsGet");
    NanonisReader in(bytes);
    EXPECT_EQ(in.read<std::uint32_t>(), continuous);
    EXPECT_EQ(in.read<std::uint32_t>(), bouncing);
    EXPECT_EQ(in.read<std::uint32_t>(), autosave);
    const std::string series(in.text());
    return series + " " + std::string(in.text());
  };
  expect(0, 0, 2);
  results_of("Scan.PropsSet", set(1, 2, 1));
  EXPECT_EQ(expect(1, 0, 0), "series words");
  results_of("Scan.PropsSet", set(0, 1, 0));
  expect(1, 1, 0);
  results_of("Scan.PropsSet", set(2, 0, 3));
  expect(0, 1, 2);
  EXPECT_THAT(error_of("Scan.PropsSet", set(3, 0, 0)), HasSubstr("choice: 3 is not within 0 to 2"));
  // clients of the protocol of 2024 send the names of modules behind them
  results_of("Scan.PropsSet", set(1, 0, 0).add_count(8).add_count(1).add_text("Scan"));
  expect(1, 1, 2);
}

TEST_F(NanonisDoorTest, NamesItsSignals) {
  const std::string names_bytes = results_of("Signals.NamesGet");
  NanonisReader names(names_bytes);
  names.read<std::int32_t>();
  ASSERT_EQ(names.read<std::int32_t>(), 128);
  std::vector<std::string> all;
  std::size_t size = 8;
  for (int i = 0; i < 128; ++i) {
    all.emplace_back(names.text());
    size += 4 + all.back().size();
  }
  EXPECT_EQ(names_bytes.size(), size);
  EXPECT_EQ(all[30], "Z (m)");
  const std::string slots_bytes = results_of("Signals.InSlotsGet");
  NanonisReader slots(slots_bytes);
  slots.read<std::int32_t>();
  EXPECT_EQ(slots.read<std::int32_t>(), 7);
}

TEST_F(NanonisDoorTest, AnswersWithAnErrorWhereClientsLookForIt) {
  EXPECT_THAT(error_of("Osci1T.Run"), HasSubstr("does not have the function Osci1T.Run"));
  EXPECT_THAT(error_of("Signals.ValGet", NanonisWriter().add(std::int32_t{500}).add(std::uint32_t{0}), 4),
              HasSubstr("no signal 500"));
  EXPECT_THAT(error_of("Bias.Set"), HasSubstr("ends too early"));
  EXPECT_THAT(error_of("Bias.Set", NanonisWriter().add(1e9F)), HasSubstr("bias"));
  EXPECT_THAT(error_of("Scan.FrameDataGrab", NanonisWriter().add(std::int32_t{30}).add(std::uint32_t{1}), 16),
              HasSubstr("no image"));
  EXPECT_THAT(error_of("Scan.PropsSet", NanonisWriter().add(0U).add(0U).add(0U).add(std::int32_t{-5})),
              HasSubstr("negative"));
  EXPECT_THAT(error_of("Scan.BufferSet", NanonisWriter().add_count(1).add(30).add(std::int32_t{1 << 30}).add(1)),
              HasSubstr("pixels"));
}

}  // namespace nanonis_door_test
}  // namespace afm::instrument
