# A library of a few rooms asks for what those rooms use and for nothing else: it is configured where
# nothing else can be found.
file(REMOVE_RECURSE "${WORK}")
set(absent "")
foreach(package IN ITEMS fmt PNG JPEG TIFF Freetype pugixml nlohmann_json SQLite3 PkgConfig pybind11 GTest
                         Python)
  list(APPEND absent "-DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON")
endforeach()
execute_process(
  COMMAND "${CMAKE_COMMAND}" -S "${SOURCE}" -B "${WORK}" -G "${GENERATOR}"
          "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DKEYLINE_ROOMS=lac;classa" ${absent}
  RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "rooms lac and classa want more than they use:\n${output}")
endif()
file(STRINGS "${WORK}/build.ninja" built REGEX "libkeyline_[a-z]+\\.a:")
string(REGEX MATCHALL "libkeyline_[a-z]+" built "${built}")
list(REMOVE_DUPLICATES built)
list(SORT built)
set(wanted analysis classa core curve fit lac numeric)
list(TRANSFORM wanted PREPEND libkeyline_)
if(NOT built STREQUAL wanted)
  message(FATAL_ERROR "built: ${built}\nwanted: ${wanted}")
endif()

# And their tests need no room above them.
execute_process(
  COMMAND "${CMAKE_COMMAND}" -S "${SOURCE}" -B "${WORK}/tested" -G "${GENERATOR}"
          "-DCMAKE_CXX_COMPILER=${COMPILER}" -DKEYLINE_ROOMS=fairing -DKEYLINE_TESTS=ON
  RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "the tests of room fairing and those below it want more rooms:\n${output}")
endif()
