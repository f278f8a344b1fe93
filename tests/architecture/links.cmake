# SPDX-License-Identifier: Apache-2.0
# cmake -DROOT=... -P links.cmake
# Every link between the documents leads to a file, and every #anchor to a heading, as forges name them: lower case, spaces
# as hyphens, other punctuation dropped.
# Invariant: every link of the documents leads to a file or a heading
cmake_minimum_required(VERSION 3.25)

# Sets `out` to the anchors of a document's headings, each between newlines.
function(anchors_of document out)
  file(READ ${document} text)
  string(REGEX REPLACE "[;\\[]" "" text "${text}")
  string(REGEX REPLACE "```[^`]*```" "" text "${text}") # a comment in a listing is no heading
  string(REGEX MATCHALL "\n#+ [^\n]+" headings "\n${text}")
  set(anchors "\n")
  foreach(heading ${headings})
    string(REGEX REPLACE "^\n#+ " "" heading "${heading}")
    string(TOLOWER "${heading}" heading)
    string(REGEX REPLACE "[^a-z0-9 _-]" "" heading "${heading}")
    string(REPLACE " " "-" heading "${heading}")
    string(APPEND anchors "${heading}\n")
  endforeach()
  set(${out} "${anchors}" PARENT_SCOPE)
endfunction()

file(GLOB_RECURSE documents RELATIVE ${ROOT} ${ROOT}/*.md)
list(FILTER documents EXCLUDE REGEX "^build/")
set(faults "")
set(count 0)
foreach(document ${documents})
  file(READ ${ROOT}/${document} text)
  string(REPLACE "](" "\n<" text "${text}") # brackets would join the elements of a CMake list
  string(REGEX REPLACE "[][;]" "" text "${text}")
  string(REGEX MATCHALL "\n<[A-Za-z0-9_./#-]+\\)" links "${text}") # an address has a colon
  get_filename_component(folder ${ROOT}/${document} DIRECTORY)
  foreach(link ${links})
    string(REGEX REPLACE "[\n<)]" "" link "${link}")
    math(EXPR count "${count} + 1")
    string(REGEX REPLACE "#.*" "" file "${link}")
    set(target ${folder}/${file})
    if(file STREQUAL "")
      set(target ${ROOT}/${document})
    endif()
    if(NOT EXISTS ${target})
      string(APPEND faults "${document}: ${link}: there is no such file\n")
    elseif(link MATCHES "#(.+)$")
      set(anchor "${CMAKE_MATCH_1}")
      anchors_of(${target} anchors)
      string(FIND "${anchors}" "\n${anchor}\n" at)
      if(at EQUAL -1)
        string(APPEND faults "${document}: ${link}: there is no such heading\n")
      endif()
    endif()
  endforeach()
endforeach()

if(count LESS 60)
  message(FATAL_ERROR "only ${count} links were found in the documents: too few")
endif()
if(faults)
  message(FATAL_ERROR "${faults}")
endif()
message(STATUS "${count} links of the documents lead to files and headings")
