// SPDX-License-Identifier: Apache-2.0
#include "servo/frame_log.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <iterator>
#include <numbers>
#include <string_view>
#include <utility>

#include "core/system_error.h"
#include "core/written_by.h"

namespace afm::servo {

namespace {

constexpr mode_t kFrameLogMode = 0666;  // file mode, minus the user's umask
constexpr double kDegreesPerRad = 180.0 / std::numbers::pi;
constexpr int kReaderPatienceMs = 5000;
constexpr auto kBetweenWrites = std::chrono::milliseconds(500);

constexpr const char* kColumns =
    "# time_s: begin of the frame, since the start; drawn_ms: time until it was presented; interval_ms: time since the "
    "previous frame\n"
    "# head_latency_ms: time from a tracker's packet to the presentation of the first frame that it moved\n"
    "# nearest_deg, farthest_deg: disparity of the nearest and farthest point, measured four times a second\n"
    "# ipd_mm: eye distance of the picture; servo_late_us: scheduling latency of the latest tick; servo_missed: ticks "
    "missed in total\n"
    "# pose_age_ms: age of the pose of a headset's eyes when its runtime got the picture that was drawn for it\n"
    "# headset: the picture in it is shown or hidden, its runtime is frozen, or it is off; empty without a headset\n"
    "frame,time_s,drawn_ms,interval_ms,head_latency_ms,nearest_deg,farthest_deg,ipd_mm,servo_late_us,servo_missed,"
    "pose_age_ms,headset\n";

core::Result<void> cannot_log(const std::string& path, int error) {
  std::string why = core::system_error(error);
  if (error == ENXIO) why = "no program reads from it";
  if (error == EAGAIN) why = "the program that reads from it took nothing for 5 s";
  return core::failure(core::ErrorCategory::Failed,
                       fmt::format("--frame-log: cannot write {} ({}); name a file in a writable folder", path, why));
}

// Like core::write_all(), but waits only a while for the reader of a pipe.
int write_patiently(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(written));
    } else if (written < 0 && errno == EAGAIN) {
      pollfd room{.fd = descriptor, .events = POLLOUT, .revents = 0};
      if (::poll(&room, 1, kReaderPatienceMs) == 0) return EAGAIN;
    } else if (written < 0 && errno != EINTR) {
      return errno;
    }
  }
  return 0;
}

std::string text_of(const std::optional<double>& value, double factor) {
  return value ? fmt::format("{:.3f}", factor * *value) : "";
}

}  // namespace

std::optional<std::uint32_t> ServoLateness::since_last(const scene::ServoTiming& timing) {
  std::optional<std::uint32_t> latest;
  if (timing.ticks > before_.ticks) {
    for (std::size_t us = timing.wake_us.size(); us > 0 && !latest; --us) {
      if (timing.wake_us[us - 1] > before_.wake_us[us - 1]) latest = static_cast<std::uint32_t>(us - 1);
    }
    // the last bin holds all later ticks
    if (latest == timing.wake_us.size() - 1) latest = timing.wake_max_us;
  }
  before_ = timing;
  return latest;
}

core::Result<std::unique_ptr<FrameLog>> FrameLog::create(const std::string& path, std::int64_t start_ns) {
  // opening a pipe without a reader fails instead of blocking
  constexpr int kHow = O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOCTTY | O_NONBLOCK;
  core::FileDescriptor file(::open(path.c_str(), kHow, kFrameLogMode));
  if (!file.is_open()) return tl::unexpected(cannot_log(path, errno).error());
  return std::unique_ptr<FrameLog>(new FrameLog(path, std::move(file), start_ns));
}

FrameLog::FrameLog(std::string path, core::FileDescriptor file, std::int64_t start_ns)
    : path_(std::move(path)),
      file_(std::move(file)),
      start_ns_(start_ns),
      waiting_(fmt::format("# {}: frames of touchafm view\n{}", core::written_by(), kColumns)),
      writer_([this] { write_all_that_comes(); }) {}

FrameLog::~FrameLog() { end(); }

void FrameLog::add(const FrameRecord& frame) {
  const auto ms = [](std::int64_t ns) { return 1e-6 * static_cast<double>(ns); };
  const std::int64_t before_ns = std::exchange(presented_before_ns_, frame.presented_ns);
  const std::lock_guard lock(changing_);
  fmt::format_to(std::back_inserter(waiting_), "{},{:.6f},{:.3f},{},{},{},{},{:.1f},{},{},{},{}\n", frames_++,
                 1e-9 * static_cast<double>(frame.begun_ns - start_ns_), ms(frame.presented_ns - frame.begun_ns),
                 before_ns == 0 ? "" : fmt::format("{:.3f}", ms(frame.presented_ns - before_ns)),
                 text_of(frame.head_latency_s, 1e3), text_of(frame.nearest_rad, kDegreesPerRad),
                 text_of(frame.farthest_rad, kDegreesPerRad), 1e3 * frame.ipd_m,
                 frame.servo_late_us ? std::to_string(*frame.servo_late_us) : "", frame.servo_missed,
                 text_of(frame.pose_age_s, 1e3), frame.headset);
}

void FrameLog::write_all_that_comes() {
  for (bool ended = false; !ended;) {
    std::string lines;
    {
      std::unique_lock lock(changing_);
      more_.wait_for(lock, kBetweenWrites, [this] { return ending_; });
      ended = ending_;
      lines.swap(waiting_);
    }
    if (error_ == 0) error_ = write_patiently(file_.get(), lines);
  }
}

void FrameLog::end() {
  if (!writer_.joinable()) return;
  {
    const std::lock_guard lock(changing_);
    ending_ = true;
  }
  more_.notify_one();
  writer_.join();
}

core::Result<void> FrameLog::finish() {
  end();
  return error_ == 0 ? core::Result<void>{} : cannot_log(path_, error_);
}

}  // namespace afm::servo
