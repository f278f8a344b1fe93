// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

// Paths of this build, absolute. They are compiled once, in places.cpp: no other test contains the path of its clone,
// so that a compiler cache serves every clone.
namespace afm::support {

std::string source(std::string_view path = {});  // below the source folder
std::string built(std::string_view path = {});   // below the build folder

std::string touchafm();       // the program
std::string servo_program();  // touchafm-servo
std::string servo_mode();  // value of --servo: "thread" under ThreadSanitizer, which sees one process, else "process"
std::string cmake();       // CMake's own program
std::string mock_dhd();    // stand-in for Force Dimension's library
std::string mock_dhd_of_old();  // the same before it had a largest force
std::string mock_dhd_without_brakes();
std::string mock_hd();  // stand-in for the vendor's haptic library
std::string mock_hd_without_unschedule();
std::string fault_layer_folder();  // value of VK_LAYER_PATH
std::string fault_layer();         // the Vulkan layer itself
std::string openxr_stand_in();     // value of XR_RUNTIME_JSON
std::string failing_calls();       // value of LD_PRELOAD; not built with a sanitizer

}  // namespace afm::support
