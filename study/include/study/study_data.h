// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "study/step_kind.h"

namespace afm::study {

// The data set of a study as `touchafm lesson` writes it: BIDS-like tables, whose columns each events.json describes.
// Nothing is believed: every number is within its range, every word one of its column's, every size bounded, or the
// error names file and line.

// A line of an events file. Empty words and missing numbers are its n/a.
struct StudyTrial {
  double onset_s = 0, duration_s = 0;
  std::string step{};
  StepKind kind = StepKind::Text;
  std::string condition{};
  bool practice = false;
  int trial = 1;                  // within its step
  std::optional<double> level{};  // w
  std::string stimulus{}, response{};
  std::optional<double> value{};  // the response of a cycle (newtons), a drawing (0..1) or a question
  std::optional<bool> right{};    // identify and threshold, where there is an answer
  std::optional<double> rt_s{};
};

// Lines without a line end at the file's end are cut: a killed program wrote them.
struct EventsFile {
  std::vector<StudyTrial> trials;
  std::size_t cut_line = 0;  // its number; 0 for none
};

// `name` is the file's, for errors. BadInputFile for a column that is unknown, missing or there twice, a wrong number
// of fields, and a value that its column does not take.
core::Result<EventsFile> parse_events(std::string_view bytes, const std::string& name);

struct StudyPerson {
  std::string id;  // sub-ABCDEF
  std::size_t order = 0;
  std::string age_band{}, comfort{};  // empty for n/a
};
struct PeopleFile {
  std::vector<StudyPerson> people;
  std::size_t cut_line = 0;
};
core::Result<PeopleFile> parse_people(std::string_view bytes, const std::string& name);

// The table "Lesson" of an events.json; what it lacks is empty.
struct LessonFacts {
  std::string id{}, title{}, digest{}, program{}, device{}, scale{}, wall{};
  bool simulated = false;
  std::optional<double> sound_lost_s{};  // into the lesson, when sound was asked for and there was none from then on
};
core::Result<LessonFacts> parse_lesson_facts(std::string_view bytes, const std::string& name);

// One person's trials of one lesson.
struct LessonVisit {
  std::string task;  // the lesson's id, as in the file's name
  LessonFacts facts{};
  std::vector<StudyTrial> trials{};
};

struct StudyData {
  struct Member {
    StudyPerson person;
    std::vector<LessonVisit> visits{};  // by task
  };
  std::vector<Member> members;        // by id: those whose trials count
  std::size_t listed = 0;             // in participants.tsv
  std::vector<std::string> left_out;  // people, and why
  std::vector<std::string> remarks;   // cut lines and missing descriptions
};

// Reads a study's folder: participants.tsv and sub-*/task-*_events.tsv and .json, at most 10000 people and two
// million trials. BadInputFile
// for a folder that holds no study, and for the first file that is not as it should be.
core::Result<StudyData> read_study(const std::string& folder);

}  // namespace afm::study
