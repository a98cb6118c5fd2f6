# SPDX-License-Identifier: Apache-2.0
# Configures ccache, if it is installed, so that all presets, `pip install .` and clones in any folder
# share compiled objects. What would prevent cache hits between two builds:
# - Precompiled headers. ccache caches a file that uses one only with the sloppiness settings
#   pch_defines and time_macros. They are safe here: no source file of ours defines a macro before its
#   includes or uses __TIME__. Compiling a header twice gives different bytes, so compile_pch.py writes
#   a checksum of its contents, and ccache hashes that file instead. clang also stores a time stamp;
#   -fno-pch-timestamp omits it.
# - Absolute paths. ccache makes those below the checkout relative to the build folder, so only build
#   folders two levels below the checkout (build/NAME) share objects. The working directory is not
#   hashed, so debug information may name another build's folder. No macro on the command line or in a
#   header may contain an absolute path (tests/places.h). The headers of wheels (MuJoCo, nanobind) can
#   be in a different folder each time, so they are copied into the build folder.
# - The compiler's name. pip calls g++ what CMake calls c++. (In a folder of links to ccache or
#   distcc all names are one file, and say nothing.)
# On a miss, ccache takes what a file includes from the compiler's own list (CCACHE_DEPEND) and does
# not preprocess it first, which costs a sixth of a build that finds nothing.
find_program(CCACHE_PROGRAM ccache)
# fp_copy_to_build(FROM TO): the files of a folder from elsewhere, to one below the build folder. A
# changed file gets a new time, so that the files that include it are compiled again.
function(fp_copy_to_build from to)
  file(GLOB_RECURSE files RELATIVE ${from} ${from}/*)
  list(FILTER files EXCLUDE REGEX "__pycache__")
  foreach(file ${files})
    configure_file(${from}/${file} ${CMAKE_BINARY_DIR}/${to}/${file} COPYONLY)
  endforeach()
endfunction()
find_program(FP_ENV_PROGRAM env)
find_program(FP_CXX_PROGRAM c++)
file(REAL_PATH ${CMAKE_CXX_COMPILER} compiler)
if(FP_CXX_PROGRAM)
  file(REAL_PATH ${FP_CXX_PROGRAM} usual)
  if(usual STREQUAL compiler AND compiler MATCHES "/[^/]*(g[+][+]|clang)[^/]*$")
    set(CMAKE_CXX_COMPILER ${FP_CXX_PROGRAM})
  endif()
endif()
find_package(Python3 3.8 COMPONENTS Interpreter)
if(CCACHE_PROGRAM AND FP_ENV_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${FP_ENV_PROGRAM} CCACHE_SLOPPINESS=pch_defines,time_macros
      CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1 CCACHE_DEPEND=1)
  if(Python3_FOUND)
    list(APPEND CMAKE_CXX_COMPILER_LAUNCHER CCACHE_PCH_EXTSUM=1)
  endif()
  if(NOT compiler MATCHES "/ccache$")  # else the compiler calls it
    list(APPEND CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
  endif()
endif()
# The compiler launcher of targets that only precompile headers. It omits ccache for clang, whose
# precompiled headers ccache cannot store.
set(FP_PRECOMPILED_LAUNCHER ${CMAKE_CXX_COMPILER_LAUNCHER})
if(CMAKE_CXX_COMPILER_LAUNCHER AND Python3_FOUND)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    set(FP_PRECOMPILED_LAUNCHER)
  endif()
  set(FP_PRECOMPILED_LAUNCHER ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/cmake/compile_pch.py
      ${FP_PRECOMPILED_LAUNCHER} --)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  add_compile_options("SHELL:-Xclang -fno-pch-timestamp")
  # By default CMake also includes the header itself, by an absolute path that ccache does not make
  # relative. The precompiled header is enough.
  set(CMAKE_CXX_COMPILE_OPTIONS_USE_PCH -Xclang -include-pch -Xclang <PCH_FILE>)
endif()
