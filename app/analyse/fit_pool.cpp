// SPDX-License-Identifier: Apache-2.0
#include "app/analyse/fit_pool.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

#include "core/interruption.h"

namespace afm::app {

FitPool::FitPool(const std::vector<std::string>& files, const AnalyseOptions& options, unsigned threads)
    : files_(files), options_(options), threads_(std::max(1U, threads)), results_(files.size()) {
  for (unsigned i = 0; i < threads_; ++i) {
    workers_.emplace_back([this](const std::stop_token& stop) { work(stop); });
  }
}

FitPool::~FitPool() {
  for (std::jthread& worker : workers_) worker.request_stop();
  changed_.notify_all();
}

std::optional<std::size_t> FitPool::count(std::size_t file) {
  return wait([&] { return results_[file].count.has_value(); }) ? results_[file].count : std::nullopt;
}

// All that follow are fetched at once: a lock and a wake-up for each curve would cost as much as its row of the table.
std::optional<curves::FittedCurve> FitPool::take(std::size_t file, std::size_t curve) {
  if (next_.empty()) {
    if (!wait([&] { return results_[file].curves[curve].has_value(); })) return std::nullopt;
    const std::lock_guard lock(mutex_);
    auto& curves = results_[file].curves;
    for (std::size_t i = curve; i < curves.size() && curves[i]; ++i) {
      next_.push_back(std::move(*curves[i]));
      curves[i].reset();
    }
  }
  std::optional<curves::FittedCurve> first(std::move(next_.front()));
  next_.pop_front();
  return first;
}

void FitPool::forget(std::size_t file) {
  const std::lock_guard lock(mutex_);
  results_[file].curves = std::vector<std::optional<curves::FittedCurve>>();
}

template <class Ready>
bool FitPool::wait(const Ready& ready) {
  constexpr std::chrono::milliseconds kLook{100};
  std::unique_lock lock(mutex_);
  while (!ready()) {
    if (core::interrupted()) return false;
    changed_.wait_for(lock, kLook);
  }
  return true;
}

// Works on shares. Those of a file already begun go before the next file, whose results are needed later.
void FitPool::work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    if (!shares_.empty()) {
      const Share share = shares_.front();
      shares_.pop_front();
      lock.unlock();
      fit_share(stop, share);
      lock.lock();
    } else if (next_file_ < files_.size()) {
      const std::size_t file = next_file_++;
      ++beginning_;
      lock.unlock();
      begin(file);
      lock.lock();
    } else if (beginning_ == 0) {
      return;
    } else {
      constexpr std::chrono::milliseconds kLook{100};
      changed_.wait_for(lock, kLook);
    }
  }
}

void FitPool::begin(std::size_t file) {
  Results begun;
  std::string why;
  try {
    const auto counted = curves::curve_count(files_[file], options_.reading);
    if (!counted) why = counted.error().message;
    begun.count = counted.value_or(1);
    begun.curves.resize(*begun.count);
  } catch (const std::exception& error) {  // more curves than fit into this machine's memory
    why = fmt::format("cannot fit {}: {}", files_[file], error.what());
    begun.count = 1;
    begun.curves.resize(1);
  }
  const auto shares = static_cast<unsigned>(std::min<std::size_t>(threads_, *begun.count));
  const std::lock_guard lock(mutex_);
  if (why.empty()) {
    for (unsigned i = 0; i < shares; ++i) shares_.push_back({file, {i, shares}});
  } else {
    begun.curves.front().emplace().why = why;
  }
  results_[file] = std::move(begun);
  --beginning_;
  changed_.notify_all();
}

void FitPool::fit_share(const std::stop_token& stop, const Share& share) {
  using Clock = std::chrono::steady_clock;
  constexpr std::size_t kMostKept = 32;
  constexpr std::chrono::milliseconds kLongestKept{50};
  const std::string& file = files_[share.file];
  const std::size_t count = *results_[share.file].count;
  Fitted fitted;
  fitted.reserve(kMostKept);
  Clock::time_point put_at = Clock::now();
  curves::read_curves(file, count, share.part, options_.reading,
                      [&](std::size_t index, core::Result<curves::RecordedCurve> curve) {
                        fitted.emplace_back(index, curves::fitted_curve(file, std::move(curve), options_.fit,
                                                                        options_.contact_method, options_.baseline));
                        if (fitted.size() == kMostKept || Clock::now() - put_at > kLongestKept) {
                          put(share.file, fitted);
                          put_at = Clock::now();
                        }
                        return !stop.stop_requested();
                      });
  put(share.file, fitted);
}

void FitPool::put(std::size_t file, Fitted& fitted) {
  const std::lock_guard lock(mutex_);
  for (auto& [curve, result] : fitted) results_[file].curves[curve] = std::move(result);
  fitted.clear();
  changed_.notify_all();
}

}  // namespace afm::app
