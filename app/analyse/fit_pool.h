// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "app/analyse/analyse_command.h"
#include "curves/curve_series.h"
#include "curves/fitting/fitted_curve.h"

namespace afm::app {

// Fits the curves of files on several threads, which share a file with several curves, and returns the results in
// order. Keeps results until they are taken: some hundred bytes per curve. One thread calls it.
class FitPool {
 public:
  // Files and options must outlive the object. `options` has a prepared fit.
  FitPool(const std::vector<std::string>& files, const AnalyseOptions& options, unsigned threads);
  ~FitPool();  // ends after the curves that are being fitted
  FitPool(const FitPool&) = delete;
  FitPool& operator=(const FitPool&) = delete;

  // Waits for the number of the file's curves; 1 if it cannot be read. Empty after an interruption.
  std::optional<std::size_t> count(std::size_t file);

  // Waits for the result of one curve, which can be taken once. Empty after an interruption.
  // Results of a file must be taken in order, from the first on.
  std::optional<curves::FittedCurve> take(std::size_t file, std::size_t curve);

  // False if the next take() may have to wait.
  bool has_next() const { return !next_.empty(); }

  // Frees the remaining results of a file.
  void forget(std::size_t file);

 private:
  // A part of a file's curves.
  struct Share {
    std::size_t file = 0;
    curves::SeriesPart part;
  };
  struct Results {
    std::optional<std::size_t> count;
    std::vector<std::optional<curves::FittedCurve>> curves;
  };

  void work(const std::stop_token& stop);
  void begin(std::size_t file);
  void fit_share(const std::stop_token& stop, const Share& share);
  // Results of a file with the indexes of their curves; empty afterwards.
  using Fitted = std::vector<std::pair<std::size_t, curves::FittedCurve>>;
  void put(std::size_t file, Fitted& fitted);
  template <class Ready>
  bool wait(const Ready& ready);

  const std::vector<std::string>& files_;
  const AnalyseOptions& options_;
  const unsigned threads_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t next_file_ = 0;  // first file not yet begun
  std::size_t beginning_ = 0;  // files whose curves are being counted
  std::deque<Share> shares_;
  std::vector<Results> results_;
  std::deque<curves::FittedCurve> next_;  // results for the thread that takes them
  std::vector<std::jthread> workers_;     // last members: they end before the objects that they use
};

}  // namespace afm::app
