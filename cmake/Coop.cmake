# The house's building blocks: every library, program and test is declared with one of these functions.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")
# What a library links its users must see too, wherever they stand.
set(CMAKE_FIND_PACKAGE_TARGETS_GLOBAL TRUE)

add_library(coop_options INTERFACE)
target_include_directories(coop_options INTERFACE "${PROJECT_SOURCE_DIR}/components")
target_compile_options(coop_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor -Woverloaded-virtual -Werror
  # gcc 12 reports false positives of these inside the standard library at -O2.
  -Wno-maybe-uninitialized -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread -Wno-restrict
  # One result on every processor: no contraction to fused multiply-add.
  -ffp-contract=off)
if(COOP_SANITIZER)
  target_compile_options(coop_options INTERFACE -fsanitize=${COOP_SANITIZER} -fno-omit-frame-pointer)
  target_link_options(coop_options INTERFACE -fsanitize=${COOP_SANITIZER})
endif()

# What a test checks is in the libraries, and what a program does too; their own text need not be fast, but quick to compile.
set(coop_test_options $<$<CONFIG:Release>:-O0>)
set(coop_front_options $<$<CONFIG:Release>:-O1>)
include(CoopPrecompiled)

# All executables of the robot, without the tests; all libraries; and the tests of each label.
add_custom_target(programs)
add_custom_target(libraries)
foreach(label unit component system)
  add_custom_target(tests_${label})
endforeach()

# Those of the folders named that hold a CMakeLists.txt.
function(coop_add_subdirectories)
  foreach(dir IN LISTS ARGN)
    if(EXISTS "${CMAKE_CURRENT_SOURCE_DIR}/${dir}/CMakeLists.txt")
      add_subdirectory("${dir}")
    endif()
  endforeach()
endfunction()

# coop_library(NAME SOURCES ... [LINK ...]) -> static library target coop_NAME
function(coop_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_library(coop_${name} STATIC ${ARG_SOURCES})
  target_link_libraries(coop_${name} PUBLIC coop_options ${ARG_LINK})
  coop_use_precompiled(coop_${name} library)
  add_dependencies(libraries coop_${name})
endfunction()

# coop_program(NAME SOURCES ... [LINK ...]): an executable that is installed beside the components. Its sources read the command line.
function(coop_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE coop_options ${ARG_LINK})
  target_compile_options(${name} PRIVATE ${coop_front_options})
  install(TARGETS ${name} RUNTIME DESTINATION lib/coop)
  add_dependencies(programs ${name})
endfunction()

# coop_front(SOURCES ...): sources of a library that read the command line. CLI11 is all templates: at -O3 each takes the
# compiler up to ten seconds.
function(coop_front)
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "${coop_front_options}" SKIP_PRECOMPILE_HEADERS ON)
endfunction()

# coop_node(NAME [SOURCES ...] [LINK ...]): the shell of a component in node/: library coop_NAME_node (for component
# tests) and executable NAME. Skipped in a core-only build.
function(coop_node name)
  if(COOP_CORE_ONLY)
    return()
  endif()
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_library(coop_${name}_node STATIC ${ARG_SOURCES})
  target_link_libraries(coop_${name}_node PUBLIC coop_options coop_runtime coop_conversions ${ARG_LINK})
  coop_use_precompiled(coop_${name}_node library)
  coop_program(${name} SOURCES node/main.cpp LINK coop_${name}_node)
endfunction()

# coop_test(NAME SOURCES ... [LINK ...] [LABELS unit|component|system] [SEPARATE]): a GoogleTest program NAME.
# SEPARATE: its sources use the same names for different things and cannot share a translation unit.
function(coop_test name)
  cmake_parse_arguments(ARG "SEPARATE" "TIMEOUT" "SOURCES;LINK;LABELS" ${ARGN})
  if(NOT ARG_LABELS)
    set(ARG_LABELS unit)
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  if(COOP_SANITIZER)
    math(EXPR ARG_TIMEOUT "${ARG_TIMEOUT} * 3")
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}/tests")
  target_compile_definitions(${name} PRIVATE COOP_SOURCE_DIR="${PROJECT_SOURCE_DIR}" COOP_BIN_DIR="${PROJECT_BINARY_DIR}/bin")
  target_link_libraries(${name} PRIVATE coop_options ${ARG_LINK} GTest::gtest GTest::gmock GTest::gtest_main)
  target_compile_options(${name} PRIVATE ${coop_test_options})
  coop_use_precompiled(${name} test)
  if(COOP_UNITY_TESTS AND NOT ARG_SEPARATE)
    set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
  endif()
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/tests")
  add_test(NAME ${name} COMMAND ${name})
  foreach(label IN LISTS ARG_LABELS)
    add_dependencies(tests_${label} ${name})
  endforeach()
  set_tests_properties(${name} PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT ${ARG_TIMEOUT}
    WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}")
  if(ARG_LABELS STREQUAL "system")
    # A whole robot wants the machine for itself.
    set_tests_properties(${name} PROPERTIES RUN_SERIAL TRUE)
  endif()
endfunction()

# coop_bench(NAME SOURCES ... [LINK ...]): a Google Benchmark program NAME
function(coop_bench name)
  if(NOT TARGET benchmark::benchmark_main)
    return()
  endif()
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}/tests")
  target_compile_definitions(${name} PRIVATE COOP_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_link_libraries(${name} PRIVATE coop_options ${ARG_LINK} benchmark::benchmark_main)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bench")
endfunction()
