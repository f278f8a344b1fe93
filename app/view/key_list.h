// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace afm::exhibit {
class Phrases;
}
namespace afm::render {
struct DataPanel;
}

namespace afm::app {

enum class HandSource { Mouse, Simulated, Device };
enum class WallUse { Free, Lesson };

// Makes the list of keys on the wall. An unattended wall leaves out the keys of staff.
using KeyList = render::DataPanel (*)(HandSource hand, bool unattended, const exhibit::Phrases& phrases, WallUse use);

}  // namespace afm::app
