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
include(CompilerCache)

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
# Warnings are errors with the compilers that .ci/run builds with, in every build, so that all builds
# share the compiler cache. Other compilers, or these with a user's own flags, may warn of more, which
# must not stop a build.
set(is_checked_compiler OFF)
if(NOT CMAKE_CXX_FLAGS AND
   (CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION MATCHES "^12\\." OR
    CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND CMAKE_CXX_COMPILER_VERSION MATCHES "^14\\."))
  set(is_checked_compiler ON)
endif()
option(FLOORPROOF_WERROR "Warnings are errors in our code" ${is_checked_compiler})
if(FLOORPROOF_WERROR)
  target_compile_options(fp_options INTERFACE -Werror)
endif()
target_include_directories(fp_options INTERFACE ${PROJECT_SOURCE_DIR})

set(FLOORPROOF_SANITIZE "" CACHE STRING "Sanitizers for -fsanitize=, for example address,undefined")
if(FLOORPROOF_SANITIZE)
  add_compile_options(-fsanitize=${FLOORPROOF_SANITIZE} -fno-sanitize-recover=all
                      -fno-omit-frame-pointer)
  if(FLOORPROOF_SANITIZE MATCHES "address" AND FLOORPROOF_SANITIZE MATCHES "undefined")
    # A fifth of the compile time, and little found: null and too small objects stop the address
    # sanitizer, and nothing here reads through a cast pointer.
    add_compile_options(-fno-sanitize=null,object-size,alignment)
  endif()
  # What Eigen leaves uninitialised reads as NaN, so that whoever reads it is caught.
  add_compile_definitions(EIGEN_INITIALIZE_MATRICES_BY_NAN)
  add_link_options(-fsanitize=${FLOORPROOF_SANITIZE})
endif()

# Headers that nearly every file reads, read once. Whoever names one still includes it: a target sees
# only what it links. Programs are compiled as libraries are, so that they can share them.
add_compile_options(-fPIC)
option(FLOORPROOF_PRECOMPILED_HEADERS "Precompile the headers that most files read" ON)
function(fp_precompiled name)
  cmake_parse_arguments(ARG "" "" "HEADERS;LINK;OPTIONS" ${ARGN})
  if(NOT FLOORPROOF_PRECOMPILED_HEADERS)
    return()
  endif()
  set(source ${PROJECT_BINARY_DIR}/generated/${name}.cc)
  file(CONFIGURE OUTPUT ${source} CONTENT "")
  add_library(${name} OBJECT ${source})
  set_target_properties(${name} PROPERTIES CXX_COMPILER_LAUNCHER "${FP_PRECOMPILED_LAUNCHER}")
  target_link_libraries(${name} PRIVATE fp_options ${ARG_LINK})
  target_compile_options(${name} PRIVATE ${ARG_OPTIONS})
  target_precompile_headers(${name} PRIVATE ${ARG_HEADERS})
endfunction()
function(fp_use_precompiled target name)
  if(FLOORPROOF_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} REUSE_FROM ${name})
  endif()
endfunction()

# Unity build: several source files of a target are compiled as one, so the headers that they share
# are read once. unity_groups.py keeps files with clashing names apart and writes the files that
# include them. (CMake's own UNITY_BUILD includes by absolute path, so another clone would never hit the
# compiler cache.)
option(FLOORPROOF_UNITY "Compile several files of a target as one" OFF)
set(FLOORPROOF_UNITY_FILES 16 CACHE STRING "Most files that are compiled as one")
if(FLOORPROOF_UNITY)
  find_package(Python3 3.8 COMPONENTS Interpreter)
  if(NOT Python3_FOUND)
    message(WARNING "FLOORPROOF_UNITY needs Python 3.8 or later; each file is compiled by itself")
  endif()
endif()
define_property(GLOBAL PROPERTY FP_UNITY_FILES BRIEF_DOCS "TARGET;FILE of all targets, in lines"
                FULL_DOCS "What unity_groups.py is asked about")
# fp_unity(TARGET): after its sources are known.
function(fp_unity target)
  get_target_property(sources ${target} SOURCES)
  set(absolute)
  foreach(source ${sources})
    get_filename_component(source ${source} ABSOLUTE)
    list(APPEND absolute ${source})
    string(FIND ${source} ${PROJECT_BINARY_DIR}/ generated)
    if(generated EQUAL -1)
      set_property(GLOBAL APPEND_STRING PROPERTY FP_UNITY_FILES "${target};${source}\n")
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES SOURCES "${absolute}")
endfunction()
# fp_compile_as_one(TARGET UNITY_FILE FILES...): what groups.cmake is made of.
function(fp_compile_as_one target unity)
  get_target_property(sources ${target} SOURCES)
  list(REMOVE_ITEM sources ${ARGN})
  set_target_properties(${target} PROPERTIES SOURCES "${sources};${unity}")
endfunction()
# fp_group_sources(): once, after all targets.
function(fp_group_sources)
  if(NOT FLOORPROOF_UNITY OR NOT Python3_FOUND)
    return()
  endif()
  get_property(lines GLOBAL PROPERTY FP_UNITY_FILES)
  set(folder ${PROJECT_BINARY_DIR}/unity)
  file(WRITE ${PROJECT_BINARY_DIR}/unity_files.txt "${lines}")
  execute_process(
    COMMAND ${CMAKE_COMMAND} -E env PYTHONUTF8=1 ${Python3_EXECUTABLE}
            ${PROJECT_SOURCE_DIR}/cmake/unity_groups.py ${PROJECT_SOURCE_DIR} ${folder}
            ${FLOORPROOF_UNITY_FILES}
    INPUT_FILE ${PROJECT_BINARY_DIR}/unity_files.txt RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "cmake/unity_groups.py failed: ${status}")
  endif()
  include(${folder}/groups.cmake)
endfunction()

# A faster linker, where one is installed: some sixty programs are linked.
include(CheckLinkerFlag)
foreach(linker mold lld)
  check_linker_flag(CXX -fuse-ld=${linker} FLOORPROOF_LINKS_WITH_${linker})
  if(FLOORPROOF_LINKS_WITH_${linker})
    add_link_options(-fuse-ld=${linker})
    break()
  endif()
endforeach()

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
  fp_unity(${name})
endfunction()

# fp_test(NAME LABEL quick|slow SOURCES a_test.cc ... LINK targets ... [TIMEOUT seconds] [WHOLE] [SANITIZED_EVERY n] [UNOPTIMISED])
# One executable of GoogleTest tests; each TEST becomes a ctest of that label. Where starting a process
# is dear, under sanitizers or where WHOLE says so, the executable is one ctest. Slow ones are built by fp_slow_tests alone.
# SANITIZED_EVERY: so many drives, plans or runs of the program of one kind that under sanitizers every n-th test of it is run.
# (No divisor of how many cases there are of each kind: it would always be the same ones.)
# UNOPTIMISED: it waits for the program or for one library, so clang compiles its own code at -O0, in half the time.
# A source with a * stands for the folder's files of such names that no fp_test above it has.
define_property(GLOBAL PROPERTY FP_TEST_SOURCES BRIEF_DOCS "Sources of all tests, absolute"
                FULL_DOCS "What fp_find_lost_tests compares the folders with")
# g++ compiles a test at -Og in half the time of -O3, and no slower than at -O0, where templates that a
# library shares with its test would run unoptimised: the linker keeps the test's. clang needs twice as
# long at -Og as at -O0.
set(FP_TESTS_AT_OG OFF)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT CMAKE_BUILD_TYPE STREQUAL "Debug")
  set(FP_TESTS_AT_OG ON)
endif()
add_custom_target(fp_quick_tests)
add_custom_target(fp_slow_tests)
function(fp_test name)
  cmake_parse_arguments(ARG "WHOLE;UNOPTIMISED" "LABEL;TIMEOUT;SANITIZED_EVERY" "SOURCES;LINK" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 280)
  endif()
  get_property(taken GLOBAL PROPERTY FP_TEST_SOURCES)
  set(sources)
  foreach(source ${ARG_SOURCES})
    get_filename_component(path ${source} ABSOLUTE)
    if(source MATCHES "[*]")
      file(GLOB path CONFIGURE_DEPENDS ${path})
      list(REMOVE_ITEM path "" ${taken})
    endif()
    list(APPEND sources ${path})
  endforeach()
  set_property(GLOBAL APPEND PROPERTY FP_TEST_SOURCES ${sources})
  add_executable(${name} ${sources})
  add_dependencies(fp_${ARG_LABEL}_tests ${name})
  if(ARG_LABEL STREQUAL "slow")
    set_target_properties(${name} PROPERTIES EXCLUDE_FROM_ALL ON)
    set_property(GLOBAL APPEND_STRING PROPERTY FP_SLOW_TESTS "${name} ${ARG_TIMEOUT}\n")
  endif()
  target_link_libraries(${name} PRIVATE fp_options ${ARG_LINK} fp_places GTest::gtest_main GTest::gmock)
  if(FP_TESTS_AT_OG)
    target_compile_options(${name} PRIVATE -Og)
    fp_use_precompiled(${name} fp_test_headers)
  elseif(ARG_UNOPTIMISED)
    target_compile_options(${name} PRIVATE -O0)
    fp_use_precompiled(${name} fp_unoptimised_test_headers)
  else()
    fp_use_precompiled(${name} fp_test_headers)
  endif()
  fp_unity(${name})
  if(FLOORPROOF_SANITIZE OR ARG_WHOLE)
    add_test(NAME ${name} COMMAND ${name} --gtest_brief=1)
    set(timeout ${ARG_TIMEOUT})
    if(FLOORPROOF_SANITIZE)
      math(EXPR timeout "3 * ${ARG_TIMEOUT}")
      if(ARG_SANITIZED_EVERY)
        set_tests_properties(${name} PROPERTIES ENVIRONMENT
          "GTEST_TOTAL_SHARDS=${ARG_SANITIZED_EVERY};GTEST_SHARD_INDEX=0")
      endif()
    endif()
    # The longest first.
    set_tests_properties(${name} PROPERTIES LABELS ${ARG_LABEL} TIMEOUT ${timeout} COST 100)
  else()
    gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST
      PROPERTIES LABELS ${ARG_LABEL} TIMEOUT ${ARG_TIMEOUT})
  endif()
endfunction()
# fp_list_slow_tests(): once, after all tests. .ci/slow_turn reads the list.
define_property(GLOBAL PROPERTY FP_SLOW_TESTS BRIEF_DOCS "Slow test executables, a line each: the name and the seconds that it may take"
                FULL_DOCS "What .ci/slow_turn takes turns in")
function(fp_list_slow_tests)
  get_property(names GLOBAL PROPERTY FP_SLOW_TESTS)
  file(WRITE ${PROJECT_BINARY_DIR}/slow_tests.txt "${names}")
endfunction()
# fp_find_lost_tests(FOLDER): once, after all tests. A test that no executable holds would never run.
function(fp_find_lost_tests folder)
  get_property(taken GLOBAL PROPERTY FP_TEST_SOURCES)
  file(GLOB lost CONFIGURE_DEPENDS ${folder}/*/*_test.cc)
  list(REMOVE_ITEM lost "" ${taken})
  foreach(file ${lost})
    get_filename_component(beside ${file} DIRECTORY)
    message(FATAL_ERROR "${file} is in no test: name it in an fp_test of ${beside}/CMakeLists.txt")
  endforeach()
endfunction()
