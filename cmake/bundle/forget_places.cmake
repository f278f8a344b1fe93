# SPDX-License-Identifier: Apache-2.0
# cmake -DFILE=... -P forget_places.cmake: a library no longer says where it looks for others, so that the program does.
file(RPATH_REMOVE FILE "${FILE}")
