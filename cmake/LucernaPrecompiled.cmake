# Two precompiled headers, one for the libraries and one for the tests: they save two fifths of the
# compiler's time. They hold nothing of ours but core/math/math.hpp, so that they are seldom made anew.
# Every file names what it uses all the same: the clang build does without them.
set(lucerna_precompiled_headers
  <algorithm> <array> <cmath> <cstdint> <cstring> <filesystem> <fstream> <functional> <limits> <map>
  <memory> <optional> <set> <span> <string> <string_view> <utility> <variant> <vector>
  <fmt/format.h> ${PROJECT_SOURCE_DIR}/src/core/math/math.hpp)

# Objects with no code of their own: others take the header by REUSE_FROM, for which the options that
# change code must agree.
file(WRITE ${PROJECT_BINARY_DIR}/precompiled.cpp "")
function(lucerna_precompiled name)
  add_library(${name} OBJECT ${PROJECT_BINARY_DIR}/precompiled.cpp)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(${name} PRIVATE lucerna_options fmt::fmt glm::glm)
  target_precompile_headers(${name} PRIVATE ${lucerna_precompiled_headers} ${ARGN})
endfunction()

lucerna_precompiled(lucerna_precompiled)
if(LUCERNA_TESTS)
  lucerna_precompiled(lucerna_precompiled_tests <gmock/gmock.h> <gtest/gtest.h>)
  target_link_libraries(lucerna_precompiled_tests PRIVATE GTest::gmock_main)
  lucerna_compile_as_test(lucerna_precompiled_tests)
endif()
