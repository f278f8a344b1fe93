// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "app/options/command_line.h"
#include "cluster/network.h"
#include "core/result.h"
#include "curves/tapping/tapped_hand.h"
#include "exhibit/frame/wall_pictures.h"
#include "physics/friction/friction.h"
#include "render/renderer.h"

namespace afm::cluster {
class MasterLink;
}
namespace afm::core {
class Clock;
}
namespace afm::exhibit {
struct ExhibitFiles;
struct Stage;
}  // namespace afm::exhibit

namespace afm::app {

class ClusterMaster;
struct WindowOptions;

struct ClusterOptions {
  bool wanted = false;
  std::string interface_address;  // interface address; empty: the one that leads to the first node
  std::uint32_t domain = cluster::ClusterNetwork::kUsualDomain;
};

// Adds --cluster, which starts the machine with the hand and is returned, --interface and --domain. The second function
// adds --domain only.
Option add_cluster_options(OptionList& command, ClusterOptions& options);
void add_network_options(OptionList& command, ClusterOptions& options);
void add_domain_option(OptionList& command, std::uint32_t& domain);

// Network of the machine with the hand. Fails as interface_towards and address_of_host do.
core::Result<cluster::ClusterNetwork> master_network(const ClusterOptions& options, const scene::Wall& wall);

// WrongUsage if the wall has outputs on other machines, which one window would not show. `remedy`: the option that
// shows them all, such as "--cluster, or "; empty if there is none.
core::Result<void> check_one_machine(const scene::Wall& wall, const WindowOptions& window, std::string_view remedy);

// Parts of the wall's description that no file contains.
struct WallChoice {
  physics::FrictionLaw friction = physics::FrictionLaw::None;
  exhibit::PictureOptions picture;
  render::PanelContrast contrast = render::PanelContrast::Normal;
  curves::TappedHand tapping{};
};

// The network, opened as the machine with the hand. WrongUsage if the wall has no nodes or another machine drives it.
struct OpenedMaster {
  cluster::ClusterNetwork network;
  std::unique_ptr<cluster::MasterLink> link;
};
core::Result<OpenedMaster> open_master(const ClusterOptions& options, const exhibit::ExhibitFiles& files,
                                       const WallChoice& choice, const std::string& program,
                                       const exhibit::Stage& stage, const core::Clock& clock);

// Opens the network and keeps only this machine's outputs in the wall of the stage, which must outlive the master.
core::Result<std::unique_ptr<ClusterMaster>> start_cluster(const ClusterOptions& options,
                                                           const exhibit::ExhibitFiles& files, const WallChoice& choice,
                                                           const std::string& program, exhibit::Stage& stage,
                                                           const core::Clock& clock);

}  // namespace afm::app
