# The headers that nearly every source includes, compiled once and shared: a clean build takes a third less time. A
# compiler cache does that and more, so with one it is left out.
option(EDDA_COMMON_HEADERS "Compile common headers once" ON)
if(CMAKE_CXX_COMPILER_LAUNCHER)
  set(EDDA_COMMON_HEADERS OFF)
endif()
set(edda_common_headers <algorithm> <array> <cmath> <functional> <limits> <map> <memory> <optional> <string> <string_view> <utility> <variant> <vector>)

# A target whose headers others take with use_common_headers(). PROGRAM: for programs, whose code may not be moved about as
# that of libraries may.
function(common_headers name)
  cmake_parse_arguments(arg "PROGRAM" "" "LIBRARIES;HEADERS" ${ARGN})
  if(EDDA_COMMON_HEADERS)
    set(source ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
    if(arg_PROGRAM)
      file(CONFIGURE OUTPUT ${source} CONTENT "int main() {}\n")
      add_executable(${name} ${source})
    else()
      file(CONFIGURE OUTPUT ${source} CONTENT "")
      add_library(${name} OBJECT ${source})
    endif()
    target_link_libraries(${name} PRIVATE ${arg_LIBRARIES})
    target_precompile_headers(${name} PRIVATE ${edda_common_headers} ${arg_HEADERS})
  endif()
endfunction()

function(use_common_headers target name)
  if(EDDA_COMMON_HEADERS)
    target_precompile_headers(${target} REUSE_FROM ${name})
  endif()
endfunction()
