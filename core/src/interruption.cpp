// SPDX-License-Identifier: Apache-2.0
#include "core/interruption.h"

#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

#include "core/hurry_threads.h"
#include "core/log.h"

namespace afm::core {

namespace {

constexpr auto kBeforeUndoing = std::chrono::milliseconds(400);
constexpr auto kBeforeTheEnd = std::chrono::seconds(5);
constexpr auto kTwice = std::chrono::seconds(1);  // timeout(1) and others signal a process and its group

struct Interruptions {
  std::recursive_mutex undoing;  // guard of `undos`; held while they run, and by Uninterrupted
  std::map<int, std::function<void()>> undos;
  int next_number = 0;

  std::mutex asking;  // guard of the members below
  std::condition_variable heard;
  ExitCode code = ExitCode::RunFailed;
  bool orderly = false;
  bool come = false;
  std::chrono::steady_clock::time_point first_come;
  bool asked_since = false;
};

// Never destroyed: the signal thread outlives main's statics.
Interruptions& interruptions() {
  static auto* const all = new Interruptions;
  return *all;
}

void undo_all() {
  Interruptions& all = interruptions();
  const std::lock_guard lock(all.undoing);
  for (auto undo = all.undos.rbegin(); undo != all.undos.rend(); ++undo) undo->second();
}

// Returns if the run ends by itself.
void interrupt() {
  Interruptions& all = interruptions();
  std::unique_lock lock(all.asking);
  const ExitCode code = all.code;
  const auto now = std::chrono::steady_clock::now();
  const bool first = !std::exchange(all.come, true);
  if (first) all.first_come = now;
  if (!first && all.orderly && now - all.first_come < kTwice) return;
  const auto asked = [&] { return all.asked_since; };
  if (first && all.orderly) {
    if (all.heard.wait_for(lock, kBeforeUndoing, asked)) return;
    lock.unlock();
    undo_all();
    lock.lock();
    if (all.heard.wait_for(lock, kBeforeTheEnd, asked)) return;
  }
  lock.unlock();
  end_at_once(code, "interrupted");
}

}  // namespace

void take_interruptions() {
  sigset_t ending;
  ::sigemptyset(&ending);
  ::sigaddset(&ending, SIGINT);
  ::sigaddset(&ending, SIGTERM);
  // nohup's choice: a blocked signal would arrive although it is ignored
  struct sigaction hangup{};
  if (::sigaction(SIGHUP, nullptr, &hangup) == 0 && hangup.sa_handler != SIG_IGN) ::sigaddset(&ending, SIGHUP);
  ::pthread_sigmask(SIG_BLOCK, &ending, nullptr);
  ::signal(SIGXFSZ, SIG_IGN);  // write() fails beyond the limit, as on a full disk
  std::thread([ending] {
    for (int signal = 0; ::sigwait(&ending, &signal) == 0;) interrupt();
  }).detach();
}

// Takes the lock, so that no step begins that would have to be undone.
void end_at_once(ExitCode code, std::string_view line) {
  const std::lock_guard lock(interruptions().undoing);
  undo_all();
  log_line(line);
  hurry_threads();
  ::_exit(static_cast<int>(code));
}

OnInterruption::OnInterruption(std::function<void()> undo) {
  Interruptions& all = interruptions();
  const std::lock_guard lock(all.undoing);
  number_ = all.next_number++;
  all.undos.emplace(number_, std::move(undo));
}

OnInterruption::~OnInterruption() {
  Interruptions& all = interruptions();
  const std::lock_guard lock(all.undoing);
  all.undos.erase(number_);
}

Uninterrupted::Uninterrupted() { interruptions().undoing.lock(); }
Uninterrupted::~Uninterrupted() { interruptions().undoing.unlock(); }

CodeOfInterruption::CodeOfInterruption(ExitCode code) {
  const std::lock_guard lock(interruptions().asking);
  interruptions().code = code;
}

CodeOfInterruption::~CodeOfInterruption() {
  const std::lock_guard lock(interruptions().asking);
  interruptions().code = ExitCode::RunFailed;
}

OrderlyEnd::OrderlyEnd() {
  const std::lock_guard lock(interruptions().asking);
  interruptions().orderly = true;
}

OrderlyEnd::~OrderlyEnd() {
  const std::lock_guard lock(interruptions().asking);
  interruptions().orderly = false;
}

bool interrupted() {
  Interruptions& all = interruptions();
  const std::lock_guard lock(all.asking);
  if (all.come) {
    all.asked_since = true;
    all.heard.notify_all();
  }
  return all.come;
}

}  // namespace afm::core
