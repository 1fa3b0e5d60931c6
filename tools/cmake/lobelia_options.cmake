# The options of all our targets. An interface target leaves global settings and the user's CMAKE_CXX_FLAGS alone.
add_library(lobelia_options INTERFACE)
target_include_directories(lobelia_options INTERFACE ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR})
target_compile_options(lobelia_options INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wno-sign-conversion
  # GCC 12 sees overlaps in std::string's operator+ that are not there (GCC bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  # Kernels fuse a*b+c explicitly (Highway's MulAdd). Elsewhere results must not depend on the processor.
  -ffp-contract=off)
# The kernels need SSE4.2 (docs/decisions/0001), which every x86 processor since 2009 has. Below it Highway would add a
# target without vector registers.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
  target_compile_options(lobelia_options INTERFACE -march=x86-64-v2)
endif()
# Every kernel is compiled once for each of Highway's targets. SSE4 would take a quarter of that time, and no picture needs
# what it adds to the baseline SSSE3. (SSE4 also needs AES, which x86-64-v2 lacks.)
set(LOBELIA_LEFT_OUT HWY_SSE4 CACHE STRING "Highway's targets without kernels")
if(LOBELIA_SANITIZE)
  # Instrumented, a fused kernel takes minutes to compile for all targets. All share one source, so one target is enough.
  set(LOBELIA_LEFT_OUT "(HWY_SSE4|HWY_AVX2|HWY_AVX3|HWY_AVX3_DL)")
endif()
target_compile_definitions(lobelia_options INTERFACE "HWY_DISABLED_TARGETS=${LOBELIA_LEFT_OUT}")
if(LOBELIA_SANITIZE OR LOBELIA_UNITY)
  # Where a room is one file, the names of one of its files are no concern of the next.
  target_compile_options(lobelia_options INTERFACE -Wno-subobject-linkage)
else()
  target_compile_options(lobelia_options INTERFACE -Wshadow)
endif()
if(LOBELIA_WERROR)
  target_compile_options(lobelia_options INTERFACE -Werror)
endif()
if(LOBELIA_SANITIZE)
  target_compile_options(lobelia_options INTERFACE
    -fsanitize=${LOBELIA_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all
    # Checks at every pointer would double the compile time. A null or wild pointer ends the process anyway, with the
    # address sanitizer's report.
    -fno-sanitize=null,alignment,vptr,object-size,nonnull-attribute,returns-nonnull-attribute)
  target_link_options(lobelia_options INTERFACE -fsanitize=${LOBELIA_SANITIZE})
endif()

# The paths of the sources and the program, for tests. In a header, so that a compiler cache can share all other files
# between directories; as raw strings, because a path may have any characters.
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/lobelia_paths.hpp @ONLY CONTENT
"#pragma once
#define LOBELIA_SOURCE_DIR R\"lobelia(@PROJECT_SOURCE_DIR@)lobelia\"
#define LOBELIA_PROGRAM R\"lobelia(@CMAKE_RUNTIME_OUTPUT_DIRECTORY@/lobelia)lobelia\"
")

# With sanitizers and with LOBELIA_UNITY up to 32 files of a target are compiled as one: more would leave one processor
# at work alone at the end. Sanitizers optimise only rooms that compute, which compiles fastest. LOBELIA_UNITY, for builds
# from scratch, compiles all other rooms at -O1.
set(LOBELIA_COMPUTING_ROOMS base renderer compare formulas accuracy studies)
function(lobelia_compile_quickly target room)
  if(LOBELIA_SANITIZE OR LOBELIA_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 32)
  endif()
  if(LOBELIA_SANITIZE AND room IN_LIST LOBELIA_COMPUTING_ROOMS)
    target_compile_options(${target} PRIVATE -O1)
  elseif(LOBELIA_UNITY AND NOT room IN_LIST LOBELIA_COMPUTING_ROOMS)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
endfunction()

# lobelia_module(glpk USER lobelia_studies LINK ${GLPK_LIBRARY}): a module (base/system/module.hpp), built with its user. Without
# SOURCES it has no code and only brings libraries. The shared library needs modules too, so all are in its package.
function(lobelia_module name)
  cmake_parse_arguments(ARG "" "USER" "SOURCES;LINK" ${ARGN})
  if(NOT ARG_SOURCES)
    set(ARG_SOURCES ${CMAKE_CURRENT_BINARY_DIR}/lobelia_${name}.cpp)
    file(CONFIGURE OUTPUT ${ARG_SOURCES} CONTENT "// No code: see lobelia_module() in tools/cmake/.\n")
  endif()
  add_library(lobelia_${name} MODULE ${ARG_SOURCES})
  set_target_properties(lobelia_${name} PROPERTIES PREFIX "")
  target_link_options(lobelia_${name} PRIVATE LINKER:--no-as-needed)
  target_link_libraries(lobelia_${name} PRIVATE ${ARG_LINK})
  install(TARGETS lobelia_${name} LIBRARY DESTINATION lib/lobelia COMPONENT library)
  if(ARG_USER)
    add_dependencies(${ARG_USER} lobelia_${name})
  endif()
endfunction()

# For `make mutants`, which changes one file at a time.
set(LOBELIA_ALONE "" CACHE STRING "Sources that are compiled by themselves where others are not")
option(LOBELIA_SHARED_ROOMS "A shared library of each room: a changed file links one of them anew, and no program" OFF)
if(LOBELIA_SHARED_ROOMS)
  # __FILE__ does not tell the copies of the tree apart, so that a compiler cache finds the objects of another.
  target_compile_options(lobelia_options INTERFACE "-fmacro-prefix-map=${PROJECT_SOURCE_DIR}=.")
endif()

# lobelia_room(base LINK fmt::fmt): a library of all .cpp files in the room's folder. FOLDER is a subfolder to use instead.
# EXCEPT and ALONE are regular expressions of paths: files outside of the room, and files that are compiled by themselves
# because they share names with others.
function(lobelia_room name)
  cmake_parse_arguments(ARG "" "FOLDER;EXCEPT;ALONE" "LINK;PRIVATE_LINK" ${ARGN})
  set(folder ${CMAKE_CURRENT_SOURCE_DIR}/${ARG_FOLDER})
  file(GLOB_RECURSE sources RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} CONFIGURE_DEPENDS ${folder}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "node_modules/")
  if(ARG_EXCEPT)
    list(FILTER sources EXCLUDE REGEX "${ARG_EXCEPT}")
  endif()
  set(type STATIC)
  if(LOBELIA_SHARED_ROOMS)
    set(type SHARED)
  endif()
  add_library(lobelia_${name} ${type} ${sources})
  add_library(lobelia::${name} ALIAS lobelia_${name})
  set_target_properties(lobelia_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_link_libraries(lobelia_${name} PUBLIC lobelia_options ${ARG_LINK} PRIVATE ${ARG_PRIVATE_LINK})
  if(ARG_ALONE)
    list(FILTER sources INCLUDE REGEX "${ARG_ALONE}")
    set_source_files_properties(${sources} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
  list(TRANSFORM LOBELIA_ALONE PREPEND ${PROJECT_SOURCE_DIR}/ OUTPUT_VARIABLE alone)
  set_source_files_properties(${alone} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  lobelia_compile_quickly(lobelia_${name} ${name})
endfunction()
