# The header alone: it compiles in every C and C++ it promises, and ents.f90 says the same as ents.h. Included by ../CMakeLists.txt.
set(header ${PROJECT_SOURCE_DIR}/abi/ents.h)
set(header_tests ${CMAKE_CURRENT_LIST_DIR})
set(strict -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wundef -Wpadded -Werror -fsyntax-only)

# Twice in one file, and no padding anywhere in its structs (-Wpadded): padding is the compiler's choice, not the contract's.
foreach(standard c99 c11)
  add_test(NAME abi.header.${standard} COMMAND ${CMAKE_C_COMPILER} -std=${standard} ${strict} -Wstrict-prototypes -Wc++-compat
    -include ${header} -x c ${header})
endforeach()
foreach(standard c++11 c++20)
  add_test(NAME abi.header.${standard} COMMAND ${CMAKE_CXX_COMPILER} -std=${standard} ${strict} -Wold-style-cast
    -include ${header} -x c++ ${header})
endforeach()
add_test(NAME abi.header.includes COMMAND sh ${header_tests}/header_includes.sh ${header})

if(NOT ENTS_PYTHON)
  return()
endif()

# What bindings.py writes from ents.h is what is committed, and what the compilers make of it is the same.
set(bindings ${PROJECT_SOURCE_DIR}/abi/bindings/bindings.py)
add_test(NAME abi.header.bindings COMMAND sh ${header_tests}/header_bindings.sh ${ENTS_PYTHON} ${PROJECT_SOURCE_DIR})
set(generated ${CMAKE_CURRENT_BINARY_DIR}/header_layout)
add_custom_command(OUTPUT ${generated}.c ${generated}.f90
  COMMAND sh ${header_tests}/header_layout.sh ${ENTS_PYTHON} ${header} ${generated}.c ${generated}.f90
  DEPENDS ${header} ${header_tests}/header_layout.sh ${bindings})
add_executable(header_layout_c ${generated}.c)
target_include_directories(header_layout_c PRIVATE ${PROJECT_SOURCE_DIR}/abi)
add_executable(header_layout_fortran ${generated}.f90)
target_link_libraries(header_layout_fortran PRIVATE ents_fortran)
add_test(NAME abi.fortran.layout COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/clients/same_output.sh
  $<TARGET_FILE:header_layout_c> $<TARGET_FILE:header_layout_fortran>)
add_test(NAME abi.fortran.prototypes COMMAND sh ${header_tests}/header_prototypes.sh
  ${ENTS_PYTHON} ${CMAKE_Fortran_COMPILER} ${header} ${PROJECT_SOURCE_DIR}/abi/ents.f90)
