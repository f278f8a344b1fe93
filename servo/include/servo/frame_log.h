// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "core/file_descriptor.h"
#include "core/result.h"
#include "scene/shared/shared_blocks.h"

namespace afm::servo {

// Record of a frame for --frame-log.
struct FrameRecord {
  std::int64_t begun_ns = 0, presented_ns = 0;
  std::optional<double> head_latency_s{};  // from a tracker's packet to the display of the picture that it changed
  std::optional<double> nearest_rad{}, farthest_rad{};  // limits of the crossed disparity, as last measured
  double ipd_m = 0;                                     // drawn eye distance
  std::optional<std::uint32_t> servo_late_us{};         // largest lateness of a tick since the previous frame
  std::uint64_t servo_missed = 0;                       // number of ticks missed since the servo's start
  std::optional<double> pose_age_s{};  // headset: time from locating the eyes to the runtime's receipt of the picture
  const char* headset = "";            // state of the headset: shown, hidden, frozen, off; empty without a headset
};

// Latest of the ticks that the servo has counted between two frames; empty if it has reported none.
class ServoLateness {
 public:
  std::optional<std::uint32_t> since_last(const scene::ServoTiming& timing);

 private:
  scene::ServoTiming before_;
};

// Log with one CSV line per frame. A thread writes it, so that no frame waits for a disk; write errors are reported at
// the end.
class FrameLog {
 public:
  // Replaces an existing file.
  static core::Result<std::unique_ptr<FrameLog>> create(const std::string& path, std::int64_t start_ns);
  FrameLog(const FrameLog&) = delete;
  FrameLog& operator=(const FrameLog&) = delete;
  ~FrameLog();

  void add(const FrameRecord& frame);

  // Writes the remaining lines. Nothing may be added afterwards.
  core::Result<void> finish();

 private:
  FrameLog(std::string path, core::FileDescriptor file, std::int64_t start_ns);
  void write_all_that_comes();
  void end();

  std::string path_;
  core::FileDescriptor file_;
  std::int64_t start_ns_;
  std::int64_t presented_before_ns_ = 0;
  std::uint64_t frames_ = 0;
  std::mutex changing_;
  std::condition_variable more_;
  std::string waiting_;  // lines not yet written
  bool ending_ = false;
  int error_ = 0;       // errno of the writing thread, read after its end
  std::thread writer_;  // last member, because the thread uses all the others
};

}  // namespace afm::servo
