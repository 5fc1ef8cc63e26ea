# SPDX-License-Identifier: GPL-3.0-or-later
# How our own code is compiled. Libraries' headers are system headers, so that warnings as errors
# hit only us. There is no NDEBUG question: TOILE_ASSERT is on in every build type.

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CCACHE_PROGRAM}")
endif()

# Plain variables: the cache holds CMake's own defaults, which would win over a cached value of ours.
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")
set(CMAKE_CXX_FLAGS_SANITIZE "-O1 -g -fno-omit-frame-pointer")
mark_as_advanced(CCACHE_PROGRAM)

add_library(toile_options INTERFACE)
target_compile_options(toile_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wcast-align
  -Wold-style-cast -Wextra-semi -Werror
  # GCC 12 sees overlaps where std::string is put together (GCC bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  # Answers must be the same on machines with and without fused multiply-add.
  -ffp-contract=off)

if(TOILE_SANITIZE)
  # For every target at once: a program in which only some objects are instrumented reports nonsense.
  add_compile_options(-fsanitize=${TOILE_SANITIZE})
  add_link_options(-fsanitize=${TOILE_SANITIZE})
  # GCC's flow warnings misread what the sanitizers insert; the other presets keep them.
  target_compile_options(toile_options INTERFACE -Wno-maybe-uninitialized -Wno-stringop-overflow
                                                 -Wno-array-bounds)
  if(TOILE_SANITIZE MATCHES "undefined")
    add_compile_options(-fno-sanitize-recover=undefined)
    # CGAL 5.5 starts to look for a tetrahedron from a hint that may be no cell yet.
    set_source_files_properties("${PROJECT_SOURCE_DIR}/engine/src/scan/poisson.cpp"
                                PROPERTIES COMPILE_OPTIONS "-fno-sanitize=null")
  endif()
endif()
