// SPDX-License-Identifier: Apache-2.0
// Invariant: a missing or lost sound card logs a line
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "core/clock.h"
#include "core/whole_file.h"
#include "exhibit/sound/sound_output.h"
#include "support/scratch_folder.h"
#include "support/sound_analysis.h"

namespace afm::exhibit {
namespace sdl_output_test {

TEST(SoundOutput, PlaysThePitchOfAForceIntoSdlsDiskDriver) {
  const support::ScratchFolder folder;
  const std::string file = folder.file("sound.raw");
  ::setenv("SDL_AUDIODRIVER", "disk", 1);
  ::setenv("SDL_DISKAUDIOFILE", file.c_str(), 1);
  const core::MonotonicClock clock;
  SoundMixer mixer(Channels::Stereo);
  const Ear ear(0.5 * 0.239752e-9, 1.399894e-9);
  mixer.set_ear(0, ear);
  {
    auto output = SoundOutput::open(mixer, clock);
    ASSERT_TRUE(output.has_value()) << output.error().message << " (package libsdl2-2.0-0)";
    EXPECT_EQ((*output)->driver(), "disk");
    scene::TipSample sample;
    sample.material = 0;
    sample.servo_state = scene::ServoState::Running;
    sample.phase = physics::Phase::Attached;
    sample.tip.force_n = -1.399894e-9;
    // until it contains a second of sound
    for (int i = 0; i < 3000; ++i) {
      sample.time_ns = clock.now_ns();
      mixer.heard(sample);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      if (std::filesystem::exists(file) && std::filesystem::file_size(file) > 3 * 48'000 * 8 / 2) break;
    }
    EXPECT_TRUE((*output)->plays());
  }
  const auto samples = test::floats_of(core::read_file(file).value());
  const auto left = test::channel(samples, 0);
  ASSERT_GT(left.size(), 60'000U);
  const std::span<const double> end = std::span<const double>(left).last(16384);
  EXPECT_LT(std::abs(test::cents(test::pitch_hz(end, 48000.0), ear.hz(-1.399894e-9))), 2.0);
  EXPECT_GT(test::rms(end), 2.0 * test::rms(std::span<const double>(test::channel(samples, 1)).last(16384)))
      << "a pull is on the left";
}

TEST(SoundOutput, WithoutACardIsOneLine) {
  ::setenv("SDL_AUDIODRIVER", "no-such-driver", 1);
  const core::MonotonicClock clock;
  SoundMixer mixer(Channels::Stereo);
  const auto output = SoundOutput::open(mixer, clock);
  ASSERT_FALSE(output.has_value());
  EXPECT_EQ(output.error().category, core::ErrorCategory::DeviceMissing);
  EXPECT_THAT(output.error().message, testing::StartsWith("no sound: SDL says: "));
  EXPECT_EQ(output.error().message.find('\n'), std::string::npos);
}

}  // namespace sdl_output_test
}  // namespace afm::exhibit
