// SPDX-License-Identifier: Apache-2.0
#include "exhibit/lesson/data_set.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "core/system_error.h"
#include "core/version.h"
#include "core/whole_file.h"
#include "core/write_all.h"
#include "study/age_band.h"

namespace afm::exhibit {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char* kMissing = "n/a";
constexpr std::size_t kCodeLetters = 6;
constexpr const char* kParticipantColumns = "participant_id\torder\tage_band\tcomfort\n";
constexpr const char* kFirstDay = "first_day";
constexpr mode_t kEventsMode = 0666;
constexpr auto kLockPatience = std::chrono::seconds(5);
constexpr auto kLockPause = std::chrono::milliseconds(10);

struct ColumnRow {
  const char* name;
  const char* description;
  const char* units;   // may be null
  const char* levels;  // separated by blanks; may be null
};

// Levels with a separate table are added by add_levels().
constexpr std::array kEventColumns{
    ColumnRow{"onset", "start of the trial, counted from the start of the lesson", "s", nullptr},
    ColumnRow{"duration", "duration of the trial", "s", nullptr},
    ColumnRow{"step", "id of the step in the lesson file", nullptr, nullptr},
    ColumnRow{"trial_type", "type of the step", nullptr, nullptr},
    ColumnRow{"condition", "senses that the step left the participant", nullptr, nullptr},
    ColumnRow{"practice", "1 for a practice trial, 0 for a counted one", nullptr, "0 1"},
    ColumnRow{"trial", "number of the trial within its step, from 1", nullptr, nullptr},
    ColumnRow{"level", "w of a threshold's trial: the stronger F_ad is 1 + w times the weaker one", nullptr, nullptr},
    ColumnRow{"stimulus", "identify: material shown; threshold: cycle that let go harder; question: item", nullptr,
              nullptr},
    ColumnRow{"response",
              "identify: material answered; threshold: cycle answered; question: number answered (paper 0 to 4, sus 1 "
              "to 5, tlx 0 to 100, ssq 0 to 3); draw: share of right parts; cycle: F_ad in N",
              nullptr, nullptr},
    ColumnRow{"correct", "1 for a right answer, 0 for a wrong one", nullptr, "0 1"},
    ColumnRow{"rt", "time from the question to the answer", "s", nullptr}};

constexpr std::array kParticipantRows{
    ColumnRow{"participant_id", "sub- and the participant's code of six letters", nullptr, nullptr},
    ColumnRow{"order", "place in the study from 0; modulo the number of orders it is the row of the Williams design",
              nullptr, nullptr},
    ColumnRow{"age_band", "age in years, as a band", nullptr, nullptr},
    ColumnRow{"comfort", "how the participant's newest lesson ended", nullptr, "finished stopped withdrew"}};

ordered_json described(std::span<const ColumnRow> columns) {
  ordered_json json = ordered_json::object();
  for (const ColumnRow& column : columns) {
    ordered_json& entry = json[column.name];
    entry["Description"] = column.description;
    if (column.units != nullptr) entry["Units"] = column.units;
    if (column.levels == nullptr) continue;
    std::string_view rest = column.levels;
    while (!rest.empty()) {
      const std::string_view level = rest.substr(0, rest.find(' '));
      entry["Levels"].push_back(level);
      rest.remove_prefix(std::min(level.size() + 1, rest.size()));
    }
  }
  return json;
}

template <class Rows>
void add_levels(ordered_json& described, const char* column, const Rows& rows) {
  for (const auto& row : rows) described[column]["Levels"].push_back(row.word);
}

core::Error failed(const std::string& what, const std::string& path, int error) {
  return {core::ErrorCategory::Failed, fmt::format("cannot {} {}: {}", what, path, core::system_error(error))};
}

// Locks the study's folder against other processes. Other lessons hold the lock for milliseconds, but anybody who may
// read the folder can hold it for longer.
core::Result<core::FileDescriptor> lock(const std::string& folder) {
  core::FileDescriptor held(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!held.is_open()) return tl::unexpected(failed("open", folder, errno));
  const auto end = std::chrono::steady_clock::now() + kLockPatience;
  while (::flock(held.get(), LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK && errno != EINTR) return tl::unexpected(failed("lock", folder, errno));
    if (std::chrono::steady_clock::now() > end) {
      return core::failure(core::ErrorCategory::Failed,
                           fmt::format("cannot lock {} within {} s: another program holds its lock; \"fuser -v {}\" "
                                       "names it; end it, and try again",
                                       folder, kLockPatience.count(), folder));
    }
    std::this_thread::sleep_for(kLockPause);
  }
  return held;
}

struct Participant {
  std::string id;
  std::size_t order = 0;
  std::string age_band = kMissing, comfort = kMissing;
};

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells{""};
  for (const char c : line) {
    if (c == '\t') {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  return cells;
}

// Reads participants.tsv; empty if there is no such file yet.
core::Result<std::vector<Participant>> load_participants(const std::string& folder) {
  const std::string path = folder + "/participants.tsv";
  std::vector<Participant> participants;
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return participants;
  const auto text = core::read_file(path);
  if (!text) return tl::unexpected(text.error());
  const auto bad = [&](std::size_t line, const std::string& what) {
    return core::failure(core::ErrorCategory::BadInputFile, fmt::format("{}: line {}: {}", path, line, what));
  };
  if (!text->starts_with(kParticipantColumns)) return bad(1, "is not the header of a study's participants");
  std::size_t at = std::string_view(kParticipantColumns).size(), number = 1;
  while (at < text->size()) {
    const std::size_t end = std::min(text->find('\n', at), text->size());
    const std::vector<std::string> cells = cells_of(text->substr(at, end - at));
    at = end + 1;
    ++number;
    const bool digits = cells.size() == 4 && !cells[1].empty() && cells[1].size() < 10 &&
                        std::all_of(cells[1].begin(), cells[1].end(), [](char c) { return c >= '0' && c <= '9'; });
    if (!digits) return bad(number, "must have four columns, the second one a whole number");
    participants.push_back({cells[0], static_cast<std::size_t>(std::stoul(cells[1])), cells[2], cells[3]});
  }
  return participants;
}

core::Result<void> save_participants(const std::string& folder, std::span<const Participant> participants) {
  std::string text = kParticipantColumns;
  for (const Participant& each : participants) {
    text += fmt::format("{}\t{}\t{}\t{}\n", each.id, each.order, each.age_band, each.comfort);
  }
  return core::write_file(folder + "/participants.tsv", text);
}

auto find_participant(std::vector<Participant>& participants, const std::string& code) {
  return std::find_if(participants.begin(), participants.end(),
                      [&](const Participant& each) { return each.id == "sub-" + code; });
}

// The lowest unused row: reusing the row of a withdrawn participant keeps the design balanced.
std::size_t free_order(std::span<const Participant> participants) {
  std::size_t order = 0;
  const auto taken = [&](const Participant& each) { return each.order == order; };
  while (std::any_of(participants.begin(), participants.end(), taken)) ++order;
  return order;
}

// Days since the study's first day, which participants.json stores; 0 if `day` is empty.
core::Result<std::int64_t> started_day(const std::string& folder, std::optional<std::int64_t> day) {
  const std::string path = folder + "/participants.json";
  ordered_json json = described(kParticipantRows);
  add_levels(json, "age_band", study::kAgeBands);
  std::error_code ignored;
  const bool exists = fs::exists(path, ignored);
  if (exists) {
    const auto text = core::read_file(path);
    if (!text) return tl::unexpected(text.error());
    ordered_json old = ordered_json::parse(*text, nullptr, false);
    if (!old.is_object()) {
      return core::failure(core::ErrorCategory::BadInputFile, path + ": is no JSON object; restore or delete it");
    }
    json = std::move(old);
  }
  std::int64_t first = day.value_or(0);
  const bool known = json.contains("Study") && json["Study"].is_object() && json["Study"].contains(kFirstDay) &&
                     json["Study"][kFirstDay].is_number_integer();
  if (known) first = json["Study"][kFirstDay].get<std::int64_t>();
  if (!known && day) json["Study"][kFirstDay] = *day;
  if (!exists || (!known && day)) {
    if (auto written = core::write_file(path, json.dump(2) + "\n"); !written) return tl::unexpected(written.error());
  }
  return day ? *day - first : 0;
}

std::string events_json(const Lesson& lesson, const DataSetEntry& entry, std::int64_t day) {
  ordered_json json = described(kEventColumns);
  add_levels(json, "trial_type", kStepKinds);
  add_levels(json, "condition", kConditions);
  ordered_json titles = ordered_json::object();
  for (std::size_t i = 0; i < kLanguages.size(); ++i) titles[std::string(kLanguages[i].word)] = lesson.title.texts[i];
  json["Lesson"] = {{"id", lesson.id},
                    {"title", titles},
                    {"digest", lesson.digest},
                    {"seed", entry.seed},
                    {"program", core::kVersion},
                    {"device", entry.device},
                    {"scale", scene::text_of(lesson.scale).word},
                    {"wall", entry.wall},
                    {"started_day", day}};
  if (!entry.observer.empty()) json["Lesson"]["observer"] = ordered_json::parse(entry.observer);
  return json.dump(2) + "\n";
}

std::string header_line() {
  std::string line;
  for (const ColumnRow& column : kEventColumns) line += (line.empty() ? "" : "\t") + std::string(column.name);
  return line + "\n";
}

const char* word_of(LessonEnd end) {
  switch (end) {
    case LessonEnd::Finished:
      return "finished";
    case LessonEnd::Stopped:
      return "stopped";
    case LessonEnd::Withdrew:
      break;
  }
  return "withdrew";
}

}  // namespace

bool is_participant_code(std::string_view code) {
  return code.size() == kCodeLetters &&
         std::all_of(code.begin(), code.end(), [](char c) { return c >= 'A' && c <= 'Z'; });
}

core::Result<std::size_t> order_of(const std::string& folder, const std::string& code) {
  auto participants = load_participants(folder);
  if (!participants) return tl::unexpected(participants.error());
  const auto found = find_participant(*participants, code);
  return found == participants->end() ? free_order(*participants) : found->order;
}

core::Result<void> check_not_done(const Lesson& lesson, const std::string& folder, const std::string& code) {
  const std::string path = fmt::format("{}/sub-{}/task-{}_events.tsv", folder, code, lesson.id);
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return {};
  return core::wrong_usage(fmt::format(
      "{} exists: {} has done this lesson; give another --participant, or delete the participant's data with "
      "--withdraw {}",
      path, code, code));
}

core::Result<DataSet> DataSet::create(const Lesson& lesson, const DataSetEntry& entry) {
  DataSet data;
  data.folder_ = entry.folder;
  data.code_ = entry.code;
  data.participant_folder_ = entry.folder + "/sub-" + entry.code;
  const std::string task = data.participant_folder_ + "/task-" + lesson.id;
  data.events_path_ = task + "_events.tsv";
  std::error_code error;
  fs::create_directories(data.folder_, error);
  if (error) return tl::unexpected(failed("make", data.folder_, error.value()));
  const auto held = lock(data.folder_);
  if (!held) return tl::unexpected(held.error());
  fs::create_directories(data.participant_folder_, error);
  if (error) return tl::unexpected(failed("make", data.participant_folder_, error.value()));
  if (auto free = check_not_done(lesson, entry.folder, entry.code); !free) return tl::unexpected(free.error());
  auto participants = load_participants(data.folder_);
  if (!participants) return tl::unexpected(participants.error());
  if (const auto known = find_participant(*participants, entry.code); known != participants->end()) {
    data.order_ = known->order;
  } else {
    data.order_ = entry.order.value_or(free_order(*participants));
    participants->push_back({.id = "sub-" + entry.code, .order = data.order_});
  }
  if (!entry.age_band.empty()) find_participant(*participants, entry.code)->age_band = entry.age_band;
  const auto day = started_day(data.folder_, entry.day);
  if (!day) return tl::unexpected(day.error());
  if (auto saved = save_participants(data.folder_, *participants); !saved) return tl::unexpected(saved.error());
  data.description_path_ = task + "_events.json";
  auto written = core::write_file(data.description_path_, events_json(lesson, entry, *day));
  if (!written) return tl::unexpected(written.error());
  data.events_ = core::FileDescriptor(
      ::open(data.events_path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_NOFOLLOW | O_CLOEXEC, kEventsMode));
  if (!data.events_.is_open()) return tl::unexpected(failed("create", data.events_path_, errno));
  if (const int wrong = core::write_all(data.events_.get(), header_line()); wrong != 0) {
    return tl::unexpected(failed("write", data.events_path_, wrong));
  }
  return data;
}

core::Result<void> DataSet::add(const TrialRow& row) {
  const int error = core::write_all(events_.get(), line_of(row));
  if (error != 0) return tl::unexpected(failed("write", events_path_, error));
  return {};
}

core::Result<void> DataSet::note_sound_lost(double onset_s) {
  const auto text = core::read_file(description_path_);
  if (!text) return tl::unexpected(text.error());
  ordered_json json = ordered_json::parse(*text, nullptr, false);
  if (!json.is_object() || !json["Lesson"].is_object()) {
    return core::failure(core::ErrorCategory::BadInputFile, description_path_ + ": is no longer the lesson's JSON");
  }
  json["Lesson"]["sound_lost_s"] = onset_s;
  return core::write_file(description_path_, json.dump(2) + "\n");
}

core::Result<void> DataSet::finish(LessonEnd end) {
  events_.close();
  const auto held = lock(folder_);
  if (!held) return tl::unexpected(held.error());
  auto participants = load_participants(folder_);
  if (!participants) return tl::unexpected(participants.error());
  const auto found = find_participant(*participants, code_);
  if (found == participants->end()) return {};  // withdrawn in the meantime
  found->comfort = word_of(end);
  return save_participants(folder_, *participants);
}

std::string line_of(const TrialRow& row) {
  const auto or_missing = [](const std::string& text) { return text.empty() ? std::string(kMissing) : text; };
  return fmt::format("{:.3f}\t{:.3f}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\n", row.onset_s, row.duration_s, row.step,
                     word_of(row.kind), row.condition ? word_of(*row.condition) : kMissing, row.practice ? 1 : 0,
                     row.trial, row.level ? fmt::format("{:.6g}", *row.level) : kMissing, or_missing(row.stimulus),
                     or_missing(row.response), row.correct ? (*row.correct ? "1" : "0") : kMissing,
                     row.rt_s ? fmt::format("{:.3f}", *row.rt_s) : kMissing);
}

core::Result<void> withdraw(const std::string& folder, const std::string& code) {
  const auto held = lock(folder);
  if (!held) return tl::unexpected(held.error());
  auto participants = load_participants(folder);
  if (!participants) return tl::unexpected(participants.error());
  const std::string path = folder + "/sub-" + code;
  const auto found = find_participant(*participants, code);
  std::error_code error;
  const bool exists = fs::exists(fs::symlink_status(path, error));
  if (found == participants->end() && !exists) {
    return core::wrong_usage(fmt::format("{} has no participant {}; nothing was deleted", folder, code));
  }
  fs::remove_all(path, error);
  if (error) return tl::unexpected(failed("delete", path, error.value()));
  if (found == participants->end()) return {};
  participants->erase(found);
  return save_participants(folder, *participants);
}

}  // namespace afm::exhibit
