# KEYLINE_UNITY: a target's sources are compiled twenty at a time, which takes about half of the
# time from nothing; the code and what it computes stay the same (docs/contributing.md). cmake/unity.py writes
# the sources that hold them.
set(KEYLINE_UNITY_SIZE 20 CACHE STRING "Most sources compiled as one; more take more memory")

# Rooms whose files ./dev mutate changes one at a time: compiled file by file, in half of the time.
set(KEYLINE_APART "" CACHE STRING "Rooms compiled file by file and at -O1, whatever KEYLINE_UNITY says")

# What reads words and draws pages: nobody waits for the optimiser there but who builds.
set(KEYLINE_LIGHTLY keyline keyline-cad keyline_studio keyline_presentation keyline_report)

# Puts into `result` what a target compiles: the sources as they are, or those that hold them. Alone
# stay sources with properties of their own, which have to be set before.
function(keyline_sources target result)
  if(NOT KEYLINE_UNITY OR target IN_LIST KEYLINE_APART)
    set(${result} ${ARGN} PARENT_SCOPE)
    return()
  endif()
  find_program(KEYLINE_PYTHON3 python3 REQUIRED)
  set(alone "")
  set(together "")
  foreach(source IN LISTS ARGN)
    set(told "")
    foreach(property IN ITEMS HEADER_FILE_ONLY COMPILE_OPTIONS COMPILE_DEFINITIONS)
      get_source_file_property(value "${source}" ${property})
      if(value)
        string(APPEND told "${value}")
      endif()
    endforeach()
    if(told OR NOT source MATCHES "\\.cpp$")
      list(APPEND alone "${source}")
    else()
      list(APPEND together "${source}")
    endif()
  endforeach()
  list(LENGTH together count)
  math(EXPR groups "(${count} + ${KEYLINE_UNITY_SIZE} - 1) / ${KEYLINE_UNITY_SIZE}")
  set(made "")
  set(first 0)
  foreach(group RANGE 1 ${groups})
    math(EXPR next "${count} * ${group} / ${groups}")
    math(EXPR size "${next} - ${first}")
    list(SUBLIST together ${first} ${size} part)
    set(first ${next})
    set(file "${CMAKE_CURRENT_BINARY_DIR}/${target}_${group}.cpp")
    add_custom_command(
      OUTPUT "${file}"
      COMMAND "${KEYLINE_PYTHON3}" "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/unity.py" "${file}" ${part}
      DEPENDS ${part} "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/unity.py"
      COMMENT "Putting sources of ${target} together"
      VERBATIM)
    # g++ gets the memory a source needs before it looks for what it can spare: an eighth of the time.
    set(options "$<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=1500000>")
    if(target IN_LIST KEYLINE_LIGHTLY)
      list(APPEND options -O1)
    endif()
    set_source_files_properties("${file}" PROPERTIES COMPILE_OPTIONS "${options}")
    list(APPEND made "${file}")
  endforeach()
  # Sources that a target of their own asks for, too, do not wait for the libraries of the first.
  add_custom_target("${target}_together" DEPENDS ${made})
  set(${result} ${alone} ${made} PARENT_SCOPE)
endfunction()
