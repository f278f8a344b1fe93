// SPDX-License-Identifier: Apache-2.0
#include "app/bench/cluster_benchmarks.h"

#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "app/bench/cluster_timing.h"
#include "app/cluster/cluster_start.h"
#include "core/interruption.h"
#include "core/percentiles.h"
#include "core/system_error.h"
#include "core/written_by.h"

namespace afm::app {

namespace {

struct ClusterBenchOptions {
  ClusterTimingPlan plan;
  std::string interface_address = "127.0.0.1";
  std::uint32_t domain = cluster::ClusterNetwork::kUsualDomain;
  int answer = -1;  // node as which to answer instead of measuring; -1: none
  bool elsewhere = false;
  bool json = false;
};

// The nodes on this machine. Destroying the object ends them.
class LocalNodes {
 public:
  static core::Result<std::unique_ptr<LocalNodes>> start(const std::string& program,
                                                         const ClusterBenchOptions& options) {
    std::unique_ptr<LocalNodes> nodes(new LocalNodes());
    for (std::uint32_t i = 0; i < options.plan.nodes; ++i) {
      std::vector<std::string> arguments{program,
                                         "bench",
                                         "cluster",
                                         "--answer",
                                         std::to_string(i),
                                         "--interface",
                                         options.interface_address,
                                         "--domain",
                                         std::to_string(options.domain)};
      std::vector<char*> raw;
      raw.reserve(arguments.size() + 1);
      for (std::string& argument : arguments) raw.push_back(argument.data());
      raw.push_back(nullptr);
      pid_t child = -1;
      if (const int code = ::posix_spawn(&child, program.c_str(), nullptr, nullptr, raw.data(), environ); code != 0) {
        return core::failure(core::ErrorCategory::Failed,
                             fmt::format("cannot start {}: {}", program, core::system_error(code)));
      }
      nodes->children_.push_back(child);
    }
    return nodes;
  }
  LocalNodes(const LocalNodes&) = delete;
  LocalNodes& operator=(const LocalNodes&) = delete;
  ~LocalNodes() {
    for (const pid_t child : children_) ::kill(child, SIGTERM);
    for (const pid_t child : children_) ::waitpid(child, nullptr, 0);
  }

 private:
  LocalNodes() = default;
  std::vector<pid_t> children_;
};

std::uint64_t count_all(const std::vector<std::uint64_t>& numbers) {
  return std::accumulate(numbers.begin(), numbers.end(), std::uint64_t{0});
}

std::string cluster_table(const ClusterTiming& timing, const ClusterTimingPlan& plan) {
  std::string text = fmt::format("{} nodes, {} frames, {:.0f} a second\n\n{:<34} {:>8} {:>8} {:>8}\n", plan.nodes,
                                 timing.frames, plan.frames_per_s, "ms", "p50", "p99", "max");
  const auto row = [&](const char* what, const std::vector<double>& values) {
    const core::Percentiles p = core::percentiles(values);
    text += fmt::format("{:<34} {:>8.2f} {:>8.2f} {:>8.2f}\n", what, p.p50, p.p99, p.max);
  };
  row("skew of the nodes' swaps", timing.skew_ms);
  row("frame sent to shown at the slowest", timing.latency_ms);
  row("wait of the master at the barrier", timing.barrier_ms);
  row("round trip", timing.round_ms);
  const auto [behind, ahead] = std::minmax_element(timing.clock_ms.begin(), timing.clock_ms.end());
  return text +
         fmt::format(
             "\nclocks of the nodes: {:+.2f} to {:+.2f} ms\nframes shown without a node: {}\n"
             "samples that a node did not get: {}\nbytes sent again: {}\nprocessor time of the master: {:.1f} %\n",
             *behind, *ahead, count_all(timing.timeouts), count_all(timing.lost), timing.resent_bytes,
             100.0 * timing.cpu_share);
}

std::string cluster_json(const ClusterTiming& timing, const ClusterTimingPlan& plan) {
  nlohmann::ordered_json root;
  core::name_software(root);
  root["nodes"] = plan.nodes;
  root["frames"] = timing.frames;
  root["frames_per_s"] = plan.frames_per_s;
  const auto row = [&](const char* key, const std::vector<double>& values_ms) {
    const core::Percentiles p = core::percentiles(values_ms);
    root[key] = {{"p50", 1e-3 * p.p50}, {"p99", 1e-3 * p.p99}, {"max", 1e-3 * p.max}};
  };
  row("skew_s", timing.skew_ms);
  row("latency_s", timing.latency_ms);
  row("barrier_s", timing.barrier_ms);
  row("round_trip_s", timing.round_ms);
  root["clock_offset_s"] = nlohmann::json::array();
  for (const double ms : timing.clock_ms) root["clock_offset_s"].push_back(1e-3 * ms);
  root["frames_measured"] = timing.skew_ms.size();
  root["timeouts"] = timing.timeouts;
  root["lost_samples"] = timing.lost;
  root["resent_bytes"] = timing.resent_bytes;
  root["cpu_share"] = timing.cpu_share;
  return root.dump(2) + "\n";
}

core::Result<void> run_cluster_bench(const ClusterBenchOptions& options, const std::string& program) {
  constexpr int kPatienceMs = 5000;
  const core::OrderlyEnd by_itself;
  const core::MonotonicClock clock;
  const auto found = cluster::find_interface(options.interface_address);
  if (!found) return tl::unexpected(found.error());
  cluster::ClusterNetwork network{.interface_address = found->address, .peers = {}, .domain = options.domain};
  if (!found->multicast) network.peers.push_back(found->address);
  if (options.answer >= 0) {
    return answer_frames(network, static_cast<std::uint32_t>(options.answer), kPatienceMs, clock);
  }
  std::unique_ptr<LocalNodes> nodes;
  if (!options.elsewhere) {
    auto started = LocalNodes::start(program, options);
    if (!started) return tl::unexpected(started.error());
    nodes = std::move(*started);
  }
  const auto timing = time_cluster(network, options.plan, clock);
  if (!timing) return tl::unexpected(timing.error());
  std::fputs((options.json ? cluster_json(*timing, options.plan) : cluster_table(*timing, options.plan)).c_str(),
             stdout);
  return {};
}

}  // namespace

void add_cluster_benchmarks(OptionList& bench, const CommandContext& context) {
  OptionList command =
      bench.add_command("cluster", "measure how well the machines of a wall stay in step, with nodes that only sleep");
  const auto options = std::make_shared<ClusterBenchOptions>();
  command.add_option("--nodes", options->plan.nodes, "number of nodes")
      .within(1, static_cast<int>(scene::kMostNodes))
      .show_default();
  command.add_option("--frames", options->plan.frames, "number of frames").within(10, 1'000'000).show_default();
  command.add_option("--rate", options->plan.frames_per_s, "frames in a second")
      .within(1.0, 1000.0)
      .show_default()
      .type_name("HZ");
  command.add_option("--interface", options->interface_address, "address or name of the network interface")
      .show_default()
      .type_name("ADDRESS");
  add_domain_option(command, options->domain);
  command.add_flag("--elsewhere", options->elsewhere, "start no nodes: they run on other machines, each with --answer");
  command
      .add_option("--answer", options->answer,
                  "act as node N, from 0, in a measurement that another machine makes; ends 5 s after it")
      .within(0, static_cast<int>(scene::kMostNodes) - 1)
      .type_name("N");
  command.add_flag("--json", options->json, "print JSON with times in seconds instead of a table");
  command.footer(
      "example: touchafm bench cluster --nodes 3\n"
      "         touchafm bench cluster --nodes 2 --elsewhere --interface 10.0.0.1");
  command.when_chosen([options, &context] { return run_cluster_bench(*options, context.program_path); });
}

}  // namespace afm::app
