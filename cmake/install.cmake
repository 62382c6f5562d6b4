# What `cmake --install` puts where: the program, libedda with its header and package, examples, licence.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# Before 1.0 each minor version may change the interface: programs are linked to one of them, as find_package() asks for one.
set(edda_abi ${PROJECT_VERSION_MAJOR})
if(PROJECT_VERSION_MAJOR EQUAL 0)
  set(edda_abi 0.${PROJECT_VERSION_MINOR})
endif()
add_library(edda_shared SHARED $<TARGET_OBJECTS:edda_library>)
add_library(edda::edda ALIAS edda_shared)
set_target_properties(edda_shared PROPERTIES OUTPUT_NAME edda EXPORT_NAME edda
                      VERSION ${PROJECT_VERSION} SOVERSION ${edda_abi})
target_link_libraries(edda_shared PRIVATE $<BUILD_INTERFACE:edda_sampling> $<BUILD_INTERFACE:edda_study>)
if(NOT EDDA_SANITIZE AND NOT EDDA_TSAN)  # their run-time libraries are in the program alone
  target_link_options(edda_shared PRIVATE -Wl,--exclude-libs,ALL -Wl,-z,defs)
endif()
target_compile_features(edda_shared INTERFACE cxx_std_20)
target_include_directories(edda_shared INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)

install(TARGETS edda RUNTIME)
install(TARGETS edda_shared EXPORT edda LIBRARY)
install(FILES src/library/edda.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/edda)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/edda)
install(EXPORT edda NAMESPACE edda:: FILE edda-targets.cmake DESTINATION ${package_folder})
configure_package_config_file(cmake/edda-config.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/edda-config.cmake
                              INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/edda-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/edda-config.cmake ${CMAKE_CURRENT_BINARY_DIR}/edda-config-version.cmake
        DESTINATION ${package_folder})

install(DIRECTORY examples/ DESTINATION ${CMAKE_INSTALL_DATADIR}/edda/models FILES_MATCHING PATTERN "*.toml" PATTERN "*.csv"
        PATTERN cpp EXCLUDE PATTERN python EXCLUDE)
install(DIRECTORY examples/cpp examples/python DESTINATION ${CMAKE_INSTALL_DATADIR}/edda/examples
        PATTERN __pycache__ EXCLUDE)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT licence)  # in a package, Debian's own copy stands for it
