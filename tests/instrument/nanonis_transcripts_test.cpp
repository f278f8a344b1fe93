// SPDX-License-Identifier: Apache-2.0
// Programs of others, as they were released, spoke with `touchafm serve --nanonis`; tests/data/nanonis has what they
// sent and what they got. None of their code is here.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "instrument/nanonis_door.h"
#include "instrument/simulated_instrument.h"
#include "nanonis_bytes.h"
#include "support/places.h"

namespace afm::instrument {
namespace nanonis_transcripts_test {

struct Exchange {
  std::string asked, answered;
};

std::string bytes_of(const std::string& digits) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2) {
    bytes += static_cast<char>(std::stoi(digits.substr(i, 2), nullptr, 16));
  }
  return bytes;
}

// Lines that begin with "> " for the client and "< " for the microscope; others are remarks.
std::vector<Exchange> exchanges_in(const std::string& file) {
  std::ifstream lines(support::source("tests/data/nanonis/" + file));
  std::vector<Exchange> all;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("> ")) all.push_back({bytes_of(line.substr(2)), ""});
    if (line.starts_with("< ")) all.back().answered = bytes_of(line.substr(2));
  }
  return all;
}

std::vector<float> numbers_in(std::string_view bytes) {
  NanonisReader in(bytes);
  std::vector<float> numbers;
  for (std::size_t i = 0; i < bytes.size() / sizeof(float); ++i) numbers.push_back(in.read<float>());
  return numbers;
}

// The bytes of an answer, but for the last bits of an image's heights.
void expect_answer(const std::string& name, const std::string& got, const std::string& recorded) {
  constexpr std::size_t kHeader = 40, kEnd = 12;
  ASSERT_EQ(got.size(), recorded.size()) << name;
  if (!name.starts_with("Scan.FrameDataGrab")) {
    EXPECT_EQ(got, recorded) << name;
    return;
  }
  const auto size = NanonisReader(std::string_view(recorded).substr(kHeader)).read<std::int32_t>();
  const std::size_t begin = kHeader + 4 + static_cast<std::size_t>(size) + 8, length = got.size() - kEnd - begin;
  EXPECT_EQ(got.substr(0, begin), recorded.substr(0, begin)) << name;
  EXPECT_EQ(got.substr(begin + length), recorded.substr(begin + length)) << name;
  const std::vector<float> heights = numbers_in(std::string_view(got).substr(begin, length)),
                           before = numbers_in(std::string_view(recorded).substr(begin, length));
  for (std::size_t i = 0; i < heights.size(); ++i) ASSERT_NEAR(heights[i], before[i], 1e-13F) << i;
}

TEST(NanonisTranscripts, AreAnsweredAsTheyWere) {
  for (const auto& [file, fewest] : {std::pair("nanonisTCP.txt", 20U), std::pair("nanonis_spm.txt", 30U)}) {
    auto instrument = std::move(SimulatedInstrument::create(support::source("assets"), 1)).value();
    NanonisDoor door(instrument);
    instrument.approach(NanonisDoor::kApproachSpeedM);
    const std::vector<Exchange> exchanges = exchanges_in(file);
    EXPECT_GT(exchanges.size(), fewest) << file;
    for (const Exchange& exchange : exchanges) {
      std::string got;
      ASSERT_EQ(door.request_size(exchange.asked), exchange.asked.size()) << file;
      door.answer(exchange.asked, [&](std::string_view sent) {
        got += sent;
        return true;
      });
      expect_answer(exchange.asked.substr(0, exchange.asked.find('\0')), got, exchange.answered);
    }
  }
}

}  // namespace nanonis_transcripts_test
}  // namespace afm::instrument
