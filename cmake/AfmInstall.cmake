# SPDX-License-Identifier: Apache-2.0
# `cmake --install build/release --prefix DIR` and the Debian package of scripts/package. What is installed finds its parts
# relative to itself, so that DIR may be moved: bin/touchafm is a link to libexec/touchafm/touchafm, beside which the programs lie
# that it starts; main.cpp looks for share/touchafm from there.

# The changelog's first entry is of this version; its date is the man page's and the package's.
file(STRINGS ${CMAKE_SOURCE_DIR}/CHANGELOG.md releases REGEX "^## ")
list(GET releases 0 release)
if(NOT release MATCHES "^## ${PROJECT_VERSION} \\(([0-9]+-[0-9]+-[0-9]+)\\)$")
  message(FATAL_ERROR "CHANGELOG.md begins with \"${release}\": it must begin with \"## ${PROJECT_VERSION} (YEAR-MONTH-DAY)\"")
endif()
set(release_date ${CMAKE_MATCH_1})
# Those who cite it name the same.
file(STRINGS ${CMAKE_SOURCE_DIR}/CITATION.cff cited REGEX "^(version|date-released): ")
if(NOT cited STREQUAL "version: ${PROJECT_VERSION};date-released: ${release_date}")
  message(FATAL_ERROR "CITATION.cff says \"${cited}\": it must say \"version: ${PROJECT_VERSION}\" and \"date-released: ${release_date}\"")
endif()
set_property(DIRECTORY ${CMAKE_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/CITATION.cff)

# gzip without names and times, as Debian's policy asks for
function(afm_compressed source result)
  add_custom_command(OUTPUT ${result} COMMAND sh -c "gzip -9nc \"$1\" >\"$2\"" sh ${source} ${result} DEPENDS ${source} VERBATIM)
endfunction()

set(reference ${CMAKE_BINARY_DIR}/reference)
file(MAKE_DIRECTORY ${reference})
set(assets ${CMAKE_SOURCE_DIR}/assets)
add_custom_command(
  OUTPUT ${reference}/touchafm.1 ${reference}/touchafm.bash
  COMMAND write_reference ${assets} ${release_date} ${reference}
  DEPENDS write_reference ${assets}/materials.toml ${assets}/probes.toml ${CMAKE_SOURCE_DIR}/CHANGELOG.md VERBATIM)
afm_compressed(${reference}/touchafm.1 ${reference}/touchafm.1.gz)
afm_compressed(${CMAKE_SOURCE_DIR}/CHANGELOG.md ${reference}/changelog.gz)
execute_process(COMMAND date -u -R -d ${release_date} OUTPUT_VARIABLE release_time OUTPUT_STRIP_TRAILING_WHITESPACE
                COMMAND_ERROR_IS_FATAL ANY)

# An upgrade of Debian replaces the package by that of the newer Debian: its version is the higher one.
set(package_release 1)
if(EXISTS /etc/os-release)
  file(STRINGS /etc/os-release system REGEX "^(ID|VERSION_ID)=")
  if(system MATCHES "VERSION_ID=\"?([0-9.]+)")
    set(package_release 1+deb${CMAKE_MATCH_1})
  endif()
endif()
set(maintainer "TouchAFM maintainers <maintainers@users.noreply.h-seed-49c1e331.example>")
file(CONFIGURE OUTPUT ${reference}/changelog.Debian CONTENT "touchafm (${PROJECT_VERSION}-${package_release}) unstable; urgency=medium

  * See changelog.gz.

 -- ${maintainer}  ${release_time}
")
afm_compressed(${reference}/changelog.Debian ${reference}/changelog.Debian.gz)
file(READ ${reference}/changelog.Debian changelog)
file(CONFIGURE OUTPUT ${reference}/python3/changelog.Debian CONTENT "python3-${changelog}")
afm_compressed(${reference}/python3/changelog.Debian ${reference}/python3/changelog.Debian.gz)
add_custom_target(reference
  DEPENDS ${reference}/touchafm.1.gz ${reference}/touchafm.bash ${reference}/changelog.gz ${reference}/changelog.Debian.gz ${reference}/python3/changelog.Debian.gz)

# What `cmake --install` needs; it does not build everything first.
set(programs touchafm touchafm-guard touchafm-hdf5 touchafm-servo)
if(NOT AFM_BUNDLE)  # Debian has no archive of the benchmark library, whose interface is C++
  list(APPEND programs touchafm-bench)
endif()
add_custom_target(installed DEPENDS ${programs} reference)
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
if(AFM_PYTHON)
  add_dependencies(installed touchafm_python)
endif()

set(libexec libexec/touchafm)
install(TARGETS ${programs} DESTINATION ${libexec})
file(CREATE_LINK ../${libexec}/touchafm ${reference}/touchafm SYMBOLIC)
install(FILES ${reference}/touchafm DESTINATION bin)
install(DIRECTORY ${assets}/guidance ${assets}/lessons ${assets}/models ${assets}/particles ${assets}/walls ${assets}/wands DESTINATION share/touchafm
        PATTERN *.rules EXCLUDE)
install(FILES ${assets}/materials.toml ${assets}/probes.toml DESTINATION share/touchafm)
install(FILES ${assets}/haptics/70-touchafm-haptics.rules ${assets}/wands/70-touchafm-wands.rules DESTINATION lib/udev/rules.d)
install(FILES ${assets}/cluster/touchafm-node@.service DESTINATION lib/systemd/user)
install(FILES ${assets}/desktop/touchafm.desktop DESTINATION share/applications)
install(FILES ${assets}/desktop/touchafm.svg DESTINATION share/icons/hicolor/scalable/apps)
install(FILES ${reference}/touchafm.1.gz DESTINATION share/man/man1)
install(FILES ${reference}/touchafm.bash DESTINATION share/bash-completion/completions RENAME touchafm)

# The documents that a user reads, and files to copy: the program's own, which need not lie there twice.
set(documents share/doc/touchafm)
set(docs ${CMAKE_SOURCE_DIR}/docs)
install(FILES ${CMAKE_SOURCE_DIR}/cmake/debian/copyright ${reference}/changelog.gz ${reference}/changelog.Debian.gz
        ${CMAKE_SOURCE_DIR}/CITATION.cff ${docs}/manual.md ${docs}/physics.md ${docs}/curves.md ${docs}/fits.md ${docs}/lever.md ${docs}/tapping.md
        ${docs}/manipulation.md ${docs}/generate.md ${docs}/serve.md ${docs}/gltf.md ${docs}/host-tuning.md ${docs}/glossary.md
        ${docs}/tutorial.md ${docs}/teaching.md ${docs}/teaching.de.md ${docs}/worksheet.md ${docs}/worksheet.de.md ${docs}/museum.md
        ${docs}/troubleshooting.md ${docs}/comparison.md ${docs}/adding-a-material.md ${docs}/adding-a-wand.md DESTINATION ${documents})
install(DIRECTORY ${docs}/manual DESTINATION ${documents})
install(DIRECTORY ${docs}/pictures DESTINATION ${documents} PATTERN *.webp EXCLUDE) # the animation is the README's
foreach(example guidance materials.toml particles probes.toml walls wands)
  file(MAKE_DIRECTORY ${reference}/examples)
  file(CREATE_LINK ../../../touchafm/${example} ${reference}/examples/${example} SYMBOLIC)
  install(FILES ${reference}/examples/${example} DESTINATION ${documents}/examples)
endforeach()

if(AFM_PYTHON)
  set(module_documents share/doc/python3-touchafm)
  install(TARGETS touchafm_python DESTINATION ${AFM_PYTHON_FOLDER}/touchafm COMPONENT python)
  install(DIRECTORY ${CMAKE_SOURCE_DIR}/python/touchafm DESTINATION ${AFM_PYTHON_FOLDER} COMPONENT python PATTERN __pycache__ EXCLUDE)
  install(FILES ${CMAKE_SOURCE_DIR}/cmake/debian/copyright ${reference}/changelog.gz ${reference}/python3/changelog.Debian.gz ${docs}/python.md
          DESTINATION ${module_documents} COMPONENT python)
  install(DIRECTORY ${docs}/examples DESTINATION ${module_documents} COMPONENT python PATTERN __pycache__ EXCLUDE)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME touchafm)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/package)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE ${package_release})
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${maintainer}")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each description begins with its summary
set(CPACK_DEBIAN_UNSPECIFIED_DESCRIPTION "virtual atomic force microscope to feel and see
One hand moves the tip of an atomic force microscope, with a force-feedback
device or a mouse. A window or a powerwall shows cantilever, sample and force
curve in stereo. The tip snaps onto the surface, is pressed, and is torn off.

Without hardware, a simulated hand runs the whole procedure. The program also
computes curves of any tip, lever and sample, and analyses measured ones.")
# The libraries that the programs are linked with, from their files. Opened while they run: libvulkan1, and what GLFW 3.3 opens
# to know monitors and pointers, and depends on in Debian 13 alone.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_DEPENDS
    "libvulkan1, libx11-xcb1, libxcursor1, libxi6, libxinerama1, libxrandr2, fonts-inter, fonts-dejavu-core")
# a GPU's own driver will do; SDL2 is for gamepads and sound, espeak-ng for speech, OpenXR's loader for headsets
set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_RECOMMENDS "mesa-vulkan-drivers | vulkan-icd, libsdl2-2.0-0, espeak-ng, libopenxr-loader1")

# Two packages: everything that has no component, and the Python module.
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL Unspecified)
set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_NAME touchafm)
if(AFM_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
  math(EXPR next_minor "${Python3_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-touchafm)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.${Python3_VERSION_MINOR}~), python3 (<< 3.${next_minor}), python3-numpy, \
touchafm (= ${PROJECT_VERSION}-${package_release})")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${CMAKE_SOURCE_DIR}/cmake/debian/python3-touchafm/postinst
      ${CMAKE_SOURCE_DIR}/cmake/debian/python3-touchafm/prerm)
  set(CPACK_DEBIAN_PYTHON_DESCRIPTION "virtual atomic force microscope for Python
Laws of force, approach-retract cycles, readers of curves, fits with intervals,
tapping curves, sessions, and curves whose truth is known, as numpy arrays.
The same numbers as the program touchafm prints, without a display.")
endif()
include(CPack)
