// SPDX-License-Identifier: Apache-2.0
// Each function of Nanonis' protocol that a client may call, with the bytes of its arguments and of its results.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "core/whole_file.h"
#include "instrument/nanonis_door.h"
#include "instrument/simulated_instrument.h"
#include "support/hex_report.h"
#include "support/places.h"

namespace afm::instrument {
namespace nanonis_functions_test {

struct Call {
  std::string_view name;
  std::string_view arguments;
  std::string_view results;  // all results, or the beginning and "..."
  std::size_t blank;         // number of zero bytes in place of the results of a refused call
};

// Calls in order, on a level sample: later calls see settings of earlier ones.
constexpr std::array kCalls{
    Call{"AutoApproach.Open", "", "", 0},
    Call{"AutoApproach.OnOffSet", "00 01", "", 0},
    Call{"AutoApproach.OnOffGet", "", "00 00", 2},
    Call{"ZCtrl.StatusGet", "", "00 02", 2},
    Call{"Bias.Set", "3f c0 00 00", "", 0},
    Call{"Bias.Get", "", "3f c0 00 00", 4},
    Call{"Current.Get", "", "00 00 00 00", 4},
    Call{"Signals.NamesGet", "", "00 00 07 8b 00 00 00 80 00 00 00 0b 43 75 72 72 65 6e 74 20 28 41 29 ...", 8},
    Call{"Signals.InSlotsGet", "", "00 00 00 5f 00 00 00 07 00 00 00 0b 43 75 72 72 65 6e 74 20 28 41 29 ...", 12},
    Call{"Signals.ValGet", "00 00 00 1e 00 00 00 01", "b1 9f 87 a9", 4},
    Call{"Signals.ValsGet", "00 00 00 02 00 00 00 18 00 00 00 1e 00 00 00 01", "00 00 00 02 3f c0 00 00 b1 9f 87 a9",
         4},
    Call{"ZCtrl.SetpntSet", "30 89 70 5f", "", 0},
    Call{"ZCtrl.SetpntGet", "", "30 89 70 5f", 4},
    Call{"ZCtrl.GainSet", "3f 00 00 00 3f 80 00 00 44 fa 00 00", "", 0},
    Call{"ZCtrl.GainGet", "", "3f 00 00 00 39 83 12 6f 44 fa 00 00", 12},
    Call{"ZCtrl.ZPosGet", "", "b1 9f 87 a9", 4},
    Call{"Scan.FrameSet", "00 00 00 00 00 00 00 00 33 00 00 00 32 80 00 00 41 f0 00 00", "", 0},
    Call{"Scan.FrameGet", "", "00 00 00 00 00 00 00 00 33 00 00 00 32 80 00 00 41 f0 00 00", 20},
    Call{"Scan.BufferSet", "00 00 00 01 00 00 00 1e 00 00 00 08 00 00 00 04", "", 0},
    Call{"Scan.BufferGet", "", "00 00 00 01 00 00 00 1e 00 00 00 08 00 00 00 04", 12},
    Call{"Scan.PropsSet", "00 00 00 01 00 00 00 02 00 00 00 01 00 00 00 01 61 00 00 00 02 62 63", "", 0},
    Call{"Scan.PropsGet", "", "00 00 00 01 00 00 00 00 00 00 00 00 00 00 00 01 61 00 00 00 02 62 63", 20},
    Call{"Scan.SpeedSet", "00 00 00 00 00 00 00 00 3f 00 00 00 3f 00 00 00 00 02 3f 80 00 00", "", 0},
    Call{"Scan.SpeedGet", "", "33 80 00 00 33 80 00 00 3f 00 00 00 3f 00 00 00 00 01 3f 80 00 00", 22},
    Call{"Scan.Action", "00 00 00 00 00 00", "", 0},
    Call{"Scan.StatusGet", "", "00 00 00 00", 4},
    Call{"Scan.WaitEndOfScan", "ff ff ff ff", "00 00 00 00 00 00 00 00", 8},
    Call{"Scan.FrameDataGrab", "00 00 00 1e 00 00 00 01", "00 00 00 05 5a 20 28 6d 29 00 00 00 04 00 00 00 08 ...", 16},
    Call{"FolMe.SpeedSet", "3e 80 00 00 00 00 00 01", "", 0},
    Call{"FolMe.SpeedGet", "", "3e 80 00 00 00 00 00 01", 8},
    Call{"FolMe.XYPosSet", "3e 30 00 00 00 00 00 00 be 30 00 00 00 00 00 00 00 00 00 01", "", 0},
    Call{"FolMe.XYPosGet", "00 00 00 01", "3e 30 00 00 00 00 00 00 be 30 00 00 00 00 00 00", 16},
    Call{"ZCtrl.OnOffGet", "", "00 00 00 01", 4},
    Call{"ZCtrl.OnOffSet", "00 00 00 00", "", 0},
    Call{"ZCtrl.ZPosSet", "35 80 00 00", "", 0},
    Call{"ZCtrl.Home", "", "", 0},
    Call{"ZCtrl.Withdraw", "00 00 00 01 ff ff ff ff", "", 0},
    Call{"Motor.StartMove", "00 00 00 04 00 05 00 00 00 00 00 00 00 00", "", 0},
};

std::string hex_of(std::string_view bytes) {
  std::string text;
  for (const char byte : bytes) text += fmt::format("{:02x} ", static_cast<unsigned char>(byte));
  if (!text.empty()) text.pop_back();
  return text;
}

std::string bytes_of(std::string_view hex) {
  const test::Report bytes = test::from_hex(std::string(hex));
  return {bytes.begin(), bytes.end()};
}

class NanonisFunctions : public testing::Test {
 protected:
  NanonisFunctions() {
    InstrumentSettings settings(instrument_.settings());
    settings.flat = true;
    EXPECT_TRUE(instrument_.change(settings));
  }

  // Answer after its header, whose name and size are checked.
  std::string body_of(std::string_view name, const std::string& arguments) {
    std::string header(name);
    header.resize(32, '\0');
    std::string answer;
    door_.answer(header + bytes_of(fmt::format("00 00 00 {:02x} 00 01 00 00", arguments.size())) + arguments,
                 [&](std::string_view bytes) {
                   answer += bytes;
                   return true;
                 });
    EXPECT_EQ(answer.substr(0, 32), header);
    const std::size_t size = answer.size() - 40;
    EXPECT_EQ(hex_of(answer.substr(32, 8)), fmt::format("00 00 {:02x} {:02x} 00 00 00 00", size >> 8U, size & 0xFFU));
    return answer.substr(40);
  }

  SimulatedInstrument instrument_ = std::move(SimulatedInstrument::create(support::source("assets"), 1)).value();
  NanonisDoor door_{instrument_};
};

TEST_F(NanonisFunctions, AnswerWithTheseBytes) {
  for (const Call& call : kCalls) {
    const std::string got = hex_of(body_of(call.name, bytes_of(call.arguments)));
    const bool whole = !call.results.ends_with("...");
    const std::string no_error = "00 00 00 00 00 00 00 00";
    if (whole) {
      EXPECT_EQ(got, std::string(call.results) + (call.results.empty() ? "" : " ") + no_error) << call.name;
    } else {
      const std::string_view begin = call.results.substr(0, call.results.size() - 4);
      EXPECT_EQ(got.substr(0, begin.size()), begin) << call.name;
      EXPECT_TRUE(got.ends_with(no_error)) << call.name;
    }
  }
}

// A controller answers a call that it refuses with the status 1 and a text, behind results of the usual size.
TEST_F(NanonisFunctions, RefuseArgumentsThatAreMissing) {
  const std::string why = "the body of the request ends too early";
  const std::string error = "00 00 00 01 00 00 00 26 " + hex_of(why);
  for (const Call& call : kCalls) {
    if (call.arguments.empty()) continue;
    std::string expected;
    for (std::size_t i = 0; i < call.blank; ++i) expected += "00 ";
    EXPECT_EQ(hex_of(body_of(call.name, "")), expected + error) << call.name;
  }
}

// Clients read what they have set: P, and T of I = P/T, which they compute I from.
TEST_F(NanonisFunctions, TellTheTimeConstantOfBothGains) {
  for (const auto& [gains, read] :
       {std::pair{"3e 80 00 00 3a 80 00 00 43 80 00 00", "3e 80 00 00 3a 80 00 00 43 80 00 00"},
        std::pair{"00 00 00 00 3a 80 00 00 43 80 00 00", "00 00 00 00 00 00 00 00 43 80 00 00"},
        std::pair{"00 00 00 00 00 00 00 00 00 00 00 00", "00 00 00 00 00 00 00 00 00 00 00 00"}}) {
    body_of("ZCtrl.GainSet", bytes_of(gains));
    EXPECT_EQ(hex_of(body_of("ZCtrl.GainGet", "").substr(0, 12)), read);
  }
}

// A list of channels that is kept although it has no signal would be read back by a client as numbers of pixels.
TEST_F(NanonisFunctions, RefuseChannelsThatAreNoSignals) {
  const std::string before = body_of("Scan.BufferGet", "");
  for (const auto& [channels, why] : {std::pair{"00 00 00 00", "0 signals instead of 1 to 128"},
                                      std::pair{"00 00 00 81", "129 signals instead of 1 to 128"},
                                      std::pair{"00 00 00 01 ff ff ff fb", "there is no signal -5"},
                                      std::pair{"00 00 00 01 00 00 00 80", "there is no signal 128"}}) {
    const std::string asked = bytes_of(channels) + bytes_of("00 00 00 40 00 00 00 40");
    EXPECT_EQ(body_of("Scan.BufferSet", asked).substr(8), why);
    EXPECT_EQ(body_of("Scan.BufferGet", ""), before) << channels;
  }
}

// Clients look for the error behind results of the usual size here as well.
TEST_F(NanonisFunctions, ThatAreMissingAreNamedBehindResultsOfTheirSize) {
  struct Missing {
    std::string_view name;
    std::size_t blank;
  };
  for (const Missing& missing :
       {Missing{"Piezo.TiltGet", 8}, Missing{"Signals.RangeGet", 8}, Missing{"TipShaper.PropsGet", 44},
        Missing{"SafeTip.OnOffGet", 2}, Missing{"Motor.PosGet", 24}, Missing{"Bias.RangeSet", 0}, Missing{"PosGet", 0},
        Missing{"Of.NoProtocol", 0}}) {
    const std::string body = body_of(missing.name, ""),
                      why = fmt::format("TouchAFM does not have the function {}", missing.name);
    std::string expected;
    for (std::size_t i = 0; i < missing.blank; ++i) expected += "00 ";
    EXPECT_EQ(hex_of(body), expected + fmt::format("00 00 00 01 00 00 00 {:02x} ", why.size()) + hex_of(why))
        << missing.name;
  }
}

TEST_F(NanonisFunctions, AreThoseOfThePage) {
  const std::string page = core::read_file(support::source("docs/serve.md")).value();
  const auto named = [&](std::string_view name) {
    const std::size_t dot = name.find('.');
    const std::size_t at = page.find("    " + std::string(name.substr(0, dot + 1)));
    return at != std::string::npos &&
           page.substr(at, page.find('\n', at) - at).find(name.substr(dot + 1)) != std::string::npos;
  };
  for (const Call& call : kCalls) {
    EXPECT_TRUE(named(call.name)) << call.name;
    EXPECT_EQ(std::count_if(kCalls.begin(), kCalls.end(), [&](const Call& other) { return other.name == call.name; }),
              1);
  }
  EXPECT_EQ(kCalls.size(), 38U);
}

}  // namespace nanonis_functions_test
}  // namespace afm::instrument
