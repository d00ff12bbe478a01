# One function for each kind of target.

set(LASCAUX_WARNINGS -Wall -Wextra -Wshadow -Wconversion -Werror)

# What most sources include from outside. Read once and not again for each of them, it saves a third of the time of a build.
set(LASCAUX_COMMON_HEADERS <algorithm> <array> <cmath> <cstdint> <filesystem> <limits> <map> <memory> <optional> <span>
    <string> <vector> <Eigen/Geometry>)

# lascaux_precompile(sketch base [headers...]): the target takes the precompiled headers of the first target, and the first, given the
# headers, makes them. Both must be compiled with the same options.
function(lascaux_precompile target owner)
  if(target STREQUAL owner)
    target_precompile_headers(${target} PRIVATE ${ARGN})
  else()
    target_precompile_headers(${target} REUSE_FROM ${owner})
  endif()
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -fpch-preprocess)  # for ccache
  endif()
endfunction()

function(lascaux_compile_options target)
  target_compile_options(${target} PRIVATE ${LASCAUX_WARNINGS})
  if(LASCAUX_SANITIZE)
    target_compile_options(${target} PUBLIC -fsanitize=${LASCAUX_SANITIZE} -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=${LASCAUX_SANITIZE})
  endif()
endfunction()

# lascaux_add_module(sketch SOURCES a.cpp b.cpp LINK lascaux_base PRIVATE_LINK pugixml): a static library lascaux_sketch.
function(lascaux_add_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK;PRIVATE_LINK" ${ARGN})
  set(target lascaux_${name})
  add_library(${target} STATIC ${ARG_SOURCES})
  add_library(lascaux::${name} ALIAS ${target})
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
                                              $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(${target} PUBLIC ${ARG_LINK} PRIVATE ${ARG_PRIVATE_LINK})
  lascaux_compile_options(${target})
  lascaux_precompile(${target} lascaux_base ${LASCAUX_COMMON_HEADERS})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  set_property(GLOBAL APPEND PROPERTY LASCAUX_MODULES ${target})
endfunction()

# lascaux_add_test(sketch SOURCES a_test.cpp LINK lascaux_sketch): one program test_sketch, each of its tests known to ctest.
function(lascaux_add_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  set(target test_${name})
  add_executable(${target} ${ARG_SOURCES})
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/tests)
  target_link_libraries(${target} PRIVATE ${ARG_LINK} GTest::gtest_main)
  lascaux_compile_options(${target})
  # OpenVDB's templates are most of what tests compile; optimised in full they take a third longer and run no faster.
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  lascaux_precompile(${target} test_base ${LASCAUX_COMMON_HEADERS} <gtest/gtest.h>)
  # GCC 12 warns of the inside of std::string where nothing is wrong (its bugs 105329 and 105651), once it comes precompiled.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow)
  endif()
  add_test(NAME ${name} COMMAND ${target})
  if(LASCAUX_SANITIZE)
    set_tests_properties(${name} PROPERTIES
                         ENVIRONMENT "LSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/tests/lsan.supp")
  endif()
endfunction()
