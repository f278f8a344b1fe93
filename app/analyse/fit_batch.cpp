// SPDX-License-Identifier: Apache-2.0
#include "app/analyse/fit_batch.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <iterator>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include "app/analyse/analyse_fit.h"
#include "app/options/standard_output.h"
#include "core/file_descriptor.h"
#include "core/interruption.h"
#include "core/log.h"
#include "core/printable.h"
#include "core/system_error.h"
#include "core/write_all.h"
#include "curves/curve_file.h"
#include "physics/quantity_text.h"

namespace afm::app {

namespace {

constexpr const char* kTable = "fits.tsv";
constexpr const char* kColumns =
    "file\ttrust\treason\tmodulus_Pa\tmodulus_low_Pa\tmodulus_high_Pa\treduced_modulus_Pa\tcontact_m\tlevel_N\ttilt_N_"
    "per_m\t"
    "depth_m\tnoise_N\trms_N\tpoints\tpoints_in_contact\tnoise_order\truns_probability\thalf_depth_modulus_Pa\tspring_"
    "constant_N_per_"
    "m\tshape\t"
    "radius_m\thalf_angle_rad\tlayer_m\tbase\tpoisson_ratio\tagainst\twhite_noise\tmost_force_N\tmost_depth_m\n";

// What is known of one file: a fit with the spring constant it was made with, or why there is none.
struct Fitted {
  std::optional<fits::ElasticFit> fit;
  double spring_n_per_m = 0;
  std::string why;
};

Fitted fitted(const std::string& file, const AnalyseOptions& options) {
  Fitted result;
  auto curve = curves::load_curve(file, options.reading);
  if (!curve) {
    result.why = curve.error().message;
    return result;
  }
  const auto analysed = curves::analysed(file, std::move(*curve), options.contact_method);
  if (!analysed) {
    result.why = analysed.error().message;
    return result;
  }
  auto fit = fit_of(*analysed, options.fit);
  if (!fit) {
    result.why = fit.error().message;
    return result;
  }
  result.fit = std::move(*fit);
  result.fit->model_n = {};  // the curve of the fit, for plots alone
  result.spring_n_per_m = analysed->curve.metadata.spring_constant->si;
  return result;
}

std::string reasons(const fits::ElasticFit& fit) {
  std::string text;
  for (const fits::Found& found : fit.doubts) {
    fmt::format_to(std::back_inserter(text), "{}{} {:.3g} (limit {:g})", text.empty() ? "" : "; ",
                   fits::kDoubts.at(static_cast<std::size_t>(found.doubt)).name, found.figure, found.limit);
  }
  return text;
}

// A size that the shape lacks is an empty cell.
std::string sizes(const FitOptions& options) {
  const fits::ShapeRow& shape = fits::row_of(*options.shape);
  const auto cell = [](bool has, double value) { return has ? fmt::format("{}", value) : std::string(); };
  const std::string_view base = shape.is_exact ? fits::kBases.at(static_cast<std::size_t>(options.base)).name : "";
  return fmt::format("{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}", shape.name, cell(shape.has_radius, options.radius_m),
                     cell(!shape.has_radius, options.half_angle_rad), cell(shape.has_layer, options.layer_m), base,
                     options.poisson, fits::kAgainst.at(static_cast<std::size_t>(options.against)).name,
                     options.white ? "yes" : "no", cell(std::isfinite(options.most_force_n), options.most_force_n),
                     cell(std::isfinite(options.most_depth_m), options.most_depth_m));
}

std::string row_of(const std::string& file, const Fitted& fitted, const FitOptions& options) {
  const std::string name = core::printable_line(file);
  if (!fitted.fit) {
    constexpr std::size_t kNumbers = 16;
    return fmt::format("{}\tnone\t{}{}\t{}\n", name, core::printable_line(fitted.why), std::string(kNumbers, '\t'),
                       sizes(options));
  }
  const fits::ElasticFit& fit = *fitted.fit;
  const auto cell = [](const std::optional<double>& value) {
    return value ? fmt::format("{}", *value) : std::string();
  };
  const auto finite = [&cell](double value) {
    return cell(std::isfinite(value) ? std::optional(value) : std::nullopt);
  };
  const std::string order = fit.noise_order ? fmt::format("{}", *fit.noise_order) : "";
  return fmt::format("{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\n", name,
                     fits::name_of(fit.trust), reasons(fit), fit.modulus_pa, fit.modulus_interval_pa.low,
                     finite(fit.modulus_interval_pa.high), fit.reduced_modulus_pa, fit.contact_z_m, fit.level_n,
                     cell(options.tilt ? std::optional(fit.tilt_n_per_m) : std::nullopt), fit.depth_m, fit.noise_n,
                     fit.rms_n, fit.points, fit.in_contact, order, fit.runs_p, cell(fit.half_depth_modulus_pa),
                     fitted.spring_n_per_m, sizes(options));
}

core::Result<core::FileDescriptor> new_table(const std::string& folder, const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  core::FileDescriptor table(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644));
  if (table.is_open()) return table;
  if (errno == EEXIST) {
    return core::wrong_usage(
        fmt::format("--out {}: it has a {} already; name another folder, or move the table away", folder, kTable));
  }
  return core::failure(core::ErrorCategory::Failed,
                       fmt::format("cannot write {}: {}", path, core::system_error(errno)));
}

// Fits on several threads; hands the results out in order.
class FitPool {
 public:
  FitPool(const std::vector<std::string>& files, const AnalyseOptions& options, unsigned threads)
      : files_(files), options_(options), results_(files.size()) {
    const std::size_t count = std::clamp<std::size_t>(threads, 1, files.size());
    for (std::size_t i = 0; i < count; ++i) {
      workers_.emplace_back([this](const std::stop_token& stop) { work(stop); });
    }
  }

  // At most the files begun are ended.
  ~FitPool() {
    for (std::jthread& worker : workers_) worker.request_stop();
  }
  FitPool(const FitPool&) = delete;
  FitPool& operator=(const FitPool&) = delete;

  // Waits for the result of this file. Empty after an interruption.
  std::optional<Fitted> take(std::size_t file) {
    constexpr std::chrono::milliseconds kLook{100};
    std::unique_lock lock(mutex_);
    while (!results_[file]) {
      if (core::interrupted()) return std::nullopt;
      changed_.wait_for(lock, kLook);
    }
    return std::exchange(results_[file], std::nullopt);
  }

 private:
  void work(const std::stop_token& stop) {
    for (std::size_t i; !stop.stop_requested() && (i = next_.fetch_add(1)) < files_.size();) {
      Fitted result;
      try {
        result = fitted(files_[i], options_);
      } catch (const std::exception& error) {  // a curve too large for this machine's memory
        result.why = fmt::format("cannot fit {}: {}", files_[i], error.what());
      }
      const std::lock_guard lock(mutex_);
      results_[i] = std::move(result);
      changed_.notify_all();
    }
  }

  const std::vector<std::string>& files_;
  const AnalyseOptions& options_;
  std::atomic<std::size_t> next_{0};
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::optional<Fitted>> results_;
  std::vector<std::jthread> workers_;  // last: they end before what they use
};

class Summary {
 public:
  void add(const Fitted& fitted) {
    ++done_;
    if (!fitted.fit) return void(++unread_);
    const auto trust = static_cast<std::size_t>(fitted.fit->trust);
    ++trusts_.at(trust);
    if (fitted.fit->trust != fits::Trust::No) moduli_pa_.push_back(fitted.fit->modulus_pa);
  }

  std::size_t done() const { return done_; }
  bool has_fits() const { return unread_ < done_; }

  std::string text(const std::string& path) {
    std::string text = fmt::format("{}: {} curves; {} trusted, {} doubtful, {} not trusted, {} without a fit\n", path,
                                   done_, trusts_[0], trusts_[1], trusts_[2], unread_);
    if (moduli_pa_.empty()) return text;
    std::sort(moduli_pa_.begin(), moduli_pa_.end());
    const auto at = [&](double share) {
      const auto place = static_cast<std::size_t>(std::lround(share * static_cast<double>(moduli_pa_.size() - 1)));
      return physics::format_quantity(physics::Pressure(moduli_pa_[place]), physics::kPressureUnits, 4);
    };
    return text + fmt::format("modulus of the trusted and the doubtful: median {}, quartiles {} and {}\n", at(0.5),
                              at(0.25), at(0.75));
  }

 private:
  std::size_t done_ = 0, unread_ = 0;
  std::array<std::size_t, 3> trusts_{};  // in the order of Trust
  std::vector<double> moduli_pa_;
};

}  // namespace

core::Result<void> fit_files(const std::vector<std::string>& files, const AnalyseOptions& options, unsigned threads) {
  const std::string path = (std::filesystem::path(options.out) / kTable).string();
  auto table = new_table(options.out, path);
  if (!table) return tl::unexpected(table.error());
  const auto write = [&](const std::string& text) -> core::Result<void> {
    if (const int error = core::write_all(table->get(), text); error != 0) {
      return core::failure(core::ErrorCategory::Failed,
                           fmt::format("cannot write {}: {}", path, core::system_error(error)));
    }
    return {};
  };
  if (const auto written = write(kColumns); !written) return written;
  const core::OrderlyEnd by_itself;
  Summary summary;
  {
    FitPool pool(files, options, threads);
    auto told = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < files.size(); ++i) {
      const auto fitted = pool.take(i);
      if (!fitted) break;
      if (const auto written = write(row_of(files[i], *fitted, options.fit)); !written) return written;
      summary.add(*fitted);
      if (const auto now = std::chrono::steady_clock::now(); now - told >= std::chrono::seconds(1)) {
        told = now;
        core::log_line(fmt::format("fits: {} of {} files, {} %", i + 1, files.size(), 100 * (i + 1) / files.size()));
      }
    }
  }
  if (const auto printed = write_stdout(summary.text(path)); !printed) return printed;
  if (summary.done() < files.size()) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("interrupted: {} has {} of {} files", path, summary.done(), files.size()));
  }
  if (summary.has_fits()) return {};
  return core::failure(
      core::ErrorCategory::BadInputFile,
      fmt::format("none of the {} files has a curve that can be fitted; {} has the reasons", files.size(), path));
}

}  // namespace afm::app
