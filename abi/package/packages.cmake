# Debian packages from one build: `cpack -G DEB` in the build folder, or the target debian. Their folders are Debian's, whatever prefix the
# build is installed to otherwise, so each file has a rule of its own here, in a component that a plain installation leaves out.
#
#   libents1      the library; the number is that of the contract in ents.h
#   libents-dev   header, source of the Fortran module, files for CMake and pkg-config, JSON Schema, examples/slide
#   ents-adapters the adapters, in the private folder below; ents-ccx, which builds CalculiX with them
#   python3-ents  the Python package
#   ents-tools    ents-host, ents-lab, ents-deck and the scenes
if(NOT PROJECT_IS_TOP_LEVEL OR NOT CMAKE_LIBRARY_ARCHITECTURE OR ENTS_SANITIZE)
  return()
endif()
set(libdir lib/${CMAKE_LIBRARY_ARCHITECTURE})
set(private ${libdir}/ents) # ents-lab looks for ../lib/libents.so beside its own folder, and for adapters there
# The same variables as Debian's own tools; without them an address that is nobody's, and CPack warns.
set(nobody "the ents authors <ents@example.org>")
set(maintainer "${nobody}")
if(DEFINED ENV{DEBFULLNAME} AND DEFINED ENV{DEBEMAIL})
  set(maintainer "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()
set(ENTS_MAINTAINER "${maintainer}" CACHE STRING "Maintainer of the Debian packages: NAME <ADDRESS>; default: DEBFULLNAME <DEBEMAIL>")
set(revision 1)
get_target_property(soversion ents SOVERSION)
set(generated ${PROJECT_BINARY_DIR}/packages/files)

# libentsN, libents-dev
install(TARGETS ents EXPORT ents-debian-targets
  LIBRARY DESTINATION ${libdir} COMPONENT libents${soversion} NAMELINK_COMPONENT libents-dev EXCLUDE_FROM_ALL)
set(package_dir ${libdir}/cmake/ents)
install(EXPORT ents-debian-targets FILE ents-targets.cmake NAMESPACE ents:: DESTINATION ${package_dir} COMPONENT libents-dev EXCLUDE_FROM_ALL)
block(SCOPE_FOR VARIABLES)
  set(CMAKE_INSTALL_PREFIX /usr)
  set(CMAKE_INSTALL_LIBDIR ${libdir})
  set(CMAKE_INSTALL_INCLUDEDIR include)
  set(ENTS_INSTALL_DATADIR share/ents)
  set(ENTS_PREFIX_FROM_PKGCONFIG ../../..)
  configure_file(abi/package/ents.pc.in ${generated}/ents.pc @ONLY)
  include(CMakePackageConfigHelpers)
  configure_package_config_file(abi/package/ents-config.cmake.in ${generated}/ents-config.cmake
    INSTALL_DESTINATION ${package_dir} PATH_VARS CMAKE_INSTALL_INCLUDEDIR ENTS_INSTALL_DATADIR)
  write_basic_package_version_file(${generated}/ents-config-version.cmake VERSION ${PROJECT_VERSION} COMPATIBILITY SameMinorVersion)
endblock()
install(FILES abi/ents.h abi/ents.hpp abi/ents.f90 DESTINATION include COMPONENT libents-dev EXCLUDE_FROM_ALL)
install(FILES abi/model.schema.json DESTINATION share/ents COMPONENT libents-dev EXCLUDE_FROM_ALL)
install(FILES ${generated}/ents.pc DESTINATION ${libdir}/pkgconfig COMPONENT libents-dev EXCLUDE_FROM_ALL)
install(FILES ${generated}/ents-config.cmake ${generated}/ents-config-version.cmake DESTINATION ${package_dir} COMPONENT libents-dev EXCLUDE_FROM_ALL)
install(FILES tests/clients/first.c tests/clients/first.cpp tests/clients/first.f90 examples/slide/slide.c
  examples/slide/slide.f90 examples/slide/model.json DESTINATION share/doc/libents-dev/examples COMPONENT libents-dev EXCLUDE_FROM_ALL)
set(components libents${soversion} libents-dev)

# ents-adapters
get_property(adapters GLOBAL PROPERTY ENTS_ADAPTERS)
if(adapters)
  install(TARGETS ${adapters} LIBRARY DESTINATION ${private}/lib COMPONENT ents-adapters EXCLUDE_FROM_ALL)
  configure_file(adapters/calculix/ents-ccx.in ${generated}/ents-ccx @ONLY)
  install(PROGRAMS ${generated}/ents-ccx DESTINATION bin COMPONENT ents-adapters EXCLUDE_FROM_ALL)
  install(FILES adapters/calculix/patch.py DESTINATION share/ents/calculix COMPONENT ents-adapters EXCLUDE_FROM_ALL)
  install(PROGRAMS adapters/calculix/run.sh DESTINATION share/ents/calculix COMPONENT ents-adapters EXCLUDE_FROM_ALL)
  install(DIRECTORY adapters/calculix/example DESTINATION share/ents/calculix COMPONENT ents-adapters EXCLUDE_FROM_ALL)
  list(APPEND components ents-adapters)
endif()

# python3-ents
install(DIRECTORY adapters/python/ents DESTINATION lib/python3/dist-packages COMPONENT python3-ents EXCLUDE_FROM_ALL FILES_MATCHING PATTERN *.py)
install(FILES adapters/python/hertz.py DESTINATION share/doc/python3-ents/examples COMPONENT python3-ents EXCLUDE_FROM_ALL)
list(APPEND components python3-ents)

# ents-tools
if(TARGET ents-lab)
  file(MAKE_DIRECTORY ${generated})
  file(CREATE_LINK ../${private}/bin/ents-lab ${generated}/ents-lab SYMBOLIC)
  file(CREATE_LINK ../../libents.so.${soversion} ${generated}/libents.so SYMBOLIC)
  install(TARGETS ents-lab RUNTIME DESTINATION ${private}/bin COMPONENT ents-tools EXCLUDE_FROM_ALL)
  install(FILES ${generated}/ents-lab DESTINATION bin COMPONENT ents-tools EXCLUDE_FROM_ALL)
  install(FILES ${generated}/libents.so DESTINATION ${private}/lib COMPONENT ents-tools EXCLUDE_FROM_ALL)
  install(DIRECTORY examples/ DESTINATION share/ents/examples COMPONENT ents-tools EXCLUDE_FROM_ALL FILES_MATCHING
    REGEX "/[a-z0-9_]+/[a-zA-Z0-9_]+\\.(json|inp|txt)$" PATTERN CMakeLists.txt EXCLUDE PATTERN host EXCLUDE PATTERN laboratory EXCLUDE PATTERN fortran_host EXCLUDE PATTERN slide EXCLUDE
    PATTERN bolted_joint EXCLUDE)
  if(TARGET ents-host)
    install(TARGETS ents-host RUNTIME DESTINATION bin COMPONENT ents-tools EXCLUDE_FROM_ALL)
  endif()
  if(TARGET ents-deck)
    install(TARGETS ents-deck RUNTIME DESTINATION bin COMPONENT ents-tools EXCLUDE_FROM_ALL)
    install(CODE "file(RPATH_REMOVE FILE \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/bin/ents-deck\")" COMPONENT ents-tools EXCLUDE_FROM_ALL)
  endif()
  list(APPEND components ents-tools)
endif()

# What Debian asks for in each package: its copyright and its changes.
file(READ LICENSE license)
string(REGEX REPLACE "\n+$" "" license "${license}")
string(REGEX REPLACE "\n(\n)" "\n .\\1" license "${license}")
string(REPLACE "\n" "\n " license "${license}")
string(REPLACE "\n  ." "\n ." license "${license}")
file(WRITE ${generated}/copyright "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: ents

Files: *
Copyright: 2026 the ents authors
License: BSD-3-Clause
 ${license}
")
file(WRITE ${generated}/changelog "ents (${PROJECT_VERSION}-${revision}) unstable; urgency=medium

  * Packages of this version.

 -- ${ENTS_MAINTAINER}  Tue, 24 Nov 2026 00:00:00 +0000
")
execute_process(COMMAND gzip --best --no-name --stdout ${generated}/changelog OUTPUT_FILE ${generated}/changelog.Debian.gz)
foreach(component IN LISTS components)
  install(FILES ${generated}/copyright ${generated}/changelog.Debian.gz DESTINATION share/doc/${component} COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME ents)
set(CPACK_PACKAGE_VENDOR ents)
set(CPACK_PACKAGE_CONTACT "${ENTS_MAINTAINER}")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz) # that of Debian; the library is 40 % smaller than with gzip
set(warnings "")
if(ENTS_MAINTAINER STREQUAL nobody)
  string(APPEND warnings "message(WARNING \"The packages name no real maintainer (${nobody}), to whom their users could write. \"
  \"Before you give them away, configure with -DENTS_MAINTAINER=\\\"NAME <ADDRESS>\\\".\")\n")
endif()
if("native" IN_LIST ENTS_INSTRUCTION_SETS)
  string(APPEND warnings "message(WARNING \"The library has the fast kernels of this machine's processor only; on others it is slower. \"
  \"Before you give it away, configure with -DENTS_INSTRUCTION_SETS=all.\")\n")
endif()
file(WRITE ${generated}/warnings.cmake "${warnings}")
set(CPACK_PRE_BUILD_SCRIPTS ${generated}/warnings.cmake)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL ${components})
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE ${revision})
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/lib)

# ents_describe(COMPONENT SECTION DEPENDS "Description"), whose lines have at most 80 characters; CPack adds the project's as the first one
function(ents_describe component section depends description)
  string(TOUPPER ${component} name)
  set(CPACK_DEBIAN_${name}_PACKAGE_NAME ${component} PARENT_SCOPE)
  set(CPACK_DEBIAN_${name}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_DEBIAN_${name}_PACKAGE_DEPENDS "${depends}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${name}_DESCRIPTION "${description}" PARENT_SCOPE)
endfunction()
set(same "libents${soversion} (= ${PROJECT_VERSION}-${revision})")
ents_describe(libents${soversion} libs ""
  "This package has the library. The master surface of an element carries measured\nroughness, waves, threads or grooves as a height; no mesh follows them.")
ents_describe(libents-dev libdevel "${same}"
  "This package has the header for C and C++, the source of the Fortran module,\nfiles for CMake and pkg-config, the JSON Schema of a model, and programs that\ncall the library.")
ents_describe(ents-adapters science "${same}, ents-tools (= ${PROJECT_VERSION}-${revision})"
  "This package has a shared library per host program (Abaqus, CalculiX, OpenSees,\nFEAP and others), with that program's own user routines, in\n/usr/${private}/lib, and ents-ccx, which builds\nCalculiX with them.")
ents_describe(python3-ents python "${same}, python3, python3-numpy"
  "This package has the Python module: NumPy arrays in, residuals and SciPy\nmatrices out. Contact joins two surfaces of a finite element program.")
ents_describe(ents-tools science "${same}"
  "This package has ents-host, a small finite element program that solves contact\nscenes, ents-lab, which compares them with exact solutions, checks whether a\nheight is admissible on a mesh, and draws pictures, and ents-deck, which puts contact elements into decks of CalculiX and Abaqus.\nThe scenes lie in /usr/share/ents/examples.")
string(TOUPPER libents${soversion} name)
set(CPACK_DEBIAN_${name}_PACKAGE_SHLIBDEPS ON)
file(WRITE ${generated}/shlibs "libents ${soversion} ${same}\n")
file(WRITE ${generated}/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_${name}_PACKAGE_CONTROL_EXTRA ${generated}/shlibs ${generated}/triggers)
set(CPACK_DEBIAN_ENTS-ADAPTERS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_ENTS-TOOLS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_ENTS-TOOLS_PACKAGE_RECOMMENDS "python3-matplotlib, libopenblas0-serial")
set(CPACK_DEBIAN_PYTHON3-ENTS_PACKAGE_ARCHITECTURE all)
# What Python compiles is removed with the package.
file(CONFIGURE OUTPUT ${generated}/postinst CONTENT "#!/bin/sh\nset -e\nif command -v py3compile >/dev/null 2>&1; then py3compile -p python3-ents; fi\n")
file(CONFIGURE OUTPUT ${generated}/prerm CONTENT "#!/bin/sh\nset -e\nif command -v py3clean >/dev/null 2>&1; then py3clean -p python3-ents; fi\n")
file(CHMOD ${generated}/postinst ${generated}/prerm PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_PYTHON3-ENTS_PACKAGE_CONTROL_EXTRA ${generated}/postinst ${generated}/prerm)
set(CPACK_DEBIAN_PYTHON3-ENTS_PACKAGE_RECOMMENDS "python3-scipy, python3-matplotlib")
include(CPack)

# One command for all of them.
add_custom_target(packages
  COMMAND ${CMAKE_CPACK_COMMAND} -G DEB --config ${PROJECT_BINARY_DIR}/CPackConfig.cmake
  WORKING_DIRECTORY ${PROJECT_BINARY_DIR} DEPENDS ents ${adapters} VERBATIM)
foreach(target ents-host ents-lab ents-deck wheel)
  if(TARGET ${target})
    add_dependencies(packages ${target})
  endif()
endforeach()
