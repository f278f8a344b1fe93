// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/file_descriptor.h"

namespace afm::curves {

// Time limits of a child.
struct ChildTime {
  std::chrono::milliseconds patience;  // longest wait for a result, or for each message of a stream
  std::chrono::seconds processor_time;
};
inline constexpr ChildTime kFileTime{std::chrono::seconds(20), std::chrono::seconds(3)};
// Limits for a file with up to a million curves; a stream waits until each of them has been used.
inline constexpr ChildTime kMapTime{std::chrono::minutes(2), std::chrono::minutes(1)},
    kStreamTime{std::chrono::minutes(2), std::chrono::hours(1)};

// Exit status of a child. Done: its result was written. Fault: a fault of the file was written. Failed: neither could
// be written.
enum class ChildExit : int { Done = 0, Fault = 1, Failed = 2 };

// Runs `work` in a forked, confined child (confine_this_process), and returns its result: for libraries that crash on
// damaged files, as HDF5 1.10 does. The child has no descriptors except stderr and its pipe, dies with the calling
// thread, and is killed after its time. Throws CurveError with the child's own message, or `on_death` if it died, and
// std::runtime_error if no child could be created.
//
// Never call it in the servo or a thread that others depend on. If the program has other threads, `work` must not use
// anything that they may have locked, except memory allocation.
std::string in_confined_child(const std::function<std::string()>& work, const std::string& on_death,
                              const ChildTime& time = kFileTime);

// Does so with one of our programs, in the running one's folder or in ../bin, which confines itself. Passes `input` on
// stdin and returns its stdout. Throws std::runtime_error also if there is no such program.
std::string from_confined_program(const std::string& name, const std::vector<std::string>& arguments,
                                  std::string_view input, const std::string& on_death,
                                  const ChildTime& time = kFileTime);

// One message of a child: a result, or a fault of the file, as a sentence.
struct ChildMessage {
  bool fault = false;
  std::string text;
};

// Passes a message to the parent. Throws std::runtime_error if it has gone.
using PutMessage = std::function<void(const ChildMessage&)>;

// Writes a message to stdout, in a program that was started for a stream.
void put_message(const ChildMessage& message);

// A confined child that continues while its messages are read, with the rules of in_confined_child(). At most 256 KiB
// waits unread. One thread, the one that made it. Not moved.
class ConfinedStream {
 public:
  // `on_death` must outlive the object.
  ConfinedStream(const std::function<void(const PutMessage&)>& work, const char* on_death,
                 const ChildTime& time = kStreamTime);
  // Runs one of our programs, as from_confined_program() does, which writes put_message()s.
  ConfinedStream(const std::string& name, const std::vector<std::string>& arguments, std::string_view input,
                 const char* on_death, const ChildTime& time = kStreamTime);
  ConfinedStream(const ConfinedStream&) = delete;
  ConfinedStream& operator=(const ConfinedStream&) = delete;
  ~ConfinedStream();  // kills the child if it runs

  // The next message; empty at the end of the work. A CurveError that ends the work is a message, too. Throws
  // CurveError if the child died, or is late.
  std::optional<ChildMessage> next();

 private:
  // Reads bytes, which are kept until requested. Returns less than `count` at the end, and none too late.
  std::optional<std::string_view> bytes(std::size_t count, std::chrono::steady_clock::time_point end);

  const char* on_death_;
  std::chrono::milliseconds patience_;
  pid_t child_ = -1;
  core::FileDescriptor from_child_;
  std::string unread_;
  std::size_t read_ = 0;  // number of bytes of unread_ that were returned
};

}  // namespace afm::curves
