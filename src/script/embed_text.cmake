# cmake -DOUTPUT=... -DPRELUDE=... "-DPIPELINES=a.js b.js" -P embed_text.cmake
# Defines shippedPipelines() and prelude() of script/shipped.hpp.
set(text "// Generated from the files named below; do not edit.\n#include \"script/shipped.hpp\"\n\nnamespace lucerna::script {\nnamespace {\nconstexpr EmbeddedText kPipelines[] = {\n")
separate_arguments(PIPELINES UNIX_COMMAND "${PIPELINES}")
foreach(pipeline IN LISTS PIPELINES)
  file(READ ${pipeline} content)
  get_filename_component(name ${pipeline} NAME)
  string(APPEND text "    {\"${name}\", R\"js__(${content})js__\"},\n")
endforeach()
file(READ ${PRELUDE} content)
string(APPEND text "};\n}  // namespace\n\nstd::span<const EmbeddedText> shippedPipelines() { return kPipelines; }\n\nstd::string_view prelude() { return R\"js__(${content})js__\"; }\n\n}  // namespace lucerna::script\n")
file(WRITE ${OUTPUT} "${text}")
