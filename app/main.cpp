// SPDX-License-Identifier: Apache-2.0
// Contains only main(): the linker hides our template instances of the standard library if they come from an archive
// (--exclude-libs) but not if they come from this object, and a driver would call them instead of its copies.
#include "app/commit.h"
#include "app/program.h"
#include "core/run_main.h"

int main(int count, char** arguments) {
  return afm::core::run_main([&] { return afm::app::run_program(count, arguments, afm::app::kCommit); });
}
