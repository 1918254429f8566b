# One target per room: keyline_room(lac DEPENDS core numeric LINK Boost::headers PRIVATE_LINK nlopt_cxx)
#   DEPENDS       rooms used, all of them above this one in keyline/CMakeLists.txt
#   LINK          libraries whose headers stand in this room's own headers
#   PRIVATE_LINK  libraries used in its .cpp files alone
#   INCLUDES      libraries of headers that its .cpp files alone include
#   HEADERS_ONLY  its .cpp files are left out (an option is off)
#   ELSEWHERE     inner folders whose .cpp files another target compiles
# Each library is told in KeylineLibraries.cmake; it is found when a room asks for it.
# Sources stand in the room's folder and in its inner ones (README.md there says what each holds).
function(keyline_room name)
  cmake_parse_arguments(ARG "HEADERS_ONLY" "" "DEPENDS;LINK;PRIVATE_LINK;INCLUDES;ELSEWHERE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.cpp"
       "${CMAKE_CURRENT_SOURCE_DIR}/*/*.cpp")
  file(GLOB headers CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.h"
       "${CMAKE_CURRENT_SOURCE_DIR}/*/*.h")
  foreach(folder IN LISTS ARG_ELSEWHERE)
    file(GLOB left_out CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.cpp")
    list(REMOVE_ITEM sources ${left_out})
  endforeach()
  set(target keyline_${name})
  if(target IN_LIST KEYLINE_APART)
    set(CMAKE_CXX_FLAGS_RELEASE "-O1 -DNDEBUG" PARENT_SCOPE)
  endif()
  if(sources AND NOT ARG_HEADERS_ONLY)
    keyline_sources(${target} compiled ${sources})
    add_library(${target} STATIC ${compiled} ${headers})
    set(scope PUBLIC)
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:keyline_warnings> ${ARG_PRIVATE_LINK})
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(keyline::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(
    ${target} ${scope} "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>"
                       "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
  target_compile_features(${target} ${scope} cxx_std_23)
  foreach(room IN LISTS ARG_DEPENDS)
    target_link_libraries(${target} ${scope} keyline::${room})
  endforeach()
  target_link_libraries(${target} ${scope} ${ARG_LINK})
  keyline_room_is(${name})
endfunction()

# Finds a room's libraries and keeps what the package tells of it. Called by keyline_room.
macro(keyline_room_is name)
  set(libraries "")
  foreach(link IN LISTS ARG_LINK ARG_PRIVATE_LINK ARG_INCLUDES)
    if(NOT link MATCHES "BUILD_INTERFACE")  # the same library is named for the installed package
      keyline_library_of("${link}" library)
      list(APPEND libraries "${library}")
    endif()
  endforeach()
  keyline_find(${libraries})
  set_property(GLOBAL APPEND PROPERTY KEYLINE_ROOMS ${name})
  set_property(GLOBAL APPEND PROPERTY KEYLINE_WANTED ${ARG_DEPENDS})
  set_property(GLOBAL PROPERTY KEYLINE_${name}_DEPENDS ${ARG_DEPENDS})
  list(REMOVE_ITEM libraries ${ARG_INCLUDES} "")  # nothing of them is left to find or to link
  set_property(GLOBAL PROPERTY KEYLINE_${name}_LIBRARIES ${libraries})
  set_property(GLOBAL PROPERTY KEYLINE_${name}_INCLUDES ${ARG_INCLUDES})
endmacro()

# One test program per room: every *_test.cpp of the folder. ABOVE: rooms above it that the sources BY_THEM need,
# which are left out where those rooms are not built.
function(keyline_tests name)
  cmake_parse_arguments(ARG "" "" "LINK;ABOVE;BY_THEM" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.cpp")
  foreach(room IN LISTS ARG_ABOVE)
    if(TARGET keyline::${room})
      list(APPEND ARG_LINK keyline::${room})
    elseif(ARG_BY_THEM)
      message(STATUS "Tests of ${name} without room ${room}: ${ARG_BY_THEM} left out")
      list(TRANSFORM ARG_BY_THEM PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/")
      list(REMOVE_ITEM sources ${ARG_BY_THEM})
      set(ARG_BY_THEM "")
    endif()
  endforeach()
  set(target keyline_${name}_tests)
  if(KEYLINE_APART)
    set(CMAKE_CXX_FLAGS_RELEASE "-O1 -DNDEBUG" PARENT_SCOPE)
  endif()
  if(KEYLINE_SANITIZE) # the rooms' time is the tests' time; what asks them need not be fast
    set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O1 -g1" PARENT_SCOPE)
  endif()
  keyline_sources(${target} compiled ${sources})
  add_executable(${target} ${compiled})
  target_link_libraries(${target} PRIVATE keyline::${name} keyline_warnings GTest::gtest GTest::gmock
                                          GTest::gtest_main ${ARG_LINK})
  target_compile_definitions(
    ${target} PRIVATE KEYLINE_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                      KEYLINE_SHARED_DATA="${PROJECT_SOURCE_DIR}/../shared/data")
  gtest_discover_tests(${target} NO_PRETTY_VALUES DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 120 PROPERTIES LABELS ${name})
endfunction()

add_library(keyline_warnings INTERFACE)
target_compile_options(keyline_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow
                       # g++ 12 sees overlapping copies in "a" + std::to_string(n)
                       $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
# g++ warns of what its own sanitizers put in ("maybe uninitialized"); other builds take it in earnest.
if(NOT (KEYLINE_SANITIZE AND CMAKE_CXX_COMPILER_ID STREQUAL GNU))
  target_compile_options(keyline_warnings INTERFACE -Werror)
endif()
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  # std::stable_sort of libstdc++ 12 calls what libstdc++ itself calls deprecated
  target_compile_options(keyline_warnings INTERFACE -Wno-deprecated-declarations)
endif()
if(KEYLINE_SANITIZE)
  # A finding ends the program: one that is only printed passes as a test that is green.
  add_compile_options(-fsanitize=${KEYLINE_SANITIZE} -fno-sanitize-recover=all
                      -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${KEYLINE_SANITIZE})
  # GCC tells of every fence that the thread sanitizer does not see, and Asio has some.
  if(KEYLINE_SANITIZE MATCHES thread AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    add_compile_options(-Wno-tsan)
  endif()
endif()
if(KEYLINE_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()
