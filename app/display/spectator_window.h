// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "exhibit/state/curve_player.h"
#include "exhibit/state/line_player.h"
#include "instrument/showcase.h"

namespace afm::curves {
struct SampleModel;
}
namespace afm::core {
class Clock;
}
namespace afm::exhibit {
class FrameBuilder;
class ServedImage;
struct Stage;
struct WallState;
}  // namespace afm::exhibit

namespace afm::app {

class ViewDisplay;

// Shows an instrument that a program controls: tip and sample, the newest curve at a pace that people can follow, and
// an image line by line. Changes nothing in the instrument, which does not wait for the picture. Main thread only.
class SpectatorWindow {
 public:
  // All arguments must outlive the object.
  SpectatorWindow(const exhibit::Stage& stage, std::vector<curves::SampleModel> materials, ViewDisplay& display,
                  instrument::Showcase& showcase, const core::Clock& clock);
  ~SpectatorWindow();

  // Shows frames until a person closes the window, `over` returns true, or the instrument has a material that the wall
  // lacks, whose name is returned. Throws render::DeviceFailure.
  std::optional<std::string> run(const std::function<bool()>& over);

 private:
  bool leaves();
  std::optional<std::size_t> place_of(const std::string& material) const;  // index of the material on the wall
  bool take(double frame_s);
  void take_lines();
  bool follow_contact();
  void put_tip(exhibit::WallState& wall) const;
  void draw();

  const exhibit::Stage& stage_;
  std::vector<curves::SampleModel> materials_;
  ViewDisplay& display_;
  instrument::Showcase& showcase_;
  const core::Clock& clock_;
  std::unique_ptr<exhibit::FrameBuilder> frames_;
  instrument::Shown shown_;
  std::shared_ptr<const curves::ContactSetup> followed_;  // contact of materials_, shared with the showcase
  std::optional<std::size_t> material_;
  std::uint64_t played_ = 0;  // number of the curve that is or was played
  exhibit::CurvePlayer player_;
  std::uint64_t image_number_ = 0;
  std::unique_ptr<exhibit::ServedImage> image_;  // image in front; null: the curve
  exhibit::LinePlayer line_;                     // line being played, or the last one
};

}  // namespace afm::app
