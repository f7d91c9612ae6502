# SPDX-License-Identifier: MIT
# The build for WebAssembly (preset `web`): the modules of src/CMakeLists.txt that a page needs, without what a browser has not, and
# the modules of SuiteSparse that `solve` calls, from Debian's source package (tools/web/fetch_suitesparse.sh). No module of
# SuiteSparse under the GPL is compiled: docs/decisions/0092-webassembly.md.

set(RISORIUS_SUITESPARSE "${PROJECT_SOURCE_DIR}/build/web/suitesparse" CACHE PATH "Where tools/web/fetch_suitesparse.sh has put its sources")
if(NOT EXISTS "${RISORIUS_SUITESPARSE}/.complete")
    message(FATAL_ERROR "expected the sources of SuiteSparse in ${RISORIUS_SUITESPARSE}, found none; tools/web/fetch_suitesparse.sh fetches them")
endif()

# Exceptions and vectors of four floats are part of the WebAssembly of all browsers since 2021 (Safari: 2023).
# Clang 14 makes wrong code of some loops over points when it joins scalar instructions to vectors: the tip of the tongue was moved with
# the motion of its neighbour, by .33 mm.
add_compile_options(-fwasm-exceptions -msimd128 -fno-slp-vectorize -ffunction-sections -Wno-shadow)
add_link_options(-fwasm-exceptions)
add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-include>
    $<$<COMPILE_LANGUAGE:CXX>:${PROJECT_SOURCE_DIR}/src/risorius/core/detail/missing_library.h>)

# Libraries of headers, by links of their own: the folder that they lie in also has the headers of this system's C library.
function(risorius_headers target package header)
    find_path(${package}_HEADERS ${header} PATH_SUFFIXES eigen3 REQUIRED NO_CMAKE_FIND_ROOT_PATH PATHS /usr/include /usr/local/include)
    string(REGEX REPLACE "/.*" "" folder ${header})
    file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/headers/${package})
    file(CREATE_LINK ${${package}_HEADERS}/${folder} ${PROJECT_BINARY_DIR}/headers/${package}/${folder} SYMBOLIC)
    add_library(${target} INTERFACE IMPORTED GLOBAL)
    target_include_directories(${target} INTERFACE ${PROJECT_BINARY_DIR}/headers/${package})
endfunction()
risorius_headers(Eigen3::Eigen eigen Eigen/Core)
risorius_headers(nlohmann_json::nlohmann_json json nlohmann/json.hpp)
# What other modules link is not there, and neither is what calls it.
foreach(absent IN ITEMS Threads::Threads OpenSSL::Crypto meshoptimizer::meshoptimizer tinygltf PkgConfig::FFMPEG
        PkgConfig::EBUR128 PNG::PNG ZLIB::ZLIB risorius_opencv_core risorius_opencv_imgproc)
    add_library(${absent} INTERFACE IMPORTED GLOBAL)
endforeach()

# Simplicial factors, and the ordering by METIS
set(parts ${RISORIUS_SUITESPARSE})
file(GLOB suitesparse_sources ${parts}/SuiteSparse_config/SuiteSparse_config.c ${parts}/AMD/Source/amd*.c ${parts}/CAMD/Source/camd*.c
    ${parts}/COLAMD/Source/colamd.c ${parts}/CCOLAMD/Source/ccolamd.c ${parts}/CHOLMOD/Core/cholmod_*.c
    ${parts}/CHOLMOD/Cholesky/cholmod_*.c ${parts}/CHOLMOD/Partition/cholmod_*.c)
add_library(risorius_cholmod STATIC ${suitesparse_sources})
target_include_directories(risorius_cholmod SYSTEM PUBLIC ${parts}/include PRIVATE ${parts}/include/suitesparse ${parts}/metis-5.1.0/include)
target_compile_definitions(risorius_cholmod PUBLIC RISORIUS_SIMPLICIAL_PANELS
    PRIVATE NSUPERNODAL NMATRIXOPS NMODIFY NCHECK NPRINT NTIMER)
file(GLOB metis_sources ${parts}/metis-5.1.0/libmetis/*.c)
list(APPEND metis_sources ${parts}/metis-5.1.0/GKlib/error.c ${parts}/metis-5.1.0/GKlib/mcore.c ${parts}/metis-5.1.0/GKlib/memory.c
    ${parts}/metis-5.1.0/GKlib/random.c ${parts}/metis-5.1.0/GKlib/timers.c ${parts}/metis-5.1.0/GKlib/util.c)
add_library(risorius_metis STATIC ${metis_sources})
target_include_directories(risorius_metis SYSTEM PRIVATE ${parts}/gaps ${parts}/metis-5.1.0/include ${parts}/metis-5.1.0/GKlib
    ${parts}/metis-5.1.0/libmetis)
target_link_libraries(risorius_cholmod PUBLIC risorius_metis)
foreach(target IN ITEMS risorius_cholmod risorius_metis)
    target_compile_options(${target} PRIVATE -w -include stdio.h)
endforeach()

# What a page needs of each module: all of it, or the files that are named.
set(risorius_web_modules core geom signal track io solve tissue muscle rig face render media scene view)
set(risorius_web_files_io read_mesh.cpp detail/obj_reader.cpp detail/obj_textures.cpp detail/picture_place.cpp wasm/no_import.cpp
    wasm/no_tet_meshes.cpp)
set(risorius_web_files_render value_colour.cpp detail/cie_colour.cpp)
set(risorius_web_files_scene rig_files.cpp scene_from_rig.cpp texture_picture.cpp visualization.cpp)
set(risorius_web_files_media wasm/no_pictures.cpp)
set(risorius_web_without_core sha256.cpp result_cache.cpp output_set.cpp detail/live_outputs.cpp detail/private_folder.cpp
    detail/rename_journal.cpp detail/result_folder.cpp)

# Sets `sources` to what is built of a module for pages.
function(risorius_web_sources module)
    if(risorius_web_files_${module})
        set(chosen ${risorius_web_files_${module}})
        list(TRANSFORM chosen PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/risorius/${module}/")
        set(sources ${chosen})
    endif()
    foreach(file IN LISTS risorius_web_without_${module})
        list(REMOVE_ITEM sources "${CMAKE_CURRENT_SOURCE_DIR}/risorius/${module}/${file}")
    endforeach()
    if(module STREQUAL core)
        list(APPEND sources ${CMAKE_CURRENT_SOURCE_DIR}/risorius/core/wasm/no_cache.cpp)
    endif()
    set(sources ${sources} PARENT_SCOPE)
endfunction()
