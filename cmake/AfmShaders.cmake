# SPDX-License-Identifier: Apache-2.0
# afm_shaders(target SOURCES a.vert b.frag ... VIEW_SOURCES c.vert ...)
# Compiles GLSL to SPIR-V and makes `target` an interface library with one generated header, shaders/<name>.h, a shader:
# a constexpr array named after the file, with an underscore for the dot. The .spv files are listed in the global
# property AFM_SPIRV_FILES for the tests. VIEW_SOURCES depend on the eye that is drawn, and give a second array, <name>_one_view,
# for passes of one eye: no specialisation constant takes the capability MultiView away.
find_program(AFM_GLSLANG glslangValidator REQUIRED)

# One array, in one header that is appended to `headers`.
macro(afm_shader source suffix definition output)
  string(REPLACE "." "_" name ${source}${suffix})
  set(spirv ${CMAKE_CURRENT_BINARY_DIR}/${source}${suffix}.spv)
  add_custom_command(
    OUTPUT ${spirv}
    COMMAND ${AFM_GLSLANG} --quiet -V --target-env vulkan1.3 ${definition} "$<$<CONFIG:Debug>:-gVS>" --depfile ${spirv}.d
            -I${CMAKE_CURRENT_SOURCE_DIR} -o ${spirv} ${CMAKE_CURRENT_SOURCE_DIR}/${source}
    DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${source}
    DEPFILE ${spirv}.d
    VERBATIM COMMAND_EXPAND_LISTS)
  add_custom_command(
    OUTPUT ${output}/${name}.h
    COMMAND ${CMAKE_COMMAND} -DSPIRV=${spirv} -DNAME=${name} -DHEADER=${output}/${name}.h
            -P ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/EmbedSpirv.cmake
    DEPENDS ${spirv} ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/EmbedSpirv.cmake
    VERBATIM)
  list(APPEND headers ${output}/${name}.h)
  set_property(GLOBAL APPEND PROPERTY AFM_SPIRV_FILES ${spirv})
endmacro()

function(afm_shaders target)
  cmake_parse_arguments(PARSE_ARGV 1 S "" "" "SOURCES;VIEW_SOURCES")
  set(output ${CMAKE_CURRENT_BINARY_DIR}/include/shaders)
  file(MAKE_DIRECTORY ${output})
  foreach(source ${S_SOURCES} ${S_VIEW_SOURCES})
    afm_shader(${source} "" "" ${output})
  endforeach()
  foreach(source ${S_VIEW_SOURCES})
    afm_shader(${source} _one_view -DAFM_ONE_VIEW ${output})
  endforeach()
  add_custom_target(${target}_headers DEPENDS ${headers})
  add_library(${target} INTERFACE)
  add_dependencies(${target} ${target}_headers)
  target_include_directories(${target} INTERFACE ${CMAKE_CURRENT_BINARY_DIR}/include ${CMAKE_CURRENT_SOURCE_DIR})
endfunction()
