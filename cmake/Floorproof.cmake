# SPDX-License-Identifier: Apache-2.0
# Language level, warnings and the two functions that every folder's CMakeLists.txt is made of.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
endif()

add_library(fp_options INTERFACE)
target_compile_options(fp_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                       -Wno-sign-conversion -Wnon-virtual-dtor -Woverloaded-virtual)
# g++ 12 sees overlapping and endless copies in std::string's assignment and operator+ (GCC bug
# 105651), the more so behind precompiled headers; there are none. Newer ones look.
target_compile_options(fp_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(fp_options INTERFACE -Wno-stringop-overflow -Wno-stringop-overread
                         -Wno-array-bounds)
endif()
# Results are promised bit for bit on one machine type: no fused multiply-add behind our back.
target_compile_options(fp_options INTERFACE -ffp-contract=off)
option(FLOORPROOF_WERROR "Warnings are errors in our code" ON)
if(FLOORPROOF_WERROR)
  target_compile_options(fp_options INTERFACE -Werror)
endif()
target_include_directories(fp_options INTERFACE ${PROJECT_SOURCE_DIR})

set(FLOORPROOF_SANITIZE "" CACHE STRING "Sanitizers for -fsanitize=, for example address,undefined")
if(FLOORPROOF_SANITIZE)
  add_compile_options(-fsanitize=${FLOORPROOF_SANITIZE} -fno-sanitize-recover=all
                      -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${FLOORPROOF_SANITIZE})
endif()

# Headers that nearly every file reads, read once. Whoever names one still includes it: a target sees
# only what it links. Programs are compiled as libraries are, so that they can share them.
add_compile_options(-fPIC)
option(FLOORPROOF_PRECOMPILED_HEADERS "Precompile the headers that most files read" ON)
function(fp_precompiled name)
  cmake_parse_arguments(ARG "" "" "HEADERS;LINK" ${ARGN})
  if(NOT FLOORPROOF_PRECOMPILED_HEADERS)
    return()
  endif()
  set(source ${PROJECT_BINARY_DIR}/generated/${name}.cc)
  file(CONFIGURE OUTPUT ${source} CONTENT "")
  add_library(${name} OBJECT ${source})
  target_link_libraries(${name} PRIVATE fp_options ${ARG_LINK})
  target_precompile_headers(${name} PRIVATE ${ARG_HEADERS})
endfunction()
function(fp_use_precompiled target name)
  if(FLOORPROOF_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} REUSE_FROM ${name})
  endif()
endfunction()

# fp_library(NAME SOURCES a.cc ... [PUBLIC targets ...] [PRIVATE targets ...])
# A static library of one folder. PUBLIC: what its headers need; PRIVATE: what only its sources need;
# PRECOMPILED: which headers it shares (fp_headers).
function(fp_library name)
  cmake_parse_arguments(ARG "" "PRECOMPILED" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  if(NOT ARG_PRECOMPILED)
    set(ARG_PRECOMPILED fp_headers)
  endif()
  add_library(${name} STATIC ${ARG_SOURCES})
  target_link_libraries(${name} PUBLIC ${ARG_PUBLIC} PRIVATE fp_options ${ARG_PRIVATE})
  target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR})
  fp_use_precompiled(${name} ${ARG_PRECOMPILED})
endfunction()

# fp_test(NAME LABEL quick|slow SOURCES a_test.cc ... LINK targets ... [TIMEOUT seconds])
# One executable of GoogleTest tests; each TEST becomes a ctest of that label.
function(fp_test name)
  cmake_parse_arguments(ARG "" "LABEL;TIMEOUT" "SOURCES;LINK" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 280)
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE fp_options ${ARG_LINK} GTest::gtest_main GTest::gmock)
  fp_use_precompiled(${name} fp_test_headers)
  target_compile_definitions(${name} PRIVATE
    FP_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
    FP_SHARED_MAPS_DIR="${PROJECT_SOURCE_DIR}/../shared/maps")
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST
    PROPERTIES LABELS ${ARG_LABEL} TIMEOUT ${ARG_TIMEOUT})
endfunction()
