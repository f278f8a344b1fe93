// SPDX-License-Identifier: Apache-2.0
// Invariant: the whole procedure can be followed by speech alone, with a blank picture
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "core/file_descriptor.h"
#include "core/whole_file.h"
#include "exhibit/sound/synthesizer.h"
#include "render/frame.h"
#include "servo/session_file.h"
#include "support/live_program.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"
#include "support/sound_analysis.h"
#include "support/virtual_display.h"

// The live window by ear: what is said, and what SDL's disk driver wrote. No picture is read but to see that it is
// blank.
namespace afm::app {
namespace heard_view_test {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;
using ::testing::Not;

// Variable in the environment of started programs, during the object's lifetime.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    ::setenv(name, value.c_str(), 1);
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;
  ~Variable() { before_.empty() ? ::unsetenv(name_) : ::setenv(name_, before_.c_str(), 1); }

 private:
  const char* name_;
  std::string before_;
};

class HeardView : public ::testing::Test {
 protected:
  static constexpr double kHandPerPixel = 0.085 / 0.30 / 480;

  std::unique_ptr<support::LiveProgram> live(const std::vector<std::string>& command,
                                             const std::vector<std::string>& more) const {
    std::vector<std::string> all{support::touchafm()};
    all.insert(all.end(), command.begin(), command.end());
    for (const std::string& word : std::vector<std::string>{"--size", "640x480", "--frame-rate", "12", "--eye-width",
                                                            "320", "--servo", support::servo_mode(), "--linger", "0"}) {
      all.emplace_back(word);
    }
    if (std::find(more.begin(), more.end(), "--language") == more.end()) all.insert(all.end(), {"--language", "en"});
    all.insert(all.end(), more.begin(), more.end());
    return std::make_unique<support::LiveProgram>(all, display_.name());
  }
  std::unique_ptr<support::LiveProgram> view(const std::vector<std::string>& more) const {
    return live({"view"}, more);
  }
  void xdotool(const std::string& what) const {
    const auto done = support::run_program("DISPLAY=" + display_.name() + " xdotool " + what);
    ASSERT_EQ(done.exit_code, 0) << "xdotool " << what << ": " << done.err << " (package xdotool)";
  }
  // The hand up or down, wherever the pointer is.
  void move_hand(double height_m) const {
    const int rise = static_cast<int>(std::lround(height_m / kHandPerPixel));
    xdotool("mousemove 320 240 mousedown 3 mousemove 320 " + std::to_string(240 - rise) + " mouseup 3");
  }
  std::string program(const std::string& name, const std::string& lines) const {
    const std::string path = folder_.write(name, "#!/bin/sh\n" + lines + "\n");
    ::chmod(path.c_str(), 0755);
    return path;
  }
  std::string own_path() const { return folder_.path() + ":/usr/bin:/bin"; }

  // A cycle by ear. A busy machine releases the hand now and then: repeats the cycle as announced.
  bool feel_a_cycle(support::LiveProgram& view) const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(4);
    while (std::chrono::steady_clock::now() < end) {
      move_hand(0.150);
      for (int presses = 0; presses < 40; ++presses) {
        xdotool("key t");
        if (view.says("says: The force is on", seconds(2))) break;
      }
      move_hand(-0.100);
      const std::vector<std::string> down{"says: The tip snapped to contact. 0.24 nanonewtons", "says: Force off",
                                          "says: The force is off", "says: Fault"};
      if (view.says_one_of(down) != down.front()) continue;
      move_hand(0.120);
      const std::vector<std::string> up{"says: The tip let go. 1.4 nanonewtons", "says: Force off",
                                        "says: The force is off", "says: Fault"};
      if (view.says_one_of(up) == up.front()) return true;
    }
    return false;
  }

  // A press while the previous one still counts as held is ignored. Nobody presses that fast, and a person without an
  // answer presses again.
  bool turn_on_until(support::LiveProgram& view, const std::string& text) const {
    for (int press = 0; press < 6; ++press) {
      std::this_thread::sleep_for(milliseconds(300));
      xdotool("key t");
      if (view.says(text, seconds(10))) return true;
    }
    return false;
  }

  support::ScratchFolder folder_;
  support::VirtualDisplay display_{640, 480};
};

const char* const kLesson = R"(id = "a-lesson"
title = { en = "A lesson", de = "Lektion" }
minutes = 5
materials = ["mica", "si3n4"]
scale = "fit"
[[step]]
id = "feel"
type = "free"
cycles = 9
words = { en = "Words of feel.", de = "Worte." }
[[step]]
id = "think"
type = "text"
words = { en = "Words of think.", de = "Worte." }
[[step]]
id = "load"
type = "question"
questionnaire = "tlx"
words = { en = "Words of load.", de = "Worte." }
)";

constexpr std::size_t kThin = 8;

std::vector<double> thinned(const std::vector<double>& samples) {
  std::vector<double> thin;
  for (std::size_t i = 0; i + kThin <= samples.size(); i += kThin) {
    double sum = 0;
    for (std::size_t j = 0; j < kThin; ++j) sum += samples[i + j];
    thin.push_back(sum / kThin);
  }
  return thin;
}

std::vector<double> signal_of(exhibit::HeardEvent event) {
  exhibit::Synthesizer synthesizer(exhibit::Channels::Mono);
  synthesizer.play(0, event, 0.0);
  std::vector<float> samples(2 * static_cast<std::size_t>(exhibit::row_of(event).signal.length_s() * 48e3));
  synthesizer.add_to(samples);
  return thinned(test::channel(samples, 0));
}

// Best likeness of a part of the sound to a signal; 1: equal except for the volume.
double likeness(const std::vector<double>& sound, const std::vector<double>& signal) {
  double best = 0;
  for (std::size_t at = 0; at + signal.size() < sound.size(); ++at) {
    double product = 0, power = 1e-9;
    for (std::size_t i = 0; i < signal.size(); ++i) {
      product += sound[at + i] * signal[i];
      power += sound[at + i] * sound[at + i];
    }
    best = std::max(best, product / std::sqrt(power));
  }
  return best / (test::rms(signal) * std::sqrt(static_cast<double>(signal.size())));
}

TEST_F(HeardView, GoesThroughALessonFromConsentToItsLastAnswerByEarAndHandAlone) {
  const Variable driver("SDL_AUDIODRIVER", "disk"), file("SDL_DISKAUDIOFILE", folder_.file("sound.raw"));
  const std::string lesson = folder_.write("lesson.toml", kLesson), out = folder_.file("study");
  const auto live = this->live({"lesson", lesson},
                               {"--sound", "--speech", "--haptics", "mouse", "--participant", "QXWERT", "--out", out});
  ASSERT_TRUE(live->says("sound: disk")) << live->said();
  ASSERT_TRUE(live->says("speech: /")) << live->said();
  ASSERT_TRUE(live->says("says: This lesson keeps your answers")) << live->said();
  xdotool("key x");
  ASSERT_TRUE(live->says("says: The picture is off")) << live->said();
  xdotool("key t");  // no answer, since the hand has marked none
  move_hand(-0.020);
  ASSERT_TRUE(live->says("says: Yes, I take part")) << live->said();
  ASSERT_TRUE(turn_on_until(*live, "says: Words of feel")) << live->said();

  xdotool("key 1");
  ASSERT_TRUE(live->says("says: Mica")) << live->said();
  ASSERT_TRUE(feel_a_cycle(*live)) << live->said();
  xdotool("key y");
  ASSERT_TRUE(live->says("says: The tip let go. 1.4 nanonewtons. Mica. FORCE")) << live->said();
  xdotool("key Return");
  const std::string off = "says: The force is off", think = "says: Words of think";
  const std::string first = live->says_one_of({off, think});
  ASSERT_TRUE(live->says(first == off ? think : off)) << live->said();

  ASSERT_TRUE(turn_on_until(*live, "says: Mental demand")) << live->said();
  move_hand(-0.007);
  ASSERT_FALSE(live->says_one_of({"says: 45", "says: 40", "says: 35", "says: 30"}).empty()) << live->said();
  ASSERT_TRUE(turn_on_until(*live, "says: Physical demand")) << live->said();
  for (int item = 2; item <= 6; ++item) {
    const std::string next = "question " + std::to_string(item + 1);
    ASSERT_TRUE(turn_on_until(*live, item < 6 ? next : "The lesson is finished")) << live->said();
  }
  xdotool("key Escape");
  EXPECT_EQ(live->ends(), 0) << live->said();
  const std::string said = live->said();
  EXPECT_EQ(said.find("says: The force is on", said.find("says: Mental demand")), std::string::npos)
      << "Turn-On answers, and turns nothing on: " << said;
  const std::string events = core::read_file(out + "/sub-QXWERT/beh/sub-QXWERT_task-alesson_events.tsv").value();
  EXPECT_THAT(events, HasSubstr("\tfeel\tfree\t"));
  EXPECT_THAT(events, HasSubstr("\ttlx-2\t50\t")) << "where the scale begins";
  EXPECT_THAT(events, Not(HasSubstr("\ttlx-1\t50\t"))) << events;
  EXPECT_THAT(core::read_file(out + "/participants.tsv").value(), HasSubstr("sub-QXWERT\t0\tn/a\tfinished"));

  // same lesson by sound only, independent of tone and voice
  const std::string kept = out + "/sub-QXWERT/task-a-lesson_session/session-mica.afms";
  const auto session = servo::load_session(kept);
  ASSERT_TRUE(session.has_value()) << session.error().message;
  EXPECT_NE(session->find(physics::EventKind::JumpOffContact), nullptr);
  const auto sound = thinned(test::channel(test::floats_of(core::read_file(folder_.file("sound.raw")).value()), 0));
  using exhibit::HeardEvent;
  for (const HeardEvent event : {HeardEvent::SampleChosen, HeardEvent::TurnOnReady, HeardEvent::ForceOn,
                                 HeardEvent::SnapIn, HeardEvent::PullOff, HeardEvent::ForceOff}) {
    EXPECT_GT(likeness(sound, signal_of(event)), 0.3) << exhibit::row_of(event).signal.length_s();
  }
  EXPECT_LT(likeness(sound, signal_of(HeardEvent::Fault)), 0.3) << "which never sounded";
  // sound changes no force
  const auto replayed =
      support::run_program(support::touchafm() + " replay " + kept + " --sound " + folder_.file("mica.wav"));
  EXPECT_EQ(replayed.exit_code, 0) << replayed.err;
  EXPECT_THAT(replayed.out, HasSubstr("identical, bit for bit"));
  EXPECT_GT(std::filesystem::file_size(folder_.file("mica.wav")), 100'000U);
}

TEST_F(HeardView, BlanksThePictureAndShowsItAgain) {
  const auto live = view({});
  ASSERT_TRUE(live->says("F1 shows the keys")) << live->said();
  // text is nearly white, the background is not
  const auto brightest = [&] {
    const render::Image image = display_.screenshot();
    int most = 0;
    for (std::size_t i = 0; i < image.rgba.size(); ++i) most = std::max(most, i % 4 == 3 ? 0 : int{image.rgba[i]});
    return most;
  };
  const auto shows = [&](auto&& condition) {
    for (int i = 0; i < 500; ++i) {
      if (condition(brightest())) return true;
      std::this_thread::sleep_for(milliseconds(20));
    }
    return false;
  };
  EXPECT_TRUE(shows([](int level) { return level > 200; }));
  xdotool("key x");
  ASSERT_TRUE(live->says("the picture is blank")) << live->said();
  EXPECT_TRUE(shows([](int level) { return level < 150; })) << brightest() << " is brighter than the background";
  xdotool("key x");
  ASSERT_TRUE(live->says("the picture is shown")) << live->said();
  EXPECT_TRUE(shows([](int level) { return level > 200; }));
  xdotool("key q");
  ASSERT_TRUE(live->says("sound off")) << live->said();
  xdotool("key y");
  ASSERT_TRUE(live->says("says: FORCE OFF. Choose a sample: ")) << live->said();
  xdotool("key Escape");
  EXPECT_EQ(live->ends(), 0) << live->said();
}

TEST_F(HeardView, GoesOnWithoutASoundCardAndWhenItIsLost) {
  {
    const Variable driver("SDL_AUDIODRIVER", "no-such-driver");
    const auto live = view({"--sound"});
    ASSERT_TRUE(live->says("no sound: SDL says: ")) << live->said();
    ASSERT_TRUE(live->says("Choose a sample")) << live->said();
    xdotool("key Escape");
    EXPECT_EQ(live->ends(), 0) << live->said();
  }
  // a sound card unplugged during a study: a pipe without a reader
  const std::string card = folder_.file("card");
  ASSERT_EQ(::mkfifo(card.c_str(), 0600), 0);
  core::FileDescriptor plugged(::open(card.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  ASSERT_TRUE(plugged.is_open());
  const auto end_of_a_write = ::signal(SIGPIPE, SIG_IGN);  // an error, as of a card, for what is started too
  const Variable driver("SDL_AUDIODRIVER", "disk"), file("SDL_DISKAUDIOFILE", card);
  const std::string lesson = folder_.write("lesson.toml", kLesson), out = folder_.file("study");
  const auto live = this->live({"lesson", lesson}, {"--sound", "--participant", "QXWERT", "--out", out});
  ::signal(SIGPIPE, end_of_a_write);
  ASSERT_TRUE(live->says("sound: disk")) << live->said();
  plugged.close();
  ASSERT_TRUE(live->says("no sound: the sound card is gone")) << live->said();
  xdotool("key 1");
  ASSERT_TRUE(live->says("the results say that there is no sound")) << live->said();
  xdotool("key 1");
  ASSERT_TRUE(live->says("chosen: Mica")) << live->said();
  EXPECT_THAT(core::read_file(out + "/sub-QXWERT/beh/sub-QXWERT_task-alesson_events.json").value(),
              HasSubstr("\"sound_lost_s\": "));
  xdotool("key Escape");
  EXPECT_EQ(live->ends(), 0) << live->said();
  const std::string said = live->said();
  EXPECT_EQ(said.find("no sound:", said.find("no sound:") + 1), std::string::npos) << said;
}

TEST_F(HeardView, WithoutEspeakEndsWhereSpeechWasAskedForAndElseSaysSoOnce) {
  const Variable driver("SDL_AUDIODRIVER", "dummy");
  std::unique_ptr<support::LiveProgram> asked, pressed;
  {
    const Variable path("PATH", folder_.path());
    asked = view({"--speech"});
    pressed = view({});
  }
  EXPECT_EQ(asked->ends(), 4) << asked->said();
  EXPECT_THAT(asked->said(), HasSubstr("--speech needs the program espeak-ng"));
  ASSERT_TRUE(pressed->says("F1 shows the keys")) << pressed->said();
  xdotool("key y");
  ASSERT_TRUE(pressed->says("says: FORCE OFF")) << pressed->said();
  xdotool("key y");
  ASSERT_TRUE(pressed->says("says: FORCE OFF")) << pressed->said();
  xdotool("key Escape");
  EXPECT_EQ(pressed->ends(), 0) << pressed->said();
  const std::string said = pressed->said();
  const std::size_t first = said.find("espeak-ng");
  ASSERT_NE(first, std::string::npos) << said;
  EXPECT_EQ(said.find("--speech needs", first), std::string::npos) << said;
}

TEST_F(HeardView, EndsAtOnceWhileTheProgramThatSpeaksHangs) {
  const Variable driver("SDL_AUDIODRIVER", "dummy");
  program("espeak-ng", "echo $$ > " + folder_.file("pid") + "\nsleep 1000");
  const Variable path("PATH", own_path());
  const auto live = view({"--sound", "--speech"});
  EXPECT_TRUE(live->says("says: Choose a sample")) << live->said();
  EXPECT_TRUE(live->says("did not answer within 2 s and was ended")) << live->said();
  xdotool("key 2");  // frames continue
  EXPECT_TRUE(live->says("says: Gold")) << live->said();
  live->signal(SIGINT);
  EXPECT_EQ(live->ends(), 0) << live->said();
  const std::string pid = core::read_file(folder_.file("pid")).value();
  EXPECT_FALSE(std::filesystem::exists("/proc/" + pid.substr(0, pid.find('\n')))) << "no orphan";
}

TEST_F(HeardView, LeavesSpeechToAScreenReaderThatRuns) {
  const Variable driver("SDL_AUDIODRIVER", "dummy");
  program("spd-say", "echo \"$@\" >> " + folder_.file("said"));
  // one process of that name, which must end with the test
  std::filesystem::copy_file("/bin/sleep", folder_.file("orca"));
  support::LiveProgram reader({folder_.file("orca"), "1000"}, "");
  for (int i = 0; i < 500; ++i) {  // time for the process to get its name
    const auto name = core::read_file("/proc/" + std::to_string(reader.pid()) + "/comm");
    if (name && *name == "orca\n") break;
    std::this_thread::sleep_for(milliseconds(10));
  }
  const Variable path("PATH", own_path());
  const auto live = view({"--speech", "--language", "de"});
  ASSERT_TRUE(live->says("speech: " + folder_.file("spd-say"))) << live->said();
  ASSERT_TRUE(live->says("says: Eine Probe w")) << live->said();
  xdotool("key Escape");
  EXPECT_EQ(live->ends(), 0) << live->said();
  EXPECT_THAT(core::read_file(folder_.file("said")).value(), HasSubstr("--wait -l de -- Eine Probe w"));
}

}  // namespace heard_view_test
}  // namespace afm::app
