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

// The data set of a study as written by `touchafm lesson`: BIDS-like tables with columns described in each events.json.
// Everything is validated: a number out of range, a word outside its column's list or an exceeded size is an error that
// names file and line.

// A line of an events file. Empty words and missing numbers stand for n/a.
struct StudyTrial {
  double onset_s = 0, duration_s = 0;
  std::string step{};
  StepKind kind = StepKind::Text;
  std::string condition{};
  bool practice = false;
  int trial = 1;                  // number of the trial within its step
  std::optional<double> level{};  // level w of the stimulus
  std::string stimulus{}, response{};
  // Response of a cycle (N), a drawing (0..1), a question, a push (m; threshold: force over it) or writing (m).
  std::optional<double> value{};
  std::optional<bool> right{};  // true: right answer; only for identify and threshold, empty without an answer
  std::optional<double> rt_s{};
  // True: the force was on from snap-in to pull-off of each cycle, or while a particle or a soft sample was touched.
  // Empty: unknown, or a step without these.
  std::optional<bool> force{};
  // figures of a push or of writing, SI
  std::optional<double> strokes{}, losses{}, undos{}, work_j{}, largest_force_n{};
  std::string aids{};

  // Returns whether the force on the hand was as the condition requires: on, or off under "picture". Empty if unknown.
  std::optional<bool> felt_as_set() const {
    return force ? std::optional(*force == (condition != "picture")) : std::nullopt;
  }
};

// Contents of an events file. A last line without a line end is dropped, because a killed program wrote it.
struct EventsFile {
  std::vector<StudyTrial> trials;
  std::size_t cut_line = 0;  // number of the dropped last line; 0: none
};

// `name` is the file's name in errors. BadInputFile for an unknown, missing or repeated column, a wrong number of
// fields, and an illegal value of a column.
core::Result<EventsFile> parse_events(std::string_view bytes, const std::string& name);

struct StudyPerson {
  std::string id;  // code of the person, sub-ABCDEF
  std::size_t order = 0;
  std::string age_band{}, comfort{};  // words from participants.tsv, empty for n/a
};
struct PeopleFile {
  std::vector<StudyPerson> people;
  std::size_t cut_line = 0;
};
core::Result<PeopleFile> parse_people(std::string_view bytes, const std::string& name);

// The table "Lesson" of an events.json; missing entries are empty.
struct LessonFacts {
  std::string id{}, title{}, digest{}, program{}, device{}, scale{}, wall{};
  bool simulated = false;
  std::optional<double> sound_lost_s{};  // time in the lesson at which the requested sound failed; empty: it did not
};
core::Result<LessonFacts> parse_lesson_facts(std::string_view bytes, const std::string& name);

// One person's trials of one lesson.
struct LessonVisit {
  std::string task;  // id of the lesson, from the file name
  LessonFacts facts{};
  std::vector<StudyTrial> trials{};
};

struct StudyData {
  struct Member {
    StudyPerson person;
    std::vector<LessonVisit> visits{};  // lessons taken, sorted by task
  };
  std::vector<Member> members;        // people with counted trials, sorted by id
  std::size_t listed = 0;             // number of people in participants.tsv
  std::vector<std::string> left_out;  // excluded people with the reasons
  std::vector<std::string> remarks;   // remarks on cut lines and missing descriptions
};

// Reads a study's folder: participants.tsv and sub-*/task-*_events.tsv and .json, at most 10000 people and two million
// trials. BadInputFile for a folder without a study, and for the first invalid file.
core::Result<StudyData> read_study(const std::string& folder);

}  // namespace afm::study
