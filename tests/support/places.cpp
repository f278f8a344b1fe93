// SPDX-License-Identifier: Apache-2.0
#include "support/places.h"

#include "built_places.h"

namespace afm::support {
namespace {

std::string below(const char* folder, std::string_view path) {
  return path.empty() ? folder : std::string(folder) + "/" + std::string(path);
}

}  // namespace

std::string source(std::string_view path) { return below(AFM_SOURCE_DIR, path); }
std::string built(std::string_view path) { return below(AFM_BINARY_DIR, path); }
std::string touchafm() { return AFM_PROGRAM; }
std::string servo_program() { return AFM_SERVO_PROGRAM; }
std::string servo_mode() { return AFM_SERVO_MODE; }
std::string cmake() { return AFM_CMAKE; }
std::string mock_dhd() { return AFM_MOCK_DHD; }
std::string mock_dhd_of_old() { return AFM_MOCK_DHD_OF_OLD; }
std::string mock_dhd_without_brakes() { return AFM_MOCK_DHD_WITHOUT_BRAKES; }
std::string mock_hd() { return AFM_MOCK_HD; }
std::string mock_hd_without_unschedule() { return AFM_MOCK_HD_WITHOUT_UNSCHEDULE; }
std::string fault_layer_folder() { return AFM_FAULT_LAYER_DIR; }
std::string fault_layer() { return AFM_FAULT_LAYER_FILE; }
std::string openxr_stand_in() { return AFM_OPENXR_STAND_IN_JSON; }
std::string failing_calls() { return AFM_FAILING_CALLS; }

}  // namespace afm::support
