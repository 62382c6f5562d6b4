# The Python package: build/python/edda, ready for PYTHONPATH=build/python, and where it is installed.
set(PYBIND11_FINDPYTHON OFF)
set(PYTHON_EXECUTABLE ${EDDA_PYTHON_EXECUTABLE})
find_package(pybind11 CONFIG)
if(NOT pybind11_FOUND)
  message(STATUS "pybind11 was not found: the Python module is left out")
  set(EDDA_PYTHON OFF)
  return()
endif()

file(GLOB python_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/src/python/*.cpp)
pybind11_add_module(edda_python NO_EXTRAS ${python_sources} $<TARGET_OBJECTS:edda_library>)
set_target_properties(edda_python PROPERTIES OUTPUT_NAME _edda SKIP_BUILD_RPATH ON LIBRARY_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/python/edda)
target_link_libraries(edda_python PRIVATE edda_sampling edda_study)
target_link_options(edda_python PRIVATE -Wl,--exclude-libs,ALL)

file(GLOB python_files CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/src/python/edda/*.py*)
file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/python/edda)
foreach(file ${python_files} ${CMAKE_CURRENT_SOURCE_DIR}/src/python/edda/py.typed)
  get_filename_component(name ${file} NAME)
  file(CREATE_LINK ${file} ${CMAKE_CURRENT_BINARY_DIR}/python/edda/${name} SYMBOLIC)
endforeach()

# Where the interpreter looks for packages depends on the prefix, which is known only when installing; Debian's own
# interpreter has a place for /usr, one for /usr/local and one for all others.
set(EDDA_PYTHON_FOLDER "" CACHE STRING "Folder of Python packages, relative to the prefix; empty: ask the interpreter")
install(CODE "
  set(folder \"${EDDA_PYTHON_FOLDER}\")
  if(NOT folder)
    execute_process(COMMAND ${EDDA_PYTHON_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/cmake/python_folder.py \${CMAKE_INSTALL_PREFIX}
                    OUTPUT_VARIABLE folder OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  endif()
  file(INSTALL ${python_files} ${CMAKE_CURRENT_SOURCE_DIR}/src/python/edda/py.typed $<TARGET_FILE:edda_python>
       DESTINATION \"\${CMAKE_INSTALL_PREFIX}/\${folder}/edda\")
  if(CMAKE_INSTALL_DO_STRIP)
    execute_process(COMMAND ${CMAKE_STRIP} --strip-unneeded \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/\${folder}/edda/$<TARGET_FILE_NAME:edda_python>\")
  endif()
")
