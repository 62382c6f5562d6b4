# The headers that nearly every source includes, compiled once and shared by clang. g++ 12 forgets that they are a system's
# and warns of what is in them; a compiler cache does better without.
set(EDDA_COMMON_HEADERS OFF)
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang" AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(EDDA_COMMON_HEADERS ON)
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
