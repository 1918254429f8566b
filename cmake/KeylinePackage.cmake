# The installable package: find_package(keyline) gives keyline::<room> for every room and
# keyline::keyline for all of them. Included after the rooms, whose links decide what the package
# has to find again on the user's side.
include(CMakePackageConfigHelpers)
get_property(rooms GLOBAL PROPERTY KEYLINE_ROOMS)
get_property(links GLOBAL PROPERTY KEYLINE_LINKS)
list(REMOVE_DUPLICATES links)

add_library(keyline_all INTERFACE)
add_library(keyline::keyline ALIAS keyline_all)
set_target_properties(keyline_all PROPERTIES EXPORT_NAME keyline)

set(targets keyline_all)
foreach(room IN LISTS rooms)
  target_link_libraries(keyline_all INTERFACE keyline::${room})
  list(APPEND targets keyline_${room})
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/keyline/${room}"
          DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/keyline" FILES_MATCHING PATTERN "*.h")
endforeach()

# How the package finds the library that a link target comes from.
set(KEYLINE_DEPENDENCIES "")
foreach(link IN LISTS links)
  if(link MATCHES "^PkgConfig::(.+)$")  # by our convention the module's name in capitals
    string(TOLOWER "${CMAKE_MATCH_1}" module)
    string(APPEND KEYLINE_DEPENDENCIES
           "find_dependency(PkgConfig)\n"
           "pkg_check_modules(${CMAKE_MATCH_1} REQUIRED IMPORTED_TARGET ${module})\n")
  elseif(link MATCHES "^(Eigen3|Boost|TBB|Threads|pugixml|nlohmann_json|fmt|ZLIB|PNG|JPEG|TIFF|Freetype|WebP)::")
    string(APPEND KEYLINE_DEPENDENCIES "find_dependency(${CMAKE_MATCH_1})\n")
  elseif(link STREQUAL "SQLite::SQLite3")
    string(APPEND KEYLINE_DEPENDENCIES "find_dependency(SQLite3)\n")
  elseif(link STREQUAL "nlopt_cxx")  # a plain library: say so early where it is missing
    string(APPEND KEYLINE_DEPENDENCIES "find_library(KEYLINE_NLOPT nlopt_cxx REQUIRED)\n")
  elseif(link STREQUAL "xsimd")
    string(APPEND KEYLINE_DEPENDENCIES "find_dependency(xsimd)\n")
  elseif(link MATCHES "::" AND NOT link MATCHES "\\$<")
    message(FATAL_ERROR "cmake/KeylinePackage.cmake does not know how an installed Keyline finds ${link}")
  endif()
endforeach()
configure_file("${PROJECT_SOURCE_DIR}/cmake/keylineConfig.cmake.in"
               "${PROJECT_BINARY_DIR}/keylineConfig.cmake" @ONLY)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/keylineConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion)

set(KEYLINE_PACKAGE_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/keyline")
install(TARGETS ${targets} EXPORT keylineTargets)
install(EXPORT keylineTargets NAMESPACE keyline:: DESTINATION "${KEYLINE_PACKAGE_DIR}")
install(FILES "${PROJECT_BINARY_DIR}/keylineConfig.cmake"
              "${PROJECT_BINARY_DIR}/keylineConfigVersion.cmake"
        DESTINATION "${KEYLINE_PACKAGE_DIR}")
