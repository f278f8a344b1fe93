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

# Where the sources and the build lie, for the tests that ask. In a header, not on every command line: a compiler's cache finds
# the other tests in whatever folder they are compiled.
set(AFM_TEST_PLACES ${CMAKE_BINARY_DIR}/tests/places)
file(CONFIGURE OUTPUT ${AFM_TEST_PLACES}/places.h CONTENT [[#pragma once
#define AFM_SOURCE_DIR "@CMAKE_SOURCE_DIR@"
#define AFM_BINARY_DIR "@CMAKE_BINARY_DIR@"
]] @ONLY)

# The programs that show pretended HID devices to a test and to what it starts.
find_package(PkgConfig REQUIRED)
find_program(AFM_UMOCKDEV_WRAPPER umockdev-wrapper REQUIRED)
pkg_check_modules(UMOCKDEV REQUIRED IMPORTED_TARGET umockdev-1.0)
set(AFM_WITH_PRETENDED_DEVICES ${CMAKE_SOURCE_DIR}/tests/input/with_pseudo_terminals.sh ${AFM_UMOCKDEV_WRAPPER})

# afm_test(NAME folder.unit SOURCES ... LIBRARIES ... LABELS ... [TIMEOUT seconds] [OPTIMISED] [WHOLE] [PRETENDED_DEVICES])
# One executable test_folder_unit; every TEST in it becomes a CTest case named folder.Suite.Case. With WHOLE the executable is
# one case, for suites whose set-up is dear. Nothing runs beside it, nor beside a test of real time. PRETENDED_DEVICES is
# WHOLE and runs under umockdev. Under a sanitizer, where a program takes 0.15 s to start, the unit tests of one are one case.
function(afm_test)
  cmake_parse_arguments(T "OPTIMISED;WHOLE;PRETENDED_DEVICES" "NAME;TIMEOUT" "SOURCES;LIBRARIES;LABELS" ${ARGN})
  string(REPLACE "." "_" target "test_${T_NAME}")
  string(REGEX REPLACE "\\..*" "" folder "${T_NAME}")
  if(NOT T_TIMEOUT)
    set(T_TIMEOUT 120)
  endif()
  if(T_LABELS STREQUAL "realtime")
    list(APPEND T_LIBRARIES afm_awake_processors)
  endif()
  add_executable(${target} ${T_SOURCES})
  target_link_libraries(${target} PRIVATE ${T_LIBRARIES} GTest::gmock_main afm_build_flags)
  if(T_OPTIMISED)
    target_compile_options(${target} PRIVATE -O1)
  else()
    target_compile_options(${target} PRIVATE ${AFM_TEST_OPTIMISATION})
    target_precompile_headers(${target} REUSE_FROM afm_test_headers)
  endif()
  target_include_directories(${target} PRIVATE ${CMAKE_SOURCE_DIR}/tests ${AFM_TEST_PLACES})
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  if(T_LABELS MATCHES "^(threads|realtime)$")
    add_dependencies(threaded_tests ${target})
  endif()
  set(wrapper "")
  if(T_PRETENDED_DEVICES)
    target_link_libraries(${target} PRIVATE PkgConfig::UMOCKDEV)
    # Debian 13's asks for -pthread, with which nothing was precompiled
    set_target_properties(${target} PROPERTIES DISABLE_PRECOMPILE_HEADERS ON)
    set(T_WHOLE TRUE)
    set(wrapper ${AFM_WITH_PRETENDED_DEVICES})
  endif()
  if(T_WHOLE)
    add_test(NAME ${T_NAME} COMMAND ${wrapper} $<TARGET_FILE:${target}>)
    set_tests_properties(${T_NAME} PROPERTIES LABELS "${T_LABELS}" TIMEOUT ${T_TIMEOUT} RUN_SERIAL TRUE)
    return()
  endif()
  if(AFM_SANITIZE AND T_LABELS STREQUAL "unit")
    add_test(NAME ${T_NAME} COMMAND ${target})
    set_tests_properties(${T_NAME} PROPERTIES LABELS unit TIMEOUT 600)
    return()
  endif()
  set(alone FALSE)
  if(T_LABELS STREQUAL "realtime")
    set(alone TRUE)
  endif()
  gtest_discover_tests(${target} NO_PRETTY_VALUES TEST_PREFIX "${folder}." DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60
                       PROPERTIES LABELS "${T_LABELS}" TIMEOUT ${T_TIMEOUT} RUN_SERIAL ${alone})
endfunction()
