// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "exhibit/state/particles_now.h"
#include "exhibit/words/phrases.h"
#include "panels/panel_conventions.h"
#include "physics/quantity_text.h"
#include "render/frame.h"
#include "scene/samples/particle_set.h"

namespace afm::exhibit {

// Rows of a panel of marks, with the sources of a set.
class SourcedRows {
 public:
  SourcedRows(const ParticlesNow& now, const Phrases& phrases) : now_(now), phrases_(phrases) {}

 protected:
  static constexpr double kFeltSofter = 1.05;  // factor beyond which the panel reports the softer lever

  void add(Phrase name, std::string value, std::string source) {
    rows_.push_back({phrases_[name], std::move(value), std::move(source)});
  }

  // Adds a row with one of the set's own numbers, shown only together with the sources.
  void add_sourced(Phrase name, std::string value, std::string_view key) {
    add(name, std::move(value), source(key));
    rows_.back().detail = true;
  }

  template <class Quantity, class Units>
  std::string text(Quantity value, const Units& units) const {
    return phrases_.number(physics::format_quantity(value, units, kDigits));
  }

  std::string source(std::string_view key) const {
    const scene::SourcedValue* sourced = scene::find_source(now_.set->sources, key);
    if (sourced == nullptr) return "";
    const std::array words{phrases_.word(sourced->source)};
    return sourced->estimated ? phrases_.filled(Phrase::Estimated, words) : words.front();
  }

  void add_softened(double times) {
    if (!(times > kFeltSofter)) return;
    add(Phrase::LeverSoftened, phrases_.text<Phrase::TimesSofter>(phrases_.number(fmt::format("{:.2g}", times))),
        phrases_[Phrase::LeverSoftenedWhy]);
  }

  const ParticlesNow& now_;
  const Phrases& phrases_;
  std::vector<render::DataRow> rows_;
};

}  // namespace afm::exhibit
