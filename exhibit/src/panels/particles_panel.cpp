// SPDX-License-Identifier: Apache-2.0
#include "exhibit/panels/particles_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/enumerators.h"
#include "curves/plot_units.h"
#include "exhibit/panels/push_setting_words.h"
#include "exhibit/state/plan_figures.h"
#include "panels/panel_conventions.h"
#include "physics/manipulation/push_figures.h"
#include "physics/manipulation/tip_hold.h"
#include "physics/quantity_text.h"
#include "scene/samples/adjusted_set.h"
#include "scene/samples/particle_set.h"
#include "scene/samples/pattern_state.h"
#include "scene/shared/push_values.h"
#include "servo/live_picture.h"

namespace afm::exhibit {

namespace {

using physics::Force;
using physics::format_quantity;
using physics::ParticleLaw;
using physics::ParticleSpecies;
using physics::PushState;

constexpr double kSoftened = 1.05;  // factor beyond which the panel reports the softer lever
constexpr double kFinestAimM = 1e-12;

static_assert(after(Phrase::PushFree, core::index_of(PushState::Carried)) == Phrase::PushCarried);
static_assert(after(Phrase::PictureMeasured, static_cast<std::size_t>(servo::Known::Stale)) == Phrase::PictureStale);
static_assert(after(Phrase::PushLawArea, core::index_of(ParticleLaw::Measured)) == Phrase::PushLawMeasured);

const std::string& formula_of(ParticleLaw law, const Phrases& phrases) {
  return phrases[after(Phrase::PushLawArea, core::index_of(law))];
}

// Force in nN, whatever its size, since forces next to each other are compared.
std::string force_text(Force force, const Phrases& phrases) {
  return phrases.number(fmt::format("{:.{}g} nN", force.si * curves::kNnPerN, kDigits));
}

// Value with the exponent of a square unit raised.
template <class Quantity, class Units>
std::string quantity_text(Quantity value, const Units& units, const Phrases& phrases) {
  std::string text = phrases.number(format_quantity(value, units, kDigits));
  if (text.ends_with("m2")) text.replace(text.size() - 1, 1, "\u00b2");
  return text;
}

std::string factor_text(double factor) {
  return factor < 10.0 ? fmt::format("{:.2g}", factor) : fmt::format("{:.0f}", factor);
}

std::string source_text(std::span<const scene::SourcedValue> sources, std::string_view key, const Phrases& phrases) {
  const scene::SourcedValue* sourced = scene::find_source(sources, key);
  if (sourced == nullptr) return "";
  const std::array source{phrases.word(sourced->source)};
  return sourced->estimated ? phrases.filled(Phrase::Estimated, source) : source.front();
}

class ParticleRows {
 public:
  ParticleRows(const ParticlesNow& now, const Phrases& phrases)
      : now_(now), phrases_(phrases), touched_(touched(now, now.set->particles.size())) {}

  std::vector<render::DataRow> take() {
    add_task();
    add_picture();
    add_look_load();
    add_plan();
    add_push();
    add_thresholds();
    add_limits();
    add_numbers();
    return std::move(rows_);
  }

 private:
  std::size_t species_index() const { return now_.set->particles[touched_.value_or(0)].species; }
  const ParticleSpecies& species() const { return now_.set->setup.species[species_index()]; }
  bool sticks() const { return scene::sticks_with(now_.push.settings.tool, now_.set->setup, species_index()); }

  void add(Phrase name, std::string value, std::string source) {
    rows_.push_back({phrases_[name], std::move(value), std::move(source)});
  }

  // With the source of a number of the file.
  void add_sourced(Phrase name, std::string value, std::string source) {
    add(name, std::move(value), std::move(source));
    rows_.back().detail = true;
  }

  // With an explanation, which is seen with the sources.
  void add_explained(Phrase name, std::string value, Phrase why) { add_sourced(name, std::move(value), phrases_[why]); }

  // Uses of an aid, counted.
  std::string aids_of(const scene::TaskScore& score) const {
    const std::string undos = fmt::format("{}", score.undos), guided = fmt::format("{}", score.guided);
    const bool counted = score.undos + score.guided > 0;
    if (score.truth == 0) {
      return counted ? phrases_.text<Phrase::TaskAided>(undos, guided) : phrases_[Phrase::TaskUnaided];
    }
    return counted ? phrases_.text<Phrase::TaskAidedShown>(undos, guided) : phrases_[Phrase::TaskShown];
  }

  // The clock while the task runs, the whole score once it is done.
  void add_task() {
    const scene::TaskScore& score = now_.score;
    if (score.state == scene::TaskState::NotBegun) return;
    const bool done = score.state == scene::TaskState::Done;
    add(done ? Phrase::TaskDoneIn : Phrase::TaskClock,
        phrases_.number(fmt::format("{:.{}f} s", score.time_s, done ? 1 : 0)),
        phrases_.text<Phrase::TaskStrokes>(fmt::format("{}", score.strokes), fmt::format("{}", score.losses)));
    if (!done) return;
    if (scene::answered(score)) {
      add_answer(score);
    } else {
      add(Phrase::TaskOff, quantity_text(physics::Length(score.rms_m), physics::kLengthUnits, phrases_),
          aids_of(score));
    }
    add(Phrase::TaskWork, quantity_text(physics::Energy(score.work_j), physics::kEnergyUnits, phrases_),
        phrases_.text<Phrase::TaskLargest>(force_text(Force(score.largest_lateral_n), phrases_)));
  }

  // The force that the hand held for the threshold that it had felt.
  void add_answer(const scene::TaskScore& score) {
    const double error = scene::answer_error(score);
    add(Phrase::TaskAnswer, force_text(Force(score.answer_n), phrases_),
        phrases_.text<Phrase::TaskThreshold>(force_text(Force(score.threshold_n), phrases_),
                                             fmt::format("{:+.0f} %", 100.0 * error)));
    add(Phrase::TaskFound, phrases_[std::abs(error) <= scene::kThresholdWithin ? Phrase::TaskYes : Phrase::TaskNo],
        aids_of(score));
  }

  // Knowledge of the particle nearest to the tip, and the result of the newest look.
  void add_picture() {
    if (now_.picture == nullptr) return;
    const servo::PictureNow& picture = *now_.picture;
    const std::string state =
        picture.look_share
            ? phrases_.text<Phrase::PictureLooks>(fmt::format("{:.0f}", 100.0 * *picture.look_share))
            : phrases_[after(Phrase::PictureMeasured, static_cast<std::size_t>(picture.known[picture.particle]))];
    add(Phrase::PictureName, state,
        phrases_.text<Phrase::PictureAge>(
            fmt::format("{}", picture.level), fmt::format("{}", picture.particle + 1),
            phrases_.number(fmt::format("{:.0f} s", picture.age_s)),
            quantity_text(physics::Length(picture.doubt_m), physics::kLengthUnits, phrases_)));
    if (picture.looks == 0) return;
    const servo::LookResult& look = picture.newest;
    if (look.swept_above_n > 0.0) {
      add(Phrase::LookName, phrases_[Phrase::LookSwept],
          phrases_.text<Phrase::LookSweptBy>(fmt::format("{}", look.particle + 1),
                                             force_text(Force(look.swept_above_n), phrases_)));
      return;
    }
    add(Phrase::LookName,
        look.off_m ? quantity_text(physics::Length(*look.off_m), physics::kLengthUnits, phrases_)
                   : phrases_[Phrase::LookMissed],
        phrases_.text<Phrase::LookOff>(fmt::format("{}", look.particle + 1), fmt::format("{}", look.lines)));
  }

  // Adds a warning, only if the load is not gentle.
  void add_look_load() {
    const Force load(now_.look_load_n);
    if (now_.picture == nullptr || !(load > gentle_look(*now_.set))) return;
    add(Phrase::LookLoad, force_text(load, phrases_),
        phrases_.text<Phrase::LookSweeps>(force_text(gentle_look(*now_.set), phrases_)));
  }

  // Demands of a planned push on the hand.
  void add_plan() {
    const auto figures = plan_figures(now_);
    if (!figures) return;
    const std::string number = fmt::format("{}", now_.plan.particle + 1);
    add(Phrase::PlanWay, quantity_text(figures->left, physics::kLengthUnits, phrases_),
        now_.plan.guided != 0 ? phrases_.text<Phrase::PlanGuided>(number)
                              : phrases_.text<Phrase::PlanUnguided>(number));
    add(Phrase::PlanAim,
        figures->aim.si < kFinestAimM
            ? "< " + quantity_text(physics::Length(kFinestAimM), physics::kLengthUnits, phrases_)
            : quantity_text(figures->aim, physics::kLengthUnits, phrases_),
        phrases_[Phrase::PlanAimWhy]);
    if (!(figures->hand.si > 0.0)) return;  // scale of the hand not yet reported by the servo
    add(Phrase::PlanHand, quantity_text(figures->hand, physics::kVelocityUnits, phrases_),
        phrases_.text<Phrase::PlanHandWhy>(fmt::format("{:g} s", physics::kSteeringDelay.si)));
  }

  void add_push() {
    const scene::TipPush& push = now_.push;
    const PushState state = touched_ ? push.state : PushState::Free;
    add(Phrase::PushStateName, phrases_[name_of(state, touched_ && push.normal_n < 0.0)],
        touched_ ? phrases_.text<Phrase::PushedParticle>(fmt::format("{}", *touched_ + 1),
                                                         fmt::format("{}", now_.set->particles.size()),
                                                         phrases_.word(now_.set->species[species_index()].name))
                 : phrases_[Phrase::PushedNone]);
    add_tool();
    add_changed();
    add_explained(Phrase::PushNormal, force_text(Force(touched_ ? push.normal_n : 0.0), phrases_),
                  Phrase::PushNormalOn);
    const double lateral_n = touched_ ? std::hypot(push.lateral_n[0], push.lateral_n[1]) : 0.0;
    add_explained(Phrase::PushLateral, force_text(Force(lateral_n), phrases_), Phrase::PushLateralOn);
  }

  // Of spheres that a tip can hold, and lets go; if it holds them, the row of the pull at which it tears says so.
  void add_tool() {
    if (sticks() || physics::turns_flat(species()) || !(species().tip_adhesion.si > 0.0)) return;
    add_explained(Phrase::ToolName, phrases_[Phrase::ToolPush], Phrase::ToolPushOf);
  }

  // Settings that a person has changed.
  void add_changed() {
    const std::vector<std::string> changed = changed_settings(now_.push.settings, *now_.set, phrases_);
    if (changed.empty()) return;
    add(Phrase::SettingsChanged, fmt::format("{}", changed.size()), fmt::format("{}", fmt::join(changed, ", ")));
  }

  // A tip that pulls by adhesion holds a particle back or drags it.
  static Phrase name_of(PushState state, bool pulled) {
    if (pulled && state == PushState::Holds) return Phrase::PushHeld;
    if (pulled && state == PushState::Slides) return Phrase::PushDragged;
    return after(Phrase::PushFree, core::index_of(state));
  }

  // Unloaded and at rest, as the other law's figure, until a touched particle has its own.
  void add_thresholds() {
    const ParticleSpecies& kind = species();
    const bool known = touched_ && now_.push.threshold_n > 0.0;
    const Force threshold =
        known ? Force(now_.push.threshold_n) : physics::sliding_threshold(kind, kind.law, Force(0.0));
    add(Phrase::PushThreshold, force_text(threshold, phrases_),
        phrases_.text<Phrase::PushLaw>(formula_of(kind.law, phrases_)));
    if (physics::turns_flat(kind)) return;  // species with only a measured threshold
    const ParticleLaw other = scene::other_law(kind.law);
    const Force other_threshold = physics::sliding_threshold(kind, other, Force(0.0));
    if (!(other_threshold.si > 0.0)) return;  // file without the numbers of the other law
    add_sourced(Phrase::PushOtherLaw, "(" + force_text(other_threshold, phrases_) + ")",
                phrases_.text<Phrase::PushLawUnused>(formula_of(other, phrases_)));
  }

  // Up to which load a scan is gentle, and how stiff a lever has to be; those of a plan replace them.
  void add_limits() {
    if (now_.limits == nullptr || plan_figures(now_)) return;
    const scene::PushLimits& limits = now_.limits->at(species_index());
    if (limits.gentle.si > 0.0) {
      add_explained(Phrase::GentleLoad, force_text(limits.gentle, phrases_), Phrase::GentleLoadWhy);
    }
    if (!(limits.softest.si > 0.0) || !std::isfinite(limits.softest.si)) return;
    const physics::Stiffness lever = now_.set->setup.springs.normal;
    const std::string spring = format_quantity(lever, physics::kStiffnessUnits, kDigits);
    add(Phrase::LeverAtLeast, quantity_text(limits.softest, physics::kStiffnessUnits, phrases_),
        lever < limits.softest ? phrases_.text<Phrase::LeverTooSoft>(spring)
                               : phrases_.text<Phrase::LeverEnough>(spring));
  }

  template <class Quantity, class Units>
  void add_number(Phrase name, Quantity value, const Units& units, std::string_view key) {
    if (!(value.si > 0.0)) return;
    add_sourced(name, quantity_text(value, units, phrases_),
                source_text(now_.set->species[species_index()].sources, key, phrases_));
  }

  // Work of adhesion of the sample, or of the pad below the touched sphere.
  void add_adhesion() {
    const auto pose = touched_ ? pose_of(now_, *touched_) : std::nullopt;
    const std::vector<physics::StickyPad> pads =
        pose ? scene::shared_sticky_pads(*now_.set) : std::vector<physics::StickyPad>{};
    const auto pad = std::find_if(pads.begin(), pads.end(), [&](const physics::StickyPad& p) {
      return !physics::turns_flat(species()) &&
             physics::lies_on(p, {physics::Length(pose->x_m), physics::Length(pose->y_m)});
    });
    if (pad == pads.end()) {
      add_number(Phrase::WorkOfAdhesion, species().contact.work_of_adhesion, physics::kSurfaceEnergyUnits,
                 "work_of_adhesion");
      return;
    }
    const std::string key = fmt::format("pad_{}_work_of_adhesion", pad - pads.begin() + 1);
    add_sourced(Phrase::WorkOfAdhesion, quantity_text(pad->work_of_adhesion, physics::kSurfaceEnergyUnits, phrases_),
                source_text(now_.set->sources, key, phrases_));
  }

  void add_numbers() {
    const ParticleSpecies& kind = species();
    add_number(Phrase::ParticleRadius, physics::outer_radius(kind), physics::kLengthUnits, "radius");
    add_adhesion();
    add_number(Phrase::ParticleShearStrength, kind.shear_strength, physics::kPressureUnits, "shear_strength");
    if (kind.coefficient > 0.0) {
      add_sourced(Phrase::ParticleCoefficient, phrases_.number(fmt::format("{:.3g}", kind.coefficient)),
                  source_text(now_.set->species[species_index()].sources, "coefficient", phrases_));
    }
    if (sticks()) {
      const std::string work = quantity_text(kind.tip_adhesion, physics::kSurfaceEnergyUnits, phrases_);
      const std::string source = source_text(now_.set->species[species_index()].sources, "tip_adhesion", phrases_);
      add(Phrase::ParticleTearsAt, force_text(physics::tip_pull_off(now_.set->setup.tip, kind, true), phrases_),
          work + (source.empty() ? "" : "; " + source));
    }
    const std::string lever =
        phrases_.number(format_quantity(now_.set->setup.springs.lateral, physics::kStiffnessUnits, kDigits));
    add_sourced(Phrase::LeverSideways, lever, source_text(now_.set->sources, "lateral_spring", phrases_));
    if (const double softened = now_.push.softened_sideways; softened > kSoftened) {
      add_explained(Phrase::LeverSoftened, phrases_.text<Phrase::TimesSofter>(factor_text(softened)),
                    Phrase::LeverSoftenedWhy);
    }
  }

  const ParticlesNow& now_;
  const Phrases& phrases_;
  std::optional<std::size_t> touched_;
  std::vector<render::DataRow> rows_;
};

// Distance from a pattern, or else the medium of the particles; with the pushes that can be taken back.
std::string subtitle(const ParticlesNow& now, const Phrases& phrases) {
  // no push can be taken back at level 2
  const std::uint32_t strokes = now.picture != nullptr && now.picture->level > 1 ? 0 : now.push.strokes;
  const std::string pushes = fmt::format("{}", strokes);
  const std::string& medium = phrases.word(now.set->medium);
  const auto pattern = now.set->blind ? std::nullopt : pattern_of(now);
  if (pattern) {
    const std::string off = quantity_text(pattern->match.rms, physics::kLengthUnits, phrases);
    if (pattern->done() && now.picture != nullptr && !now.picture->all_measured) {
      return phrases.text<Phrase::PatternComputed>(off, pushes);
    }
    if (pattern->done()) {
      return now.score.state == scene::TaskState::Running ? phrases.text<Phrase::PatternFits>(off, pushes)
                                                          : phrases.text<Phrase::PatternDone>(off, pushes);
    }
    if (pattern->pads > 0) {  // the distance does not decide
      return phrases.text<Phrase::ParticlesTakeBack>(medium, pushes);
    }
    const std::string allowed = quantity_text(pattern->allowed, physics::kLengthUnits, phrases);
    return phrases.text<Phrase::PatternOff>(off, allowed, pushes);
  }
  return strokes > 0 ? phrases.text<Phrase::ParticlesTakeBack>(medium, pushes)
                     : phrases.text<Phrase::ParticlesIn>(medium);
}

}  // namespace

render::DataPanel particles_panel(const ParticlesNow& now, const Phrases& phrases) {
  return {.title = phrases.word(now.set->title),
          .subtitle = subtitle(now, phrases),
          .rows = ParticleRows(now, phrases).take(),
          .details = false};
}

}  // namespace afm::exhibit
