// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "app/view/key_list.h"
#include "cluster/node_link.h"
#include "core/clock.h"
#include "curves/sample_model.h"
#include "exhibit/scan/live_scan.h"
#include "render/window_sight.h"

namespace afm::exhibit {
class FrameBuilder;
struct Stage;
struct WallHistory;
}  // namespace afm::exhibit
namespace afm::scene {
class AdjustedSet;
}

namespace afm::app {

class ViewDisplay;
class ViewPanels;
class ViewPicture;
class ViewWindows;

// A machine of a wall without the haptic device: builds every frame from the master's inputs and shows it together with
// all other machines. Starts no servo and opens no haptic device. Main thread only.
class NodeView {
 public:
  struct Place {
    std::uint32_t node = 0;     // index in Wall::nodes
    std::uint64_t session = 0;  // session of the wall's master
    std::vector<std::byte> model;
  };

  // All arguments must outlive the object; `key_list` is the function that the master's window uses.
  NodeView(const exhibit::Stage& stage, const std::vector<curves::SampleModel>& materials, ViewDisplay& display,
           cluster::NodeLink& link, Place place, KeyList key_list, const core::Clock& clock);
  ~NodeView();

  // Prepares another wall; false if it cannot be shown, so that this one continues.
  using Prepare = std::function<bool(const cluster::NodeLink::Document& other)>;

  // Runs until the window is closed or a signal arrives; returns true if another wall is prepared instead.
  bool run(const Prepare& prepare);

 private:
  bool leaves();
  bool take(const Prepare& prepare);
  void take_records();
  void restore(std::span<const std::byte> document);
  void forget();
  void apply_until(std::uint64_t journal);
  void apply_to_scan(const cluster::JournalRecord& record);
  void follow_scan(const cluster::ShownMoment& shown);
  bool catch_up(std::uint64_t journal);
  bool fits(const cluster::FrameMessage& message) const;
  void draw(const cluster::NodeLink::Came& came);
  void show(const cluster::FrameMessage& message, bool master_gone, const std::function<void(std::uint64_t)>& drawn);
  void wait_for_swap(const cluster::FrameMessage& message);
  cluster::ReadyMessage answer_to(const cluster::FrameMessage& message, std::int64_t came_ns) const;

  const exhibit::Stage& stage_;
  ViewWindows& windows_;
  ViewPicture& picture_;
  cluster::NodeLink& link_;
  Place place_;
  std::vector<std::byte> refused_;  // newest description that could not be prepared
  const core::Clock& clock_;
  std::vector<curves::SampleModel> felt_;
  std::unique_ptr<exhibit::FrameBuilder> frames_;
  std::unique_ptr<ViewPanels> panels_;
  std::unique_ptr<exhibit::WallHistory> history_;
  std::unique_ptr<scene::AdjustedSet> adjusted_;  // null without particles
  bool knows_history_ = false;
  std::optional<exhibit::LiveScan> scan_;
  std::deque<cluster::NodeLink::Numbered> records_;  // received and not yet applied
  std::optional<cluster::NodeLink::Came> next_;
  std::optional<cluster::FrameMessage> shown_;  // newest frame on screen
  std::int64_t shown_ns_ = 0;
  std::int64_t swapped_ns_ = 0;
  std::uint64_t lost_records_ = 0;
  std::uint32_t late_swaps_ = 0;
  std::uint32_t stops_ = 0;
  render::WindowSight sight_;
};

}  // namespace afm::app
