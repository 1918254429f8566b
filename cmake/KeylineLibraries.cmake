# Every library of others that a room is linked with, told once: how it is found (here and by the
# installed package), what pkg-config and Debian call it, and its licence (SPDX). The package, the
# .pc files, the .debs and the bill of materials are made from this table.
#
#   keyline_library(TARGET NAME … LICENCE … DEBIAN … [PKGCONFIG … | FLAGS …] FIND …)
set(CMAKE_FIND_PACKAGE_TARGETS_GLOBAL ON)  # found for one room, known to doors and tests
set(KEYLINE_LIBRARIES "")

function(keyline_library target)
  cmake_parse_arguments(ARG "" "NAME;LICENCE;DEBIAN;PKGCONFIG;FLAGS" "FIND" ${ARGN})
  string(MAKE_C_IDENTIFIER "${target}" id)
  foreach(field IN ITEMS NAME LICENCE DEBIAN PKGCONFIG FLAGS FIND)
    set(KEYLINE_${id}_${field} "${ARG_${field}}" PARENT_SCOPE)
  endforeach()
  set(KEYLINE_LIBRARIES ${KEYLINE_LIBRARIES} "${target}" PARENT_SCOPE)
endfunction()

keyline_library(Threads::Threads NAME "POSIX threads" LICENCE LGPL-2.1-or-later DEBIAN libc6-dev
                FLAGS -pthread FIND Threads)
keyline_library(Eigen3::Eigen NAME Eigen LICENCE MPL-2.0 DEBIAN libeigen3-dev PKGCONFIG eigen3
                FIND Eigen3 3.4 NO_MODULE)
keyline_library(Boost::headers NAME Boost LICENCE BSL-1.0 DEBIAN libboost-dev FIND Boost 1.74)
keyline_library(xsimd NAME xsimd LICENCE BSD-3-Clause DEBIAN libxsimd-dev FIND xsimd)
keyline_library(TBB::tbb NAME oneTBB LICENCE Apache-2.0 DEBIAN libtbb-dev PKGCONFIG tbb FIND TBB)
keyline_library(nlopt_cxx NAME NLopt LICENCE "LGPL-2.1-or-later AND MIT" DEBIAN libnlopt-cxx-dev
                FLAGS -lnlopt_cxx FIND LIBRARY nlopt_cxx)
keyline_library(fmt::fmt NAME fmt LICENCE MIT DEBIAN libfmt-dev PKGCONFIG fmt FIND fmt)
keyline_library(nlohmann_json::nlohmann_json NAME "JSON for Modern C++" LICENCE MIT
                DEBIAN nlohmann-json3-dev PKGCONFIG nlohmann_json FIND nlohmann_json)
keyline_library(pugixml::pugixml NAME pugixml LICENCE MIT DEBIAN libpugixml-dev PKGCONFIG pugixml
                FIND pugixml)
keyline_library(ZLIB::ZLIB NAME zlib LICENCE Zlib DEBIAN zlib1g-dev PKGCONFIG zlib FIND ZLIB)
keyline_library(PNG::PNG NAME libpng LICENCE libpng-2.0 DEBIAN libpng-dev PKGCONFIG libpng FIND PNG)
keyline_library(JPEG::JPEG NAME libjpeg-turbo LICENCE IJG DEBIAN libjpeg-dev PKGCONFIG libjpeg
                FIND JPEG)
keyline_library(TIFF::TIFF NAME LibTIFF LICENCE libtiff DEBIAN libtiff-dev PKGCONFIG libtiff-4
                FIND TIFF)
keyline_library(PkgConfig::LIBWEBP NAME libwebp LICENCE BSD-3-Clause DEBIAN libwebp-dev
                PKGCONFIG libwebp FIND MODULE LIBWEBP libwebp)
keyline_library(Freetype::Freetype NAME FreeType LICENCE FTL DEBIAN libfreetype-dev
                PKGCONFIG freetype2 FIND Freetype)
keyline_library(PkgConfig::CAIRO NAME cairo LICENCE "LGPL-2.1-only OR MPL-1.1" DEBIAN libcairo2-dev
                PKGCONFIG cairo FIND MODULE CAIRO cairo)
keyline_library(SQLite::SQLite3 NAME SQLite LICENCE blessing DEBIAN libsqlite3-dev PKGCONFIG sqlite3
                FIND SQLite3 3.35)
keyline_library(opencv_imgproc NAME OpenCV LICENCE Apache-2.0 DEBIAN libopencv-imgproc-dev
                FLAGS -lopencv_imgproc)
keyline_library(opencv_core NAME OpenCV LICENCE Apache-2.0 DEBIAN libopencv-core-dev
                FLAGS -lopencv_core)

# The table's name of what a target is linked with.
function(keyline_library_of link result)
  string(REGEX REPLACE "^.*(opencv_[a-z]+).*$" "\\1" name "${link}")
  if(NOT name IN_LIST KEYLINE_LIBRARIES)
    message(FATAL_ERROR "cmake/KeylineLibraries.cmake does not tell what ${link} is")
  endif()
  set(${result} "${name}" PARENT_SCOPE)
endfunction()

# The lines of CMake that find a library, with `command` for find_package.
function(keyline_find_lines library command result)
  string(MAKE_C_IDENTIFIER "${library}" id)
  set(how ${KEYLINE_${id}_FIND})
  set(lines "")
  if(how)
    list(GET how 0 first)
    if(first STREQUAL "MODULE")
      list(GET how 1 variable)
      list(GET how 2 module)
      set(lines "${command}(PkgConfig REQUIRED)\n"
                "pkg_check_modules(${variable} REQUIRED IMPORTED_TARGET GLOBAL ${module})\n")
    elseif(first STREQUAL "LIBRARY")  # a plain library: say so early where it is missing
      list(GET how 1 file)
      string(TOUPPER "KEYLINE_${file}" variable)
      set(lines "find_library(${variable} ${file} REQUIRED)\n")
    else()
      list(JOIN how " " how)
      set(lines "${command}(${how} REQUIRED)\n")
    endif()
  endif()
  list(JOIN lines "" lines)
  set(${result} "${lines}" PARENT_SCOPE)
endfunction()

# Finds what is named, or stops and says which Debian package has it.
macro(keyline_find)
  foreach(library ${ARGN})
    keyline_find_lines("${library}" find_package lines)
    cmake_language(EVAL CODE "${lines}")
  endforeach()
endmacro()
