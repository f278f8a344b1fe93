// SPDX-License-Identifier: Apache-2.0
#include "app/analyse/fit_batch.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "app/analyse/fit_maps.h"
#include "app/analyse/fit_page.h"
#include "app/analyse/fit_pool.h"
#include "app/options/standard_output.h"
#include "core/file_descriptor.h"
#include "core/freed_memory.h"
#include "core/interruption.h"
#include "core/log.h"
#include "core/printable.h"
#include "core/system_error.h"
#include "core/whole_file.h"
#include "core/write_all.h"
#include "core/written_by.h"
#include "curves/modulus_statistics.h"
#include "physics/quantity_text.h"

namespace afm::app {

namespace {

constexpr const char* kTable = "fits.tsv";
constexpr std::size_t kMostUnwritten = 65536;  // bytes of rows
constexpr const char* kHistograms = "modulus.svg";
constexpr const char* kPage = "report.html";
constexpr const char* kColumns =
    "file\ttrust\treason\tmodulus_Pa\tmodulus_low_Pa\tmodulus_high_Pa\treduced_modulus_Pa\tcontact_m\tlevel_N\ttilt_N_"
    "per_m\t"
    "depth_m\tnoise_N\trms_N\tpoints\tpoints_in_contact\tnoise_order\truns_probability\thalf_depth_modulus_Pa\tspring_"
    "constant_N_per_"
    "m\tshape\t"
    "radius_m\thalf_angle_rad\tlayer_m\tbase\tpoisson_ratio\tagainst\twhite_noise\tmost_force_N\tmost_depth_m\t"
    "law\tW_J_per_m2\tW_low_J_per_m2\tW_high_J_per_m2\tpull_off_N\ttabor\tmodulus_systematic_Pa\tW_systematic_J_per_"
    "m2\t"
    "curve\tx_m\ty_m\tcolumn\trow\tadhesion_N\tsnap_in_N\tcontact_slope_N_per_m\tloop_energy_J\tadhesion_energy_J\t"
    "modulus_bootstrap_low_Pa\tmodulus_bootstrap_high_Pa\tW_bootstrap_low_J_per_m2\tW_bootstrap_high_J_per_m2\t"
    "remarks\tsource\tsoftware\n";

std::string reasons(const fits::ElasticFit& fit) {
  std::string text;
  for (const fits::Found& found : fit.doubts) {
    text += (text.empty() ? "" : "; ") + curves::doubt_text(found);
  }
  return text;
}

// Settings of the fit by column; a size that the shape lacks is empty.
std::vector<std::pair<std::string, std::string>> settings_of(const curves::FitOptions& options) {
  const fits::ShapeRow& shape = fits::row_of(*options.shape);
  const auto cell = [](bool has, double value) { return has ? fmt::format("{}", value) : std::string(); };
  const auto name = [](std::string_view word) { return std::string(word); };
  return {{"shape", name(shape.name)},
          {"radius_m", cell(shape.has_radius, options.radius_m)},
          {"half_angle_rad", cell(!shape.has_radius, options.half_angle_rad)},
          {"layer_m", cell(shape.has_layer, options.layer_m)},
          {"base", shape.is_exact ? name(fits::kBases.at(static_cast<std::size_t>(options.base)).name) : ""},
          {"poisson_ratio", fmt::format("{}", options.poisson)},
          {"against", name(fits::kAgainst.at(static_cast<std::size_t>(options.against)).name)},
          {"white_noise", options.white ? "yes" : "no"},
          {"most_force_N", cell(std::isfinite(options.most_force_n), options.most_force_n)},
          {"most_depth_m", cell(std::isfinite(options.most_depth_m), options.most_depth_m)}};
}

std::string sizes(const curves::FitOptions& options) {
  std::string cells;
  for (const auto& [column, value] : settings_of(options)) cells += (cells.empty() ? "" : "\t") + value;
  return cells;
}

// Texts of the fit in the maps of a file.
FitMaps::Texts map_texts(const curves::FitOptions& options) {
  FitMaps::Texts texts{{"Law", std::string(fits::row_of(*options.shape).meaning)}};
  for (const auto& [column, value] : settings_of(options)) {
    if (!value.empty()) texts.emplace_back(column, value);
  }
  return texts;
}

std::string cell(const std::optional<double>& value) { return value ? fmt::format("{}", *value) : std::string(); }

// Name of the curve, position of its recording, and its figures without a fit.
std::string features(std::size_t index, const curves::FittedCurve& fitted) {
  const auto& position = fitted.position;
  const auto& pixel = fitted.pixel;
  const curves::CurveFigures& figures = fitted.figures;
  return fmt::format(
      "{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}", index, cell(position ? std::optional(position->x_m) : std::nullopt),
      cell(position ? std::optional(position->y_m) : std::nullopt), pixel ? fmt::format("{}", pixel->column) : "",
      pixel ? fmt::format("{}", pixel->row) : "", cell(figures.adhesion_n), cell(figures.snap_in_n),
      cell(figures.contact_slope_n_per_m), cell(figures.loop_energy_j), cell(figures.adhesion_energy_j));
}

// Work of adhesion and systematic parts; cells are empty where the fit has none.
std::string adhesion_cells(const fits::ElasticFit& fit) {
  const auto given = [](bool has, double value) {
    return has && std::isfinite(value) ? fmt::format("{}", value) : std::string();
  };
  const bool adheres = fit.adhesion.has_value(), erred = !fit.systematic.empty();
  const fits::Adhesion adhesion = fit.adhesion.value_or(fits::Adhesion{});
  const fits::SystematicShares shares = fits::sum_of_shares(fit.systematic);
  return fmt::format("{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}", adheres ? fits::row_of(fit.shape).name : "",
                     given(adheres, adhesion.work_j_per_m2), given(adheres, adhesion.work_interval.low),
                     given(adheres, adhesion.work_interval.high), given(adheres, adhesion.pull_off_n),
                     given(adheres, adhesion.tabor), given(erred, shares.modulus * fit.modulus_pa),
                     given(adheres && erred, shares.work * adhesion.work_j_per_m2));
}

// Ends of the intervals by a bootstrap; cells are empty where the fit has none.
std::string bootstrap_cells(const fits::ElasticFit& fit) {
  if (!fit.bootstrap) return "\t\t\t";
  const fits::Interval &modulus_pa = fit.bootstrap->modulus_pa, &work = fit.bootstrap->work_j_per_m2;
  const std::string moduli = fmt::format("{}\t{}\t", modulus_pa.low, modulus_pa.high);
  return moduli + (fit.adhesion ? fmt::format("{}\t{}", work.low, work.high) : "\t");
}

// Remarks of the reading, the publication of the law, and the program.
std::string origin(fits::Shape shape, const curves::FittedCurve& fitted) {
  const std::string remarks = fmt::format("{}", fmt::join(fitted.remarks, "; "));
  return fmt::format("{}\t{}\t{}", core::printable_line(remarks), fits::row_of(shape).meaning, core::written_by());
}

// Path of a file as a cell. A spreadsheet would compute a name that begins like a formula, also within quotes.
std::string path_cell(const std::string& file) {
  const bool is_formula = !file.empty() && std::string_view("=+-@\"").find(file.front()) != std::string_view::npos;
  return (is_formula ? "./" : "") + core::printable_line(file);
}

// Cells that all rows of a file have in common.
struct FileCells {
  FileCells(const std::string& file, const curves::FitOptions& options)
      : name(path_cell(file)), sizes_of_fit(sizes(options)) {}

  std::string name, sizes_of_fit;
};

std::string row_of(const FileCells& file, std::size_t index, const curves::FittedCurve& fitted,
                   const curves::FitOptions& options) {
  if (!fitted.fit) {
    constexpr std::size_t kNumbers = 16, kAdhesionCells = 8;
    return fmt::format("{}\tnone\t{}{}\t{}{}\t{}\t\t\t\t\t{}\n", file.name, core::printable_line(fitted.why),
                       std::string(kNumbers, '\t'), file.sizes_of_fit, std::string(kAdhesionCells, '\t'),
                       features(index, fitted), origin(*options.shape, fitted));
  }
  const fits::ElasticFit& fit = *fitted.fit;
  const auto finite = [](double value) { return cell(std::isfinite(value) ? std::optional(value) : std::nullopt); };
  const std::string order = fit.noise_order ? fmt::format("{}", *fit.noise_order) : "";
  return fmt::format("{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\n",
                     file.name, fits::name_of(fit.trust), reasons(fit), fit.modulus_pa, fit.modulus_interval_pa.low,
                     finite(fit.modulus_interval_pa.high), fit.reduced_modulus_pa, fit.contact_z_m, fit.level_n,
                     cell(options.tilt ? std::optional(fit.tilt_n_per_m) : std::nullopt), fit.depth_m, fit.noise_n,
                     fit.rms_n, fit.points, fit.in_contact, order, fit.runs_p, cell(fit.half_depth_modulus_pa),
                     fitted.spring_n_per_m, file.sizes_of_fit, adhesion_cells(fit), features(index, fitted),
                     bootstrap_cells(fit), origin(fit.shape, fitted));
}

core::Result<void> add_to_table(int table, const std::string& path, std::string_view text) {
  if (const int error = core::write_all(table, text); error != 0) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("cannot write {}: {}", path, core::system_error(error)));
  }
  return {};
}

// A table with its heading. A disk without room for that keeps no empty table, which would refuse the next try.
core::Result<core::FileDescriptor> new_table(const std::string& folder, const std::string& path) {
  std::error_code error, unknown;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder, unknown)) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("--out {}: it is no folder, and none can be made there ({}); name another", folder,
                                     error ? error.message() : core::system_error(ENOTDIR)));
  }
  for (const char* name : {kHistograms, kPage}) {
    if (!std::filesystem::exists(std::filesystem::path(folder) / name, error)) continue;
    return core::wrong_usage(fmt::format("--out {}: it has a {} already; name another folder", folder, name));
  }
  core::FileDescriptor table(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644));
  if (table.is_open()) {
    const auto written = add_to_table(table.get(), path, kColumns);
    if (written) return table;
    std::filesystem::remove(path, error);
    return tl::unexpected(written.error());
  }
  if (errno == EEXIST) {
    return core::wrong_usage(fmt::format("--out {}: it has a {} already; name another folder", folder, kTable));
  }
  return core::failure(core::ErrorCategory::Failed,
                       fmt::format("cannot write {}: {}", path, core::system_error(errno)));
}

class Summary {
 public:
  void add(const curves::FittedCurve& fitted) {
    ++done_;
    if (!fitted.fit) return void(++unread_);
    const auto trust = static_cast<std::size_t>(fitted.fit->trust);
    ++trusts_.at(trust);
    if (fitted.fit->trust != fits::Trust::No) moduli_pa_.push_back(fitted.fit->modulus_pa);
  }

  std::size_t done() const { return done_; }
  bool has_fits() const { return unread_ < done_; }

  std::vector<std::string> lines() const {
    std::vector<std::string> lines{fmt::format("{} curve{}; {} trusted, {} doubtful, {} not trusted, {} without a fit",
                                               done_, done_ == 1 ? "" : "s", trusts_[0], trusts_[1], trusts_[2],
                                               unread_)};
    if (moduli_pa_.empty()) return lines;
    const curves::ModulusFigures figures = curves::modulus_figures(moduli_pa_);
    const auto pressure = [](double pa) {
      return physics::format_quantity(physics::Pressure(pa), physics::kPressureUnits, 4);
    };
    lines.push_back(fmt::format("modulus of the trusted and the doubtful: median {}, deviation {}, geometric mean {}",
                                pressure(figures.median_pa), pressure(figures.deviation_pa),
                                pressure(figures.geometric_mean_pa)));
    return lines;
  }

  // Histograms of the trusted and the doubtful; empty without any.
  std::string histograms() const { return moduli_pa_.empty() ? std::string() : curves::modulus_histograms(moduli_pa_); }

 private:
  std::size_t done_ = 0, unread_ = 0;
  std::array<std::size_t, 3> trusts_{};  // counts in the order of Trust
  std::vector<double> moduli_pa_;
};

// Histograms and page, beside the table.
core::Result<void> write_page(const AnalyseOptions& options, const Summary& summary,
                              const std::vector<std::string>& results, const FitPage& page) {
  const std::filesystem::path folder(options.out);
  const std::string histograms = summary.histograms();
  if (!histograms.empty()) {
    if (auto written = core::write_file((folder / kHistograms).string(), histograms); !written) return written;
  }
  return core::write_file((folder / kPage).string(), page.html(results, map_texts(options.fit), histograms));
}

// Logs each remark on the curves of a file once, and the progress once a second.
class RunLog {
 public:
  void add_remarks(const std::string& file, const curves::FittedCurve& fitted) {
    for (const std::string& remark : fitted.remarks) {
      const std::string line = fmt::format("{}: {}", core::printable_line(file), core::printable_line(remark));
      if (remarks_.size() < curves::kMostRemarks && remarks_.insert(line).second) core::log_line(line);
    }
  }

  void tell_progress(std::size_t whole_files, std::size_t files, std::size_t curves, std::size_t count) {
    const auto now = std::chrono::steady_clock::now();
    if (now - told_ < std::chrono::seconds(1)) return;
    told_ = now;
    if (count == 1) {
      core::log_line(
          fmt::format("fits: {} of {} files, {} %", whole_files + 1, files, 100 * (whole_files + 1) / files));
    } else {
      core::log_line(fmt::format("fits: {} of {} curves of file {} of {}, {} %", curves, count, whole_files + 1, files,
                                 100 * curves / count));
    }
  }

 private:
  std::set<std::string> remarks_;
  std::chrono::steady_clock::time_point told_ = std::chrono::steady_clock::now();
};

}  // namespace

core::Result<void> fit_files(const std::vector<std::string>& files, const AnalyseOptions& options, unsigned threads) {
  core::keep_freed_memory();
  const std::string path = (std::filesystem::path(options.out) / kTable).string();
  auto table = new_table(options.out, path);
  if (!table) return tl::unexpected(table.error());
  const auto write = [&](const std::string& text) { return add_to_table(table->get(), path, text); };
  const core::OrderlyEnd by_itself;
  Summary summary;
  FitPage page;
  std::size_t whole_files = 0;
  core::Result<void> drawn;  // first failure of a picture, which costs no fit
  {
    FitPool pool(files, options, threads);
    RunLog log;
    for (; whole_files < files.size(); ++whole_files) {
      const std::string& file = files[whole_files];
      const auto count = pool.count(whole_files);
      if (!count) break;
      FitMaps maps(*count);
      page.begin(file);
      const FileCells cells(file, options.fit);
      std::string rows;
      std::size_t index = 0;
      for (; index < *count; ++index) {
        const auto fitted = pool.take(whole_files, index);
        if (!fitted) break;
        rows += row_of(cells, index, *fitted, options.fit);
        if (!pool.has_next() || rows.size() > kMostUnwritten) {
          if (const auto written = write(std::exchange(rows, {})); !written) return written;
        }
        log.add_remarks(file, *fitted);
        summary.add(*fitted);
        page.add(*fitted);
        maps.add(*fitted);
        log.tell_progress(whole_files, files.size(), index + 1, *count);
      }
      if (const auto written = write(rows); !written) return written;
      if (index < *count) break;
      pool.forget(whole_files);
      auto pictured = maps.write(options.out, file, map_texts(options.fit));
      if (pictured && !pictured->empty()) page.add_map(std::move(*pictured));
      if (!pictured && drawn) drawn = tl::unexpected(pictured.error());
    }
  }
  const std::vector<std::string> results = summary.lines();
  if (auto written = write_page(options, summary, results, page); !written && drawn) drawn = std::move(written);
  if (const auto printed = write_report(fmt::format("{}: {}\n", core::printable_line(path), fmt::join(results, "\n")));
      !printed)
    return printed;
  if (whole_files < files.size()) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("interrupted: {} has {} curves, and {} of {} files whole", path, summary.done(),
                                     whole_files, files.size()));
  }
  if (summary.has_fits()) return drawn;
  return core::failure(
      core::ErrorCategory::BadInputFile,
      fmt::format("{} a curve that can be fitted; {} has the reasons",
                  files.size() == 1 ? "the file has not" : fmt::format("none of the {} files has", files.size()),
                  path));
}

}  // namespace afm::app
