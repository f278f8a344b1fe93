// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace afm::study::test {

inline constexpr const char* kEventsHeader =
    "onset\tduration\tstep\ttrial_type\tcondition\tpractice\ttrial\tlevel\tstimulus\tresponse\tcorrect\trt\n";
// Adds the column of the force; its value follows each line.
inline std::string with_force(const std::string& events, const std::string& force) {
  std::string text = kEventsHeader + events;
  std::string with;
  bool first = true;
  for (const char c : text) {
    if (c == '\n') with += "\t" + (std::exchange(first, false) ? "force" : force);
    with += c;
  }
  return with;
}
inline constexpr const char* kPeopleHeader = "participant_id\torder\tage_band\tcomfort\n";

inline std::string facts_json(const std::string& device = "sim") {
  return R"({"onset": {"Units": "s"}, "Lesson": {"id": "three", "title": {"en": "Three materials", "de": "Drei"},
"digest": "a1b2", "seed": 7, "program": "0.3.0", "device": ")" +
         device + R"(", "scale": "common", "wall": "desk", "started_day": 0, "observer": {"seed": 7}}})";
}

// One line of an events file.
inline std::string event_line(double onset, const std::string& step, const std::string& type,
                              const std::string& condition, bool practice, int trial, const std::string& level,
                              const std::string& stimulus, const std::string& response, const std::string& correct) {
  return std::to_string(onset) + "\t1.5\t" + step + "\t" + type + "\t" + condition + "\t" + (practice ? "1" : "0") +
         "\t" + std::to_string(trial) + "\t" + level + "\t" + stimulus + "\t" + response + "\t" + correct + "\t" +
         (correct == "n/a" ? "n/a" : "0.8") + "\n";
}

// A study's folder with people whose answers are given.
class StudyWriter {
 public:
  explicit StudyWriter(std::string folder) : folder_(std::move(folder)) {}

  static std::string code(std::size_t person) {
    std::string letters = "AAAAAA";
    for (auto letter = letters.rbegin(); person > 0; ++letter, person /= 26) {
      *letter = static_cast<char>('A' + person % 26);
    }
    return "sub-" + letters;
  }

  void add_person(std::size_t person, const std::string& events, const std::string& comfort = "finished",
                  const std::string& task = "three") {
    people_ += code(person) + "\t" + std::to_string(person) + "\t18-24\t" + comfort + "\n";
    const std::string path = folder_ + "/" + code(person);
    std::filesystem::create_directories(path);
    write(path + "/task-" + task + "_events.tsv", kEventsHeader + events);
    write(path + "/task-" + task + "_events.json", facts_json());
    write(folder_ + "/participants.tsv", kPeopleHeader + people_);
  }

  // Same in the layout used since version 0.2.1. `events`: a whole table.
  void add_bids_person(std::size_t person, const std::string& events, const std::string& task = "three") {
    people_ += code(person) + "\t" + std::to_string(person) + "\t18-24\tfinished\n";
    const std::string stem = folder_ + "/" + code(person) + "/beh/" + code(person) + "_task-" + task + "_events";
    std::filesystem::create_directories(folder_ + "/" + code(person) + "/beh");
    write(stem + ".tsv", events);
    write(stem + ".json", facts_json());
    write(folder_ + "/participants.tsv", kPeopleHeader + people_);
  }

  static void write(const std::string& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }

 private:
  std::string folder_;
  std::string people_;
};

// Events of one simulated person: identification under two conditions, a threshold, all questionnaires.
class SimulatedEvents {
 public:
  explicit SimulatedEvents(unsigned seed) : random_(seed) {}

  double share() { return (static_cast<double>(random_()) + 0.5) / 4294967296.0; }

  // Answers right with the given probability, otherwise one of the other materials, after three practice trials.
  void identify(const std::string& condition, double right, int trials) {
    static const std::vector<std::string> kMaterials{"mica", "gold", "si3n4"};
    for (int i = -2; i <= trials; ++i) {
      const std::size_t shown = random_() % 3;
      const std::size_t answered = share() < right ? shown : (shown + 1 + random_() % 2) % 3;
      line("blind", "identify", condition, i <= 0, i <= 0 ? i + 3 : i, "n/a", kMaterials[shown], kMaterials[answered],
           shown == answered ? "1" : "0");
    }
  }

  // Answers a weighted staircase as an observer whose d' is proportional to the level.
  void threshold(double weber_fraction, double bias, int trials) {
    double log_level = std::log10(weber_fraction) + 0.4;
    for (int i = 1; i <= trials; ++i) {
      const bool second = share() < 0.5;
      const double level = std::pow(10.0, log_level);
      const double signal = 0.6744897501960817 * level / weber_fraction * (second ? 1.0 : -1.0);
      const bool answer = share() < 0.5 * std::erfc(-(signal - bias / std::sqrt(2.0)) / std::sqrt(2.0));
      line("harder", "threshold", "n/a", false, i, std::to_string(level), second ? "second" : "first",
           answer ? "second" : "first", second == answer ? "1" : "0");
      log_level += second == answer ? -0.04 : 0.12;
    }
  }

  void questions(const std::string& step, const std::string& questionnaire, int items, int least, int most) {
    for (int i = 1; i <= items; ++i) {
      const int answer = least + static_cast<int>(share() * (most - least + 1));
      line(step, "question", "n/a", false, i, "n/a", questionnaire + "-" + std::to_string(i), std::to_string(answer),
           "n/a");
    }
  }

  void line(const std::string& step, const std::string& type, const std::string& condition, bool practice, int trial,
            const std::string& level, const std::string& stimulus, const std::string& response,
            const std::string& correct) {
    text_ += event_line(onset_ += 2.0, step, type, condition, practice, trial, level, stimulus, response, correct);
  }

  const std::string& text() const { return text_; }

 private:
  std::mt19937 random_;
  std::string text_;
  double onset_ = 0;
};

inline std::string whole_lesson(unsigned seed) {
  SimulatedEvents events(seed);
  events.questions("ssq-before", "ssq", 16, 0, 1);
  events.identify("haptics", 0.8, 12);
  events.identify("picture", 0.5, 12);
  events.threshold(0.1, 0.0, 40);
  events.line("sketch", "draw", "n/a", false, 1, "n/a", "n/a", "0.8", "n/a");
  events.line("cycle", "cycle", "n/a", false, 1, "n/a", "n/a", "1.39989e-09", "n/a");
  events.line("end", "text", "n/a", false, 1, "n/a", "n/a", "n/a", "n/a");
  events.questions("survey", "paper", 8, 2, 4);
  events.questions("usability", "sus", 10, 1, 5);
  events.questions("load", "tlx", 6, 0, 100);
  events.questions("ssq-after", "ssq", 16, 0, 2);
  return events.text();
}

}  // namespace afm::study::test
