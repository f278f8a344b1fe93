// SPDX-License-Identifier: Apache-2.0
#include "study/study_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>
#include <utility>

#include "core/printable.h"
#include "core/whole_file.h"
#include "study/age_band.h"
#include "study_table.h"

namespace afm::study {

namespace {

namespace fs = std::filesystem;
using core::printable;

constexpr std::array<std::string_view, 4> kPeopleColumns{"participant_id", "order", "age_band", "comfort"};
constexpr std::array<std::string_view, 3> kComforts{"finished", "stopped", "withdrew"};
constexpr std::size_t kMostPeople = 10'000;
constexpr std::size_t kMostVisits = 1'000;
constexpr std::size_t kMostTrialsInAll = 2'000'000;
constexpr std::uintmax_t kLargestTable = 32U << 20U;
constexpr std::uintmax_t kLargestDescription = 1U << 20U;
constexpr std::string_view kPersonPrefix = "sub-", kTaskPrefix = "task-", kEventsEnding = "_events.tsv";
constexpr std::string_view kTrialsFolder = "beh";

tl::unexpected<core::Error> bad_file(const std::string& path, const std::string& what) {
  return core::failure(core::ErrorCategory::BadInputFile, path + ": " + what);
}

core::Result<std::string> read_bounded(const std::string& path, std::uintmax_t largest) {
  std::error_code error;
  if (const std::uintmax_t size = fs::file_size(path, error); !error && size > largest) {
    return bad_file(path, fmt::format("it is larger than {} MiB", largest >> 20U));
  }
  return core::read_file(path);
}

bool is_person(std::string_view id) {
  constexpr std::size_t kLetters = 6;
  return id.starts_with(kPersonPrefix) && id.size() == kPersonPrefix.size() + kLetters &&
         std::all_of(id.begin() + kPersonPrefix.size(), id.end(), [](char c) { return c >= 'A' && c <= 'Z'; });
}

bool is_age_band(std::string_view text) {
  return std::any_of(kAgeBands.begin(), kAgeBands.end(), [&](const AgeBandRow& band) { return band.word == text; });
}

// Names in a folder with this prefix and suffix, sorted; empty if it cannot be read.
std::set<std::string> names_in(const std::string& folder, std::string_view prefix, std::string_view ending) {
  std::set<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    const bool fits =
        name.size() >= prefix.size() + ending.size() && name.starts_with(prefix) && name.ends_with(ending);
    if (fits) names.insert(name);
  }
  return names;
}

std::string text_in(const nlohmann::json& table, const char* key) {
  constexpr std::size_t kLongest = 200;
  auto found = table.find(key);
  if (found == table.end()) return {};
  if (const auto& texts = *found; texts.is_object()) {  // titles by language
    found = texts.find("en");
    if (found == texts.end()) return {};
  }
  return found->is_string() ? printable(found->get<std::string>().substr(0, kLongest)) : std::string{};
}

std::string without_dashes(std::string id) {
  std::erase(id, '-');
  return id;
}

std::string cut_remark(const std::string& name, std::size_t line) {
  return fmt::format("{}: line {} was cut off and is left out", name, line);
}

// An events file of a person, with its description.
core::Result<LessonVisit> read_visit(const std::string& folder, const std::string& name, StudyData& data) {
  LessonVisit visit;
  visit.task = name.substr(name.find(kTaskPrefix, name.rfind('/')) + kTaskPrefix.size());
  visit.task.resize(visit.task.size() - kEventsEnding.size());
  if (!is_word(visit.task)) return bad_file(folder + "/" + printable(name), "the name holds no lesson's id");
  const std::string path = folder + "/" + name;
  const auto bytes = read_bounded(path, kLargestTable);
  if (!bytes) return tl::unexpected(bytes.error());
  auto events = parse_events(*bytes, path);
  if (!events) return tl::unexpected(events.error());
  visit.trials = std::move(events->trials);
  if (events->cut_line > 0) data.remarks.push_back(cut_remark(name, events->cut_line));

  const std::string description = name.substr(0, name.size() - 4) + ".json";
  std::error_code ignored;
  if (!fs::exists(folder + "/" + description, ignored)) {
    data.remarks.push_back(description + ": there is no such file");
    return visit;
  }
  const auto text = read_bounded(folder + "/" + description, kLargestDescription);
  if (!text) return tl::unexpected(text.error());
  auto facts = parse_lesson_facts(*text, folder + "/" + description);
  if (!facts) return tl::unexpected(facts.error());
  visit.facts = std::move(*facts);
  // ids are compared by letters and digits, as in the names of files; those of 0.2.0 also have dashes
  if (is_word(visit.facts.id) && without_dashes(visit.facts.id) == without_dashes(visit.task)) {
    visit.task = visit.facts.id;
  }
  if (visit.facts.sound_lost_s) {
    data.remarks.push_back(fmt::format("{}: without sound from {:.0f} s on; the trials since then count", description,
                                       *visit.facts.sound_lost_s));
  }
  return visit;
}

core::Result<void> read_person(const std::string& folder, const StudyPerson& person, StudyData& data) {
  if (person.comfort == "withdrew") {
    data.left_out.push_back(person.id + ": withdrew");
    return {};
  }
  auto names = names_in(folder + "/" + person.id, kTaskPrefix, kEventsEnding);
  const std::string trials = fmt::format("{}/{}", person.id, kTrialsFolder);
  const std::string of_person = fmt::format("{}_{}", person.id, kTaskPrefix);
  for (const std::string& name : names_in(fmt::format("{}/{}", folder, trials), of_person, kEventsEnding)) {
    names.insert(fmt::format("{}/{}", kTrialsFolder, name));
  }
  if (names.empty()) {
    data.left_out.push_back(person.id + ": there is no task-*_events.tsv");
    return {};
  }
  if (names.size() > kMostVisits) {
    return bad_file(folder + "/" + person.id, fmt::format("more than {} lessons", kMostVisits));
  }
  if (person.comfort == "stopped") data.remarks.push_back(person.id + ": stopped; the trials until then count");
  StudyData::Member member{.person = person};
  for (const std::string& name : names) {
    auto visit = read_visit(folder, person.id + "/" + name, data);
    if (!visit) return tl::unexpected(visit.error());
    member.visits.push_back(std::move(*visit));
  }
  std::stable_sort(member.visits.begin(), member.visits.end(),
                   [](const LessonVisit& a, const LessonVisit& b) { return a.task < b.task; });
  data.members.push_back(std::move(member));
  return {};
}

}  // namespace

core::Result<PeopleFile> parse_people(std::string_view bytes, const std::string& name) {
  const auto table = parse_tsv(bytes, name, kPeopleColumns);
  if (!table) return tl::unexpected(table.error());
  PeopleFile file{.people = {}, .cut_line = table->cut_line};
  std::set<std::string_view> ids;
  for (std::size_t row = 0; row < table->lines.size(); ++row) {
    const auto& fields = table->lines[row];
    const auto order = parse_number(fields[1], 0, 1e6);
    if (!is_person(fields[0])) return table->bad(row, "participant_id is not sub- and six capital letters");
    if (!ids.insert(fields[0]).second) return table->bad(row, "this participant is there twice");
    if (!order || *order != std::floor(*order)) return table->bad(row, "order is not a whole number from 0");
    if (!fields[2].empty() && !is_age_band(fields[2])) {
      return table->bad(row, "age_band is none of those that touchafm lesson --age-band takes, nor n/a");
    }
    if (!fields[3].empty() && std::find(kComforts.begin(), kComforts.end(), fields[3]) == kComforts.end()) {
      return table->bad(row, "comfort is none of finished, stopped, withdrew and n/a");
    }
    if (ids.size() > kMostPeople) return table->bad(row, fmt::format("more than {} participants", kMostPeople));
    file.people.push_back({.id = std::string(fields[0]),
                           .order = static_cast<std::size_t>(*order),
                           .age_band = std::string(fields[2]),
                           .comfort = std::string(fields[3])});
  }
  return file;
}

core::Result<LessonFacts> parse_lesson_facts(std::string_view bytes, const std::string& name) {
  const auto json = nlohmann::json::parse(bytes, nullptr, false);
  if (!json.is_object()) return bad_file(name, "it is not a JSON object");
  const auto lesson = json.find("Lesson");
  if (lesson == json.end() || !lesson->is_object()) return bad_file(name, "there is no table \"Lesson\"");
  const auto lost = lesson->find("sound_lost_s");
  const bool has_lost = lost != lesson->end();
  if (has_lost && !(lost->is_number() && lost->get<double>() >= 0.0)) {
    return bad_file(name, "sound_lost_s is not a number from 0");
  }
  return LessonFacts{.id = text_in(*lesson, "id"),
                     .title = text_in(*lesson, "title"),
                     .digest = text_in(*lesson, "digest"),
                     .program = text_in(*lesson, "program"),
                     .device = text_in(*lesson, "device"),
                     .scale = text_in(*lesson, "scale"),
                     .wall = text_in(*lesson, "wall"),
                     .simulated = lesson->contains("observer"),
                     .sound_lost_s = has_lost ? std::optional(lost->get<double>()) : std::nullopt};
}

core::Result<StudyData> read_study(const std::string& folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) {
    return bad_file(folder, "there is no such folder; give the folder that `touchafm lesson --out` wrote");
  }
  const std::string list = folder + "/participants.tsv";
  if (!fs::exists(list, ignored)) {
    return bad_file(folder, "no participants.tsv is in it; give the folder that `touchafm lesson --out` wrote");
  }
  const auto bytes = read_bounded(list, kLargestTable);
  if (!bytes) return tl::unexpected(bytes.error());
  auto people = parse_people(*bytes, list);
  if (!people) return tl::unexpected(people.error());
  if (people->people.empty()) return bad_file(list, "it names no participant");
  std::sort(people->people.begin(), people->people.end(),
            [](const StudyPerson& a, const StudyPerson& b) { return a.id < b.id; });

  StudyData data;
  data.listed = people->people.size();
  if (people->cut_line > 0) data.remarks.push_back(cut_remark("participants.tsv", people->cut_line));
  std::size_t trials = 0;
  std::set<std::string> unlisted = names_in(folder, kPersonPrefix, "");
  for (const StudyPerson& person : people->people) {
    unlisted.erase(person.id);
    if (const auto read = read_person(folder, person, data); !read) return tl::unexpected(read.error());
    if (data.members.empty() || data.members.back().person.id != person.id) continue;
    for (const LessonVisit& visit : data.members.back().visits) trials += visit.trials.size();
    if (trials > kMostTrialsInAll) return bad_file(folder, fmt::format("more than {} trials", kMostTrialsInAll));
  }
  for (const std::string& name : unlisted) {
    data.left_out.push_back(printable(name.substr(0, 64)) + ": not in participants.tsv");
  }
  return data;
}

}  // namespace afm::study
