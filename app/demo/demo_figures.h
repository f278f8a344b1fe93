// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "curves/sample_model.h"
#include "exhibit/state/moment.h"

namespace afm::exhibit {
class FrameBuilder;
struct Measurement;
class Phrases;
struct Variation;
}  // namespace afm::exhibit
namespace afm::render {
class Renderer;
}
namespace afm::servo {
struct RecordedSession;
}

namespace afm::app {

struct Figure {
  std::string file;     // name such as "fig5a.png"
  std::string caption;  // description below the picture
  exhibit::Moment moment;
};

// Pictures (a) to (e) of the paper's Fig. 5, as moments of recorded sessions: the pull just after the jump to contact,
// the deepest push, the last moment before the jump off contact, the free tip, and all curves together. `curves`
// receives one curve per material for each moment and must outlive the figures.
class FigurePlan {
 public:
  FigurePlan(const std::vector<servo::RecordedSession>& sessions, const std::vector<exhibit::Measurement>& measurements,
             std::size_t shown_material, const exhibit::Phrases& phrases);

  const std::vector<Figure>& figures() const { return figures_; }

 private:
  std::vector<std::vector<exhibit::CycleCurve>> curves_;  // one set per figure
  std::vector<Figure> figures_;
};

// A material and its own variations together in the same picture as (e). The FrameBuilder must draw from `materials()`.
class VariationFigure {
 public:
  VariationFigure(const servo::RecordedSession& base, const exhibit::Measurement& measurement,
                  const curves::SampleModel& model, std::span<const exhibit::Variation> variations,
                  std::size_t material, const exhibit::Phrases& phrases);
  VariationFigure(const VariationFigure&) = delete;
  VariationFigure& operator=(const VariationFigure&) = delete;

  const std::vector<curves::SampleModel>& materials() const { return materials_; }
  const exhibit::Moment& moment() const { return moment_; }

 private:
  std::vector<curves::SampleModel> materials_;
  std::vector<exhibit::CycleCurve> curves_;
  exhibit::Moment moment_;
};

// A film strip of ten places of the journey of scale on the first material, one for each order of magnitude.
render::Image journey_strip(const exhibit::FrameBuilder& frames, render::Renderer& renderer);

}  // namespace afm::app
