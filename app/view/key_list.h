// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace afm::exhibit {
class Phrases;
}
namespace afm::render {
struct DataPanel;
}

namespace afm::app {

enum class HandSource { Mouse, Simulated, Device };
enum class WallUse { Free, Particles, Lesson };

// Makes the list of keys on the wall. An unattended wall omits staff keys. `letters`: as render::Window::letters().
using KeyList = render::DataPanel (*)(HandSource hand, bool unattended, const exhibit::Phrases& phrases, WallUse use,
                                      std::string_view letters);

}  // namespace afm::app
