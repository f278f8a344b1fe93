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
  std::optional<double> head_latency_s{};               // from a tracker's packet to the presenting of what it moved
  std::optional<double> nearest_rad{}, farthest_rad{};  // crossed disparity, as measured last
  double ipd_m = 0;                                     // that the eyes were drawn for
  std::optional<std::uint32_t> servo_late_us{};         // of the latest tick that the servo has reported since
  std::uint64_t servo_missed = 0;                       // ticks, since the servo's start
  std::optional<double> pose_age_s{};  // of a headset: from locating the eyes to its runtime's getting the picture
  const char* headset = "";            // shown, hidden, frozen, off; empty without one
};

// The latest of the ticks that the servo has counted between two frames; empty: it has reported none.
class ServoLateness {
 public:
  std::optional<std::uint32_t> since_last(const scene::ServoTiming& timing);

 private:
  scene::ServoTiming before_;
};

// A line of CSV a frame. A thread writes, so that no frame waits for a disk; what it cannot write is said at the end.
class FrameLog {
 public:
  // A file that is there is replaced.
  static core::Result<std::unique_ptr<FrameLog>> create(const std::string& path, std::int64_t start_ns);
  FrameLog(const FrameLog&) = delete;
  FrameLog& operator=(const FrameLog&) = delete;
  ~FrameLog();

  void add(const FrameRecord& frame);

  // Writes the rest. Nothing is added after it.
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
  std::string waiting_;  // lines
  bool ending_ = false;
  int error_ = 0;       // of the writing thread, read after its end
  std::thread writer_;  // last: it uses all of the above
};

}  // namespace afm::servo
