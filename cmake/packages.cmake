# The Debian package: `cpack -G DEB` in a build folder, or tools/package. One package holds all: the program stands alone,
# and who wants the library or the Python module need not look for more.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME edda)
set(EDDA_PACKAGE_CONTACT "edda developers <edda@example.org>" CACHE STRING "Who answers for the Debian package")
set(CPACK_PACKAGE_CONTACT ${EDDA_PACKAGE_CONTACT})
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/package)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "movement of jointed rock by discontinuous deformation analysis")
set(CPACK_PACKAGE_DESCRIPTION
"edda cuts rock into blocks along its joints and follows every block and
every contact through time, in two dimensions, by explicit discontinuous
deformation analysis (explicit DDA).

This package holds the program, the C++ library libedda with its header,
the Python module edda, and models to start from.")
# Prefix and DESTDIR apart, so that what asks for the prefix sees /usr.
set(CPACK_SET_DESTDIR ON)
set(CPACK_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
# Whatever the umask of who packs it: everybody may look into its folders.
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_INSTALL_CMAKE_PROJECTS "${CMAKE_CURRENT_BINARY_DIR};edda;Unspecified;/;${CMAKE_CURRENT_BINARY_DIR};edda;debian;/")

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3, python3-numpy")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "python3-matplotlib, g++, cmake, paraview")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(debian ${CMAKE_CURRENT_SOURCE_DIR}/cmake/debian)
configure_file(${debian}/shlibs.in ${CMAKE_CURRENT_BINARY_DIR}/debian/shlibs @ONLY)
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA
    "${debian}/postinst;${debian}/prerm;${debian}/triggers;${CMAKE_CURRENT_BINARY_DIR}/debian/shlibs")

# What Debian wants in /usr/share/doc: a copyright file and a changelog of the package.
string(TIMESTAMP package_date "%a, %d %b %Y %H:%M:%S +0000" UTC)
configure_file(${debian}/changelog.in ${CMAKE_CURRENT_BINARY_DIR}/debian/changelog @ONLY)
configure_file(${CMAKE_CURRENT_SOURCE_DIR}/CHANGELOG.md ${CMAKE_CURRENT_BINARY_DIR}/debian/upstream COPYONLY)
foreach(pair "changelog changelog.Debian.gz" "upstream changelog.gz")
  separate_arguments(pair)
  list(GET pair 0 plain)
  list(GET pair 1 packed)
  execute_process(COMMAND gzip -9nc ${CMAKE_CURRENT_BINARY_DIR}/debian/${plain}
                  OUTPUT_FILE ${CMAKE_CURRENT_BINARY_DIR}/debian/${packed} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
install(FILES ${debian}/copyright ${CMAKE_CURRENT_BINARY_DIR}/debian/changelog.Debian.gz
              ${CMAKE_CURRENT_BINARY_DIR}/debian/changelog.gz
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/edda COMPONENT debian EXCLUDE_FROM_ALL)
install(FILES ${debian}/lintian-overrides DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides RENAME edda
        COMPONENT debian EXCLUDE_FROM_ALL)

# And manual pages packed.
install(CODE "
  file(GLOB pages \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_MANDIR}/man*/*.[0-9]\")
  if(pages)
    execute_process(COMMAND gzip -9nf \${pages} COMMAND_ERROR_IS_FATAL ANY)
  endif()
" COMPONENT debian EXCLUDE_FROM_ALL)

include(CPack)
