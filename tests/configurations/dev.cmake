# To change the sources: every file on its own, warnings are errors, and ccache where it is installed. Elements are evaluated one by one,
# without the kernels of many elements, which take most of a build: results are right to rounding, and their bits those of no other build.
set(ENTS_INSTRUCTION_SETS "" CACHE STRING "")
set(ENTS_GROUPED OFF CACHE BOOL "")
set(ENTS_WERROR ON CACHE BOOL "")
find_program(ENTS_CCACHE ccache)
if(ENTS_CCACHE)
  foreach(language C CXX)
    set(CMAKE_${language}_COMPILER_LAUNCHER ${ENTS_CCACHE} CACHE STRING "")
  endforeach()
endif()
