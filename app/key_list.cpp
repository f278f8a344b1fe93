// SPDX-License-Identifier: Apache-2.0
#include "app/key_list.h"

namespace afm::app {

render::DataPanel key_list(HandSource hand) {
  render::DataPanel panel;
  panel.title = "Keys";
  panel.subtitle = "F1 hides them";
  panel.rows = {{"Choose a sample", "left click, 1 to 9", ""}};
  if (hand == HandSource::Mouse) {
    panel.rows.insert(panel.rows.end(), {{"Move the hand", "hold right button",
                                          "or the space bar, and drag: up, down, sideways; or the wheel"},
                                         {"Turn-On", "T", "or the middle button"}});
  }
  panel.rows.insert(panel.rows.end(), {{"Parameters", "F2", ""},
                                       {"Scale of the hand", "M", "fit, compressed, common"},
                                       {"Begin again", "R", ""},
                                       {"Hide the panels", "P", ""},
                                       {"Swap the eyes", "S", ""},
                                       {"Full screen", "F11", ""},
                                       {"End", "Esc", ""}});
  return panel;
}

}  // namespace afm::app
