# What packages hold beside the programs (licence, bill of materials), and the .debs: `cpack` in a
# build folder that is built, or ./dev package.
set(KEYLINE_BILL "${PROJECT_BINARY_DIR}/keyline.spdx.json")
set(bill_of "")
foreach(library IN LISTS KEYLINE_LIBRARIES)
  string(MAKE_C_IDENTIFIER "${library}" id)
  string(APPEND bill_of
         "${KEYLINE_${id}_NAME}\t${KEYLINE_${id}_DEBIAN}\t${KEYLINE_${id}_LICENCE}\n")
endforeach()
file(WRITE "${PROJECT_BINARY_DIR}/libraries.tsv" "${bill_of}")
find_package(Python3 COMPONENTS Interpreter QUIET)
if(Python3_FOUND)
  execute_process(
    COMMAND "${Python3_EXECUTABLE}" -B "${PROJECT_SOURCE_DIR}/cmake/bill_of_materials.py"
            "${PROJECT_VERSION}" "${PROJECT_BINARY_DIR}/libraries.tsv"
            "${PROJECT_SOURCE_DIR}/web/package-lock.json" "${KEYLINE_BILL}"
    COMMAND_ERROR_IS_FATAL ANY)
endif()

set(parts development)
if(TARGET keyline-cad)
  list(APPEND parts cad)
endif()
if(TARGET keyline-studio)
  list(APPEND parts studio)
endif()
if(TARGET keyline_python)
  list(APPEND parts python plugins)
endif()
if(TARGET keyline)
  list(APPEND parts tool)
endif()

set(name_tool keyline)
set(name_cad keyline-cad)
set(name_studio keyline-studio)
set(name_python python3-keyline)
set(name_plugins keyline-plugins)
set(name_development libkeyline-dev)
set(text_tool "Aesthetic curves and surfaces: the command line")
set(text_cad "Aesthetic curves and surfaces: reading and writing STEP and IGES")
set(text_studio "Aesthetic curves and surfaces: the studio in the browser")
set(text_python "Aesthetic curves and surfaces: the Python package")
set(text_plugins "Aesthetic curves and surfaces: inside Inkscape and FreeCAD, and for type in UFO")
set(text_development "Aesthetic curves and surfaces: the C++ library")

# The library's headers and archives want those of the libraries beneath it.
set(below "")
foreach(library IN LISTS KEYLINE_LIBRARIES)
  string(MAKE_C_IDENTIFIER "${library}" id)
  list(APPEND below ${KEYLINE_${id}_DEBIAN})
endforeach()
list(REMOVE_DUPLICATES below)
list(JOIN below ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS)
set(CPACK_DEBIAN_STUDIO_PACKAGE_DEPENDS "keyline (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_TOOL_PACKAGE_RECOMMENDS keyline-cad)
set(CPACK_DEBIAN_TOOL_PACKAGE_SUGGESTS keyline-studio)
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS keyline-cad)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-matplotlib, python3-distributed")
get_property(minor GLOBAL PROPERTY KEYLINE_PYTHON_MINOR)
if(minor)  # the module is made for one version of Python
  math(EXPR next "${minor} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (>= 3.${minor}), python3 (<< 3.${next}), python3-numpy")
endif()

# Plug-ins lie where the programs look for them.
if(TARGET keyline_python)
  set(CPACK_DEBIAN_PLUGINS_PACKAGE_ARCHITECTURE all)
  set(CPACK_DEBIAN_PLUGINS_PACKAGE_DEPENDS "python3-keyline (= ${PROJECT_VERSION})")
  set(CPACK_DEBIAN_PLUGINS_PACKAGE_SUGGESTS "inkscape, freecad, python3-ufolib2")
  set(plugins "${PROJECT_SOURCE_DIR}/integrations")
  install(DIRECTORY "${plugins}/inkscape/" COMPONENT plugins DESTINATION share/inkscape/extensions/keyline
          PATTERN "__pycache__" EXCLUDE)
  install(DIRECTORY "${plugins}/freecad/Keyline" COMPONENT plugins DESTINATION share/freecad/Mod
          PATTERN "__pycache__" EXCLUDE)
  install(PROGRAMS "${plugins}/ufo/keyline_ufo.py" RENAME keyline-ufo COMPONENT plugins
          DESTINATION "${CMAKE_INSTALL_BINDIR}")
endif()

# Modules that Python compiles belong to no package: made when it comes, gone before it goes.
function(keyline_compiled_modules package variable)
  set(scripts "${PROJECT_BINARY_DIR}/debian/${package}")
  set(compile "if command -v py3compile >/dev/null; then py3compile -p ${package}; fi")
  set(clean "if command -v py3clean >/dev/null; then py3clean -p ${package}; fi")
  file(WRITE "${scripts}/postinst" "#!/bin/sh\nset -e\n${compile}\n")
  file(WRITE "${scripts}/prerm" "#!/bin/sh\nset -e\n${clean}\n")
  set(${variable} "${scripts}/postinst;${scripts}/prerm" PARENT_SCOPE)
endfunction()
keyline_compiled_modules(${name_python} CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA)
keyline_compiled_modules(${name_plugins} CPACK_DEBIAN_PLUGINS_PACKAGE_CONTROL_EXTRA)

foreach(part IN LISTS parts)
  string(TOUPPER ${part} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_CONTROL_STRICT_PERMISSION TRUE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name_${part}})
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${text_${part}}")
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION graphics)
  install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" RENAME copyright COMPONENT ${part}
          DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${name_${part}}")
  if(Python3_FOUND)
    install(FILES "${KEYLINE_BILL}" COMPONENT ${part}
            DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${name_${part}}")
  endif()
endforeach()
set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL ${parts})
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "Keyline <keyline@localhost>")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY "${PROJECT_BINARY_DIR}/packages")
include(CPack)
