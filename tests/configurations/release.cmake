# What packages are made of: the kernels of every processor of this family, without tests and benchmark.
set(ENTS_INSTRUCTION_SETS all CACHE STRING "")
set(ENTS_GROUPED ON CACHE BOOL "")
set(ENTS_BUILD_TESTS OFF CACHE BOOL "")
set(ENTS_BUILD_BENCH OFF CACHE BOOL "")
