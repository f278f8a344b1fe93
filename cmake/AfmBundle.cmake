# SPDX-License-Identifier: Apache-2.0
# The preset bundle: programs that a folder of another distribution can hold (scripts/bundle, docs/decisions/0024). Sources are compiled as
# for the preset release, so that both share a compiler cache; only what is linked differs.
#
# The C++ library is in each program, hidden: a driver brings the system's, which is another. So must be every library whose interface is
# C++; those of C stay shared and lie in lib/touchafm, which programs name by RPATH: unlike a RUNPATH it holds for what they need in turn.
set(CMAKE_INSTALL_RPATH $ORIGIN/../../lib/touchafm)
set(CMAKE_BUILD_WITH_INSTALL_RPATH ON)
add_link_options(-static-libstdc++ -static-libgcc -Wl,--disable-new-dtags -Wl,--as-needed -Wl,--gc-sections)

# what it needs of a glibc that is too new
add_library(afm_bundled_random STATIC cmake/bundle/arc4random.cpp)
link_libraries(afm_bundled_random)

# fmt and toml++ have no archive in Debian: their sources are in their headers
add_library(afm_bundled_fmt STATIC cmake/bundle/fmt.cpp)
target_include_directories(afm_bundled_fmt PRIVATE $<TARGET_PROPERTY:fmt::fmt,INTERFACE_INCLUDE_DIRECTORIES>)
get_target_property(configurations fmt::fmt IMPORTED_CONFIGURATIONS)
set_target_properties(fmt::fmt PROPERTIES IMPORTED_LOCATION_${configurations} ${CMAKE_CURRENT_BINARY_DIR}/libafm_bundled_fmt.a)
add_dependencies(fmt::fmt afm_bundled_fmt)

find_package(PkgConfig REQUIRED)
pkg_check_modules(TOMLPLUSPLUS REQUIRED IMPORTED_TARGET GLOBAL tomlplusplus)
add_library(afm_bundled_toml STATIC cmake/bundle/toml.cpp)
target_compile_options(afm_bundled_toml PRIVATE ${TOMLPLUSPLUS_CFLAGS_OTHER})
set_target_properties(PkgConfig::TOMLPLUSPLUS PROPERTIES INTERFACE_LINK_LIBRARIES afm_bundled_toml)

# not every distribution has systemd
pkg_check_modules(SYSTEMD REQUIRED IMPORTED_TARGET GLOBAL libsystemd)
add_library(afm_bundled_systemd STATIC cmake/bundle/systemd.cpp)
set_target_properties(PkgConfig::SYSTEMD PROPERTIES INTERFACE_LINK_LIBRARIES "afm_bundled_systemd;${CMAKE_DL_LIBS}")

find_package(draco CONFIG REQUIRED)
get_target_property(archive draco::draco_static IMPORTED_LOCATION_NONE)
set_target_properties(draco::draco PROPERTIES IMPORTED_LOCATION_NONE ${archive})
find_package(pugixml REQUIRED)
set_target_properties(pugixml::pugixml PROPERTIES INTERFACE_LINK_LIBRARIES pugixml::static)

# C, but other libraries of a process may want the system's newer one
find_library(PNG_LIBRARY_RELEASE NAMES libpng16.a REQUIRED)

# HDF5's shared library needs curl for files of a web service, which the archive leaves out of a program that asks for none
set(AFM_HDF5_NAMES libhdf5_serial.a)
find_library(AFM_SZIP NAMES libsz.a REQUIRED)
find_library(AFM_AEC NAMES libaec.a REQUIRED)
set(AFM_HDF5_NEEDS ${AFM_SZIP} ${AFM_AEC} z m ${CMAKE_DL_LIBS})
