# Headers of others that most sources include, compiled once for the libraries and once for the tests (docs/decisions.md).
# Only headers that do not change belong here: one of our own would turn each touch of it into a full build.
set(precompiled_library
  <algorithm> <array> <chrono> <cmath> <cstdint> <filesystem> <functional> <limits> <map> <memory> <numbers> <optional>
  <span> <sstream> <string> <string_view> <unordered_map> <vector> <Eigen/Core> <Eigen/Geometry>)
set(precompiled_test ${precompiled_library} <gmock/gmock.h> <gtest/gtest.h>)

find_package(Eigen3 REQUIRED)
file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/precompiled.cpp" CONTENT "")
foreach(kind library test)
  if(kind STREQUAL "test" AND NOT COOP_BUILD_TESTS)
    continue()
  endif()
  add_library(coop_precompiled_${kind} OBJECT "${PROJECT_BINARY_DIR}/precompiled.cpp")
  target_link_libraries(coop_precompiled_${kind} PRIVATE coop_options Eigen3::Eigen)
  target_precompile_headers(coop_precompiled_${kind} PRIVATE ${precompiled_${kind}})
endforeach()
if(COOP_BUILD_TESTS)
  find_package(GTest REQUIRED)
  target_link_libraries(coop_precompiled_test PRIVATE GTest::gtest GTest::gmock)
  target_compile_options(coop_precompiled_test PRIVATE ${coop_test_options})
endif()

function(coop_use_precompiled target kind)
  target_precompile_headers(${target} REUSE_FROM coop_precompiled_${kind})
endfunction()
