# SPDX-License-Identifier: Apache-2.0
# What the built programs are protected by, read from their files.
find_program(READELF readelf REQUIRED)
find_program(OBJDUMP objdump REQUIRED)

function(must_match program text pattern what)
  if(NOT text MATCHES "${pattern}")
    message(SEND_ERROR "${program} ${what}")
  endif()
endfunction()

string(REPLACE "," ";" programs "${PROGRAMS}")
foreach(program ${programs})
  execute_process(COMMAND ${READELF} --wide --file-header --program-headers --dynamic --dyn-syms ${program} OUTPUT_VARIABLE elf
                  COMMAND_ERROR_IS_FATAL ANY)
  must_match(${program} "${elf}" "Type: +DYN" "is not position-independent (-fPIE -pie)")
  must_match(${program} "${elf}" "GNU_RELRO" "has no read-only relocations (-z relro)")
  must_match(${program} "${elf}" "BIND_NOW|FLAGS_1.*NOW" "looks symbols up while it runs (-z now)")
  must_match(${program} "${elf}" "__stack_chk_fail" "has no stack protector (-fstack-protector-strong)")
  must_match(${program} "${elf}" "__glibcxx_assert_fail" "has no assertions of the standard library (-D_GLIBCXX_ASSERTIONS)")
  if(NOT SANITIZED)
    must_match(${program} "${elf}" "_chk@GLIBC" "is not fortified (-D_FORTIFY_SOURCE=2)")
    # a driver that called our std::vector and got no memory would throw past its own locks; _M_dispose allocates nothing
    string(REGEX MATCHALL "FUNC +(WEAK|GLOBAL) +DEFAULT +[0-9]+ _Z[^\n]*" offered "${elf}")
    list(FILTER offered EXCLUDE REGEX "_M_dispose")
    if(program MATCHES "touchafm(-servo)?$" AND offered)
      message(SEND_ERROR "${program} offers libraries its own ${offered} (--exclude-libs, and no code beside main())")
    endif()
  endif()
  if(elf MATCHES "GNU_STACK[^\n]*RWE")
    message(SEND_ERROR "${program} has an executable stack")
  endif()
  if(CONTROL_FLOW)
    # the C library's own start files have no such branches, so that the note of the whole program says nothing
    execute_process(COMMAND ${OBJDUMP} --disassemble=main ${program} OUTPUT_VARIABLE code COMMAND_ERROR_IS_FATAL ANY)
    must_match(${program} "${code}" "endbr64" "has no control-flow protection (-fcf-protection)")
  endif()
endforeach()
