# SPDX-License-Identifier: Apache-2.0
# ccache, where it is installed, set so that builds share what they compile: every preset, `pip install .`
# and clones in any folder. What would make two builds strangers to each other:
# - Precompiled headers. ccache takes a file that uses one only when told that macros defined before it
#   and the time macros do not matter (no source of ours defines any before its includes, or uses
#   __TIME__). No two compilations of one are the same, so compile_pch.py writes a checksum of what is
#   in it, which ccache reads in its place. clang's also contain a time stamp, which is switched off.
# - Absolute paths. Those below the checkout are made relative to the build folder, so builds share
#   where that lies two folders below the checkout (build/NAME), and debug information names no folder.
#   No absolute path may be a macro on the command line or in a header (tests/places.h). Headers from
#   elsewhere that move, those of wheels, are copied into the build folder.
# - The compiler's name. pip calls g++ what CMake calls c++.
find_program(CCACHE_PROGRAM ccache)
find_program(FP_ENV_PROGRAM env)
find_program(FP_CXX_PROGRAM c++)
if(FP_CXX_PROGRAM)
  file(REAL_PATH ${FP_CXX_PROGRAM} usual)
  file(REAL_PATH ${CMAKE_CXX_COMPILER} named)
  if(usual STREQUAL named)
    set(CMAKE_CXX_COMPILER ${FP_CXX_PROGRAM})
  endif()
endif()
if(CCACHE_PROGRAM AND FP_ENV_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${FP_ENV_PROGRAM} CCACHE_SLOPPINESS=pch_defines,time_macros
      CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1 CCACHE_PCH_EXTSUM=1 ${CCACHE_PROGRAM})
endif()
# The launcher of a target that only precompiles headers. ccache does not take clang's.
set(FP_PRECOMPILED_LAUNCHER ${CMAKE_CXX_COMPILER_LAUNCHER})
find_package(Python3 3.8 COMPONENTS Interpreter)
if(CMAKE_CXX_COMPILER_LAUNCHER AND Python3_FOUND)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    set(FP_PRECOMPILED_LAUNCHER)
  endif()
  set(FP_PRECOMPILED_LAUNCHER ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/cmake/compile_pch.py
      ${FP_PRECOMPILED_LAUNCHER} --)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  add_compile_options("SHELL:-Xclang -fno-pch-timestamp")
  # CMake includes the header as well, by a path that ccache does not make relative; the precompiled
  # one is enough.
  set(CMAKE_CXX_COMPILE_OPTIONS_USE_PCH -Xclang -include-pch -Xclang <PCH_FILE>)
endif()
