// SPDX-License-Identifier: Apache-2.0
#include "app/cluster/cluster_start.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "app/cluster/cluster_master.h"
#include "app/display/view_outputs.h"
#include "core/log.h"
#include "core/whole_file.h"
#include "exhibit/cluster/wall_model.h"
#include "exhibit/frame/exhibit_setup.h"
#include "render/renderer.h"
#include "scene/samples/particle_files.h"

namespace afm::app {

namespace {

constexpr int kListenMs = 1500;  // wait for another master, longer than DDS needs to discover one

// Description of the wall. It contains the texts of the files, so that the other machines need no files.
core::Result<exhibit::WallModel> wall_model(const exhibit::ExhibitFiles& files, const WallChoice& choice,
                                            const std::string& program, const exhibit::Stage& stage) {
  exhibit::WallModel model;
  auto build = exhibit::build_digest(program);
  if (!build) return tl::unexpected(build.error());
  model.build = *build;
  model.scene = scene::digest(stage.wall_scene.scene());
  for (const auto& [path, text] : {std::pair(&files.wall, &model.wall), std::pair(&files.guidance, &model.guidance),
                                   std::pair(&files.materials, &model.materials)}) {
    if (path->empty()) continue;
    auto read = core::read_file(*path);
    if (!read) return tl::unexpected(read.error());
    *text = std::move(*read);
  }
  for (const scene::Output& output : stage.wall.outputs) {
    if (output.warp_file.empty() || model.meshes.contains(output.warp_file)) continue;
    if (!exhibit::lies_beside(output.warp_file)) {
      return core::wrong_usage(fmt::format(
          "--cluster: the warp mesh {} of output \"{}\" must lie beside the wall file or in a folder below it",
          output.warp_file, output.name));
    }
    auto mesh = core::read_file((std::filesystem::path(files.wall).parent_path() / output.warp_file).string());
    if (!mesh) return tl::unexpected(mesh.error());
    model.meshes.emplace(output.warp_file, std::move(*mesh));
  }
  model.files = files;
  for (std::string* own : {&model.files.probe, &model.files.sample, &model.files.force_map}) {
    if (!own->empty()) *own = std::filesystem::absolute(*own).string();
  }
  if (std::string& own = model.files.particles; scene::is_particle_path(own)) {
    own = std::filesystem::absolute(own).string();
  }
  model.friction = choice.friction;
  model.picture = choice.picture;
  model.contrast = choice.contrast;
  if (choice.tapping.choice.mode == "tapping") model.tapping = choice.tapping;
  return model;
}

}  // namespace

void add_domain_option(OptionList& command, std::uint32_t& domain) {
  command
      .add_option("--domain", domain,
                  "number of the wall in its network: walls of different numbers do not see each other")
      .within(0, static_cast<int>(cluster::ClusterNetwork::kMostDomain))
      .show_default()
      .type_name("N");
}

Option add_cluster_options(OptionList& command, ClusterOptions& options) {
  const Option cluster =
      command.add_flag("--cluster", options.wanted,
                       "also show the wall on the other machines in its file, each of which runs touchafm node; the "
                       "hand stays on this one");
  add_network_options(command, options);
  return cluster;
}

void add_network_options(OptionList& command, ClusterOptions& options) {
  command
      .add_option("--interface", options.interface_address,
                  "with --cluster, address of the network interface to the other machines; default: the one that leads "
                  "to the first")
      .type_name("ADDRESS");
  add_domain_option(command, options.domain);
}

core::Result<cluster::ClusterNetwork> master_network(const ClusterOptions& options, const scene::Wall& wall) {
  cluster::ClusterNetwork network{
      .interface_address = options.interface_address, .peers = {}, .domain = options.domain};
  std::vector<std::string> hosts;
  for (const scene::WallNode& node : wall.nodes) {
    auto address = cluster::address_of_host(node.host);
    if (!address)
      return tl::unexpected(
          core::Error{address.error().category, fmt::format("node \"{}\": {}", node.name, address.error().message)});
    hosts.push_back(std::move(*address));
  }
  if (network.interface_address.empty()) {
    auto towards = cluster::interface_towards(hosts.front());
    if (!towards) return tl::unexpected(towards.error());
    network.interface_address = std::move(*towards);
  }
  const auto found = cluster::find_interface(network.interface_address);
  if (!found) return tl::unexpected(found.error());
  network.interface_address = found->address;
  if (!found->multicast) network.peers = hosts;
  return network;
}

core::Result<void> check_one_machine(const scene::Wall& wall, const WindowOptions& window, std::string_view remedy) {
  const bool elsewhere = std::any_of(wall.outputs.begin(), wall.outputs.end(),
                                     [](const scene::Output& output) { return output.node.has_value(); });
  if (!elsewhere || window.size_px || !window.monitor.empty() || window.full_screen) return {};
  return core::wrong_usage(
      fmt::format("the wall has outputs on other machines: add {}--size to show it in one window", remedy));
}

core::Result<OpenedMaster> open_master(const ClusterOptions& options, const exhibit::ExhibitFiles& files,
                                       const WallChoice& choice, const std::string& program,
                                       const exhibit::Stage& stage, const core::Clock& clock) {
  if (stage.wall.nodes.empty()) {
    return core::wrong_usage(
        "--cluster: the wall file names no other machine; add [[node]] to it, with a name and a host, and node = "
        "\"NAME\" to its outputs");
  }
  auto network = master_network(options, stage.wall);
  if (!network) return tl::unexpected(network.error());
  const auto model = wall_model(files, choice, program, stage);
  if (!model) return tl::unexpected(model.error());
  auto link = cluster::MasterLink::open(*network, exhibit::document_of(*model), kListenMs, clock);
  if (!link) return tl::unexpected(link.error());
  return OpenedMaster{std::move(*network), std::move(*link)};
}

core::Result<std::unique_ptr<ClusterMaster>> start_cluster(const ClusterOptions& options,
                                                           const exhibit::ExhibitFiles& files, const WallChoice& choice,
                                                           const std::string& program, exhibit::Stage& stage,
                                                           const core::Clock& clock) {
  auto opened = open_master(options, files, choice, program, stage, clock);
  if (!opened) return tl::unexpected(opened.error());
  const cluster::ClusterNetwork& network = opened->network;
  core::log_line(fmt::format("cluster: session {:x}, {} nodes, interface {}, domain {}, {}", opened->link->session(),
                             stage.wall.nodes.size(), network.interface_address, network.domain,
                             network.peers.empty() ? "multicast" : "no multicast"));
  auto master = std::make_unique<ClusterMaster>(std::move(opened->link), stage.wall, stage.wall_scene.contact_m(),
                                                stage.materials.materials.size(), clock);
  scene::keep_outputs_of(std::nullopt, stage.wall);
  return master;
}

}  // namespace afm::app
