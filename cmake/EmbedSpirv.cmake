# SPDX-License-Identifier: Apache-2.0
# cmake -DSPIRV=in.spv -DNAME=identifier -DHEADER=out.h -P EmbedSpirv.cmake: SPIR-V as a C++ array of 32-bit words.
file(READ ${SPIRV} bytes HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1U," words "${bytes}")
string(REGEX REPLACE "((0x........U,)(0x........U,)(0x........U,)(0x........U,)(0x........U,)(0x........U,)(0x........U,)(0x........U,))"
       "\\1\n" words "${words}")
file(WRITE ${HEADER} "#pragma once
#include <cstdint>

namespace afm::shaders {
inline constexpr std::uint32_t ${NAME}[] = {
${words}};
}  // namespace afm::shaders
")
