# A first picture or a first job, in a third of the time: elements one by one, without the kernels of many elements; no tests.
set(ENTS_INSTRUCTION_SETS "" CACHE STRING "")
set(ENTS_GROUPED ON CACHE BOOL "")
set(ENTS_BUILD_TESTS OFF CACHE BOOL "")
set(ENTS_BUILD_BENCH OFF CACHE BOOL "")
