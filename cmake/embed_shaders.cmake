# cmake -DNAME=... -DOUTPUT=... -DROOT=... -DSHADERS="a;b" -P embed_shaders.cmake
# The generated file defines `std::span<const gpu::EmbeddedShader> embeddedShaders_NAME()`.
set(text "// Generated from the shader files named below; do not edit.\n#include \"gpu/shader_source.hpp\"\n\nnamespace lucerna::gpu {\nnamespace {\nconstexpr EmbeddedShader kShaders[] = {\n")
separate_arguments(SHADERS UNIX_COMMAND "${SHADERS}")
foreach(shader IN LISTS SHADERS)
  file(READ ${ROOT}/${shader} content)
  string(APPEND text "    {\"${shader}\", R\"glsl__(${content})glsl__\"},\n")
endforeach()
string(APPEND text "};\n}  // namespace\n\nstd::span<const EmbeddedShader> embeddedShaders_${NAME}() { return kShaders; }\n\n}  // namespace lucerna::gpu\n")
file(WRITE ${OUTPUT} "${text}")
