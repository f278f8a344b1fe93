# SPDX-License-Identifier: Apache-2.0
# include(production.cmake) sets `modules`, each folder that a CMakeLists makes a module of (afm_module), app and python, and `production`, the
# top folders that hold them: a new folder is measured by every rule without a list.
file(GLOB candidates RELATIVE ${ROOT} ${ROOT}/*/CMakeLists.txt ${ROOT}/*/*/CMakeLists.txt)
set(modules app python)
foreach(candidate ${candidates})
  file(STRINGS ${ROOT}/${candidate} calls REGEX "^afm_module\\(")
  if(calls)
    get_filename_component(module ${candidate} DIRECTORY)
    list(APPEND modules ${module})
  endif()
endforeach()
list(SORT modules)
list(TRANSFORM modules REPLACE "/.*" "" OUTPUT_VARIABLE production)
list(REMOVE_DUPLICATES production)
