// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdlib>

#include "support/scratch_folder.h"

namespace afm::support {
namespace {

// Programs of one user meet at the sockets in this folder: a view takes over the servo of one that died. Those of two
// tests beside each other must not.
class OwnRuntimeFolder : public testing::Environment {
 public:
  void SetUp() override { ::setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1); }

 private:
  ScratchFolder folder_;
};

[[maybe_unused]] const testing::Environment* const kOwn = testing::AddGlobalTestEnvironment(new OwnRuntimeFolder);

}  // namespace
}  // namespace afm::support
