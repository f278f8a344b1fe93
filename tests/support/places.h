// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

// Absolute paths of this build. They are compiled once, in places.cpp: no other test contains the path of its clone,
// so that a compiler cache serves every clone.
namespace afm::support {

std::string source(std::string_view path = {});  // path below the source folder
std::string built(std::string_view path = {});   // path below the build folder

std::string touchafm();       // the program
std::string servo_program();  // touchafm-servo
std::string servo_mode();  // value of --servo: "thread" under ThreadSanitizer, which sees one process, else "process"
std::string cmake();       // program of CMake
std::string mock_dhd();    // stand-in for Force Dimension's library
std::string mock_dhd_of_old();  // same library before it had a largest force
std::string mock_dhd_without_brakes();
std::string mock_hd();  // stand-in for the vendor's haptic library
std::string mock_hd_without_unschedule();
std::string fault_layer_folder();  // value of VK_LAYER_PATH
std::string fault_layer();         // path of the Vulkan layer itself
std::string openxr_stand_in();     // value of XR_RUNTIME_JSON
std::string failing_calls();       // value of LD_PRELOAD; not built with a sanitizer

}  // namespace afm::support
