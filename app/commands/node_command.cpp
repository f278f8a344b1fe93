// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "app/cluster/cluster_start.h"
#include "app/cluster/node_view.h"
#include "app/commands/view_command.h"
#include "app/display/view_display.h"
#include "app/live/view_keys.h"
#include "app/options/command.h"
#include "app/options/dynamic_resolution.h"
#include "app/options/exhibit_options.h"
#include "app/options/pixel_size_option.h"
#include "cluster/node_link.h"
#include "core/exit_code.h"
#include "core/interruption.h"
#include "core/log.h"
#include "core/system_error.h"
#include "exhibit/cluster/wall_model.h"
#include "exhibit/frame/exhibit_setup.h"
#include "render/device_failure.h"
#include "render/renderer.h"

namespace afm::app {

namespace {

struct NodeOptions {
  std::string name;
  std::string interface_address;
  std::string master;  // host name; empty: found by multicast
  std::uint32_t domain = cluster::ClusterNetwork::kUsualDomain;
  DisplayOptions display;
};

// A temporary folder for the texts of the master's files, removed by the destructor.
class PrivateFolder {
 public:
  static core::Result<std::unique_ptr<PrivateFolder>> create() {
    std::string path = (std::filesystem::temp_directory_path() / "touchafm-node-XXXXXX").string();
    if (::mkdtemp(path.data()) == nullptr) {
      return core::failure(core::ErrorCategory::Failed,
                           fmt::format("cannot create the folder {}: {}", path, core::system_error(errno)));
    }
    return std::unique_ptr<PrivateFolder>(new PrivateFolder(std::move(path)));
  }
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;
  ~PrivateFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  const std::string& path() const { return path_; }

 private:
  explicit PrivateFolder(std::string path) : path_(std::move(path)) {}
  std::string path_;
};

core::Result<cluster::ClusterNetwork> node_network(const NodeOptions& options) {
  const auto found = cluster::find_interface(options.interface_address);
  if (!found) return tl::unexpected(found.error());
  cluster::ClusterNetwork network{.interface_address = found->address, .peers = {}, .domain = options.domain};
  if (!options.master.empty()) {
    auto address = cluster::address_of_host(options.master);
    if (!address) return tl::unexpected(address.error());
    network.peers.push_back(std::move(*address));
  } else if (!found->multicast) {
    network.peers.push_back(found->address);  // loopback interface: all nodes on one machine
  }
  return network;
}

core::Result<std::uint32_t> place_of(const std::string& name, const scene::Wall& wall) {
  const auto found = std::find_if(wall.nodes.begin(), wall.nodes.end(),
                                  [&](const scene::WallNode& node) { return node.name == name; });
  if (found != wall.nodes.end()) return static_cast<std::uint32_t>(found - wall.nodes.begin());
  std::string list;
  for (const scene::WallNode& node : wall.nodes) list += (list.empty() ? "" : ", ") + node.name;
  return core::wrong_usage(fmt::format("the master's wall has no node \"{}\"; choose from: {}", name, list));
}

// Reports the reason to the master before this program ends.
core::Error refuse(cluster::NodeLink& link, const cluster::ClusterHeader& header, std::uint32_t node,
                   cluster::NodeState state, std::uint64_t here, std::uint64_t there) {
  constexpr auto kToBeSent = std::chrono::milliseconds(500);
  cluster::ReadyMessage answer{.header = header, .state = state, .digest = here};
  answer.header.node = node;
  link.answer(answer);
  std::this_thread::sleep_for(kToBeSent);
  const bool build = state == cluster::NodeState::OtherBuild;
  return {
      core::ErrorCategory::BadInputFile,
      fmt::format("this machine has {}: {:016x} here, {:016x} on the master; {}",
                  build ? "another build of touchafm" : "other models", here, there,
                  build ? "install the same package" : "copy the master's probe and sample files to the same place")};
}

struct NodeStage {
  cluster::NodeLink::Document document;
  std::uint32_t node = 0;  // index of the node in the wall
  exhibit::WallModel model;
  exhibit::Stage stage;
  std::vector<curves::SampleModel> materials;
};

// Deletes the master's files from the disk before it returns, so that a node killed while it shows them leaves none.
core::Result<std::unique_ptr<NodeStage>> load_stage(const std::string& name, cluster::NodeLink::Document document,
                                                    const CommandContext& context, cluster::NodeLink& link) {
  auto model = exhibit::read_wall_model(document.bytes);
  if (!model) return tl::unexpected(model.error());
  const auto folder = PrivateFolder::create();
  if (!folder) return tl::unexpected(folder.error());
  const auto files = exhibit::unpack(*model, context.assets_dir, (*folder)->path());
  if (!files) return tl::unexpected(files.error());
  const auto wall = scene::load_wall(files->wall);
  if (!wall) return tl::unexpected(wall.error());
  const auto node = place_of(name, *wall);
  if (!node) return tl::unexpected(node.error());
  const auto build = exhibit::build_digest(context.program_path);
  if (!build) return tl::unexpected(build.error());
  if (*build != model->build) {
    return tl::unexpected(refuse(link, document.header, *node, cluster::NodeState::OtherBuild, *build, model->build));
  }
  auto stage = exhibit::load_exhibit(*files);
  if (!stage) return tl::unexpected(stage.error());
  if (const std::uint64_t here = scene::digest(stage->wall_scene.scene()); here != model->scene) {
    return tl::unexpected(refuse(link, document.header, *node, cluster::NodeState::OtherScene, here, model->scene));
  }
  auto materials = exhibit::felt_samples(*stage, model->friction, &model->tapping);
  if (!materials) return tl::unexpected(materials.error());
  scene::keep_outputs_of(*node, stage->wall);
  return std::make_unique<NodeStage>(
      NodeStage{std::move(document), *node, std::move(*model), std::move(*stage), std::move(*materials)});
}

// Shows one wall. Returns the next one if a master has another. A description that cannot be loaded ends nothing here,
// and `earlier`, the wall before, is forgotten once this one's windows are open.
core::Result<std::unique_ptr<NodeStage>> show_wall(const NodeOptions& options, NodeStage& shown,
                                                   std::unique_ptr<NodeStage>& earlier, const CommandContext& context,
                                                   cluster::NodeLink& link, const core::Clock& clock) {
  DisplayOptions display_options = options.display;
  display_options.picture = shown.model.picture;
  display_options.contrast = shown.model.contrast;
  display_options.swap = render::Swap::WithOthers;
  auto display = ViewDisplay::open(shown.stage, display_options, nullptr, clock);
  if (!display) return tl::unexpected(display.error());
  earlier.reset();
  core::log_line(fmt::format("cluster: session {:x}: node {} of the wall, {} of its outputs",
                             shown.document.header.session, options.name, shown.stage.wall.outputs.size()));
  NodeView view(shown.stage, shown.materials, **display, link,
                {.node = shown.node, .session = shown.document.header.session, .model = shown.document.bytes}, key_list,
                clock);
  std::unique_ptr<NodeStage> next;
  const auto prepare = [&](const cluster::NodeLink::Document& other) {
    auto loaded = load_stage(options.name, other, context, link);
    if (!loaded) {
      core::log_line(fmt::format("cluster: another wall was announced, but cannot be shown: {}; this one goes on",
                                 loaded.error().message));
      return false;
    }
    next = std::move(*loaded);
    return true;
  };
  try {
    view.run(prepare);
  } catch (const render::DeviceFailure& failure) {
    return core::failure(core::ErrorCategory::Failed, failure.what());
  }
  return next;
}

// Shows one wall after the other until the program is interrupted or a window closed.
core::Result<void> show_walls(const NodeOptions& options, const CommandContext& context, cluster::NodeLink& link,
                              const core::Clock& clock) {
  std::unique_ptr<NodeStage> shown, earlier;
  while (!core::interrupted()) {
    if (!shown) {
      auto document = link.model();
      if (!document) {
        link.wait(50);
        continue;
      }
      auto loaded = load_stage(options.name, std::move(*document), context, link);
      if (!loaded) return tl::unexpected(loaded.error());
      shown = std::move(*loaded);
    }
    auto next = show_wall(options, *shown, earlier, context, link, clock);
    if (!next && earlier) {
      core::log_line(fmt::format("cluster: the next wall cannot be shown here: {}; showing the one before again",
                                 next.error().message));
      shown = std::move(earlier);
      continue;
    }
    if (!next) return tl::unexpected(next.error());
    if (!*next) return {};
    earlier = std::exchange(shown, std::move(*next));
  }
  return {};
}

core::Result<void> run_node(const NodeOptions& options, const CommandContext& context) {
  const core::CodeOfInterruption ended(core::ExitCode::Done);
  const core::OrderlyEnd by_itself;
  const core::MonotonicClock clock;
  const auto network = node_network(options);
  if (!network) return tl::unexpected(network.error());
  auto link = cluster::NodeLink::open(*network, clock);
  if (!link) return tl::unexpected(link.error());
  core::log_line(fmt::format("cluster: node {} waits for the machine with the hand on {}, domain {}", options.name,
                             network->interface_address, network->domain));
  auto shown = show_walls(options, context, **link, clock);
  core::log_line(fmt::format("cluster: node {} ends; {} datagrams refused", options.name, (*link)->refused()));
  return shown;
}

}  // namespace

void add_node_command(OptionList& program, const CommandContext& context) {
  OptionList command =
      program.add_command("node", "show a part of a wall of several machines; the hand is on another one");
  command.footer(
      "Everything but models of your own comes from the machine with the hand, which runs touchafm view --cluster.\n"
      "The node waits for it, follows the next one after it, and rejoins automatically. It starts no servo.\n\n"
      "example: touchafm node left --interface 10.0.0.2\n"
      "         touchafm node left --interface 10.0.0.2 --master 10.0.0.1");
  auto options = std::make_shared<NodeOptions>();
  command.add_option("name", options->name, "name of this machine in the wall file").required().type_name("NAME");
  command
      .add_option("--interface", options->interface_address,
                  "address or name of the network interface to the machine with the hand; no other is used")
      .required()
      .type_name("ADDRESS");
  command
      .add_option("--master", options->master,
                  "machine with the hand, where the network forbids multicast; default: found automatically")
      .type_name("HOST");
  add_domain_option(command, options->domain);
  pixel_size_option(command, "--size", options->display.window.size_px,
                    "open one window of this size in pixels; default: one window per output of this machine",
                    PixelRange{64, 16384});
  add_frame_budget(command, options->display.frame_budget_ms);
  add_gpu_option(command, options->display.picture.gpu);
  command
      .add_option("--pictures", options->display.saved_folder,
                  "existing folder for screenshots taken with F12; default: the current folder")
      .existing_folder()
      .type_name("DIR");
  command.when_chosen([options, &context] { return run_node(*options, context); });
}

}  // namespace afm::app
