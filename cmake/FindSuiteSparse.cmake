# SPDX-License-Identifier: GPL-3.0-or-later
# Finds CHOLMOD and UMFPACK and makes SuiteSparse::cholmod and SuiteSparse::umfpack. SuiteSparse 5
# comes without a package file of its own.

find_path(SuiteSparse_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
find_library(SuiteSparse_CHOLMOD_LIBRARY cholmod)
find_library(SuiteSparse_UMFPACK_LIBRARY umfpack)
mark_as_advanced(SuiteSparse_INCLUDE_DIR SuiteSparse_CHOLMOD_LIBRARY SuiteSparse_UMFPACK_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(SuiteSparse REQUIRED_VARS SuiteSparse_CHOLMOD_LIBRARY
                                  SuiteSparse_UMFPACK_LIBRARY SuiteSparse_INCLUDE_DIR)

if(SuiteSparse_FOUND)
  foreach(part IN ITEMS CHOLMOD UMFPACK)
    string(TOLOWER ${part} name)
    if(NOT TARGET SuiteSparse::${name})
      add_library(SuiteSparse::${name} UNKNOWN IMPORTED)
      set_target_properties(SuiteSparse::${name} PROPERTIES
        IMPORTED_LOCATION "${SuiteSparse_${part}_LIBRARY}"
        INTERFACE_INCLUDE_DIRECTORIES "${SuiteSparse_INCLUDE_DIR}")
    endif()
  endforeach()
  set_property(TARGET SuiteSparse::umfpack APPEND PROPERTY
               INTERFACE_LINK_LIBRARIES SuiteSparse::cholmod)
endif()
