# SPDX-License-Identifier: Apache-2.0
# cmake -DBUILD=... -P made_up_faults.cmake: each rule below finds a fault in a small tree that has it, and none in the tree before.
# Invariant: the rules for the sources find made-up faults
cmake_minimum_required(VERSION 3.25)

set(tree ${BUILD}/tests/architecture/made-up)
file(REMOVE_RECURSE ${tree})

# Runs a rule on the tree; the text that it must print, or an empty one where it must find nothing.
function(expect rule fault)
  execute_process(COMMAND ${CMAKE_COMMAND} -DROOT=${tree} -DMADE_UP=TRUE ${ARGN} -P ${CMAKE_CURRENT_LIST_DIR}/${rule}.cmake
                  RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  string(REGEX REPLACE "[ \n]+" " " output "${output}")
  if(fault STREQUAL "" AND NOT status EQUAL 0)
    message(FATAL_ERROR "${rule} found a fault where there is none: ${output}")
  endif()
  if(NOT fault STREQUAL "" AND (status EQUAL 0 OR NOT output MATCHES "${fault}"))
    message(FATAL_ERROR "${rule} did not find \"${fault}\": ${output}")
  endif()
endfunction()

# a folder with two subfolders
file(WRITE ${tree}/made/CMakeLists.txt "afm_module(made)\n")
file(WRITE ${tree}/made/include/made/low/one.h "#pragma once\n")
file(WRITE ${tree}/made/include/made/high/two.h "#include \"made/low/one.h\"\n")
file(WRITE ${tree}/subfolders.cmake "set(subfolders_app)\nset(subfolders_made low high)\nset(arrows_made/high low)\n")
expect(subfolders "")
file(WRITE ${tree}/made/src/low/one.cpp "#include \"made/high/two.h\"\n")
expect(subfolders "low may not include high")
file(APPEND ${tree}/subfolders.cmake "set(arrows_made/low high)\n")
expect(subfolders "from low to high does not lead down")
file(WRITE ${tree}/made/src/low/one.cpp "#include \"made/low/one.h\"\n")
file(WRITE ${tree}/made/include/made/high/two.h "#pragma once\n")
file(WRITE ${tree}/subfolders.cmake "set(subfolders_app)\nset(subfolders_made low high)\nset(arrows_made/high low)\n")
expect(subfolders "no include needs the arrow from high to low")
file(WRITE ${tree}/made/src/third/three.cpp "\n")
expect(subfolders "has no row for third")

# a chain of 62 headers: the last pulls in 61
file(WRITE ${tree}/made/include/made/chain0.h "#pragma once\n")
foreach(i RANGE 1 60)
  math(EXPR before "${i} - 1")
  file(WRITE ${tree}/made/include/made/chain${i}.h "#include \"made/chain${before}.h\"\n")
endforeach()
expect(header_reach "")
file(WRITE ${tree}/made/include/made/chain61.h "#include \"made/chain60.h\"\n")
expect(header_reach "made/chain61.h: pulls in 61 headers")
file(WRITE ${tree}/made/include/made/chain0.h "#include \"made/chain61.h\"\n")
expect(header_reach "include each other")
expect(include_cycles "include each other")

# a public header that includes one of another folder
file(WRITE ${tree}/other/CMakeLists.txt "afm_module(other)\n")
file(WRITE ${tree}/other/include/other/three.h "#pragma once\n")
file(WRITE ${tree}/made/include/made/high/two.h "#include \"other/three.h\"\n")
file(WRITE ${tree}/made/CMakeLists.txt "afm_module(made PRIVATE afm::other)\n")
expect(public_links "made does not link other with PUBLIC")
file(WRITE ${tree}/made/CMakeLists.txt "afm_module(made COLD PUBLIC afm::other PRIVATE fmt::fmt)\n")
expect(public_links "")
file(WRITE ${tree}/made/CMakeLists.txt "afm_module(made)\n")
file(WRITE ${tree}/made/include/made/high/two.h "#pragma once\n")

# two folders of equal size: each has more than its share
file(WRITE ${tree}/other/src/long.cpp "// 1\n// 2\n// 3\n")
expect(sizes "production lines are")

file(REMOVE_RECURSE ${tree})
message(STATUS "the rules find made-up faults")
