// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string_view>

#include "core/exit_code.h"

// SIGINT and SIGTERM. A thread of their own takes them, so that they end a run at once whatever it is doing: what it
// would leave behind is undone, and the process is over.
namespace afm::core {

// Once, at the beginning of main, before there is any other thread: a signal undoes what is registered, the newest
// first, logs "interrupted", and ends the process with RunFailed or CodeOfInterruption. A limit on the size of files
// ends nothing any more: write() fails. Throws std::system_error if no thread can be started.
void take_interruptions();

// Ends the process as an interruption does, but with `line` as its last words: for what would be waited for without
// end. Any thread.
[[noreturn]] void end_at_once(ExitCode code, std::string_view line);

// Registers the clean-up of an interruption for the lifetime of this object. `undo` is called by the signals' thread
// while this one runs on; it must be quick, and what it touches must not belong to one thread alone.
class OnInterruption {
 public:
  explicit OnInterruption(std::function<void()> undo);
  OnInterruption(const OnInterruption&) = delete;
  OnInterruption& operator=(const OnInterruption&) = delete;
  ~OnInterruption();

 private:
  int number_;
};

// No interruption takes effect while this lives: some milliseconds, for steps that belong together.
class Uninterrupted {
 public:
  Uninterrupted();
  Uninterrupted(const Uninterrupted&) = delete;
  Uninterrupted& operator=(const Uninterrupted&) = delete;
  ~Uninterrupted();
};

// While this lives, an interruption ends the process with `code`.
class CodeOfInterruption {
 public:
  explicit CodeOfInterruption(ExitCode code);
  CodeOfInterruption(const CodeOfInterruption&) = delete;
  CodeOfInterruption& operator=(const CodeOfInterruption&) = delete;
  ~CodeOfInterruption();
};

// While this lives, a run ends by itself: it asks interrupted() often, and ends in good order once that is true. If it
// has not asked within 400 ms, what is registered is undone; within 5 s more, or at a signal that comes more than a
// second after the first, the process is ended as above.
class OrderlyEnd {
 public:
  OrderlyEnd();
  OrderlyEnd(const OrderlyEnd&) = delete;
  OrderlyEnd& operator=(const OrderlyEnd&) = delete;
  ~OrderlyEnd();
};

// True after a signal. For a run with an OrderlyEnd; any thread.
bool interrupted();

}  // namespace afm::core
