// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "app/view/key_list.h"
#include "cluster/node_link.h"
#include "core/clock.h"
#include "curves/sample_model.h"
#include "exhibit/scan/live_scan.h"

namespace afm::exhibit {
class FrameBuilder;
struct Stage;
struct WallHistory;
}  // namespace afm::exhibit

namespace afm::app {

class ViewDisplay;
class ViewPanels;
class ViewPicture;
class ViewWindows;

// A machine of a wall without the hand: builds every frame from the inputs that the master sends, and shows it together
// with all others. It starts no servo and opens no haptic device. Main thread only.
class NodeView {
 public:
  struct Place {
    std::uint32_t node = 0;     // of Wall::nodes
    std::uint64_t session = 0;  // of the master whose wall this is
    std::vector<std::byte> model;
  };

  // All must outlive it; `key_list` is that of the master's window.
  NodeView(const exhibit::Stage& stage, const std::vector<curves::SampleModel>& materials, ViewDisplay& display,
           cluster::NodeLink& link, Place place, KeyList key_list, const core::Clock& clock);
  ~NodeView();

  // Until the window is closed or a signal comes; or until a master shows another wall, whose description it returns.
  std::optional<cluster::NodeLink::Document> run();

 private:
  bool leaves();
  std::optional<cluster::NodeLink::Document> take();
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
  const core::Clock& clock_;
  std::vector<curves::SampleModel> felt_;
  std::unique_ptr<exhibit::FrameBuilder> frames_;
  std::unique_ptr<ViewPanels> panels_;
  std::unique_ptr<exhibit::WallHistory> history_;
  bool knows_history_ = false;
  std::optional<exhibit::LiveScan> scan_;
  std::deque<cluster::NodeLink::Numbered> records_;  // that have come and are not applied yet
  std::optional<cluster::NodeLink::Came> next_;
  std::optional<cluster::FrameMessage> shown_;  // the newest
  std::int64_t shown_ns_ = 0;
  std::int64_t swapped_ns_ = 0;
  std::uint64_t lost_records_ = 0;
  std::uint32_t late_swaps_ = 0;
};

}  // namespace afm::app
