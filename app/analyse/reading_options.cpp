// SPDX-License-Identifier: Apache-2.0
#include "app/analyse/reading_options.h"

namespace afm::app {

std::vector<NamedOption> add_reading_options(OptionList& command, curves::CurveReading& reading) {
  std::vector<NamedOption> added = add_calibration_options(command, reading);
  added.push_back(add_columns_option(command, reading));
  return added;
}

}  // namespace afm::app
