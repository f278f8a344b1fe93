// SPDX-License-Identifier: Apache-2.0
// Nothing but this: what an object of the program itself has of the standard library's templates, unlike that of an
// archive, its drivers would call instead of their own.
#include "app/commit.h"
#include "app/program.h"
#include "core/run_main.h"

int main(int count, char** arguments) {
  return afm::core::run_main([&] { return afm::app::run_program(count, arguments, afm::app::kCommit); });
}
