// SPDX-License-Identifier: Apache-2.0
// Invariant: speech never waits for its program, which is ended when it hangs; the newest text wins
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include "core/clock.h"
#include "core/whole_file.h"
#include "exhibit/sound/sound_mixer.h"
#include "exhibit/sound/speaker.h"
#include "exhibit/sound/speech_program.h"
#include "exhibit/sound/wav_file.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"

// Real child processes: espeak-ng, and scripts that behave badly.
namespace afm::exhibit {
namespace speech_test {

using std::chrono::milliseconds;
using ::testing::HasSubstr;
using Voice = SpeechProgram::Voice;

constexpr const char* kEspeak = "/usr/bin/espeak-ng";
constexpr const char* kSentence = "The tip snapped to contact. Zero point two four nanonewtons.";
const auto never = [] { return false; };

SpeechProgram script(const support::ScratchFolder& folder, const std::string& lines, Voice voice = Voice::Piped) {
  const std::string path = folder.write("speak", "#!/bin/sh\n" + lines + "\n");
  ::chmod(path.c_str(), 0755);
  return {path, "en", voice};
}

TEST(SpeechChild, OfEspeakGivesTheSameBytesEveryTime) {  // D17
  ASSERT_TRUE(std::filesystem::exists(kEspeak)) << "install the package espeak-ng";
  const SpeechProgram espeak{kEspeak, "en", Voice::Piped};
  SpeechChild child;
  const auto once = child.run(espeak, kSentence, never);
  ASSERT_TRUE(once.has_value()) << once.error().message;
  EXPECT_EQ(*once, child.run(espeak, kSentence, never).value());
  const auto wav = parse_mono_wav(*once);
  ASSERT_TRUE(wav.has_value());
  EXPECT_EQ(wav->rate_hz, 22050);
  const auto version = support::run_program(std::string(kEspeak) + " --version");
  if (version.out.find(" 1.51 ") == std::string::npos) return;
  EXPECT_EQ(wav->samples.size(), 92191U);
  EXPECT_NEAR(10.0 / (static_cast<double>(wav->samples.size()) / wav->rate_hz), 2.391773447, 1e-3);  // D18
  // the program's own file, whose length it knows
  const support::ScratchFolder folder;
  const auto direct =
      support::run_program(std::string(kEspeak) + " -v en -w " + folder.file("d.wav") + " \"" + kSentence + "\"");
  ASSERT_EQ(direct.exit_code, 0) << direct.err;
  EXPECT_EQ(parse_mono_wav(core::read_file(folder.file("d.wav")).value())->samples, wav->samples);
  const auto sum = support::run_program("md5sum " + folder.file("d.wav"));
  EXPECT_THAT(sum.out, HasSubstr("7ad9fc58f35528f763514a6db27d5421"));
}

TEST(SpeechChild, SpeaksGermanAndTextThatLooksLikeAnOption) {
  const SpeechProgram german{kEspeak, "de", Voice::Piped};
  SpeechChild child;
  for (const char* text : {"Die Spitze ist abgerissen. 1,4 Nanonewton", "--version", "-w /nowhere"}) {
    const auto bytes = child.run(german, text, never);
    ASSERT_TRUE(bytes.has_value()) << text << ": " << bytes.error().message;
    const auto wav = parse_mono_wav(*bytes);
    ASSERT_TRUE(wav.has_value()) << text;
    EXPECT_GT(wav->samples.size(), 4000U) << text;
  }
}

TEST(SpeechChild, ThatHangsIsEndedWithItsChildren) {
  const support::ScratchFolder folder;
  SpeechChild child;
  const auto begun = std::chrono::steady_clock::now();
  const auto hung = child.run(script(folder, "echo $$ > " + folder.file("pid") + "; sleep 1000; true"), "x", never);
  ASSERT_FALSE(hung.has_value());
  EXPECT_THAT(hung.error().message, HasSubstr("did not answer within 2 s and was ended"));
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(20));
  const std::string pid = core::read_file(folder.file("pid")).value();
  EXPECT_FALSE(std::filesystem::exists("/proc/" + pid.substr(0, pid.find('\n'))));
}

TEST(SpeechChild, ThatFailsOrIsMissingIsOneLine) {
  const support::ScratchFolder folder;
  SpeechChild child;
  EXPECT_THAT(child.run(script(folder, "exit 3"), "x", never).error().message, HasSubstr("ended with an error"));
  EXPECT_THAT(child.run({folder.file("none"), "en", Voice::Piped}, "x", never).error().message,
              HasSubstr("cannot be started"));
}

TEST(SpeechChild, IsEndedAtOnceWhenItIsCutOff) {
  const support::ScratchFolder folder;
  SpeechChild child;
  int asked = 0;
  const auto begun = std::chrono::steady_clock::now();
  const auto cut = child.run(script(folder, "sleep 1000", Voice::ItsOwn), "x", [&] { return ++asked > 5; });
  ASSERT_TRUE(cut.has_value());
  EXPECT_EQ(*cut, "");
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(20));
}

// A mixer that a test pulls from, as a card does.
class SpeakerTest : public ::testing::Test {
 protected:
  // Waits for a voice; returns whether there was one.
  bool hears_a_voice(milliseconds patience = std::chrono::seconds(20)) {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (std::chrono::steady_clock::now() < end) {
      std::array<float, 512> block{};
      mixer_.fill(block, clock_.now_ns());
      for (const float sample : block) {
        if (std::abs(sample) > 0.01F) return true;
      }
      std::this_thread::sleep_for(milliseconds(1));
    }
    return false;
  }
  bool log_has(const std::string& file, const std::string& text, int lines) const {
    for (int i = 0; i < 1000; ++i) {
      const auto log = core::read_file(file);
      if (log && log->find(text) != std::string::npos && std::count(log->begin(), log->end(), '\n') >= lines)
        return true;
      std::this_thread::sleep_for(milliseconds(20));
    }
    return false;
  }

  core::MonotonicClock clock_;
  SoundMixer mixer_{Channels::Stereo};
};

TEST_F(SpeakerTest, PutsTheVoiceOfEspeakIntoTheMixer) {
  Speaker speaker({kEspeak, "en", Voice::Piped}, mixer_, clock_);
  speaker.offer({"Gold", SpeechKind::Event});
  EXPECT_TRUE(hears_a_voice());
}

TEST_F(SpeakerTest, SpeaksTheNewestOfAFloodAndReturnsAtOnce) {
  const support::ScratchFolder folder;
  const std::string log = folder.file("log");
  // a slow child, which takes 0.3 s per text
  Speaker speaker(script(folder, "echo \"$5\" >> " + log + "; sleep 0.3", Voice::ItsOwn), mixer_, clock_);
  const auto begun = std::chrono::steady_clock::now();
  for (int i = 0; i < 1000; ++i) speaker.offer({"text " + std::to_string(i), SpeechKind::Event});
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(5));
  EXPECT_TRUE(log_has(log, "text 999\n", 1));
  const std::string all = core::read_file(log).value();
  EXPECT_LT(std::count(all.begin(), all.end(), '\n'), 500) << "a queue of one";
}

TEST_F(SpeakerTest, LogsAChildThatDiesOnce) {
  const support::ScratchFolder folder;
  testing::internal::CaptureStderr();
  {
    Speaker speaker(script(folder, "echo >> " + folder.file("log") + "; exit 1"), mixer_, clock_);
    for (int i = 1; i <= 3; ++i) {
      speaker.offer({"text", SpeechKind::Event});
      ASSERT_TRUE(log_has(folder.file("log"), "\n", i));
    }
  }
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_LE(std::count(said.begin(), said.end(), '\n'), 1) << said;
}

TEST_F(SpeakerTest, EndsAtOnceWhileAChildHangs) {
  const support::ScratchFolder folder;
  auto speaker =
      std::make_unique<Speaker>(script(folder, "echo > " + folder.file("log") + "; sleep 1000"), mixer_, clock_);
  speaker->offer({"text", SpeechKind::Event});
  EXPECT_TRUE(log_has(folder.file("log"), "\n", 1));
  const auto begin = std::chrono::steady_clock::now();
  speaker.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::minutes(1)) << "far less than the child's 1000 s";
}

TEST(WavFile, ComesBackAndNeverBelievesItsLengths) {
  std::string bytes;
  const auto put = [&](std::uint32_t value, int size) {
    for (int i = 0; i < size; ++i) bytes += static_cast<char>(value >> (8 * i));
  };
  bytes = "RIFF";
  put(0x7ffff024, 4);
  bytes += "WAVEfmt ";
  put(16, 4), put(1, 2), put(1, 2), put(22050, 4), put(44100, 4), put(2, 2), put(16, 2);
  bytes += "data";
  put(0x7ffff000, 4), put(0x4000, 2), put(0xC000, 2);
  const auto wav = parse_mono_wav(bytes);
  ASSERT_TRUE(wav.has_value());
  ASSERT_EQ(wav->samples.size(), 2U);
  EXPECT_NEAR(wav->samples[0], 0.5, 1e-4);
  EXPECT_NEAR(wav->samples[1], -0.5, 1e-4);
  EXPECT_EQ(resampled(*wav, 44100).size(), 4U);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const auto part = parse_mono_wav(std::string_view(bytes).substr(0, size));
    EXPECT_LE(part ? part->samples.size() : 0, 2U);
  }
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string garbled = bytes;
    garbled[i] = static_cast<char>(0xFF);
    parse_mono_wav(garbled);
  }
}

}  // namespace speech_test
}  // namespace afm::exhibit
