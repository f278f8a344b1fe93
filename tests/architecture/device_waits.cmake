# SPDX-License-Identifier: Apache-2.0
# cmake -DROOT=... -P device_waits.cmake
# The program waits until the graphics device is idle when the size of something changes and at the end, never in a frame:
# all such waits stand here, by file and number.
# Invariant: only resize and exit wait for an idle graphics device
set(allowed
  "render/src/composition/corrections.cpp 1"     # many sizes of one warped window
  "render/src/device/device.cpp 2"               # the function, and wait_idle(), for what destroys
  "render/src/device/device.h 1"
  "render/src/output/window_surface.cpp 2"       # another size of the window, another surface
  "render/src/renderer/renderer.cpp 1")          # resize()
file(GLOB_RECURSE sources RELATIVE ${ROOT} ${ROOT}/render/src/*.cpp ${ROOT}/render/src/*.h ${ROOT}/exhibit/*.cpp ${ROOT}/app/*.cpp)
set(found "")
foreach(source ${sources})
  file(STRINGS ${ROOT}/${source} waits REGEX "(waitIdle|finish_all)\\(")
  list(LENGTH waits count)
  if(count GREATER 0)
    list(APPEND found "${source} ${count}")
  endif()
endforeach()
if(NOT found STREQUAL allowed)
  message(FATAL_ERROR "waits for an idle device: ${found}\nallowed: ${allowed}")
endif()
