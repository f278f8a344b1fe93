// SPDX-License-Identifier: Apache-2.0
#include "app/view/parameter_edits.h"

#include <algorithm>
#include <array>

#include "cluster/messages.h"
#include "core/log.h"
#include "curves/curve_map.h"
#include "exhibit/panels/parameter_panel.h"
#include "exhibit/scan/map_picture.h"
#include "servo/servo_client.h"

namespace afm::app {

curves::LiveParameters& ParameterEdits::parameters(std::size_t material) {
  Edit& edit = edits_[material];
  if (!edit.parameters) edit.parameters.emplace(loaded_[material]);
  return *edit.parameters;
}

const curves::LiveParameters& ParameterEdits::of(std::size_t material) { return parameters(material); }

std::optional<cluster::EditRecord> ParameterEdits::recorded(std::size_t material) const {
  const Edit& edit = edits_[material];
  if (!edit.parameters) return std::nullopt;
  const curves::LiveParameters::State state = edit.parameters->state();
  cluster::EditRecord record{.material = static_cast<std::uint32_t>(material), .revision = edit.revision};
  static_assert(std::tuple_size_v<decltype(record.steps)> == curves::LiveParameters::kRows);
  std::copy(state.steps.begin(), state.steps.end(), record.steps.begin());
  if (state.refused) record.refused_row = static_cast<std::int32_t>(*state.refused);
  record.refused_direction = state.refused_direction;
  return record;
}

bool ParameterEdits::follow(const cluster::EditRecord& edit) {
  if (edit.material >= edits_.size()) return false;
  edits_[edit.material].revision = edit.revision;
  curves::LiveParameters::State state;
  state.refused_direction = edit.refused_direction;
  std::copy(edit.steps.begin(), edit.steps.end(), state.steps.begin());
  if (edit.refused_row >= 0) state.refused = static_cast<curves::LiveParameters::Row>(edit.refused_row);
  return parameters(edit.material).restore(state);
}

bool ParameterEdits::take_felt(const scene::TipState& tip, std::vector<curves::SampleModel>& felt) {
  if (tip.material < 0) return false;
  const auto material = static_cast<std::size_t>(tip.material);
  const exhibit::ChangeState now = state(material, tip);
  const curves::SampleModel& edited = parameters(material).model();
  const bool taken = now == exhibit::ChangeState::Applied || now == exhibit::ChangeState::AsLoaded;
  if (!taken || felt[material].tables == edited.tables) return false;
  felt[material] = edited;
  return true;
}

bool ParameterEdits::changed(std::size_t material) const {
  const Edit& edit = edits_[material];
  return edit.parameters && edit.parameters->changed();
}

bool ParameterEdits::apply(const render::ControlTarget& target, std::size_t material, servo::ServoClient& servo) {
  using Control = render::ControlTarget::Kind;
  curves::LiveParameters& now = parameters(material);
  if (now.model().felt_map && target.kind == Control::Pixel) {
    core::log_line("force map: the whole map is felt; --felt pixel feels the curve of one pixel");
    return false;
  }
  if (holds_pixel(material, servo.tip())) {
    core::log_line("force map: lift the tip off the sample before you choose another pixel");
    return false;
  }
  // a pixel is read from its file: no force waits for that
  if (now.model().pixel && scene::is_armed(servo.tip().servo_state)) servo.take_force_away();
  curves::ParameterBuild& build = edits_[material].build;
  const bool steps = target.kind == Control::More || target.kind == Control::Less;
  if (steps && now.model().taps()) {
    build.step(now, now.rows()[target.index], target.kind == Control::More ? 1 : -1);
    return false;
  }
  bool changed = false;
  if (target.kind == Control::Pixel) {
    const auto before = now.model().tables;
    if (const auto chosen = now.choose(exhibit::place_of(target, *now.model().pixel->map)); !chosen) {
      core::log_line(chosen.error().message);
      return false;
    }
    changed = now.model().tables != before;
  } else if (steps) {
    changed = now.step(now.rows()[target.index], target.kind == Control::More ? 1 : -1);
  } else if (static_cast<exhibit::PanelButton>(target.index) == exhibit::PanelButton::Reset) {
    build.drop();
    changed = now.reset();
  }
  if (changed) send(material, servo);
  return true;
}

void ParameterEdits::send(std::size_t material, servo::ServoClient& servo) {
  const curves::SampleModel& model = parameters(material).model();
  edits_[material].revision = servo.change(material, model.parameters, curves::shared_curve(model));
}

std::vector<std::size_t> ParameterEdits::take_built(servo::ServoClient& servo) {
  std::vector<std::size_t> taken;
  for (std::size_t i = 0; i < edits_.size(); ++i) {
    Edit& edit = edits_[i];
    if (!edit.parameters) continue;
    auto built = edit.build.take(*edit.parameters);
    if (!built) continue;
    const bool changed = built->model().tables != edit.parameters->model().tables;
    edit.parameters = std::move(built);
    if (changed) send(i, servo);
    taken.push_back(i);
  }
  return taken;
}

bool ParameterEdits::keeps_force_off(const scene::TipState& tip) {
  if (tip.material < 0) return false;
  const auto material = static_cast<std::size_t>(tip.material);
  Edit& edit = edits_[material];
  const bool sent = edit.revision != 0 && state(material, tip) == exhibit::ChangeState::Waiting;
  const bool changes = loaded_[material].taps() && (edit.build.running() || sent);
  edit.force_off = changes && (edit.force_off || !scene::is_armed(tip.servo_state));
  return edit.force_off;
}

bool ParameterEdits::holds_pixel(std::size_t material, const scene::TipState& tip) const {
  return loaded_[material].pixel && !loaded_[material].felt_map &&
         tip.material == static_cast<std::int32_t>(material) && tip.phase == physics::Phase::Attached;
}

void ParameterEdits::reset(servo::ServoClient& servo) {
  for (std::size_t i = 0; i < edits_.size(); ++i) {
    edits_[i].build.drop();
    if (edits_[i].parameters && edits_[i].parameters->reset()) send(i, servo);
  }
}

void ParameterEdits::resend(servo::ServoClient& servo) {
  for (std::size_t i = 0; i < edits_.size(); ++i) {
    edits_[i].revision = 0;
    if (changed(i)) send(i, servo);
  }
}

bool ParameterEdits::builds() const {
  return builds_elsewhere_ ||
         std::any_of(edits_.begin(), edits_.end(), [](const Edit& edit) { return edit.build.running(); });
}

exhibit::ChangeState ParameterEdits::state(std::size_t material, const scene::TipState& tip) const {
  const Edit& edit = edits_[material];
  if (builds()) return exhibit::ChangeState::Waiting;
  const bool under_tip = tip.material == static_cast<std::int32_t>(material);
  const bool taken = under_tip ? tip.active.edit_revision == edit.revision : edit.revision == 0;
  if (edit.revision != 0 && tip.acknowledged.refused_edit == edit.revision) return exhibit::ChangeState::Refused;
  if (!taken) return exhibit::ChangeState::Waiting;
  return changed(material) ? exhibit::ChangeState::Applied : exhibit::ChangeState::AsLoaded;
}

exhibit::ChangeState ParameterEdits::shown_state(std::size_t material, const scene::TipState& tip) const {
  return holds_pixel(material, tip) ? exhibit::ChangeState::Held : state(material, tip);
}

}  // namespace afm::app
