# SPDX-License-Identifier: GPL-3.0-or-later
# The libraries of the engine, all packages of Debian 12. What the engine links privately is in
# TOILE_PRIVATE_LIBRARIES.

find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)

# CGAL speaks about build types and about features we do not use; it also adds -frounding-math,
# which its exact predicates rely on.
set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE TRUE)
set(CGAL_DATA_DIR "unused")
find_package(CGAL 5.5 REQUIRED QUIET)

find_package(nanoflann 1.4 REQUIRED)
find_package(TBB REQUIRED)
find_package(embree 3 REQUIRED)
find_package(SuiteSparse REQUIRED)
# CHOLMOD reaches OpenBLAS through libblas; linked by name too, so that the engine can hold it to
# one thread (openblas_set_num_threads in cblas.h).
pkg_check_modules(openblas REQUIRED IMPORTED_TARGET openblas)
find_package(PNG REQUIRED)
pkg_check_modules(cairo REQUIRED IMPORTED_TARGET cairo)
pkg_check_modules(pangocairo REQUIRED IMPORTED_TARGET pangocairo)
pkg_check_modules(clipper REQUIRED IMPORTED_TARGET polyclipping)
pkg_check_modules(dxflib REQUIRED IMPORTED_TARGET dxflib)
pkg_check_modules(xxhash REQUIRED IMPORTED_TARGET libxxhash)

set(TOILE_PRIVATE_LIBRARIES
    CGAL::CGAL nanoflann::nanoflann TBB::tbb embree SuiteSparse::cholmod SuiteSparse::umfpack
    PkgConfig::openblas PNG::PNG PkgConfig::cairo PkgConfig::pangocairo PkgConfig::clipper
    PkgConfig::dxflib PkgConfig::xxhash Threads::Threads)
