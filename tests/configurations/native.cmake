# The kernels of this processor; sources of ents-lab and of the tests in groups. What setup.sh builds without a name.
set(ENTS_INSTRUCTION_SETS native CACHE STRING "")
set(ENTS_GROUPED ON CACHE BOOL "")
