// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string_view>

#include "core/exit_code.h"

// SIGINT, SIGTERM and, unless it is ignored as under nohup, SIGHUP. A dedicated thread receives them, so that they end
// a run at once whatever it is doing: it runs the registered clean-ups and ends the process.
namespace afm::core {

// Call once, at the beginning of main, before any other thread exists. A signal then runs the registered clean-ups,
// newest first, logs "interrupted", and ends the process with RunFailed or CodeOfInterruption. Exceeding the file size
// limit no longer ends the process: write() fails. Throws std::system_error if no thread can be started.
void take_interruptions();

// Ends the process like an interruption, with `line` as the last line of the log. Used where waiting would never end.
// Any thread.
[[noreturn]] void end_at_once(ExitCode code, std::string_view line);

// Registers the clean-up of an interruption for the lifetime of this object. The signal thread calls `undo` while the
// calling thread runs on, so it must be quick and must not touch data owned by one thread.
class OnInterruption {
 public:
  explicit OnInterruption(std::function<void()> undo);
  OnInterruption(const OnInterruption&) = delete;
  OnInterruption& operator=(const OnInterruption&) = delete;
  ~OnInterruption();

 private:
  int number_;
};

// Holds back interruptions during its lifetime. Keep it to a few milliseconds, for steps that belong together.
class Uninterrupted {
 public:
  Uninterrupted();
  Uninterrupted(const Uninterrupted&) = delete;
  Uninterrupted& operator=(const Uninterrupted&) = delete;
  ~Uninterrupted();
};

// Sets the exit code of an interruption to `code` during its lifetime.
class CodeOfInterruption {
 public:
  explicit CodeOfInterruption(ExitCode code);
  CodeOfInterruption(const CodeOfInterruption&) = delete;
  CodeOfInterruption& operator=(const CodeOfInterruption&) = delete;
  ~CodeOfInterruption();
};

// Lets a run end in good order during its lifetime: the run polls interrupted() and ends once it returns true. If it
// has not polled within 400 ms, the registered clean-ups run. After 5 s more, or at a signal more than a second after
// the first, the process ends as above.
class OrderlyEnd {
 public:
  OrderlyEnd();
  OrderlyEnd(const OrderlyEnd&) = delete;
  OrderlyEnd& operator=(const OrderlyEnd&) = delete;
  ~OrderlyEnd();
};

// True after a signal. Used by a run with an OrderlyEnd; any thread.
bool interrupted();

}  // namespace afm::core
