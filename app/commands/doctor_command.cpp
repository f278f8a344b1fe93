// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <span>

#include "app/bench/servo_latency.h"
#include "app/doctor/diagnosis.h"
#include "app/doctor/doctor_cluster.h"
#include "app/doctor/fault_bundle.h"
#include "app/doctor/findings_json.h"
#include "app/options/command.h"
#include "core/log.h"
#include "core/percentiles.h"
#include "core/printable.h"
#include "core/whole_file.h"
#include "core/written_by.h"
#include "servo/servo_client.h"

namespace afm::app {

namespace {

constexpr double kDefaultSeconds = 2.0;
constexpr double kShortest = 0.1;
constexpr double kLongest = 600.0;

// Requirements on the servo of a lab machine, over one minute.
constexpr double kLabSeconds = 60.0;
constexpr double kLabLateness_us = 200.0;  // limit for 99.9 % of the ticks

struct DoctorOptions {
  double seconds = kDefaultSeconds;
  bool lab = false;
  bool json = false;
  std::string bundle;  // file for a fault report; empty: none
};

// Rows of the printed histogram, microseconds; the last one is open.
constexpr std::array<std::uint32_t, 8> kUpperEdgesUs{10, 20, 50, 100, 200, 500, 1000, scene::kHistogramBins - 1};

std::string histogram(const char* what, std::span<const std::uint32_t> late_us, std::uint64_t all) {
  constexpr double kBarLength = 40.0;
  std::string text = fmt::format("\n{}, late by    ticks\n", what);
  std::uint32_t from_us = 0;
  for (const std::uint32_t to_us : kUpperEdgesUs) {
    const bool last = to_us == kUpperEdgesUs.back();
    const auto begin = late_us.begin() + from_us;
    const auto end = last ? late_us.end() : late_us.begin() + to_us;
    const std::uint64_t ticks = std::accumulate(begin, end, std::uint64_t{0});
    const double share = static_cast<double>(ticks) / static_cast<double>(std::max<std::uint64_t>(1, all));
    // bar of at least one character for every row with ticks
    const auto bar = static_cast<std::size_t>(ticks == 0 ? 0.0 : std::max(1.0, kBarLength * share));
    const std::string range = last ? fmt::format("{} and more", from_us) : fmt::format("{} to {}", from_us, to_us);
    text += fmt::format("{:>13} \u00b5s {:>9}  {}\n", range, ticks, std::string(bar, '#'));
    from_us = to_us;
  }
  return text;
}

std::string plain(const MachineFacts& facts, const std::vector<Finding>& findings) {
  std::string text;
  for (const Finding& f : findings) text += fmt::format("{:<19} {:<8} {}\n", f.check, word(f.verdict), f.found);
  text += histogram("a plain loop", facts.jitter.late_us, facts.jitter.ticks);
  std::string fix;
  for (const Finding& f : findings) {
    if (f.verdict != Verdict::Good) fix += fmt::format("  {}: {}\n", f.check, f.fix);
  }
  return core::with_software_line(text + (fix.empty() ? "\nno fixes needed\n" : "\nfixes\n" + fix));
}

std::string json(const MachineFacts& facts, const std::vector<Finding>& findings) {
  const SchedulingLatency& jitter = facts.jitter;
  const core::Percentiles late = core::percentiles(jitter.late_us, jitter.max_us);
  nlohmann::json root{{"checks", to_json(findings)},
                      {"wake",
                       {{"rate_hz", servo::kServoRateHz},
                        {"policy", jitter.grant.priority > 0 ? "SCHED_FIFO" : "SCHED_OTHER"},
                        {"ticks", jitter.ticks},
                        {"missed", jitter.missed},
                        {"late_us", {{"p50", late.p50}, {"p99", late.p99}, {"p99.9", late.p999}, {"max", late.max}}},
                        {"histogram_us", jitter.late_us}}}};
  core::name_software(root);
  return root.dump() + "\n";
}

// Runs the real servo with the simulated hand.
core::Result<void> examine_servo(const std::string& program, bool as_json) {
  core::log_line(fmt::format("running the servo for {} s", kLabSeconds));
  const auto wake = measure_servo_wake(program, kLabSeconds);
  if (!wake) return tl::unexpected(wake.error());
  const scene::ServoTiming& servo = wake->servo;
  const core::Percentiles late = core::percentiles(servo.wake_us, servo.wake_max_us);
  const bool met = late.p999 < kLabLateness_us && servo.missed == 0;
  if (as_json) {
    nlohmann::json root{{"servo",
                         {{"rate_hz", servo.rate_hz},
                          {"policy", servo.policy_fifo != 0 ? "SCHED_FIFO" : "SCHED_OTHER"},
                          {"ticks", servo.ticks},
                          {"missed", servo.missed},
                          {"late_us", {{"p50", late.p50}, {"p99", late.p99}, {"p99.9", late.p999}, {"max", late.max}}},
                          {"histogram_us", servo.wake_us},
                          {"met", met}}}};
    core::name_software(root);
    std::fputs((root.dump() + "\n").c_str(), stdout);
  } else {
    std::fputs(
        (histogram("the servo", servo.wake_us, servo.ticks) +
         fmt::format("\nlate by p50 {:.0f}, p99 {:.0f}, p99.9 {:.0f}, max {:.0f} \u00b5s; {} of {} ticks missed\n",
                     late.p50, late.p99, late.p999, late.max, servo.missed, servo.ticks + servo.missed))
            .c_str(),
        stdout);
  }
  if (met) return {};
  return core::failure(core::ErrorCategory::Failed,
                       fmt::format("this machine does not meet the lab limits: p99.9 is {:.0f} us, the limit is {:.0f} "
                                   "us; {} ticks were missed; see docs/host-tuning.md",
                                   late.p999, kLabLateness_us, servo.missed));
}

core::Result<void> examine(const std::string& program, const DoctorOptions& options) {
  if (!(options.seconds >= kShortest && options.seconds <= kLongest)) {
    return core::failure(
        core::ErrorCategory::WrongUsage,
        fmt::format("cannot measure for {} s: give --seconds {} to {}", options.seconds, kShortest, kLongest));
  }
  if (options.lab) return examine_servo(program, options.json);
  const core::MonotonicClock clock;
  const MachineFacts facts = look_at_machine(clock, program, options.seconds);
  std::vector<Finding> findings = diagnose(facts);
  for (Finding& f : findings) f.found = core::printable_line(f.found);
  if (!options.bundle.empty()) {
    auto written = core::write_file(options.bundle, fault_bundle(facts, plain(facts, findings)));
    if (!written) return written;
    core::log_line("written: " + options.bundle +
                   "; read it, describe the problem in it, and attach it to your report");
  }
  std::fputs((options.json ? json(facts, findings) : plain(facts, findings)).c_str(), stdout);
  return {};
}

}  // namespace

void add_doctor_command(OptionList& program, const CommandContext& context) {
  OptionList command = program.add_command("doctor", "check this machine and print a fix for each problem");
  const auto options = std::make_shared<DoctorOptions>();
  command
      .add_option("--seconds", options->seconds, "duration of the latency measurement in a 1 kHz loop, s, 0.1 to 600")
      .show_default()
      .type_name("SECONDS");
  command.add_flag("--lab", options->lab,
                   "run the servo itself for 60 s instead; exit code 1 if it misses a tick or if p99.9 of its latency "
                   "reaches 200 us");
  command.add_flag("--json", options->json, "print the findings and the histogram as JSON, with the unit in each key");
  command
      .add_option("--bundle", options->bundle,
                  "write the details for a fault report to FILE: versions, system, devices and findings, without the "
                  "names of people, of this computer or of home folders")
      .writable_file()
      .type_name("FILE");
  const auto cluster = std::make_shared<ClusterCheck>();
  const Option wall = command
                          .add_option("--cluster", cluster->wall,
                                      "check the machines of this wall file (or included wall) instead, each of "
                                      "which runs touchafm node; exit code 1 if one does not show its part")
                          .or_included_in(context.assets_dir + "/walls")
                          .type_name("FILE");
  add_network_options(command, cluster->cluster);
  command.add_option("--patience", cluster->seconds, "with --cluster, time for the machines to answer, s")
      .within(1.0, 600.0)
      .show_default()
      .type_name("SECONDS");
  command.footer(
      "example: touchafm doctor --seconds 10\n"
      "         touchafm doctor --bundle fault.txt\n"
      "         touchafm doctor --cluster wall.toml\n"
      "Needs no special rights and changes nothing. The exit code is 0 whatever it finds, except with --lab and\n"
      "--cluster.");
  command.when_chosen([&context, options, cluster, wall] {
    if (!wall.given()) return examine(context.program_path, *options);
    cluster->json = options->json;
    cluster->files.assets_dir = context.assets_dir;
    cluster->files.language = context.language;
    return examine_cluster(context, *cluster);
  });
}

}  // namespace afm::app
