# The installable library: find_package(keyline COMPONENTS lac) gives keyline::lac and what it uses;
# without components there are all rooms, and keyline::keyline is all of them. pkg-config knows each
# room as keyline-<room>. Included after the rooms, which tell what they use (KeylineRoom.cmake).
include(CMakePackageConfigHelpers)
get_property(rooms GLOBAL PROPERTY KEYLINE_ROOMS)
list(REVERSE rooms)  # from the bottom up

add_library(keyline_all INTERFACE)
add_library(keyline::keyline ALIAS keyline_all)
set_target_properties(keyline_all PROPERTIES EXPORT_NAME keyline)

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/keyline")
set(pkgconfig_dir "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
file(RELATIVE_PATH to_prefix "/${pkgconfig_dir}" "/")
string(REGEX REPLACE "/$" "" to_prefix "${to_prefix}")

# keyline-<room>.pc: the rooms and libraries it uses, by what pkg-config calls them.
function(keyline_write_pc room)
  get_property(depends GLOBAL PROPERTY KEYLINE_${room}_DEPENDS)
  get_property(libraries GLOBAL PROPERTY KEYLINE_${room}_LIBRARIES)
  list(TRANSFORM depends PREPEND keyline-)
  set(flags "")
  get_target_property(type keyline_${room} TYPE)
  if(NOT type STREQUAL "INTERFACE_LIBRARY")
    set(flags "-L\${libdir}" "-lkeyline_${room}")
  endif()
  foreach(library IN LISTS libraries)
    string(MAKE_C_IDENTIFIER "${library}" id)
    list(APPEND depends ${KEYLINE_${id}_PKGCONFIG})
    list(APPEND flags ${KEYLINE_${id}_FLAGS})
  endforeach()
  list(JOIN depends " " depends)
  list(JOIN flags " " flags)
  file(WRITE "${PROJECT_BINARY_DIR}/pkgconfig/keyline-${room}.pc"
"prefix=\${pcfiledir}/${to_prefix}
libdir=\${prefix}/${CMAKE_INSTALL_LIBDIR}
includedir=\${prefix}/${CMAKE_INSTALL_INCLUDEDIR}

Name: keyline-${room}
Description: ${PROJECT_DESCRIPTION}: room ${room} (compile with -std=c++23)
Version: ${PROJECT_VERSION}
Requires: ${depends}
Libs: ${flags}
Cflags: -I\${includedir}
")
  install(FILES "${PROJECT_BINARY_DIR}/pkgconfig/keyline-${room}.pc" DESTINATION "${pkgconfig_dir}"
          COMPONENT development)
endfunction()

# What keylineConfig.cmake does for a room that is wanted, and (from the top down) what it wants.
set(KEYLINE_CLOSURE "")
set(KEYLINE_BLOCKS "")
set(table "")  # room, rooms it uses, libraries it needs: for docs/tables.py
foreach(room IN LISTS rooms)
  target_link_libraries(keyline_all INTERFACE keyline::${room})
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/keyline/${room}" COMPONENT development
          DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/keyline" FILES_MATCHING PATTERN "*.h")
  install(TARGETS keyline_${room} EXPORT keyline_${room} ARCHIVE COMPONENT development)
  install(EXPORT keyline_${room} NAMESPACE keyline:: FILE keyline-${room}.cmake
          DESTINATION "${package_dir}" COMPONENT development)
  keyline_write_pc(${room})
  get_property(depends GLOBAL PROPERTY KEYLINE_${room}_DEPENDS)
  list(JOIN depends " " depends)
  get_property(libraries GLOBAL PROPERTY KEYLINE_${room}_LIBRARIES)
  get_property(included GLOBAL PROPERTY KEYLINE_${room}_INCLUDES)
  set(finds "")
  set(needs "")
  foreach(library IN LISTS libraries included)
    string(MAKE_C_IDENTIFIER "${library}" id)
    list(APPEND needs "${KEYLINE_${id}_NAME} (`${KEYLINE_${id}_DEBIAN}`)")
  endforeach()
  list(JOIN needs ", " needs)
  string(APPEND table "${room}\t${depends}\t${needs}\n")
  foreach(library IN LISTS libraries)
    keyline_find_lines("${library}" find_dependency lines)
    string(APPEND finds "${lines}")
  endforeach()
  string(PREPEND KEYLINE_CLOSURE
         "if(${room} IN_LIST keyline_wanted)\n  list(APPEND keyline_wanted ${depends})\nendif()\n")
  string(APPEND KEYLINE_BLOCKS
         "if(${room} IN_LIST keyline_wanted)\n${finds}"
         "include(\"\${CMAKE_CURRENT_LIST_DIR}/keyline-${room}.cmake\")\n"
         "set(keyline_${room}_FOUND TRUE)\nendif()\n")
endforeach()
file(WRITE "${PROJECT_BINARY_DIR}/rooms.tsv" "${table}")
list(JOIN rooms " " KEYLINE_ROOM_NAMES)

configure_file("${PROJECT_SOURCE_DIR}/cmake/keylineConfig.cmake.in"
               "${PROJECT_BINARY_DIR}/keylineConfig.cmake" @ONLY)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/keylineConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(TARGETS keyline_all EXPORT keyline_all)
install(EXPORT keyline_all NAMESPACE keyline:: FILE keyline-all.cmake DESTINATION "${package_dir}"
        COMPONENT development)
install(FILES "${PROJECT_BINARY_DIR}/keylineConfig.cmake"
              "${PROJECT_BINARY_DIR}/keylineConfigVersion.cmake"
        DESTINATION "${package_dir}" COMPONENT development)
