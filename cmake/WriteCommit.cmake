# SPDX-License-Identifier: Apache-2.0
# cmake -DSOURCE=... -DFILE=commit.cpp -P WriteCommit.cmake: the commit of the sources as a C++ constant. The file is written only
# when that has changed.
cmake_minimum_required(VERSION 3.25)

set(commit "built without git: the commit is not known")
find_program(GIT git)
if(GIT AND EXISTS ${SOURCE}/.git)  # a tarball may lie inside another project's checkout
  # a checkout may belong to another user, as in a container
  execute_process(COMMAND ${GIT} -c safe.directory=* -C ${SOURCE} describe --always --abbrev=12 --dirty=+ --exclude=*
                  OUTPUT_VARIABLE found RESULT_VARIABLE status OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(status EQUAL 0 AND found MATCHES "^([0-9a-f]+)([+]?)$")
    set(commit "commit ${CMAKE_MATCH_1}")
    if(CMAKE_MATCH_2)
      string(APPEND commit ", with uncommitted changes")
    endif()
  endif()
endif()

file(CONFIGURE OUTPUT ${FILE} CONTENT [[#include "app/commit.h"

namespace afm::app {

const char* const kCommit = "@commit@";

}  // namespace afm::app
]] @ONLY)
