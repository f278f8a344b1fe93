# SPDX-License-Identifier: Apache-2.0
# afm_shaders(target SOURCES a.vert b.frag ...)
# Compiles GLSL to SPIR-V and makes `target` an interface library with one generated header, shaders/<name>.h, a shader:
# a constexpr array named after the file, with an underscore for the dot. The .spv files are listed in the global
# property AFM_SPIRV_FILES for the tests.
find_program(AFM_GLSLANG glslangValidator REQUIRED)

function(afm_shaders target)
  cmake_parse_arguments(PARSE_ARGV 1 S "" "" "SOURCES")
  set(output ${CMAKE_CURRENT_BINARY_DIR}/include/shaders)
  file(MAKE_DIRECTORY ${output})
  foreach(source ${S_SOURCES})
    string(REPLACE "." "_" name ${source})
    set(spirv ${CMAKE_CURRENT_BINARY_DIR}/${source}.spv)
    add_custom_command(
      OUTPUT ${spirv}
      COMMAND ${AFM_GLSLANG} --quiet -V --target-env vulkan1.3 "$<$<CONFIG:Debug>:-gVS>" --depfile ${spirv}.d
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
  endforeach()
  add_custom_target(${target}_headers DEPENDS ${headers})
  add_library(${target} INTERFACE)
  add_dependencies(${target} ${target}_headers)
  target_include_directories(${target} INTERFACE ${CMAKE_CURRENT_BINARY_DIR}/include ${CMAKE_CURRENT_SOURCE_DIR})
endfunction()
