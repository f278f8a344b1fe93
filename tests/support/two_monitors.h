// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <string>

#include "render/frame.h"
#include "support/scratch_folder.h"

namespace afm::support {

// An X server with two monitors beside each other, DUMMY0 at the left and DUMMY1, 320 x 240 pixels each: the real Xorg
// with the driver that shows nothing. Throws if the packages for it are missing.
class TwoMonitors {
 public:
  static constexpr int kWidth = 320, kHeight = 240;  // size of each monitor

  TwoMonitors();
  TwoMonitors(const TwoMonitors&) = delete;
  TwoMonitors& operator=(const TwoMonitors&) = delete;
  ~TwoMonitors();

  const std::string& name() const { return name_; }

  // Changes the outputs, as cables and switches do: "--output DUMMY1 --off".
  void xrandr(const std::string& arguments) const;

  // Picture of the whole desktop.
  render::Image screenshot() const;

 private:
  ScratchFolder folder_;
  pid_t pid_ = -1;
  std::string name_;
};

}  // namespace afm::support
