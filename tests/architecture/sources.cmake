# SPDX-License-Identifier: Apache-2.0
# cmake -DROOT=... -DBUILD=... -P sources.cmake: a folder compiles its own sources, and each source is compiled once.
cmake_minimum_required(VERSION 3.25)

set(faults "")

# No CMakeLists names a source of another folder.
set(production app core curves exhibit haptics input physics render scene servo)
set(scanned 0)
foreach(top ${production} assets tests)
  file(GLOB_RECURSE lists RELATIVE ${ROOT} ${ROOT}/${top}/CMakeLists.txt)
  foreach(list ${lists})
    math(EXPR scanned "${scanned} + 1")
    file(STRINGS ${ROOT}/${list} lines)
    foreach(line IN LISTS lines)
      string(REGEX REPLACE "#.*" "" line "${line}")
      if(line MATCHES "(\\.\\./|_SOURCE_DIR}/)[^ )\"]*\\.(cpp|h)([ )\"]|$)" AND NOT line MATCHES "CURRENT_SOURCE_DIR}/[^ ./]+\\.(cpp|h)")
        string(APPEND faults "${list}: ${line}: names a source of another folder\n")
      endif()
    endforeach()
  endforeach()
endforeach()

# Each source is compiled once. Not counted are the files that the build generates (precompiled headers, and the public headers that
# are compiled alone) and what is compiled in two ways on purpose.
set(compiled_in_two_ways tests/support/mock_libhd/mock_functions.cpp)  # with and without one function of the driver
file(READ ${BUILD}/compile_commands.json commands)
string(REGEX MATCHALL "\"file\": \"[^\"]*\"" entries "${commands}")
set(compiled 0)
foreach(entry ${entries})
  string(REGEX REPLACE "\"file\": \"(.*)\"" "\\1" file "${entry}")
  string(FIND "${file}" "${BUILD}/" generated)
  file(RELATIVE_PATH source ${ROOT} ${file})
  if(generated EQUAL 0 OR source IN_LIST compiled_in_two_ways)
    continue()
  endif()
  math(EXPR compiled "${compiled} + 1")
  if(DEFINED seen_${source})
    string(APPEND faults "${source}: is compiled more than once\n")
  endif()
  set(seen_${source} TRUE)
endforeach()
# what a module forgets to compile
foreach(top ${production})
  file(GLOB_RECURSE sources RELATIVE ${ROOT} ${ROOT}/${top}/*.cpp)
  foreach(source ${sources})
    if(NOT DEFINED seen_${source})
      string(APPEND faults "${source}: is not compiled\n")
    endif()
  endforeach()
endforeach()

if(scanned LESS 20 OR compiled LESS 400)
  message(FATAL_ERROR "only ${scanned} CMakeLists and ${compiled} compiled sources were looked at: too few")
endif()
if(faults)
  message(FATAL_ERROR "${faults}")
endif()
message(STATUS "${scanned} CMakeLists name only their own sources; ${compiled} sources are compiled once each")
