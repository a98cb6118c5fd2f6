# SPDX-License-Identifier: Apache-2.0
# Finds MuJoCo 4.0.1: FLOORPROOF_MUJOCO_DIR (an unpacked official release, or the folder that
# ./floorproof made from the pinned mujoco-core wheel), else an installed one.
set(FLOORPROOF_MUJOCO_DIR "${PROJECT_SOURCE_DIR}/build/deps/mujoco" CACHE PATH
    "Folder with include/mujoco/mujoco.h and libmujoco.so.4.0.1 (in it or in its lib/)")
set(_mujoco_hints ${FLOORPROOF_MUJOCO_DIR})
if(SKBUILD AND NOT EXISTS ${FLOORPROOF_MUJOCO_DIR})  # pip brings the wheel along
  find_package(Python REQUIRED COMPONENTS Interpreter)
  execute_process(
    COMMAND ${Python_EXECUTABLE} -c
            "import importlib.util as u; print(*u.find_spec('mujoco').submodule_search_locations)"
    OUTPUT_VARIABLE _mujoco_hints OUTPUT_STRIP_TRAILING_WHITESPACE)
endif()
find_path(MUJOCO_INCLUDE_DIR mujoco/mujoco.h HINTS ${_mujoco_hints}/include)
find_library(MUJOCO_LIBRARY NAMES libmujoco.so.4.0.1 mujoco
             HINTS ${_mujoco_hints} ${_mujoco_hints}/lib)
if(NOT MUJOCO_INCLUDE_DIR OR NOT MUJOCO_LIBRARY)
  message(FATAL_ERROR "MuJoCo was not found. Run ./floorproof (it fetches the pinned wheel), or give "
          "-DFLOORPROOF_MUJOCO_DIR=DIR of an unpacked official 4.0.1 release.")
endif()
file(STRINGS ${MUJOCO_INCLUDE_DIR}/mujoco/mujoco.h _mj_version REGEX "define mjVERSION_HEADER")
if(NOT _mj_version MATCHES "4000001|401")
  message(WARNING "Floorproof is tested with MuJoCo 4.0.1; ${MUJOCO_INCLUDE_DIR} says: ${_mj_version}")
endif()
add_library(mujoco::mujoco SHARED IMPORTED)
set_target_properties(mujoco::mujoco PROPERTIES
  IMPORTED_LOCATION ${MUJOCO_LIBRARY}
  INTERFACE_INCLUDE_DIRECTORIES ${PROJECT_BINARY_DIR}/mujoco)  # SYSTEM, as of every imported target
fp_copy_to_build(${MUJOCO_INCLUDE_DIR}/mujoco mujoco/mujoco)
