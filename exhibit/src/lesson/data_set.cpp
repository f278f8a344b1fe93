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

#include "core/json_text.h"
#include "core/system_error.h"
#include "core/text_lines.h"
#include "core/whole_file.h"
#include "core/write_all.h"
#include "data_set_texts.h"

namespace afm::exhibit {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr std::size_t kCodeLetters = 6;
constexpr const char* kParticipantColumns = "participant_id\torder\tage_band\tcomfort\n";
constexpr const char* kFirstDay = "first_day";
constexpr mode_t kEventsMode = 0666;
constexpr auto kLockPatience = std::chrono::seconds(5);
constexpr auto kLockPause = std::chrono::milliseconds(10);

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
  std::string age_band = kMissingValue, comfort = kMissingValue;
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

// Text with Unix line ends and without a byte order mark.
std::string plain_lines(std::string_view bytes) {
  std::string text;
  bytes = core::without_byte_order_mark(bytes);
  while (!bytes.empty()) {
    const std::size_t end = bytes.find('\n');
    text += core::without_line_end(bytes.substr(0, end));
    if (end == std::string_view::npos) break;
    text += '\n';
    bytes.remove_prefix(end + 1);
  }
  return text;
}

// Reads participants.tsv; empty if there is no such file yet.
core::Result<std::vector<Participant>> load_participants(const std::string& folder) {
  const std::string path = folder + "/participants.tsv";
  std::vector<Participant> participants;
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return participants;
  const auto bytes = core::read_file(path);
  if (!bytes) return tl::unexpected(bytes.error());
  const std::string text = plain_lines(*bytes);
  const auto bad = [&](std::size_t line, const std::string& what) {
    return core::failure(core::ErrorCategory::BadInputFile, fmt::format("{}: line {}: {}", path, line, what));
  };
  if (!text.starts_with(kParticipantColumns)) return bad(1, "is not the header of a study's participants");
  std::size_t at = std::string_view(kParticipantColumns).size(), number = 1;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::vector<std::string> cells = cells_of(text.substr(at, end - at));
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

// Lowest unused row: reusing the row of a withdrawn participant keeps the design balanced.
std::size_t free_order(std::span<const Participant> participants) {
  std::size_t order = 0;
  const auto taken = [&](const Participant& each) { return each.order == order; };
  while (std::any_of(participants.begin(), participants.end(), taken)) ++order;
  return order;
}

// Beginning of the names of a lesson's files.
std::string task_path(const std::string& folder, const std::string& code, const std::string& lesson) {
  return fmt::format("{}/sub-{}/beh/sub-{}_task-{}", folder, code, code, task_label(lesson));
}

// Writes the files of the data set as a whole, unless they exist.
core::Result<void> describe(const std::string& folder) {
  for (const RootFile& file : root_files()) {
    std::error_code ignored;
    const bool there = std::any_of(file.names.begin(), file.names.end(), [&](const std::string& name) {
      return fs::exists(fs::symlink_status(fmt::format("{}/{}", folder, name), ignored));
    });
    if (there) continue;
    if (auto written = core::write_file(folder + "/" + file.names.front(), file.text); !written) return written;
  }
  return {};
}

// Days since the study's first day, which participants.json stores; 0 if `day` is empty.
core::Result<std::int64_t> started_day(const std::string& folder, std::optional<std::int64_t> day) {
  const std::string path = folder + "/participants.json";
  ordered_json json = participants_json();
  std::error_code ignored;
  bool changed = !fs::exists(path, ignored);
  if (!changed) {
    const auto text = core::read_file(path);
    if (!text) return tl::unexpected(text.error());
    ordered_json old = ordered_json::parse(*text, nullptr, false);
    if (!old.is_object()) {
      return core::failure(core::ErrorCategory::BadInputFile, path + ": is not a JSON object; restore or delete it");
    }
    changed = describe_anew(json, old);
    json = std::move(old);
  }
  std::int64_t first = day.value_or(0);
  const bool known = json.contains("Study") && json["Study"].is_object() && json["Study"].contains(kFirstDay) &&
                     json["Study"][kFirstDay].is_number_integer();
  if (known) first = json["Study"][kFirstDay].get<std::int64_t>();
  if (!known && day) json["Study"][kFirstDay] = *day;
  if (changed || (!known && day)) {
    if (auto written = core::write_file(path, core::json_text(json, 2) + "\n"); !written)
      return tl::unexpected(written.error());
  }
  return day ? *day - first : 0;
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
  // the second one is of an earlier version
  for (const std::string& path : {task_path(folder, code, lesson.id) + "_events.tsv",
                                  fmt::format("{}/sub-{}/task-{}_events.tsv", folder, code, lesson.id)}) {
    std::error_code ignored;
    if (!fs::exists(path, ignored)) continue;
    return core::wrong_usage(fmt::format(
        "{} exists: {} has done this lesson; give another --participant, or delete the participant's data with "
        "--withdraw {}",
        path, code, code));
  }
  return {};
}

core::Result<DataSet> DataSet::create(const Lesson& lesson, const DataSetEntry& entry) {
  DataSet data;
  data.folder_ = entry.folder;
  data.code_ = entry.code;
  data.participant_folder_ = entry.folder + "/sub-" + entry.code;
  const std::string task = task_path(entry.folder, entry.code, lesson.id);
  data.events_path_ = task + "_events.tsv";
  std::error_code error;
  fs::create_directories(data.folder_, error);
  if (error) return tl::unexpected(failed("make", data.folder_, error.value()));
  const auto held = lock(data.folder_);
  if (!held) return tl::unexpected(held.error());
  const std::string trials = fs::path(task).parent_path().string();
  fs::create_directories(trials, error);
  if (error) return tl::unexpected(failed("make", trials, error.value()));
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
  if (auto described = describe(data.folder_); !described) return tl::unexpected(described.error());
  const auto day = started_day(data.folder_, entry.day);
  if (!day) return tl::unexpected(day.error());
  if (auto saved = save_participants(data.folder_, *participants); !saved) return tl::unexpected(saved.error());
  data.description_path_ = task + "_events.json";
  auto written = core::write_file(data.description_path_, events_json(lesson, entry, *day));
  if (!written) return tl::unexpected(written.error());
  data.events_ = core::FileDescriptor(
      ::open(data.events_path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_NOFOLLOW | O_CLOEXEC, kEventsMode));
  if (!data.events_.is_open()) return tl::unexpected(failed("create", data.events_path_, errno));
  if (const int wrong = core::write_all(data.events_.get(), events_header()); wrong != 0) {
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
  return core::write_file(description_path_, core::json_text(json, 2) + "\n");
}

core::Result<void> DataSet::finish(LessonEnd end) {
  events_.close();
  const auto held = lock(folder_);
  if (!held) return tl::unexpected(held.error());
  auto participants = load_participants(folder_);
  if (!participants) return tl::unexpected(participants.error());
  const auto found = find_participant(*participants, code_);
  if (found == participants->end()) return {};  // participant withdrawn in the meantime
  found->comfort = word_of(end);
  return save_participants(folder_, *participants);
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
