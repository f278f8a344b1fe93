// SPDX-License-Identifier: Apache-2.0
#include "app/analyse/map_benchmark.h"

#include <fmt/format.h>
#include <sched.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/analyse/fit_options.h"
#include "app/analyse/fit_pool.h"
#include "app/analyse/reading_options.h"
#include "app/options/standard_output.h"
#include "core/clock.h"
#include "core/json_text.h"
#include "core/log.h"
#include "core/written_by.h"

namespace afm::app {

namespace {

constexpr double kMostReadPerUnzip = 3.0, kMostFitPerUnzip = 6.0, kLeastTwoPerOne = 1.8;
constexpr double kBytesPerMebibyte = 1024.0 * 1024.0;

// Seconds of one run; empty: not measured.
struct MapTimes {
  std::size_t curves = 0, unread = 0, fitted = 0;
  std::size_t threads = 1;
  std::optional<double> unzip_s{};
  double read_s = 0;
  std::optional<double> fit_s{}, fit_alone_s{};  // read and fitted on all threads, and by one thread on one processor
  double unzip_processor_s = 0, fit_processor_s = 0;  // sums over all processes
  double memory_bytes = 0;                            // peaks of this process and of its largest child together
};

// Times `work`, which returns a count.
template <class Work>
double time_of_work(std::size_t& count, const Work& work) {
  const core::MonotonicClock clock;
  const std::int64_t begun_ns = clock.now_ns();
  count = work();
  return 1e-9 * static_cast<double>(clock.now_ns() - begun_ns);
}

double seconds_in(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

// Processor time of this program, including the readers that have ended.
double processor_s() {
  double sum = 0.0;
  for (const int of : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage used{};
    ::getrusage(static_cast<__rusage_who>(of), &used);
    sum += seconds_in(used.ru_utime) + seconds_in(used.ru_stime);
  }
  return sum;
}

// Keeps this thread, and the threads and readers that it starts, on one processor: otherwise a reader works beside its
// thread, and one thread is no measure for two.
class OnOneProcessor {
 public:
  OnOneProcessor() {
    if (::sched_getaffinity(0, sizeof(before_), &before_) != 0) return;
    cpu_set_t one;
    CPU_ZERO(&one);
    for (std::size_t i = 0; i < CPU_SETSIZE; ++i) {
      if (!CPU_ISSET(i, &before_)) continue;
      CPU_SET(i, &one);
      break;
    }
    bound_ = ::sched_setaffinity(0, sizeof(one), &one) == 0;
  }
  ~OnOneProcessor() {
    if (bound_) ::sched_setaffinity(0, sizeof(before_), &before_);
  }
  OnOneProcessor(const OnOneProcessor&) = delete;
  OnOneProcessor& operator=(const OnOneProcessor&) = delete;

 private:
  cpu_set_t before_{};
  bool bound_ = false;
};

// Runs `unzip -t`. False if the program is missing, or the file is no archive.
bool unzips(const std::string& file) {
  std::array<std::string, 3> words{"unzip", "-tqq", file};
  const std::array arguments{words[0].data(), words[1].data(), words[2].data(), static_cast<char*>(nullptr)};
  posix_spawn_file_actions_t to_stderr;
  ::posix_spawn_file_actions_init(&to_stderr);
  ::posix_spawn_file_actions_adddup2(&to_stderr, STDERR_FILENO, STDOUT_FILENO);
  pid_t child = 0;
  const bool started = ::posix_spawnp(&child, arguments.front(), &to_stderr, nullptr, arguments.data(), environ) == 0;
  ::posix_spawn_file_actions_destroy(&to_stderr);
  int status = 0;
  return started && ::waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

// Reads every curve and discards it; returns the number of unreadable ones.
std::size_t unread_of(const std::string& file, const MapTimes& times, const curves::CurveReading& reading) {
  std::atomic<std::size_t> unread{0};
  std::vector<std::jthread> readers;
  readers.reserve(times.threads);
  for (std::size_t first = 0; first < times.threads; ++first) {
    readers.emplace_back([&, first] {
      curves::read_curves(file, times.curves, {first, times.threads}, reading,
                          [&unread](std::size_t, const core::Result<curves::RecordedCurve>& curve) {
                            if (!curve) ++unread;
                            return true;
                          });
    });
  }
  readers.clear();
  return unread;
}

std::size_t fitted_of(const AnalyseOptions& options, std::size_t curves, std::size_t threads) {
  const std::vector<std::string> files{options.file};
  FitPool pool(files, options, static_cast<unsigned>(threads));
  std::size_t fitted = 0;
  if (!pool.count(0)) return 0;
  for (std::size_t i = 0; i < curves; ++i) {
    const auto result = pool.take(0, i);
    if (!result) break;
    if (result->fit) ++fitted;
  }
  return fitted;
}

double peak_of_memory() {
  rusage self{}, children{};
  ::getrusage(RUSAGE_SELF, &self);
  ::getrusage(RUSAGE_CHILDREN, &children);
  return 1024.0 * static_cast<double>(self.ru_maxrss + children.ru_maxrss);
}

core::Result<MapTimes> time_map(const AnalyseOptions& options) {
  const auto count = curves::curve_count(options.file, options.reading);
  if (!count) return tl::unexpected(count.error());
  MapTimes times{.curves = *count, .threads = std::max(1U, std::thread::hardware_concurrency())};
  bool is_archive = false;
  std::size_t counted = 0;
  core::log_line("bench maps: unzip -t");
  double before_s = processor_s();
  const double unzip_s = time_of_work(counted, [&] {
    is_archive = unzips(options.file);
    return std::size_t{0};
  });
  if (is_archive) times.unzip_s = unzip_s;
  times.unzip_processor_s = processor_s() - before_s;
  core::log_line("bench maps: reading");
  times.read_s = time_of_work(times.unread, [&] { return unread_of(options.file, times, options.reading); });
  if (times.unread == times.curves) {
    const auto first = curves::load_curve(options.file, options.reading);
    if (!first) return tl::unexpected(first.error());
  }
  if (!options.fit.shape) return times;
  core::log_line("bench maps: fitting");
  before_s = processor_s();
  times.fit_s = time_of_work(times.fitted, [&] { return fitted_of(options, times.curves, times.threads); });
  times.fit_processor_s = processor_s() - before_s;
  times.memory_bytes = peak_of_memory();
  core::log_line("bench maps: fitting on one processor");
  const OnOneProcessor bound;
  times.fit_alone_s = time_of_work(times.fitted, [&] { return fitted_of(options, times.curves, 1); });
  return times;
}

std::string map_times_table(const MapTimes& times) {
  std::string text = fmt::format("{} curves, {} cannot be read; {} fitted\n\n{:<32} {:>9}\n", times.curves,
                                 times.unread, times.fitted, "", "s");
  const auto row = [&](const std::string& what, std::optional<double> seconds) {
    if (seconds) text += fmt::format("{:<32} {:>9.2f}\n", what, *seconds);
  };
  row("unzip -t", times.unzip_s);
  row(fmt::format("reading, {} threads", times.threads), times.read_s);
  row(fmt::format("reading and fitting, {} threads", times.threads), times.fit_s);
  row("reading and fitting, one thread", times.fit_alone_s);
  if (times.fit_s) row("  processor time, all threads", times.fit_processor_s);
  text += '\n';
  const auto ratio = [&](const char* what, std::optional<double> of, std::optional<double> to, const char* goal,
                         double bar) {
    if (of && to) text += fmt::format("{}: {:.2f}, {} {:g}\n", what, *of / *to, goal, bar);
  };
  ratio("reading / unzip -t", times.read_s, times.unzip_s, "at most", kMostReadPerUnzip);
  ratio("reading and fitting / unzip -t", times.fit_s, times.unzip_s, "at most", kMostFitPerUnzip);
  if (times.fit_s && times.unzip_s && times.unzip_processor_s > 0.0) {
    const double shared_s = times.fit_processor_s / static_cast<double>(times.threads);
    text += fmt::format("  in processor time, evenly shared: {:.2f}\n", shared_s / times.unzip_processor_s);
  }
  if (times.threads == 2) ratio("two threads against one", times.fit_alone_s, times.fit_s, "at least", kLeastTwoPerOne);
  if (times.memory_bytes > 0.0) {
    text += fmt::format("memory of this program and its largest reader: {:.0f} MiB\n",
                        times.memory_bytes / kBytesPerMebibyte);
  }
  return text;
}

std::string map_times_json(const MapTimes& times) {
  nlohmann::ordered_json root;
  core::name_software(root);
  const auto add = [&](const char* key, std::optional<double> value) {
    root[key] = value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
  };
  root["curves"] = times.curves;
  root["unread"] = times.unread;
  root["fitted"] = times.fitted;
  root["threads"] = times.threads;
  add("unzip_s", times.unzip_s);
  add("read_s", times.read_s);
  add("fit_s", times.fit_s);
  add("fit_on_one_thread_s", times.fit_alone_s);
  root["unzip_processor_s"] = times.unzip_processor_s;
  root["fit_processor_s"] = times.fit_processor_s;
  root["memory_bytes"] = times.memory_bytes;
  return core::json_text(root, 2) + "\n";
}

}  // namespace

void add_map_benchmark(OptionList& bench) {
  OptionList command =
      bench.add_command("maps", "measure how fast the curves of a map are read and fitted, next to unzip -t");
  // shared: the parser writes into it while it lives, the chosen command reads it afterwards
  const auto options = std::make_shared<AnalyseOptions>();
  command.add_option("file", options->file, "file with curves, such as a QI map of JPK").required().type_name("FILE");
  add_reading_options(command, options->reading);
  add_fit_options(command, options->fit);
  command.add_flag("--json", options->json, "print JSON with times in seconds instead of a table");
  command.footer("example: touchafm bench maps cell.jpk-qi-data --fit cone --half-angle 18deg");
  command.when_chosen([options]() -> core::Result<void> {
    if (const auto checked = curves::prepare(options->fit); !checked) return checked;
    const auto times = time_map(*options);
    if (!times) return tl::unexpected(times.error());
    return write_stdout(options->json ? map_times_json(*times) : map_times_table(*times));
  });
}

}  // namespace afm::app
