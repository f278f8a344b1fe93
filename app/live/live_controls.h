// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "app/live/view_keys.h"

namespace afm::exhibit {
class LiveLesson;
}

namespace afm::app {

class ClusterMaster;
class InstructorWindow;
class ViewControl;
class ViewHeadset;
struct ViewParts;
struct ViewSettings;

// Optional features of a live window; null: no such control. None is owned.
struct LiveFeatures {
  ViewHeadset* headset = nullptr;          // draws the picture if set
  ClusterMaster* cluster = nullptr;        // other machines of the wall
  exhibit::LiveLesson* lesson = nullptr;   // guide through the window
  InstructorWindow* instructor = nullptr;  // the lesson's second window
};

// Creates the controls of a live window and routes its keys to them.
class LiveControls {
 public:
  // `parts` and all features must outlive the object. Adds the controls to those of `parts`.
  LiveControls(ViewParts& parts, const ViewSettings& settings, const LiveFeatures& features);
  ~LiveControls();
  LiveControls(const LiveControls&) = delete;
  LiveControls& operator=(const LiveControls&) = delete;

  void press(render::Key key);

 private:
  template <typename Control, typename... Arguments>
  Control& add(Arguments&&... arguments);

  ViewParts& parts_;
  WallUse use_;
  bool unattended_;
  std::vector<std::unique_ptr<ViewControl>> owned_;
  KeyOwners owners_;
};

}  // namespace afm::app
