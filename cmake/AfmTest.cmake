# SPDX-License-Identifier: Apache-2.0
find_package(GTest REQUIRED)
include(GoogleTest)

# What the tsan preset builds and runs: the tests in which more than one thread or process takes part.
add_custom_target(threaded_tests)

# GoogleTest and JSON are read once for all tests. Their own code is not optimised: it compiles sooner, and none of it is timed. That of
# the few that compute for seconds is (OPTIMISED).
set(AFM_TEST_OPTIMISATION -O0)
afm_precompiled(afm_test_headers OPTIONS ${AFM_TEST_OPTIMISATION} LIBRARIES GTest::gmock_main nlohmann_json::nlohmann_json
                HEADERS <gmock/gmock.h> <gtest/gtest.h> <nlohmann/json.hpp>)
afm_precompiled(afm_optimised_test_headers OPTIONS -O1 LIBRARIES GTest::gmock_main nlohmann_json::nlohmann_json
                HEADERS <gmock/gmock.h> <gtest/gtest.h> <nlohmann/json.hpp>)

# The programs that show pretended HID devices to a test and to what it starts.
find_package(PkgConfig REQUIRED)
find_program(AFM_UMOCKDEV_WRAPPER umockdev-wrapper REQUIRED)
pkg_check_modules(UMOCKDEV REQUIRED IMPORTED_TARGET umockdev-1.0)
set(AFM_WITH_PRETENDED_DEVICES ${CMAKE_SOURCE_DIR}/tests/input/with_pseudo_terminals.sh ${AFM_UMOCKDEV_WRAPPER})

# afm_test(NAME folder.subject SOURCES ... LIBRARIES ... LABELS ... [NEEDS target ...] [TIMEOUT seconds] [OPTIMISED] [SERIAL] [DRAWS]
#          [CASES | SUITES] [DEEP pattern ...] [ONLY_DEEP pattern ...] [PRETENDED_DEVICES])
# One program, test_folder_subject, of sources that are compiled together: the names in them must differ. It is one case of CTest,
# folder.subject. With CASES every TEST in it is one, folder.Suite.Case, and with SUITES every suite, folder.Suite. Three cases run
# side by side, two under AddressSanitizer; nothing runs beside one that is SERIAL, as everything of label realtime is. Those of
# label hand wait more than they compute: scripts/run-tests runs them after all others, three at a time; one that DRAWS takes the
# place of two and begins before those that do not, and one that measures a speed is SERIAL.
# Patterns are GoogleTest's. The tests that a pattern of DEEP names draw more in a case of their own, NAME.deep.PATTERN of label deep
# (tests/support/deep.h). Those that ONLY_DEEP names (suites with SUITES) are left out of the usual run and have the label deep beside
# their own. NEEDS names the programs that the test starts. PRETENDED_DEVICES runs it under umockdev.
function(afm_test)
  cmake_parse_arguments(T "OPTIMISED;SERIAL;DRAWS;CASES;SUITES;PRETENDED_DEVICES" "NAME;TIMEOUT" "SOURCES;LIBRARIES;LABELS;NEEDS;DEEP;ONLY_DEEP" ${ARGN})
  if(T_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "afm_test(${T_NAME}): unknown: ${T_UNPARSED_ARGUMENTS}")
  endif()
  string(REPLACE "." "_" target "test_${T_NAME}")
  string(REGEX REPLACE "\\..*" "" folder "${T_NAME}")
  if(NOT T_TIMEOUT)
    set(T_TIMEOUT 300)  # for a machine several times as busy as usual
  endif()
  set(serial ${T_SERIAL})  # by option or label
  set(deep_serial ${T_SERIAL})  # the same for its cases of label deep
  if(T_LABELS MATCHES "^(realtime|hand)$")
    list(APPEND T_LIBRARIES afm_awake_processors)
    set(deep_serial TRUE)
  endif()
  if(T_LABELS STREQUAL realtime)
    set(serial TRUE)
  endif()
  if(T_NEEDS MATCHES touchafm)
    list(APPEND T_LIBRARIES afm_own_runtime_folder)
  endif()
  list(TRANSFORM T_SOURCES PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  add_executable(${target} ${T_SOURCES})
  target_link_libraries(${target} PRIVATE ${T_LIBRARIES} afm_test_places GTest::gmock_main afm_build_flags)
  if(T_OPTIMISED)
    target_compile_options(${target} PRIVATE -O1)
    target_precompile_headers(${target} REUSE_FROM afm_optimised_test_headers)
  else()
    target_compile_options(${target} PRIVATE ${AFM_TEST_OPTIMISATION})
    target_precompile_headers(${target} REUSE_FROM afm_test_headers)
  endif()
  target_include_directories(${target} PRIVATE ${CMAKE_SOURCE_DIR}/tests)
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  if(T_LABELS MATCHES "^(threads|realtime|hand)$")
    add_dependencies(threaded_tests ${target})
  endif()
  if(T_NEEDS)
    add_dependencies(${target} ${T_NEEDS})
  endif()
  set(wrapper "")
  if(T_PRETENDED_DEVICES)
    target_link_libraries(${target} PRIVATE PkgConfig::UMOCKDEV)
    # Debian 13's asks for -pthread, with which nothing was precompiled
    set_target_properties(${target} PROPERTIES DISABLE_PRECOMPILE_HEADERS ON)
    set(wrapper ${AFM_WITH_PRETENDED_DEVICES})
  endif()
  afm_compile_together(${target})

  set(deep ${T_DEEP})  # patterns of the cases NAME.deep.PATTERN
  list(JOIN T_ONLY_DEEP ":" only_deep)
  set(usual "")        # the filter of the usual run
  if(T_ONLY_DEEP AND NOT T_SUITES)
    set(usual --gtest_filter=-${only_deep})
    if(NOT T_CASES)
      list(APPEND deep ${T_ONLY_DEEP})
    endif()
  endif()
  foreach(pattern IN LISTS deep)
    string(REPLACE "/" "." case "${pattern}")
    string(REGEX REPLACE "\\.?[*]$|[*]\\.?" "" case "${case}")
    add_test(NAME ${T_NAME}.deep.${case} COMMAND ${wrapper} $<TARGET_FILE:${target}> --gtest_filter=${pattern})
    set_tests_properties(${T_NAME}.deep.${case} PROPERTIES LABELS deep TIMEOUT 900 RUN_SERIAL ${deep_serial} ENVIRONMENT AFM_DEEP=1
                         FAIL_REGULAR_EXPRESSION "Running 0 tests")
  endforeach()
  string(REPLACE ";" "\\;" labels "${T_LABELS}")  # one value of the list of properties
  set(properties LABELS "${labels}" TIMEOUT ${T_TIMEOUT} RUN_SERIAL ${serial})
  if(T_DRAWS)
    list(APPEND properties PROCESSORS 2 COST 10)
  endif()
  if(T_CASES)
    set(discovery NO_PRETTY_VALUES TEST_PREFIX "${folder}." DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60)
    if(T_ONLY_DEEP)
      gtest_discover_tests(${target} ${discovery} TEST_LIST ${target}_deep TEST_FILTER "${only_deep}"
                           PROPERTIES LABELS "deep\;${T_LABELS}" TIMEOUT ${T_TIMEOUT} RUN_SERIAL ${deep_serial})
      list(APPEND discovery TEST_FILTER "-${only_deep}")
    endif()
    gtest_discover_tests(${target} ${discovery} PROPERTIES ${properties})
  elseif(T_SUITES)
    afm_suites_of(suites ${T_SOURCES})
    foreach(suite ${suites})
      add_test(NAME ${folder}.${suite} COMMAND ${wrapper} $<TARGET_FILE:${target}> --gtest_filter=${suite}.*)
      set_tests_properties(${folder}.${suite} PROPERTIES ${properties})
      if(suite IN_LIST T_ONLY_DEEP)
        set_tests_properties(${folder}.${suite} PROPERTIES LABELS "deep;${T_LABELS}")
      endif()
    endforeach()
  else()
    add_test(NAME ${T_NAME} COMMAND ${wrapper} $<TARGET_FILE:${target}> ${usual})
    set_tests_properties(${T_NAME} PROPERTIES ${properties})
  endif()
endfunction()

# Sets `result` to the suites of TEST and TEST_F in the sources.
function(afm_suites_of result)
  set(suites "")
  foreach(source ${ARGN})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source})
    file(STRINGS ${source} lines REGEX "^TEST(_F)?\\(")
    list(TRANSFORM lines REPLACE "^TEST(_F)?\\(([A-Za-z0-9]+).*" "\\2")
    list(APPEND suites ${lines})
  endforeach()
  list(REMOVE_DUPLICATES suites)
  set(${result} ${suites} PARENT_SCOPE)
endfunction()
