# The library, the adapters, and the tests of their functions under the address and undefined-behaviour sanitizers: .ci/run. The tests of
# mechanics and laws compare numbers; with sanitizers they take an hour (-DENTS_TEST_MECHANICS=ON).
set(ENTS_SANITIZE "address,undefined" CACHE STRING "")
set(ENTS_GROUPED ON CACHE BOOL "")
set(ENTS_BUILD_HOST OFF CACHE BOOL "")
set(ENTS_BUILD_BENCH OFF CACHE BOOL "")
set(ENTS_TEST_MECHANICS OFF CACHE BOOL "")
