# SPDX-License-Identifier: Apache-2.0
# What every target shares: language level, warnings, sanitizers, ccache, and how a folder becomes a library.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
# -O3 takes the compiler a tenth longer than -O2 and makes nothing here measurably faster
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")
set(THREADS_PREFER_PTHREAD_FLAG ON)
find_package(Threads REQUIRED)

set(AFM_SANITIZE "" CACHE STRING "comma-separated list for -fsanitize, empty for none")
option(AFM_BUILD_FUZZERS "build the libFuzzer targets (clang only)" OFF)
option(AFM_PYTHON "build the Python module touchafm" ON)
set(AFM_PYTHON_FOLDER lib/python3/dist-packages)  # of a build as of an installation
option(AFM_BUNDLE "link programs that run on other distributions (scripts/bundle)" OFF)
if(AFM_PYTHON)
  set(Python3_EXECUTABLE /usr/bin/python3)  # that of the Debian package, whatever else is in the path
  find_package(Python3 REQUIRED COMPONENTS Interpreter Development.Module)
endif()

find_program(AFM_CCACHE ccache)
if(AFM_CCACHE)
  # precompiled headers are cacheable only when time macros and pch defines are declared harmless; paths below the source
  # folder are hashed relative to it, so that a fresh clone finds what another has compiled; what a source includes is taken
  # from the compiler's own list of it, which spares preprocessing everything once more when the cache is empty
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_DEPEND=1 CCACHE_INODECACHE=1 CCACHE_SLOPPINESS=pch_defines,time_macros
      CCACHE_BASEDIR=${CMAKE_SOURCE_DIR} CCACHE_NOHASHDIR=1 ${AFM_CCACHE})
endif()

include(CheckCXXCompilerFlag)
check_cxx_compiler_flag(-fcf-protection=full AFM_HAS_CONTROL_FLOW_PROTECTION)
if(AFM_HAS_CONTROL_FLOW_PROTECTION)
  set(AFM_CONTROL_FLOW_PROTECTION -fcf-protection=full)
endif()
# a hundred programs are linked by every build; GNU's linker takes four times as long
find_program(AFM_MOLD mold)
if(AFM_MOLD)
  add_link_options(-fuse-ld=mold)
endif()
# every symbol is bound at the start: the servo must not look one up in a tick
add_link_options(-Wl,-z,relro,-z,now)
if(NOT AFM_SANITIZE)
  # hides our instances of the standard library's templates: drivers and vendors' libraries must call their own, since
  # ours are compiled with other checks; a sanitizer's runtime has to stay visible
  add_link_options(-Wl,--exclude-libs,ALL)
endif()

add_library(afm_build_flags INTERFACE)
target_compile_options(afm_build_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow -Wdouble-promotion -Wnon-virtual-dtor -Werror
  -ffp-contract=off
  # what an attacker of a parser, or a mistake, would have to get past; measured: no tick is longer
  -fstack-protector-strong -D_GLIBCXX_ASSERTIONS ${AFM_CONTROL_FLOW_PROTECTION}
  $<$<CONFIG:Release>:-U_FORTIFY_SOURCE> $<$<CONFIG:Release>:-D_FORTIFY_SOURCE=2>
  # lets ccache keep what is compiled with a precompiled header; clang's headers contain the path of their clone, so that nothing
  # compiled with them would serve another one: its presets have none
  $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>
  # clang blames us for what libstdc++ 12 does within std::stable_sort; g++ still reports what is deprecated in our own lines
  $<$<CXX_COMPILER_ID:Clang>:-Wno-deprecated-declarations>
  # memory is there: cleaning it up while compiling takes a twelfth of the time
  "$<$<CXX_COMPILER_ID:GNU>:SHELL:--param ggc-min-expand=1000 --param ggc-min-heapsize=2000000>"
  # gcc 12 reports false positives of these inside libstdc++ and fmt once it inlines at -O2
  $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow -Wno-array-bounds -Wno-restrict -Wno-maybe-uninitialized>)
if(AFM_SANITIZE)
  add_compile_options(-fsanitize=${AFM_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${AFM_SANITIZE})
endif()
if(AFM_BUILD_FUZZERS)
  # all of the code tells libFuzzer where it has been, not only the targets' own file
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()

# GLM's conventions are fixed here once: depth 0..1, no implicit or ambiguous conversions.
add_library(afm_glm INTERFACE)
target_compile_definitions(afm_glm INTERFACE GLM_FORCE_DEPTH_ZERO_TO_ONE GLM_FORCE_EXPLICIT_CTOR GLM_ENABLE_EXPERIMENTAL)
target_link_libraries(afm_build_flags INTERFACE afm_glm)

# What runs a few times a frame or less gains nothing from -O2, and takes the compiler a third longer with it; a sanitizer's
# instructions cost a compiler that optimises twice as long as one that does not.
set(AFM_COLD_CODE $<$<CONFIG:Release>:-O1> $<$<CONFIG:RelWithDebInfo>:-O0>)

# What most files include and the compiler needs seconds to read is read once. It replaces no include: the public headers are
# compiled alone, without it (scripts/compile-alone). Those who share it must agree about what they optimise and
# about fmt's macros.
set(AFM_PRECOMPILED_HEADERS <algorithm> <array> <chrono> <cmath> <cstdint> <filesystem> <functional> <limits> <map> <memory>
    <optional> <random> <span> <stdexcept> <string> <string_view> <thread> <utility> <vector>
    <glm/geometric.hpp> <glm/gtc/matrix_transform.hpp> <glm/gtc/quaternion.hpp> <glm/mat4x4.hpp> <tl/expected.hpp>)
file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/precompiled.cpp CONTENT "")
# Each once more for the libraries that the Python module links, which have to be relocatable (docs/decisions/0023).
function(afm_precompiled name)
  cmake_parse_arguments(P "" "" "OPTIONS;LIBRARIES;HEADERS" ${ARGN})
  foreach(each ${name} ${name}_relocatable)
    add_library(${each} OBJECT EXCLUDE_FROM_ALL ${CMAKE_BINARY_DIR}/precompiled.cpp)
    target_link_libraries(${each} PRIVATE ${P_LIBRARIES} glm::glm afm_build_flags)
    target_compile_options(${each} PRIVATE ${P_OPTIONS})
    target_precompile_headers(${each} PRIVATE ${AFM_PRECOMPILED_HEADERS} ${P_HEADERS})
  endforeach()
  afm_relocatable(${name}_relocatable)
endfunction()

# Code that a shared object can hold. Hidden symbols cannot be replaced from outside, so that the compiler may inline them, and calls
# them directly, as in a program.
function(afm_relocatable target)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
endfunction()
find_package(fmt REQUIRED)
find_package(glm REQUIRED)
find_package(nlohmann_json REQUIRED)
afm_precompiled(afm_plain_headers)
afm_precompiled(afm_formatting_headers LIBRARIES fmt::fmt HEADERS <fmt/format.h>)
afm_precompiled(afm_cold_headers OPTIONS ${AFM_COLD_CODE} LIBRARIES fmt::fmt nlohmann_json::nlohmann_json
                HEADERS <fmt/format.h> <nlohmann/json.hpp>)

# Ten sources of a module are compiled as one, which takes a third of the time: what they name for themselves must differ within the
# module. `scripts/compile-alone` finds a source that lacks an include. CMake's own unity builds name the sources
# by their absolute paths, and ccache would find none of them for another clone.
option(AFM_UNITY_BUILD "compile ten sources of a module as one" ON)
# afm_compile_together(TARGET [SOURCE that is compiled alone ...])
function(afm_compile_together target)
  if(NOT AFM_UNITY_BUILD)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cpp$")
  list(TRANSFORM ARGN PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE alone)
  list(REMOVE_ITEM sources ${alone})
  set_source_files_properties(${sources} PROPERTIES HEADER_FILE_ONLY ON)  # listed, not compiled
  set(number 0)
  while(sources)
    list(SUBLIST sources 0 10 batch)
    list(REMOVE_ITEM sources ${batch})
    set(includes "")
    foreach(source ${batch})
      file(RELATIVE_PATH path ${CMAKE_CURRENT_BINARY_DIR}/Unity ${source})
      string(APPEND includes "#include \"${path}\"\n")
    endforeach()
    set(unity ${CMAKE_CURRENT_BINARY_DIR}/Unity/unity_${target}_${number}.cpp)
    file(CONFIGURE OUTPUT ${unity} CONTENT "${includes}" @ONLY)
    target_sources(${target} PRIVATE ${unity})
    math(EXPR number "${number} + 1")
  endwhile()
endfunction()

# afm_module(NAME [COLD] [IN_PYTHON] PUBLIC ... PRIVATE ... [PRECOMPILED ...] [ALONE source that is not compiled together with others ...])
# A folder is a static library afm::NAME of all that lies in its include/ and src/. Only include/ is exported, so that including a
# module that is not linked fails; every public header is compiled alone by scripts/compile-alone. Headers are
# precompiled by names in <>: the path of one in quotes would be that of a clone, and the compiler's cache useless to every other.
# The Python module links those with IN_PYTHON.
function(afm_module name)
  cmake_parse_arguments(PARSE_ARGV 1 M "COLD;IN_PYTHON" "" "PUBLIC;PRIVATE;PRECOMPILED;ALONE")
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS src/*.cpp)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS include/*.h)
  add_library(afm_${name} STATIC ${sources})
  add_library(afm::${name} ALIAS afm_${name})
  target_sources(afm_${name} PUBLIC FILE_SET HEADERS BASE_DIRS include FILES ${headers})
  target_include_directories(afm_${name} PRIVATE src)
  target_link_libraries(afm_${name} PUBLIC ${M_PUBLIC} PRIVATE ${M_PRIVATE} $<BUILD_INTERFACE:afm_build_flags>)
  if("${M_PRECOMPILED}" MATCHES "(^|;)[^<]")
    message(FATAL_ERROR "afm_module(${name}): PRECOMPILED takes headers in <>: ${M_PRECOMPILED}")
  endif()
  set(relocatable "")
  if(M_IN_PYTHON AND AFM_PYTHON)
    afm_relocatable(afm_${name})
    set(relocatable _relocatable)
  endif()
  if(M_PRECOMPILED)
    target_precompile_headers(afm_${name} PRIVATE ${AFM_PRECOMPILED_HEADERS} ${M_PRECOMPILED})
  elseif(M_COLD)
    target_compile_options(afm_${name} PRIVATE ${AFM_COLD_CODE})
    target_precompile_headers(afm_${name} REUSE_FROM afm_cold_headers${relocatable})
  elseif("fmt::fmt" IN_LIST M_PRIVATE)
    target_precompile_headers(afm_${name} REUSE_FROM afm_formatting_headers${relocatable})
  else()
    target_precompile_headers(afm_${name} REUSE_FROM afm_plain_headers${relocatable})
  endif()
  set_target_properties(afm_${name} PROPERTIES VERIFY_INTERFACE_HEADER_SETS ON)
  afm_compile_together(afm_${name} ${M_ALONE})
endfunction()
