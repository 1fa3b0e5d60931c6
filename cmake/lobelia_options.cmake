# What every target of ours is compiled with. An interface target, so that nothing global is set and
# the user's own CMAKE_CXX_FLAGS stay as they are.
add_library(lobelia_options INTERFACE)
target_include_directories(lobelia_options INTERFACE ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR})
target_compile_options(lobelia_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  # GCC 12 sees overlaps in std::string's operator+ that are not there (GCC bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  # Kernels say themselves where a*b+c is fused (Highway's MulAdd); elsewhere a compiler that does it on
  # some processors only would make results depend on them.
  -ffp-contract=off)
# SSE4.2 is the least that the kernels are written for (docs/decisions/0002); below it Highway would add
# a target without registers. Every x86 processor since 2009 has it.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
  target_compile_options(lobelia_options INTERFACE -march=x86-64-v2)
endif()
# Every kernel is compiled once for each of Highway's targets. SSE4 is left out: no picture needs what it adds
# to SSSE3, which is the baseline (SSE4 asks for AES too, and x86-64-v2 has none), and a quarter of the
# kernels' compile time would go into it.
set(LOBELIA_LEFT_OUT HWY_SSE4)
if(LOBELIA_SANITIZE)
  # Instrumented, a fused kernel takes minutes for all its targets: the narrowest registers are enough to find what
  # is wrong with the text that they all share.
  set(LOBELIA_LEFT_OUT "(HWY_SSE4|HWY_AVX2|HWY_AVX3|HWY_AVX3_DL)")
endif()
target_compile_definitions(lobelia_options INTERFACE "HWY_DISABLED_TARGETS=${LOBELIA_LEFT_OUT}")
if(LOBELIA_WERROR)
  target_compile_options(lobelia_options INTERFACE -Werror)
endif()
if(LOBELIA_SANITIZE)
  target_compile_options(lobelia_options INTERFACE
    -fsanitize=${LOBELIA_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all
    # A check at every pointer would take as long to compile as all others together. A null or wild pointer ends the
    # process anyway, with the address sanitizer's report.
    -fno-sanitize=null,alignment,vptr,object-size,nonnull-attribute,returns-nonnull-attribute)
  target_link_options(lobelia_options INTERFACE -fsanitize=${LOBELIA_SANITIZE})
endif()

# Where a test finds the sources and the program. A header, because a compiler's cache that has compiled the others in
# one directory knows them in every other; raw, for whatever is in a path.
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/lobelia_paths.hpp @ONLY CONTENT
"#pragma once
#define LOBELIA_SOURCE_DIR R\"lobelia(@PROJECT_SOURCE_DIR@)lobelia\"
#define LOBELIA_PROGRAM R\"lobelia(@CMAKE_RUNTIME_OUTPUT_DIRECTORY@/lobelia)lobelia\"
")

# The presets of the sanitizers optimise nothing, which compiles fastest, except rooms that compute. There, and with
# LOBELIA_UNITY, the files of a target are compiled as one. LOBELIA_UNITY is for a build from scratch:
# rooms that take no time at run time are then compiled at -O1.
set(LOBELIA_COMPUTING_ROOMS core renderer compare formulas accuracy studies)
function(lobelia_compile_quickly target room)
  if(LOBELIA_SANITIZE OR LOBELIA_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
    # Names of one file are no concern of the next; the other presets have these warnings.
    target_compile_options(${target} PRIVATE -Wno-shadow -Wno-subobject-linkage)
  endif()
  if(LOBELIA_SANITIZE AND room IN_LIST LOBELIA_COMPUTING_ROOMS)
    target_compile_options(${target} PRIVATE -O1)
  elseif(LOBELIA_UNITY AND NOT room IN_LIST LOBELIA_COMPUTING_ROOMS)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
endfunction()

# One library per room, of all .cpp files of its folder: lobelia_room(core LINK fmt::fmt). FOLDER is another one than that
# of the CMakeLists.txt. EXCEPT and ALONE are regular expressions of paths: what is no part of the room, and what has names
# in common with other files and is compiled by itself.
function(lobelia_room name)
  cmake_parse_arguments(ARG "" "FOLDER;EXCEPT;ALONE" "LINK;PRIVATE_LINK" ${ARGN})
  set(folder ${CMAKE_CURRENT_SOURCE_DIR}/${ARG_FOLDER})
  file(GLOB_RECURSE sources RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} CONFIGURE_DEPENDS ${folder}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "node_modules/")
  if(ARG_EXCEPT)
    list(FILTER sources EXCLUDE REGEX "${ARG_EXCEPT}")
  endif()
  add_library(lobelia_${name} STATIC ${sources})
  add_library(lobelia::${name} ALIAS lobelia_${name})
  set_target_properties(lobelia_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_link_libraries(lobelia_${name} PUBLIC lobelia_options ${ARG_LINK} PRIVATE ${ARG_PRIVATE_LINK})
  if(ARG_ALONE)
    list(FILTER sources INCLUDE REGEX "${ARG_ALONE}")
    set_source_files_properties(${sources} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
  lobelia_compile_quickly(lobelia_${name} ${name})
endfunction()
