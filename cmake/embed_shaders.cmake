# cmake -DNAME=... -DOUTPUT=... -DROOT=... "-DSHADERS=a|b" -P embed_shaders.cmake
# The generated file defines `std::span<const gpu::EmbeddedShader> embeddedShaders_NAME()`.
# The text only ever passes through quoted arguments: unquoted, CMake would split it at semicolons
# and join lines over square brackets.
set(text "// Generated from the shader files named below; do not edit.
#include \"gpu/shader_source.hpp\"

namespace lucerna::gpu {
namespace {
constexpr EmbeddedShader kShaders[] = {
")
string(REPLACE "|" ";" SHADERS "${SHADERS}")
foreach(shader IN LISTS SHADERS)
  file(READ "${ROOT}/${shader}" content)
  string(APPEND text "    {\"${shader}\", R\"glsl__(${content})glsl__\"},\n")
endforeach()
string(APPEND text "};
}  // namespace

std::span<const EmbeddedShader> embeddedShaders_${NAME}();
std::span<const EmbeddedShader> embeddedShaders_${NAME}() { return kShaders; }

}  // namespace lucerna::gpu
")
file(WRITE "${OUTPUT}" "${text}")
