// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>
#include <sys/resource.h>

#include <chrono>
#include <exception>
#include <future>
#include <stop_token>
#include <thread>
#include <utility>

#include "python/unlocked.h"

namespace afm::python {

// True in the thread in which Python handles signals.
inline bool handles_signals() {
  const auto threading = pybind11::module_::import("threading");
  return threading.attr("get_ident")().equal(threading.attr("main_thread")().attr("ident"));
}

// Runs work(stop) without Python's lock and returns its result. It runs in another thread while this one looks for
// signals, so that Ctrl-C raises KeyboardInterrupt within 0.2 s. Work that does not look at `stop` then continues to
// its end in the background, and its result is lost: it must own all that it uses.
template <class Work>
auto long_work(Work work) -> decltype(work(std::stop_token())) {
  using Result = decltype(work(std::stop_token()));
  constexpr std::chrono::milliseconds kLook(50);
  constexpr int kNicer = 5;  // lower priority than Python's own threads where all cores are busy
  const bool watches = handles_signals();
  Unlocked unlocked;
  std::promise<Result> promise;
  std::future<Result> result = promise.get_future();
  std::jthread thread([work = std::move(work), promise = std::move(promise)](const std::stop_token& stop) mutable {
    // affects this thread and those that it starts; if refused, their priority stays as it was
    ::setpriority(PRIO_PROCESS, 0, ::getpriority(PRIO_PROCESS, 0) + kNicer);
    try {
      promise.set_value(work(stop));
    } catch (...) {
      promise.set_exception(std::current_exception());
    }
  });
  while (result.wait_for(kLook) != std::future_status::ready) {
    if (!watches) continue;
    const pybind11::gil_scoped_acquire locked;
    if (PyErr_CheckSignals() == 0) continue;
    thread.request_stop();
    if (result.wait_for(kLook) != std::future_status::ready) thread.detach();
    throw pybind11::error_already_set();
  }
  unlocked.lock();
  return result.get();
}

}  // namespace afm::python
