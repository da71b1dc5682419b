# The three ways a target is made here: a library of src/, its unit tests, and a set of shaders
# compiled into a library as text.

add_library(lucerna_options INTERFACE)
target_compile_options(lucerna_options INTERFACE
  -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion -Werror -ffp-contract=off
  -fno-semantic-interposition  # nobody replaces single functions of a shared library
  -pthread)  # some libraries ask for it, and precompiled headers want it everywhere or nowhere
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # How ccache sees a precompiled header.
  target_compile_options(lucerna_options INTERFACE -fpch-preprocess)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC 12 warns falsely on "literal" + std::string (GCC bug 105329), all the more when that is
  # precompiled.
  target_compile_options(lucerna_options INTERFACE
    -Wno-restrict -Wno-array-bounds -Wno-stringop-overread -Wno-stringop-overflow)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  # libstdc++ 12's own std::stable_sort calls what it deprecates.
  target_compile_options(lucerna_options INTERFACE -Wno-deprecated-declarations)
endif()
set(sanitizers_address address,undefined)
set(sanitizers_thread thread)
set(sanitizers_fuzzer fuzzer-no-link,address,undefined,float-cast-overflow)
if(LUCERNA_SANITIZE)
  set(sanitizers ${sanitizers_${LUCERNA_SANITIZE}})
  if(NOT sanitizers)
    message(FATAL_ERROR "LUCERNA_SANITIZE is '${LUCERNA_SANITIZE}'; wanted address, thread or "
      "fuzzer. If it was set before these were its values: cmake --preset dev")
  endif()
  # Line tables alone, and no check of null pointers (the address sanitizer sees their use): this
  # compiles in about half the time. Without -g1 a debugger shows locals too.
  target_compile_options(lucerna_options INTERFACE
    -g1 -O1 -fsanitize=${sanitizers} -fno-sanitize=null -fno-sanitize-recover=all
    -fno-omit-frame-pointer)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # False under sanitizers, as GCC's manual says of -fsanitize; the release build still asks.
    target_compile_options(lucerna_options INTERFACE -Wno-maybe-uninitialized)
  endif()
  target_link_options(lucerna_options INTERFACE -fsanitize=${sanitizers})
endif()

# lucerna_library(NAME SOURCES ... [DEPENDS public targets] [PRIVATE private targets] [SHADERS files])
# makes the target lucerna_NAME from src/NAME. DEPENDS is the layer table of DESIGN made checkable.
function(lucerna_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;PRIVATE;SHADERS" ${ARGN})
  if(ARG_SHADERS)
    lucerna_embed_shaders(${name} shader_source ${ARG_SHADERS})
    list(APPEND ARG_SOURCES ${shader_source})
  endif()
  add_library(lucerna_${name} STATIC ${ARG_SOURCES})
  target_include_directories(lucerna_${name} PUBLIC ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(lucerna_${name} PUBLIC ${ARG_DEPENDS} PRIVATE lucerna_options ${ARG_PRIVATE})
  target_precompile_headers(lucerna_${name} REUSE_FROM lucerna_precompiled)
endfunction()

# Tests themselves need no speed: this compiles them in two thirds of the time. They are no part of a
# shared library.
function(lucerna_compile_as_test target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
endfunction()

# lucerna_test(NAME SOURCES ... [DEPENDS targets] [LABELS gl] [ENVIRONMENT A=B]) makes one GoogleTest
# program and one CTest entry. Tests that need a GL driver carry the label "gl", those that compute
# long and prove figures, not code, "truth"; the others are unit tests, which the sanitized build
# runs too (target unit_tests).
add_custom_target(unit_tests)
function(lucerna_test name)
  if(NOT LUCERNA_TESTS)
    return()
  endif()
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;LABELS;ENVIRONMENT" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE lucerna_options ${ARG_DEPENDS} GTest::gmock_main)
  target_precompile_headers(${name} REUSE_FROM lucerna_precompiled_tests)
  lucerna_compile_as_test(${name})
  target_compile_definitions(${name} PRIVATE
    LUCERNA_SOURCE_DIR="${PROJECT_SOURCE_DIR}" LUCERNA_BINARY_DIR="${PROJECT_BINARY_DIR}")
  if(NOT ARG_LABELS)
    set(ARG_LABELS unit)
    add_dependencies(unit_tests ${name})
  endif()
  add_test(NAME ${name} COMMAND ${name})
  set_tests_properties(${name} PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT 900
    ENVIRONMENT "${ARG_ENVIRONMENT}")
endfunction()

# Writes one .cpp that holds the text of the given shader files (paths relative to src/). Declare and
# use its one function as
#   std::span<const gpu::EmbeddedShader> lucerna::gpu::embeddedShaders_NAME();
#   device.shaderSources().add(gpu::embeddedShaders_NAME());
function(lucerna_embed_shaders name out_variable)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/${name}_shaders.cpp)
  set(inputs)
  list(JOIN ARGN "|" joined)  # a list would not survive the command line
  foreach(shader IN LISTS ARGN)
    list(APPEND inputs ${PROJECT_SOURCE_DIR}/src/${shader})
  endforeach()
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DNAME=${name} -DOUTPUT=${output} -DROOT=${PROJECT_SOURCE_DIR}/src
            "-DSHADERS=${joined}" -P ${PROJECT_SOURCE_DIR}/cmake/embed_shaders.cmake
    DEPENDS ${inputs} ${PROJECT_SOURCE_DIR}/cmake/embed_shaders.cmake VERBATIM)
  set_property(GLOBAL APPEND PROPERTY LUCERNA_SHADERS ${ARGN})
  set(${out_variable} ${output} PARENT_SCOPE)
endfunction()
