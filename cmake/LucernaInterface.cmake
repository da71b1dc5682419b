# What people outside build against: the public headers, and core/version.hpp, which is made of them.

# A glob, which is asked again in every build: a header that a list forgot would be missed by strangers
# only. Left out are those of tests, those that need private libraries, and the insides of scene/ and of
# passes, which meet through ports.
file(GLOB_RECURSE lucerna_headers CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}/src
  ${PROJECT_SOURCE_DIR}/src/*.hpp)
list(FILTER lucerna_headers EXCLUDE REGEX
  "_test|test_folder|fake_pass|_fixture|slow_decoder|trace_scenes|^bake/(triangle_soup|light_scenes|brute_force)|^scene/gltf/gltf_structure|^gpu/(gl|gl_format|device_impl)\\.hpp|^image/exr_|^passes/.*/|^scene/(gltf|import|builtin)/|^app/bench/soft_shadows_quality|^script/shipped")
list(APPEND lucerna_headers
  scene/gltf/gltf_writer.hpp  # the one of its folder that is for others
  render/blocks.glsl)         # which C++ includes, too
list(SORT lucerna_headers)
set(absolute_headers ${lucerna_headers})
list(TRANSFORM absolute_headers PREPEND ${PROJECT_SOURCE_DIR}/src/)

set(lucerna_generated ${PROJECT_BINARY_DIR}/generated)
set(lucerna_version_header ${lucerna_generated}/core/version.hpp)
list(JOIN lucerna_headers "\n" lines)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/public_headers.txt CONTENT "${lines}\n" @ONLY)
add_custom_command(OUTPUT ${lucerna_version_header}
  COMMAND ${CMAKE_COMMAND} -DOUTPUT=${lucerna_version_header} -DVERSION=${PROJECT_VERSION}
          -DROOT=${PROJECT_SOURCE_DIR}/src -DHEADERS=${PROJECT_BINARY_DIR}/public_headers.txt
          -P ${PROJECT_SOURCE_DIR}/cmake/interface_header.cmake
  DEPENDS ${absolute_headers} ${PROJECT_BINARY_DIR}/public_headers.txt
          ${PROJECT_SOURCE_DIR}/cmake/interface_header.cmake
  VERBATIM)
add_custom_target(lucerna_version DEPENDS ${lucerna_version_header})
