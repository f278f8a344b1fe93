// SPDX-License-Identifier: Apache-2.0
#include "app/doctor/doctor_cluster.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "app/doctor/diagnosis.h"
#include "app/doctor/findings_json.h"
#include "cluster/clock_offset.h"
#include "cluster/master_link.h"
#include "core/log.h"
#include "core/percentiles.h"
#include "core/printable.h"
#include "core/written_by.h"
#include "exhibit/cluster/frame_inputs.h"
#include "exhibit/cluster/wall_history.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/frame/recorded_wall.h"
#include "exhibit/scan/live_scan.h"

namespace afm::app {

namespace {

constexpr auto kBetweenFrames = std::chrono::milliseconds(50);
constexpr std::size_t kEnoughAnswers = 10;  // number needed from each node
constexpr double kSlowRoundMs = 5.0;        // limit for an idle network

struct NodeAnswers {
  std::optional<cluster::ReadyMessage> newest;
  std::vector<double> round_ms;
  cluster::ClockOffset clock;

  void add(const cluster::ReadyMessage& ready, std::int64_t now_ns) {
    newest = ready;
    if (ready.frame_sent_ns == 0) return;
    round_ms.push_back(1e-6 * static_cast<double>(clock.add(ready, now_ns)));
  }
  bool enough() const {
    return newest && newest->state == cluster::NodeState::Drawing && round_ms.size() >= kEnoughAnswers;
  }
};

// Sends frames of a wall at rest until every node has answered often enough.
std::vector<NodeAnswers> ask_nodes(cluster::MasterLink& link, const exhibit::Stage& stage, double seconds,
                                   const core::Clock& clock) {
  std::vector<NodeAnswers> nodes(stage.wall.nodes.size());
  const exhibit::WallHistory nothing_felt(stage.materials.materials.size());
  cluster::FrameMessage frame;
  exhibit::Moment at_rest;
  exhibit::set_moment(at_rest, {}, "", false, frame);
  frame.view.head = exhibit::pose_of(stage.wall.viewers.front().sweet_spot);
  frame.view.ipd_m = frame.view.drawn_ipd_m = stage.wall.viewers.front().ipd_m;
  const std::int64_t until_ns = clock.now_ns() + static_cast<std::int64_t>(seconds * 1e9);
  std::uint64_t number = 0;
  while (clock.now_ns() < until_ns) {
    link.send(++number, frame);
    std::this_thread::sleep_for(kBetweenFrames);
    bool wanted = false;
    while (const auto answer = link.answer()) {
      if (answer->ready.header.node >= nodes.size()) continue;
      nodes[answer->ready.header.node].add(answer->ready, answer->came_ns);
      wanted = wanted || answer->ready.wants_history != 0;
    }
    if (wanted && !link.sending_history()) {
      link.send_history(exhibit::save_history(0, nothing_felt.cycles, nothing_felt.friction, {}, {}));
    }
    link.swap(number);
    if (std::all_of(nodes.begin(), nodes.end(), [](const NodeAnswers& node) { return node.enough(); })) break;
  }
  return nodes;
}

Finding judge(const scene::WallNode& node, const NodeAnswers& answers, const cluster::ClusterNetwork& network) {
  Finding finding{.check = "node " + node.name, .verdict = Verdict::Missing, .found = {}, .fix = {}};
  if (!answers.newest) {
    finding.found = "does not answer";
    finding.fix = fmt::format(
        "start touchafm node {} --interface ADDRESS{} on {}; if it runs there, this network may forbid multicast: add "
        "--master {}",
        node.name,
        network.domain == cluster::ClusterNetwork::kUsualDomain ? "" : fmt::format(" --domain {}", network.domain),
        node.host, network.interface_address);
    return finding;
  }
  const cluster::ReadyMessage& newest = *answers.newest;
  switch (newest.state) {
    case cluster::NodeState::OtherBuild:
      finding.found = fmt::format("is another build of touchafm: {:016x}", newest.digest);
      finding.fix = fmt::format("install the package of this machine on {}", node.host);
      return finding;
    case cluster::NodeState::OtherScene:
      finding.found = fmt::format("has other models: {:016x}", newest.digest);
      finding.fix = fmt::format("copy the files of --probe and --sample to the same place on {}", node.host);
      return finding;
    case cluster::NodeState::Loading:
      finding.found = "answers, but draws nothing";
      finding.fix = fmt::format("read what touchafm node says on {}", node.host);
      return finding;
    case cluster::NodeState::Drawing:
      break;
  }
  const core::Percentiles round = core::percentiles(answers.round_ms);
  const bool slow = round.p50 > kSlowRoundMs;
  finding.verdict = slow ? Verdict::Limited : Verdict::Good;
  finding.found =
      fmt::format("draws in {:.1f} ms; round trip {:.2f} ms, at most {:.2f} ms; its clock differs by {:+.1f} ms",
                  1e-3 * newest.draw_us, round.p50, round.max, 1e-6 * static_cast<double>(answers.clock.ahead_ns()));
  if (slow) finding.fix = "use a wired network that the wall has for itself";
  return finding;
}

void print_findings(const std::vector<Finding>& findings, bool as_json) {
  if (as_json) {
    nlohmann::json root{{"checks", to_json(findings)}};
    core::name_software(root);
    std::fputs((root.dump() + "\n").c_str(), stdout);
    return;
  }
  std::string text;
  for (const Finding& f : findings) {
    text += fmt::format("{:<19} {:<8} {}\n", f.check, word(f.verdict), core::printable_line(f.found));
    if (f.verdict != Verdict::Good) text += fmt::format("  fix: {}\n", f.fix);
  }
  std::fputs(text.c_str(), stdout);
}

}  // namespace

core::Result<void> examine_cluster(const CommandContext& context, const ClusterCheck& check) {
  const core::MonotonicClock clock;
  exhibit::ExhibitFiles files = check.files;
  files.wall = check.wall;
  auto stage = exhibit::load_exhibit(files);
  if (!stage) return tl::unexpected(stage.error());
  const auto opened = open_master(check.cluster, files, {}, context.program_path, *stage, clock);
  if (!opened) return tl::unexpected(opened.error());
  const auto interface = cluster::find_interface(opened->network.interface_address);
  if (!interface) return tl::unexpected(interface.error());
  std::vector<Finding> findings;
  findings.push_back({.check = "interface",
                      .verdict = interface->up ? Verdict::Good : Verdict::Missing,
                      .found = fmt::format("{} ({}), {}", interface->name, interface->address,
                                           interface->multicast ? "multicast" : "no multicast"),
                      .fix = "plug in the cable, or name another interface with --interface"});
  core::log_line(
      fmt::format("waiting up to {:g} s for the answers of {} machines", check.seconds, stage->wall.nodes.size()));
  const std::vector<NodeAnswers> answers = ask_nodes(*opened->link, *stage, check.seconds, clock);
  for (std::size_t i = 0; i < answers.size(); ++i) {
    findings.push_back(judge(stage->wall.nodes[i], answers[i], opened->network));
  }
  print_findings(findings, check.json);
  const bool whole = std::none_of(findings.begin(), findings.end(),
                                  [](const Finding& finding) { return finding.verdict == Verdict::Missing; });
  if (whole) return {};
  return core::failure(core::ErrorCategory::Failed, "the wall is incomplete; the fixes are above");
}

}  // namespace afm::app
